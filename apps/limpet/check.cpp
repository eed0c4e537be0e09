// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "command_line.hpp"
#include "limpet/campaign/campaign.hpp"
#include "limpet/companion/config.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/file_kind.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/flight_data.hpp"
#include "limpet/identification/propeller_file.hpp"
#include "limpet/identification/suspicion.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/remarks/remarks.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "limpet/simulation/flight.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/wire_log.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

namespace fs = std::filesystem;

std::string text_of(const simulation::WireTally::Way& way) {
    std::vector<std::string> parts;
    for (const auto& [name, count] : way.messages) {
        parts.push_back(fmt::format("{} {}", name, count));
    }
    const mavlink::LinkStatistics& seen = way.statistics;
    for (const auto& [what, count] :
         {std::pair("of another kind", seen.unknown), std::pair("lost", seen.lost),
          std::pair("with a wrong checksum", seen.bad_checksum),
          std::pair("bytes of no message", seen.discarded_bytes)}) {
        if (count > 0) {
            parts.push_back(fmt::format("{} {}", count, what));
        }
    }
    return parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, ", "));
}

/// @return false: it is a recording of another kind
bool check_wire(const std::string& file) {
    const auto wire = simulation::read_wire_log(file);
    if (!wire) {
        return false;
    }
    if (!wire->damage.empty()) {
        throw InputError(file + ": " + wire->damage);
    }
    fmt::print("{}: a whole recording of a wire, {:.1f} s\n  sent      {}\n  received  {}\n", file,
               wire->lasted_s, text_of(wire->sent), text_of(wire->received));
    return true;
}

/// @param notes  more lines, which are no remarks
void print_verdict(const std::string& verdict, const std::vector<std::string>& remarks,
                   const std::vector<std::string>& notes = {}) {
    const std::size_t count = remarks.size();
    fmt::print("{}{}\n", verdict,
               count == 0 ? "" : fmt::format("; {} remark{}", count, count == 1 ? "" : "s"));
    for (const std::string& note : notes) {
        fmt::print("  {}\n", note);
    }
    for (const std::string& remark : remarks) {
        fmt::print("  remark: {}\n", remark);
    }
}

void check_recording(const std::string& file) {
    if (check_wire(file)) {
        return;
    }
    const record::Recording recording = record::read_recording(file);
    if (!recording.damage.empty()) {
        throw InputError(file + ": " + recording.damage);
    }
    const auto counted_of = [](std::size_t count, const char* what) {
        return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
    };
    print_verdict(fmt::format("{}: a whole recording, {}, {}", file,
                              counted_of(recording.tables.size(), "topic"),
                              counted_of(recording.events.size(), "event")),
                  {}, recording.remarks);
}

/// What is checked, and how its user calls it: by a name or by its file.
struct Checked {
    std::string name;
    fs::path file;
};

void check_scenario(const Checked& it) {
    const scenario::Scenario scenario = scenario::load_scenario(it.file.string());
    (void)simulation::build_model(scenario);  // the plant compiles it as well
    std::vector<std::string> notes;
    for (const remarks::Note& note : remarks::notes_of(scenario)) {
        if (!note.warns) {
            notes.push_back(note.text);
        }
    }
    print_verdict(fmt::format("{}: a good scenario{}{}", it.name,
                              scenario.description.empty() ? "" : ": ", scenario.description),
                  remarks::warnings(scenario), notes);
}

/// Why a vehicle does not hover in still air for some seconds; empty: it does.
std::string why_it_does_not_hover(const scenario::Scenario& hover) {
    constexpr double kDrift_m = 0.5, kTilt_deg = 20.0;
    simulation::Flight flight(simulation::build_model(hover));
    const Vector3 from_W_m = flight.state().truth.base.p_WF_m;
    double most_m = 0.0, most_rad = 0.0;
    while (!flight.ended()) {
        flight.tick();
        const Kinematics& base = flight.state().truth.base;
        most_m = std::max(most_m, (base.p_WF_m - from_W_m).norm());
        const Vector3 down_B = base.q_WF.conjugate() * Vector3::UnitZ();
        most_rad = std::max(most_rad, std::acos(std::clamp(down_B.z(), -1.0, 1.0)));
    }
    const guidance::Ending& ending = *flight.state().ending;
    if (ending.outcome != Outcome::released) {
        return fmt::format("ends {}: {}", to_string(ending.outcome), ending.reason.view());
    }
    if (most_m > kDrift_m || degrees(most_rad) > kTilt_deg) {
        return fmt::format("goes up to {:.2g} m astray and tilts up to {:.2g} deg", most_m,
                           degrees(most_rad));
    }
    return {};
}

