// SPDX-License-Identifier: Apache-2.0
#include "px4_link.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"

namespace limpet::app {
namespace {

using Json = nlohmann::ordered_json;

/// A ground station's address on the network, as QGroundControl has it: PX4 tells it texts.
constexpr std::uint8_t kSimulatorSystem = 255;

std::unique_ptr<mavlink::Link> open(const std::string& address) {
    return std::make_unique<mavlink::Link>(
        open_transport(parse_address(address), Role::listen),
        mavlink::Sender{.system = kSimulatorSystem, .component = mavlink::kCompanionComponent});
}

void wait_for_peer(mavlink::Link& link, double wait_s, Terminal& terminal,
                   const std::atomic<bool>* stop) {
    using Clock = std::chrono::steady_clock;
    const std::string where = link.transport().describe();
    terminal.line("waiting for PX4 on " + where +
                  "; start it as `make px4_sitl none_iris`, with the parameters of\n"
                  "`limpet px4-params`; without a PX4 at hand: `limpet stand-in SCENARIO`");
    const Clock::time_point begin = Clock::now();
    while (!link.wait_for_peer(std::chrono::milliseconds(100))) {
        const double waited_s = std::chrono::duration<double>(Clock::now() - begin).count();
        terminal.progress(fmt::format("{:.0f} s of {:.0f}", waited_s, wait_s));
        if (stop != nullptr && *stop) {
            throw InputError("interrupted while waiting for PX4");
        }
        if (waited_s > wait_s) {
            throw InputError(
                fmt::format("no PX4 came to {} within {:.0f} s (--wait SECONDS); is it "
                            "running, as a simulation whose simulator is outside?",
                            where, wait_s));
        }
    }
}

std::string milliseconds(double duration_s) {
    return fmt::format("{:.3g} ms", 1e3 * duration_s);
}

std::string quantiles(const DurationHistogram& histogram) {
    return fmt::format("median {}, p99 {}, largest {}", milliseconds(histogram.quantile_s(0.5)),
                       milliseconds(histogram.quantile_s(0.99)),
                       milliseconds(histogram.largest_s()));
}

Json json_of(const DurationHistogram& histogram) {
    Json bins = Json::array();
    for (std::size_t k = 0; k < DurationHistogram::kBins; ++k) {
        if (histogram.bins()[k] > 0) {
            bins.push_back(
                {{"up_to_s", DurationHistogram::edge_s(k)}, {"count", histogram.bins()[k]}});
        }
    }
    return {{"count", histogram.count()},
            {"mean_s", histogram.mean_s()},
            {"median_s", histogram.quantile_s(0.5)},
            {"p99_s", histogram.quantile_s(0.99)},
            {"largest_s", histogram.largest_s()},
            {"bins", bins}};
}

Json json_of(const mavlink::Link& link) {
    const mavlink::LinkCount count = link.count();
    return {{"wire", link.transport().describe()},
            {"sent", count.sent},
            {"not_sent", count.not_sent},
            {"received", count.received},
            {"lost", count.lost},
            {"damaged", count.damaged},
            {"discarded_bytes", count.discarded_bytes}};
}

std::string line_of(const mavlink::Link& link) {
    const mavlink::LinkCount count = link.count();
    return fmt::format("{} sent, {} received, {} lost, {} damaged", count.sent, count.received,
                       count.lost, count.damaged);
}

}  // namespace

void add_options(CLI::App& verb, Px4LinkOptions& options, bool flies) {
    verb.add_option("--hil", options.hil,
                    "PX4's simulator link: tcp:HOST:PORT (we listen, lockstep; default\n"
                    "tcp:127.0.0.1:4560) or serial:DEVICE:BAUD (a board, real time)")
        ->type_name("ADDRESS");
    if (flies) {
        verb.add_option("--offboard", options.offboard,
                        "where PX4's onboard link comes in (default udp:127.0.0.1:14540; over\n"
                        "serial all goes over the one wire)")
            ->type_name("ADDRESS");
    }
    verb.add_option("--wait", options.wait_s, "longest wait for PX4 [s] (default 60)")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 86400.0));
}

double speed_of(const std::string& text, double by_default) {
    if (text.empty()) {
        return by_default;
    }
    if (text == "max") {
        return 0.0;
    }
    char* end = nullptr;
    const double speed = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !std::isfinite(speed) || speed < 0.01 ||
        speed > 1000.0) {
        throw InputError("--speed " + text + ": must be max or a number, 0.01 to 1000");
    }
    return speed;
}

Px4Link::Px4Link(const Px4LinkOptions& options, const SimulationModel& model, bool flies,
                 Terminal& terminal, const std::atomic<bool>* stop)
    : speed_(speed_of(options.speed, options.serial() ? 1.0 : 0.0)) {
    if (options.serial() && speed_ != 1.0) {
        throw InputError("--speed " + options.speed +
                         ": a board on a serial wire has its own "
                         "clock; there is 1 alone");
    }
    hil_ = open(options.hil);
    if (!options.serial() && flies) {
        offboard_ = open(options.offboard);
    }
    wait_for_peer(*hil_, options.wait_s, terminal, stop);
    Px4Options px4;
    px4.hil.timing =
        options.serial() ? mavlink::HilTiming::real_time : mavlink::HilTiming::lockstep;
    px4.hil.motion_capture = flies;
    px4.hil.stop = stop;
    px4.control_rate_Hz = model.control_rate_Hz;
    px4.flies = flies;
    px4.on_text = [&terminal](const std::string& text) {
        terminal.line(terminal.dim("          PX4: " + text));
    };
    autopilot_ =
        std::make_unique<Px4Autopilot>(*hil_, offboard_ ? *offboard_ : *hil_, std::move(px4));
}

std::vector<std::string> Px4Link::report(const FlightPerformance& performance,
                                         const Terminal& terminal) const {
    const mavlink::HilCount& count = autopilot_->count();
    std::vector<std::string> lines;
    const auto add = [&](const std::string& label, const std::string& text) {
        lines.push_back(terminal.bold(fmt::format("{:<11}", label)) + text);
    };
    add("hil", line_of(*hil_) + fmt::format("; {} sensors, {} answers, {} missed",
                                            count.sensors_sent, count.answers, count.unanswered));
    if (count.round_trip.count() > 0) {
        add("round trip", quantiles(count.round_trip));
    }
    if (count.send_jitter.count() > 0) {
        add("jitter", quantiles(count.send_jitter));
    }
    if (offboard_) {
        add("offboard", line_of(*offboard_));
    }
    if (performance.wall_s > 0.0 && count.send_jitter.count() == 0) {
        add("share", fmt::format("{:.1f} % of the wall time was the simulator's own, the rest "
                                 "PX4's",
                                 100.0 * (1.0 - performance.waited_s / performance.wall_s)));
    }
    return lines;
}

std::string Px4Link::json(const FlightPerformance& performance) const {
    const mavlink::HilCount& count = autopilot_->count();
    Json json = {{"hil", json_of(*hil_)}};
    json["hil"]["sensors"] = count.sensors_sent;
    json["hil"]["answers"] = count.answers;
    json["hil"]["unanswered"] = count.unanswered;
    json["hil"]["strays"] = count.strays;
    json["hil"]["round_trip"] = json_of(count.round_trip);
    json["hil"]["send_jitter"] = json_of(count.send_jitter);
    if (offboard_) {
        json["offboard"] = json_of(*offboard_);
    }
    json["wall_s"] = performance.wall_s;
    json["waited_for_autopilot_s"] = performance.waited_s;
    return json.dump(2);
}

}  // namespace limpet::app
