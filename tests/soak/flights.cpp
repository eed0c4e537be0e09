// SPDX-License-Identifier: Apache-2.0
//
// Flights with whatever is allowed, faults among it, one after the other in one process: each ends
// as what happened says, finite, and leaves no memory, descriptor or file behind.
//   soak_flights [--flights N] [--minutes M] [--seed S] [--only RUN]
// 0 if all held, 1 if something did not, with the command that flies it again.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest-spi.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "../simulation/drawn.hpp"
#include "../simulation/flown.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/fault_table.hpp"
#include "limpet/scenario/sections.hpp"

namespace limpet::simulation {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kScenarios = {
    "perch_concrete",      "perch_metal", "perch_metal_valve", "perch_cinder_block",
    "perch_turbine_blade", "hover",       "pendulum_concrete", "press_concrete"};
constexpr std::uint32_t kOnMujoco = 10;  ///< every so many
constexpr std::uint32_t kAgain = 100;
constexpr std::uint32_t kRecorded = 50;
constexpr std::uint32_t kLook = 1000;
constexpr long kMayGrow_kB = 32 * 1024;  ///< what the allocator keeps of the greatest flight yet

/// For every temporary file of this process, and gone with it.
class Folder {
public:
    Folder() : path_(fs::temp_directory_path() / fmt::format("limpet_soak_{}", getpid())) {
        fs::create_directories(path_);
        setenv("TMPDIR", path_.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

struct Asked {
    std::uint32_t flights = 1000;
    double minutes = 1e9;
    std::uint64_t seed = 1;
    long only = -1;
};

struct Drawn {
    std::string scenario;
    std::vector<std::string> overrides;
    std::uint64_t seed = 1;
    [[nodiscard]] std::string command() const {
        std::string text = fmt::format("limpet fly {} --seed {}", scenario, seed);
        for (const std::string& change : overrides) {
            text += fmt::format(" --set '{}'", change);
        }
        return text;
    }
};

template <class List>
auto any_of(const List& list, RandomStream& random) {
    return list[static_cast<std::size_t>(random.uniform() * static_cast<double>(std::size(list)))];
}

/// Legal by its own row, at some time of a flight.
faults::Fault any_fault(RandomStream& random) {
    constexpr double kFlight_s = 30.0;
    const auto& kinds = kNamesOf<faults::FaultKind>;
    const std::string_view name = any_of(kinds, random);
    faults::Fault fault{.kind = *enumerator_of<faults::FaultKind>(name)};
    const faults::KindRow& row = kind_row(fault.kind);
    if (row.units != 0) {
        const int units = row.units == faults::kRotors ? 4 : row.units;
        fault.unit = static_cast<int>(random.uniform() * units);
    }
    fault.size = row.size_min + (row.size_max - row.size_min) * random.uniform();
    if (random.uniform() < 0.7) {
        fault.phase = enumerator_of<guidance::PerchingState>(
            any_of(kNamesOf<guidance::PerchingState>, random));
        fault.after_s = 3.0 * random.uniform();
    } else {
        fault.after_s = kFlight_s * random.uniform();
    }
    if (random.uniform() < 0.5) {
        fault.for_s = 5.0 * random.uniform();
    }
    return fault;
}

/// Every number nearby, a few ways of flying anywhere in their range, up to three faults; each of
/// the three or not.
Drawn draw(std::uint64_t seed, std::uint32_t run) {
    RandomStream random(seed, run, Stream::test);
    Drawn drawn_one{.scenario = any_of(kScenarios, random),
                    .overrides = {},
                    .seed = static_cast<std::uint64_t>(1e6 * random.uniform())};
    const bool all_nearby = random.uniform() < 0.5;
    scenario::Scenario scenario = scenario::load_scenario(drawn_one.scenario);
    std::vector<std::string> all;
    for (const scenario::Section& section : scenario_sections(scenario)) {
        for (const BoundParameter& row : section.rows) {
            const auto change = [&](double value) {
                return fmt::format("{}.{}={:.17g}", section.name, row.name, value);
            };
            if (is_drawn(section.name, row)) {
                all.push_back(change(drawn(row, random)));
            }
            // Some are said by a list as well, or must divide each other.
            if (all_nearby && !row.value.is_whole() && !row.value.is_switch() &&
                row.value.get() != 0.0 && row.name != "height_m" && section.name != "simulation") {
                drawn_one.overrides.push_back(change(drawn_nearby(row, random)));
            }
        }
    }
    const auto few = static_cast<int>(6.0 * random.uniform());
    for (int k = 0; k < few; ++k) {
        drawn_one.overrides.push_back(any_of(all, random));
    }
    std::vector<std::string> faults;
    const auto count = static_cast<int>(4.0 * random.uniform());
    for (int k = 0; k < count; ++k) {
        faults.push_back(scenario::fault_text(any_fault(random)));
    }
    if (!faults.empty()) {
        drawn_one.overrides.push_back(fmt::format("faults=[{}]", fmt::join(faults, ", ")));
    }
    if (run % kOnMujoco == kOnMujoco - 1) {
        drawn_one.overrides.emplace_back("simulation.engine=mujoco");
    }
    return drawn_one;
}

/// What a finite flight's truth is made of.
bool is_finite(const Truth& truth) {
    const auto finite = [](const Kinematics& part) {
        return part.p_WF_m.allFinite() && part.q_WF.coeffs().allFinite() &&
               part.v_WF_W_m_s.allFinite();
    };
    return finite(truth.base) && finite(truth.cup) && std::isfinite(truth.thrust_N) &&
           truth.legs_force_W_N.allFinite();
}

/// @return what did not hold; empty: all did
std::string wrong_with(const Trace& flight) {
    for (const Truth& truth : flight.truth) {
        if (!is_finite(truth)) {
            return fmt::format("not finite at {:.3f} s", truth.time_s);
        }
    }
    for (const MetricInfo& metric : metric_table()) {
        if (std::isinf(flight.result.metrics.*metric.field)) {  // NaN: did not come to pass
            return fmt::format("{} is infinite", metric.name);
        }
    }
    return "";
}

struct Soak {
    Asked asked;
    Folder folder;
    std::map<std::string, int> outcomes;
    int failures = 0;
    std::uint32_t flown = 0, mujoco = 0, again = 0, recorded = 0;

    void fail(std::uint32_t run, const Drawn& drawn_one, const std::string& what) {
        ++failures;
        fmt::print("FAILED run {}: {}\n  soak_flights --seed {} --only {}\n  {}\n", run, what,
                   asked.seed, run, drawn_one.command());
    }
    void fly(std::uint32_t run) {
        const Drawn one = draw(asked.seed, run);
        testing::TestPartResultArray broken;
        std::string what;
        try {
            const testing::ScopedFakeTestPartResultReporter reporter(
                testing::ScopedFakeTestPartResultReporter::INTERCEPT_ALL_THREADS, &broken);
            const auto model = model_of(one.scenario, one.overrides, one.seed);
            const Trace flight = trace(model);
            ++outcomes[std::string(to_string(flight.result.outcome))];
            mujoco += run % kOnMujoco == kOnMujoco - 1 ? 1U : 0U;
            what = wrong_with(flight);
            if (const std::uint32_t nth = flown++; nth % kRecorded == 0) {
                // The same again; recorded every other time.
                const bool record = nth % kAgain != 0;
                const fs::path file = record ? folder.path() / "flight.mcap" : fs::path();
                const FlightResult second = simulation::fly(model, file);
                (record ? recorded : again) += 1U;
                if (second.state_hash != flight.result.state_hash) {
                    what = "flown again it is another flight";
                }
                if (record) {
                    fs::remove(file);
                }
            }
        } catch (const InputError& error) {
            ++outcomes["refused"];
            const std::string line = error.what();
            if (line.empty() || line.find('\n') != line.npos) {
                what = "a refusal that is not one line: " + line;
            }
        } catch (const std::exception& error) {
            what = std::string("an exception: ") + error.what();
        }
        for (int k = 0; k < broken.size(); ++k) {
            what += fmt::format("{}:{} {}; ", broken.GetTestPartResult(k).file_name(),
                                broken.GetTestPartResult(k).line_number(),
                                broken.GetTestPartResult(k).message());
        }
        if (!what.empty()) {
            fail(run, one, what);
        }
    }
};

/// Of this process.
struct Held {
    long memory_kB = 0;
    long descriptors = 0;
    long files = 0;
};
Held held(const fs::path& folder) {
    Held now;
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> pages;
    now.memory_kB = pages * sysconf(_SC_PAGESIZE) / 1024;
    now.descriptors = std::distance(fs::directory_iterator("/proc/self/fd"), {});
    now.files = std::distance(fs::directory_iterator(folder), {});
    return now;
}

int soak(const Asked& asked) {
    Soak soak{.asked = asked, .folder = {}, .outcomes = {}};
    if (asked.only >= 0) {
        const auto run = static_cast<std::uint32_t>(asked.only);
        fmt::print("{}\n", draw(asked.seed, run).command());
        soak.fly(run);
        fmt::print("{}\n", soak.outcomes);
        return soak.failures == 0 ? 0 : 1;
    }
    const auto began = std::chrono::steady_clock::now();
    const auto minutes = [&began] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() / 60;
    };
    Held settled;
    std::uint32_t run = 0;
    const auto done = [&] {
        return std::max(static_cast<double>(run) / asked.flights, minutes() / asked.minutes);
    };
    const auto tell = [&] {
        const Held now = held(soak.folder.path());
        fmt::print("{} flights, {:.1f} min, {} kB, {} descriptors, {} files, {} failures, {}\n",
                   run, minutes(), now.memory_kB, now.descriptors, now.files, soak.failures,
                   soak.outcomes);
        std::fflush(stdout);
    };
    while (done() < 1.0) {
        soak.fly(run++);
        if (settled.memory_kB == 0 && done() >= 0.05) {
            settled = held(soak.folder.path());
        }
        if (run % kLook == 0) {
            tell();
        }
    }
    tell();
    const Held last = held(soak.folder.path());
    fmt::print(
        "on MuJoCo {}, flown again {}, recorded {}; since the first 5 %: {:+} kB, {:+} "
        "descriptors, {:+} files\n",
        soak.mujoco, soak.again, soak.recorded, last.memory_kB - settled.memory_kB,
        last.descriptors - settled.descriptors, last.files - settled.files);
    if (last.memory_kB > settled.memory_kB + kMayGrow_kB ||
        last.descriptors != settled.descriptors || last.files != settled.files) {
        fmt::print("FAILED: something is left behind: soak_flights --seed {} --flights {}\n",
                   asked.seed, run);
        return 1;
    }
    return soak.failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace limpet::simulation

int main(int argc, char** argv) {
    limpet::simulation::Asked asked;
    for (int k = 1; k + 1 < argc; k += 2) {
        const std::string key = argv[k];
        const double value = std::atof(argv[k + 1]);
        if (key == "--flights" && value >= 1) {
            asked.flights = static_cast<std::uint32_t>(value);
        } else if (key == "--minutes" && value > 0) {
            asked.minutes = value;
            asked.flights = UINT32_MAX;
        } else if (key == "--seed") {
            asked.seed = std::strtoull(argv[k + 1], nullptr, 10);
        } else if (key == "--only") {
            asked.only = static_cast<long>(value);
        } else {
            argc = 0;
        }
    }
    if (argc % 2 == 0) {
        fmt::print(stderr, "soak_flights [--flights N] [--minutes M] [--seed S] [--only RUN]\n");
        return 2;
    }
    testing::InitGoogleTest();
    return limpet::simulation::soak(asked);
}