void check_vehicle(const Checked& it) {
    const std::string file = it.file.string();
    const double mass_kg = scenario::load_vehicle(file, scenario::data_root()).mass_kg;
    const std::string path = in_yaml(fs::absolute(file).string());
    scenario::Scenario hover;
    try {
        hover = scenario::load_scenario_text(
            "vehicle: " + path + "\nmission: hover\nsimulation: {hover_s: 4}\n", file);
    } catch (const InputError& error) {  // of a text that is made here
        const std::string why = error.what(), where = file + ":1: vehicle";
        throw InputError(why.starts_with(where) ? file + why.substr(where.size()) : why);
    }
    const std::vector<std::string> warnings = remarks::warnings(hover);
    if (const std::string why = why_it_does_not_hover(hover); !why.empty()) {
        throw InputError(
            fmt::format("{}: does not hover: flown by mission hover in still air it {}{}{}",
                        it.name, why, warnings.empty() ? "" : "; ", fmt::join(warnings, "; ")));
    }
    print_verdict(fmt::format("{}: a good vehicle of {:.2f} kg", it.name, mass_kg), warnings);
}

void check_campaign(const Checked& it) {
    const campaign::Campaign campaign = campaign::load_campaign(it.file.string());
    std::vector<std::string> remarks = {campaign::uneven_runs(campaign.keys, campaign.runs)};
    std::erase(remarks, "");
    print_verdict(fmt::format("{}: a good campaign: {} runs of {}", it.name, campaign.runs,
                              campaign.scenario_name),
                  remarks);
}

void check_companion(const Checked& it) {
    (void)companion::load_companion(it.file.string(), {});
    fmt::print("{}: a good companion; what it would do: limpet companion {} --check\n", it.name,
               it.name);
}

void check_surfaces(const fs::path& file) {
    const fs::path root = fs::absolute(file).parent_path();
    fmt::print("{}: {} surfaces, all good\n", file.string(), scenario::load_surfaces(root).size());
}

void check_surface(const Checked& it) {
    const scenario::Surface surface = scenario::load_surface(it.name, it.file.parent_path());
    fmt::print("{}: a good surface: {}\n", it.name, surface.description);
}

void check_propeller(const Checked& it) {
    fmt::print("{}: a good propeller file of {} rows\n", it.name,
               identification::read_propeller_file(it.file).size());
}

/// Units that differ from the header's.
std::vector<std::string> log_remarks(const identification::FlightData& log) {
    std::vector<std::string> remarks = {
        identification::suspected_pressure_unit(log.pressure.pressure_Pa, kAtmosphere_Pa),
        identification::suspected_time_unit(log.pressure.t_s)};
    std::erase(remarks, "");
    return remarks;
}

void check_log(const Checked& it) {
    const identification::FlightData log = identification::read_flight(it.file);
    if (!log.damage.empty()) {
        throw InputError(it.name + ": " + log.damage);
    }
    std::vector<std::string> parts;
    for (const auto& [what, count] :
         {std::pair("pressure", log.pressure.t_s.size()), std::pair("gyro", log.imu_s.size()),
          std::pair("motor commands", log.command_s.size()),
          std::pair("velocity", log.velocity_s.size()), std::pair("force", log.force_s.size())}) {
        if (count > 0) {
            parts.push_back(fmt::format("{} {}", what, count));
        }
    }
    if (parts.empty()) {
        throw InputError(
            fmt::format("{}: a log ({}) without pressure, gyro, motor commands, "
                        "velocity or force: nothing to identify or calibrate by",
                        it.name, log.kind));
    }
    print_verdict(
        fmt::format("{}: a good log ({}), samples: {}", it.name, log.kind, fmt::join(parts, ", ")),
        log_remarks(log), log.remarks);
}

