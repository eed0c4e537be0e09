// SPDX-License-Identifier: Apache-2.0
#include "px4_link.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/interrupted.hpp"
#include "options.hpp"

namespace limpet::app {
namespace {

/// A ground station's address on the network, as QGroundControl has it: PX4 tells it texts.
constexpr std::uint8_t kSimulatorSystem = 255;

TransportAddress hil_address(const Px4LinkOptions& options) {
    return address_of("--hil", options.hil, {Medium::tcp, Medium::serial});
}

TransportAddress offboard_address(const Px4LinkOptions& options) {
    return address_of("--offboard", options.offboard, {Medium::udp});
}

std::unique_ptr<mavlink::Link> open(const TransportAddress& address, WireLog* log = nullptr) {
    auto wire = open_transport(address, Role::listen);
    return std::make_unique<mavlink::Link>(
        log != nullptr ? tapped(std::move(wire), *log) : std::move(wire),
        mavlink::Sender{.system = kSimulatorSystem, .component = mavlink::kCompanionComponent});
}

/// How to start what is waited for, to be copied.
void say_how(const Px4LinkOptions& options, const std::string& scenario, Terminal& terminal) {
    if (options.serial()) {
        terminal.line("a board: with the parameters of `limpet px4-params " + scenario +
                      " --target hitl`");
        return;
    }
    const Px4LinkOptions by_default;
    const auto unless_default = [](const char* option, const std::string& text,
                                   const std::string& usual) {
        return text == usual ? std::string() : fmt::format(" {} {}", option, text);
    };
    terminal.line(
        "PX4, in its tree:      PX4_SYS_AUTOSTART=22001 build/px4_sitl_default/bin/px4 -d");
    terminal.line("                       (its airframe: limpet px4-params " + scenario +
                  "; docs/px4.md)");
    terminal.line("without a PX4 at hand: limpet stand-in " + scenario +
                  unless_default("--hil", options.hil, by_default.hil) +
                  unless_default("--peer", options.offboard, by_default.offboard));
}

void wait_for_peer(mavlink::Link& link, double wait_s, Terminal& terminal,
                   const std::atomic<bool>* stop) {
    using Clock = std::chrono::steady_clock;
    const std::string where = link.transport().describe();
    const Clock::time_point begin = Clock::now();
    while (!link.wait_for_peer(std::chrono::milliseconds(100))) {
        const double waited_s = std::chrono::duration<double>(Clock::now() - begin).count();
        terminal.progress(fmt::format("{:.0f} s of {:.0f}", waited_s, wait_s));
        if (stop != nullptr && *stop) {
            throw Interrupted("interrupted while waiting for PX4");
        }
        if (waited_s > wait_s) {
            throw InputError(
                fmt::format("no PX4 came to {} within {:g} s (--wait SECONDS)", where, wait_s));
        }
    }
}

}  // namespace

OptionList options_of(Px4LinkOptions& options, bool flies) {
    OptionList list = {{"--hil", &options.hil,
                        "PX4's simulator link: tcp:HOST:PORT (we listen, lockstep; default\n"
                        "tcp:127.0.0.1:4560) or serial:DEVICE:BAUD (a board, real time)",
                        "ADDRESS"}};
    if (flies) {
        list.push_back({"--offboard", &options.offboard,
                        "where PX4's onboard link comes in (default udp:127.0.0.1:14540; over\n"
                        "serial all goes over the one wire)",
                        "ADDRESS"});
    }
    list.push_back({"--wait",
                    &options.wait_s,
                    "longest wait for PX4 [s] (default 60)",
                    "SECONDS",
                    {.range = {{0.1, 86400.0}}, .told = false}});
    list.push_back({"--record-wire", &options.record_wire,
                    "write every byte of the simulator link as well, into wire.mcap"});
    return list;
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

void check(const Px4LinkOptions& options, const Scenario& scenario) {
    (void)hil_address(options);
    (void)offboard_address(options);
    const double speed = speed_of(options.speed, 1.0);
    if (options.serial() && speed != 1.0) {
        throw InputError("--speed " + options.speed +
                         ": a board on a serial wire has its own clock; there is 1 alone");
    }
    if (scenario.mount != Mount::free) {
        throw InputError(scenario.name + ": hangs on a mount; a PX4 is for what flies");
    }
}

Px4Link::Px4Link(const Px4LinkOptions& options, const FlightModel& model, bool flies,
                 const std::filesystem::path& folder, Terminal& terminal,
                 const std::atomic<bool>* stop)
    : speed_(speed_of(options.speed, options.serial() ? 1.0 : 0.0)) {
    const TransportAddress hil = hil_address(options);
    if (!options.serial() && flies) {
        offboard_ = open(offboard_address(options));
    }
    if (options.record_wire) {
        wire_log_ = std::make_unique<WireLog>(folder / "wire.mcap");
    }
    try {
        hil_ = open(hil, wire_log_.get());
        terminal.line("waiting for PX4 on " + hil_->transport().describe());
        say_how(options, model.scenario->name, terminal);
        wait_for_peer(*hil_, options.wait_s, terminal, stop);
    } catch (...) {
        std::error_code ignored;  // a wire on which nothing went is no log
        std::filesystem::remove(folder / "wire.mcap.part", ignored);
        throw;
    }
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

Px4Link::~Px4Link() {
    if (wire_log_ && autopilot_ && !wire_finished_) {
        try {
            wire_log_->finish();  // what led to no flight is what one wants to see
        } catch (const InputError&) {
            return;  // a full disk: the error that is on its way tells more
        }
    }
}

std::filesystem::path Px4Link::finish_wire_log() {
    if (!wire_log_) {
        return {};
    }
    wire_finished_ = true;
    wire_log_->finish();
    return wire_log_->path();
}

LinkReport Px4Link::report(const FlightPerformance& performance) const {
    LinkReport report;
    report.hil = autopilot_->count();
    report.wires.emplace_back("hil", *hil_);
    if (offboard_) {
        report.wires.emplace_back("offboard", *offboard_);
    }
    report.wall_s = performance.wall_s;
    report.waited_s = performance.waited_s;
    report.held_back = speed_ > 0.0;
    return report;
}

}  // namespace limpet::app
