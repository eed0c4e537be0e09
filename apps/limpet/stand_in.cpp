// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/stand_in.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/px4/airframe.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/model.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

struct StandInOptions {
    std::string what;
    px4::Px4Instance instance;
    std::optional<std::string> hil;
    std::optional<std::string> onboard;
    std::optional<std::string> peer;
    std::vector<std::string> parameters;
};

/// A vehicle flies as in the scenario `hover`.
scenario::Scenario scenario_of(const std::string& what) {
    return scenario::is_vehicle(what, scenario::data_root())
               ? scenario::load_scenario("hover", {.overrides = {"vehicle=" + what}})
               : scenario::load_scenario(what);
}

void set(const std::vector<BoundParameter>& rows, const std::string& text) {
    const std::size_t at = text.find('=');
    const std::string name = text.substr(0, at);
    const std::string value = at == std::string::npos ? "" : text.substr(at + 1);
    const BoundParameter* row = find_named(rows, name);
    if (row == nullptr) {
        throw InputError("--param " + text + ": no parameter of the stand-in is called '" + name +
                         "'");
    }
    const auto number = decimal(value);
    if (!number || !row->allows(*number)) {
        throw InputError("--param " + text + ": '" + value + "' is no value for it");
    }
    row->value.set(*number);
}

/// As `limpet px4-params` sets a PX4: else a perched vehicle may not arm.
void set_as_px4(const scenario::Scenario& scenario, px4::StandInParameters& parameters) {
    if (!scenario.airframe.has_cup) {
        return;
    }
    const std::vector<BoundParameter> rows = bind(px4::stand_in_table(), parameters);
    for (const px4::Px4Setting& setting : px4::px4_needs()) {
        if (const BoundParameter* row = find_named(rows, setting.name)) {
            row->value.set(setting.value);
        }
    }
}

void serve(const StandInOptions& options) {
    const scenario::Scenario scenario = scenario_of(options.what);
    autopilot::AutopilotModel model = simulation::autopilot_model(scenario);
    px4::StandInOptions stand_in;
    const px4::Px4Instance& instance = options.instance;
    stand_in.hil =
        address_of("--hil", options.hil, {wire::Medium::tcp, wire::Medium::serial}, instance.hil());
    stand_in.onboard =
        address_of("--onboard", options.onboard, {wire::Medium::udp}, instance.onboard());
    stand_in.onboard_peer =
        address_of("--peer", options.peer, {wire::Medium::udp}, instance.offboard());
    stand_in.system = instance.system();
    set_as_px4(scenario, stand_in.parameters);
    for (const std::string& text : options.parameters) {
        set(wire_parameters(stand_in.parameters, model.parameters), text);
    }
    px4::StandIn autopilot(std::move(model), stand_in);
    const std::atomic<bool>* stop = stop_on_signals();
    Terminal terminal(Terminal::Voice::normal);
    terminal.line(
        "the built-in autopilot behind PX4's wire: " + autopilot.hil().transport().describe() +
        (autopilot.onboard_address() ? ", onboard " + to_text(*autopilot.onboard_address()) : "") +
        "; Ctrl-C ends it");
    bool there = false;
    while (!*stop) {
        const bool now = autopilot.serve(std::chrono::milliseconds(100));
        if (now != there) {
            terminal.line(now ? "a simulator is there" : "no simulator; it goes on trying");
            there = now;
        }
    }
    terminal.line(fmt::format("{} HIL_SENSOR, {} answers", autopilot.count().sensors,
                              autopilot.count().answers));
    const std::string refused = text_of(autopilot.hil().count().refusals);
    if (!refused.empty()) {
        terminal.line(refused);
    }
}

OptionList options_of(StandInOptions& options) {
    return {{"what SCENARIO", &options.what, "scenario (name or file) or vehicle (name) to fly"},
            {"--instance N", &options.instance.number,
             "as `px4 -i N` (default 0): system N + 1, ports 4560 + N, 14580 + N,\n14540 + N",
             range(0, px4::Px4Instance::kMost, false)},
            {"--hil ADDRESS", &options.hil,
             "the simulator: tcp:HOST:PORT (connects, lockstep; default\n"
             "tcp:127.0.0.1:4560 + N) or serial:DEVICE:BAUD (as a board, real time)"},
            {"--onboard ADDRESS", &options.onboard,
             "where its onboard link listens (default udp:127.0.0.1:14580 + N)"},
            {"--peer ADDRESS", &options.peer,
             "first peer of the onboard link (default\nudp:127.0.0.1:14540 + N)"},
            {"--param NAME=VALUE", &options.parameters,
             "a parameter, NAME=VALUE; otherwise as px4-params sets it"}};
}

}  // namespace

Verb stand_in_verb() {
    return verb<StandInOptions>(
        "stand-in", "The built-in autopilot behind PX4's wire, in place of a PX4", options_of,
        serve,
        "In another terminal: limpet fly SCENARIO --autopilot px4\n"
        "It arms, refuses, lands and loses offboard control as PX4 v1.15 does.\n");
}

}  // namespace limpet::app