void check_yaml(const Checked& it) {
    switch (scenario::kind_of(it.file)) {
        case scenario::FileKind::scenario: check_scenario(it); break;
        case scenario::FileKind::vehicle: check_vehicle(it); break;
        case scenario::FileKind::campaign: check_campaign(it); break;
        case scenario::FileKind::companion: check_companion(it); break;
    }
}

/// By how its name ends, and YAML by what is in it.
void check_file(const Checked& it) {
    const std::string ending = it.file.extension().string();
    if (is_recording_name(it.file)) {
        check_recording(it.file.string());
    } else if (ending == ".txt" ||
               (ending == ".csv" && identification::is_propeller_file(it.file))) {
        check_propeller(it);
    } else if (ending == ".csv" || ending == ".ulg") {
        check_log(it);
    } else if (it.file.filename() == "surfaces.yaml") {
        check_surfaces(it.file);
    } else {
        check_yaml(it);
    }
}

/// Something of the data that goes by a name.
struct Entry {
    std::string kind;
    std::string name;
    fs::path file;
    void (*check)(const Checked&);
};

std::vector<Entry> all_entries() {
    constexpr struct {
        const char* kind;
        const char* folder;
        void (*check)(const Checked&);
    } kFolders[] = {{"scenario", "scenarios", check_scenario},
                    {"vehicle", "vehicles", check_vehicle},
                    {"campaign", "campaigns", check_campaign},
                    {"companion", "companions", check_companion}};
    const fs::path root = scenario::data_root();
    std::vector<Entry> entries;
    for (const auto& [kind, folder, check] : kFolders) {
        for (const std::string& name : scenario::names_in(root / folder)) {
            entries.push_back({kind, name, root / folder / (name + ".yaml"), check});
        }
    }
    for (const scenario::CatalogueEntry& surface : scenario::list_surfaces(root)) {
        entries.push_back({"surface", surface.name, root / "surfaces.yaml", check_surface});
    }
    for (const scenario::CatalogueEntry& sample : scenario::list_samples(root)) {
        entries.push_back(
            {"sample", sample.name, scenario::find_sample(sample.name, {}), check_file});
    }
    return entries;
}

/// A name is looked for wherever a verb would; then it is a file, as elsewhere.
void check_name(const std::string& name) {
    std::vector<Entry> all = all_entries(), found;
    std::copy_if(all.begin(), all.end(), std::back_inserter(found),
                 [&](const Entry& entry) { return entry.name == name; });
    if (found.size() == 1) {
        found.front().check({name, found.front().file});
    } else if (found.size() > 1) {
        throw InputError(fmt::format("{}: is a {} and a {}; give {} or {}", in_quotes(name),
                                     found[0].kind, found[1].kind, found[0].file.string(),
                                     found[1].file.string()));
    } else if (!name.empty() && is_there(name)) {
        check_file({name, name});
    } else {
        std::vector<std::string_view> names;
        for (const Entry& entry : all) {
            names.push_back(entry.name);
        }
        throw InputError(
            in_quotes(name) +
            ": no such file, scenario, vehicle, campaign, companion, surface or sample" +
            scenario::hint(name, names, "limpet list KIND lists them"));
    }
}

void check_wanted(const std::string& wanted) {
    const fs::path path(wanted);
    const std::string ending = path.extension().string();
    const bool file = scenario::is_path(wanted) || is_recording_name(path) || ending == ".csv" ||
                      ending == ".ulg" || ending == ".txt";
    if (file && path.parent_path() == "samples") {  // as pages print it, from any folder
        check_file({wanted, scenario::find_sample(wanted, {})});
    } else if (file) {
        check_file({wanted, path});
    } else {
        check_name(wanted);
    }
}

OptionList file_option(std::string& wanted) {
    return {{"name NAME|FILE", &wanted,
             "name of a scenario, vehicle, campaign, companion, surface or sample;\n"
             "or a file of one, known by what is in it; *.mcap, *.ulg, *.csv"}};
}

}  // namespace

Verb check_verb() {
    return verb<std::string>(
        "check", "Check a file, or what has a name: scenario, vehicle, log, recording", file_option,
        check_wanted, "Exits with 0 when all is good, 2 when not.\n");
}

}  // namespace limpet::app
