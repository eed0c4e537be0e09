// SPDX-License-Identifier: Apache-2.0
#include "px4_link.hpp"

#include <fmt/format.h>

#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/simulation/px4_setup.hpp"

namespace limpet::app {
namespace {

px4::Px4Addresses addresses_of(const Px4LinkOptions& options, const scenario::Scenario& scenario) {
    const px4::Px4Instance& instance = options.instance;
    px4::Px4Addresses addresses = simulation::px4_addresses(scenario, instance);
    addresses.hil =
        address_of("--hil", options.hil, {wire::Medium::tcp, wire::Medium::serial}, instance.hil());
    addresses.offboard =
        address_of("--offboard", options.offboard, {wire::Medium::udp}, instance.offboard());
    addresses.wait_s = options.wait_s;
    addresses.patience_s = options.patience_s;
    addresses.only_px4 = options.only_px4;
    return addresses;
}

/// How to start what is waited for, to be copied.
void print_start_commands(const Px4LinkOptions& options, const scenario::Scenario& flown,
                          Terminal& terminal) {
    const std::string& scenario = flown.name;
    if (options.serial()) {
        terminal.line("a board: with the parameters of `limpet px4-params " + scenario +
                      " --target hitl`");
        return;
    }
    const auto if_given = [](const char* option, const std::optional<std::string>& text) {
        return text ? fmt::format(" {} {}", option, *text) : std::string();
    };
    const auto number = options.instance.number == 0
                            ? std::nullopt
                            : std::optional(std::to_string(options.instance.number));
    terminal.line(
        fmt::format("PX4, in its tree:      PX4_SYS_AUTOSTART={} build/px4_sitl_default/bin/px4 -d",
                    px4::px4_airframe_id(flown.airframe.name)) +
        if_given("-i", number));
    terminal.line("                       (its airframe: limpet px4-params " + scenario +
                  "; docs/px4.md)");
    terminal.line("without a PX4 at hand: limpet stand-in " + scenario +
                  if_given("--instance", number) + if_given("--hil", options.hil) +
                  if_given("--peer", options.offboard));
}

}  // namespace

Option px4_start_option(std::optional<std::string>& start) {
    return {"--px4 BUILD", &start,
            "starts it: the folder of a PX4 built for simulation, which flies\n"
            "with the parameters that px4-params would write; or a command,\n"
            "{instance} and {folder} in it: 'my_px4 -i {instance} -w {folder}'"};
}

OptionList options_of(Px4LinkOptions& options, bool flies) {
    OptionList list = {
        {"--instance N", &options.instance.number,
         "PX4's, as in `px4 -i N` (default 0): system N + 1, ports 4560 + N and\n14540 + N",
         range(0, px4::Px4Instance::kMost, false)},
        {"--hil ADDRESS", &options.hil,
         "PX4's simulator link: tcp:HOST:PORT (we listen, lockstep; default\n"
         "tcp:127.0.0.1:4560 + N) or serial:DEVICE:BAUD (a board, real time)"}};
    if (flies) {
        list.push_back({"--offboard ADDRESS", &options.offboard,
                        "where PX4's onboard link comes in (default udp:127.0.0.1:14540 + N;\n"
                        "over serial all goes over the one wire)"});
        list.push_back({"--only-px4", &options.only_px4,
                        "no flight when the stand-in answers instead of a PX4"});
    }
    list.push_back(px4_start_option(options.start));
    list.push_back({"--wait SECONDS", &options.wait_s,
                    "longest wait for PX4 and its first answer [s] (default 60)",
                    range(0.1, 86400.0, false)});
    list.push_back({"--patience SECONDS", &options.patience_s,
                    "in lockstep, longest wait for PX4's next answer [s] (default 5);\n"
                    "more for one that a debugger stops",
                    range(0.1, 86400.0, false)});
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
    const auto speed = decimal(text);
    if (!speed || *speed < 0.01 || *speed > 1000.0) {
        throw InputError("--speed " + text + ": must be max or a number, 0.01 to 1000");
    }
    return *speed;
}

void check(const Px4LinkOptions& options, const scenario::Scenario& scenario) {
    (void)addresses_of(options, scenario);
    const double speed = speed_of(options.speed, 1.0);
    if (options.serial() && speed != 1.0) {
        throw InputError("--speed " + options.speed +
                         ": a board on a serial wire runs in real time; only 1 is possible");
    }
    if (options.start && options.serial()) {
        throw InputError("--px4: a board on a serial wire runs by itself");
    }
    if (scenario.mount != vehicle::Mount::free) {
        throw InputError(scenario.name + ": hangs on a mount; a PX4 is for what flies");
    }
}

Px4Link::Px4Link(const Px4LinkOptions& options, const simulation::FlightModel& model, bool flies,
                 const std::filesystem::path& folder, Terminal& terminal,
                 const std::atomic<bool>* stop)
    : folder_(folder), speed_(speed_of(options.speed, options.serial() ? 1.0 : 0.0)) {
    if (options.start) {
        process_.emplace(*options.start, simulation::px4_airframe(*model.scenario),
                         options.instance);
    }
    if (options.record_wire) {
        wire_log_ = std::make_unique<simulation::WireLog>(folder / "wire.mcap");
    }
    px4::Px4WireWatch watch{
        .on_open =
            [&](const std::string& where) {
                terminal.line("waiting for PX4 on " + where);
                if (process_) {
                    terminal.line("started " + process_->command());
                    if (!process_->left_out().empty()) {
                        terminal.line("note", fmt::format("this PX4 has no {}: left out",
                                                          fmt::join(process_->left_out(), ", ")));
                    }
                } else {
                    print_start_commands(options, *model.scenario, terminal);
                }
            },
        .on_wait =
            [&](double waited_s) {
                if (process_) {
                    process_->require_running();
                }
                terminal.progress(fmt::format("{:.0f} s of {:.0f}", waited_s, options.wait_s));
            },
        .on_text =
            [&terminal](const std::string& text) {
                terminal.line(terminal.dim("          PX4: " + text));
            },
        .on_difference =
            [this, &terminal](const std::vector<mavlink::ParameterDifference>& found) {
                for (const mavlink::ParameterDifference& difference : found) {
                    differences_.push_back(text_of(difference));
                }
                const char* head = "parameters";
                for (const std::string& line : lines_of(found)) {
                    terminal.line(std::exchange(head, ""), line);
                }
            },
        .wait_key = "--wait SECONDS"};
    if (wire_log_) {
        watch.tap = [this](auto wire) { return tapped(std::move(wire), *wire_log_); };
    }
    try {
        px4::Px4Addresses addresses = addresses_of(options, *model.scenario);
        if (flies) {
            px4::Px4Airframe airframe = simulation::px4_airframe(*model.scenario);
            airframe.target = options.serial() ? px4::Px4Target::hitl : px4::Px4Target::sitl;
            addresses.expected = px4::expected_parameters(
                airframe, process_ ? process_->left_out() : std::vector<std::string>());
        }
        wires_.emplace(addresses, model.control_rate_Hz, flies, watch, stop);
    } catch (...) {
        std::error_code ignored;  // a wire on which nothing went is no log
        std::filesystem::remove(folder / "wire.mcap.part", ignored);
        (void)keep_logs(folder_);
        throw;
    }
}

std::vector<std::filesystem::path> Px4Link::keep_logs(const std::filesystem::path& folder) {
    if (!process_ || folder.empty() || std::exchange(kept_, true)) {
        return {};
    }
    try {
        return process_->keep(folder);
    } catch (const InputError& error) {  // a full disk: the flight itself is reported all the same
        complain(error.what());
        return {};
    }
}

Px4Link::~Px4Link() {
    (void)keep_logs(folder_);
    if (wire_log_ && wires_ && !wire_finished_) {
        try {
            wire_log_->finish();  // what led to no flight is what one wants to see
        } catch (const InputError&) {
            return;  // a full disk: the first error is the one to report
        }
    }
}

std::vector<std::pair<const char*, const mavlink::Link*>> Px4Link::links() const {
    std::vector<std::pair<const char*, const mavlink::Link*>> links = {{"hil", &wires_->hil()}};
    if (wires_->offboard() != nullptr) {
        links.emplace_back("offboard", wires_->offboard());
    }
    return links;
}

}  // namespace limpet::app
