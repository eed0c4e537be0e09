// SPDX-License-Identifier: Apache-2.0
#include "ground_station.hpp"

#include <fmt/core.h>

#include <sstream>

#include "limpet/core/errors.hpp"
#include "limpet/core/version.hpp"
#include "limpet/mavlink/key_file.hpp"

namespace limpet::app {
namespace {

constexpr int kUpdates_Hz = 100;
constexpr std::size_t kLongestName = 16;  // on the wire

wire::TransportAddress address(const GroundStationOptions& options) {
    return address_of(
        "--ground-station", options.address,
        {wire::Medium::udp, wire::Medium::udp_broadcast, wire::Medium::tcp, wire::Medium::serial});
}

mavlink::Link open(const GroundStationOptions& options) {
    mavlink::Link link(open_transport(address(options), wire::Role::connect),
                       {.system = 1, .component = mavlink::kAutopilotComponent});
    mavlink::sign(link, options.signing_key);
    return link;
}

/// "0.1.0" as MAVLink has it, a byte each from the top; a development version.
std::uint32_t software_version() {
    std::istringstream text{std::string(kVersion)};
    std::uint32_t version = 0;
    for (std::uint32_t part = 0; text >> part; text.ignore()) {
        version = version << 8U | part;
    }
    return version << 8U;
}

ground_station::TelemetrySetup setup(const simulation::FlightModel& model) {
    const scenario::Scenario& scenario = *model.scenario;
    return {.battery_cells = scenario.airframe.battery.cells,
            .lidar_minimum_m = scenario.sensors.lidar_range_min_m,
            .lidar_maximum_m = scenario.sensors.lidar_range_max_m,
            .software_version = software_version()};
}

}  // namespace

OptionList options_of(GroundStationOptions& options) {
    return {{"--ground-station ADDRESS",
             [&options](const std::string& address) {
                 options.wanted = true;
                 options.address = address.empty() ? options.address : address;
             },
             "let a ground station watch and set the autopilot's parameters;\n"
             "where it listens (default udp:127.0.0.1:14550, QGroundControl's)",
             values(0, 1)},
            {"--signing-key FILE", &options.signing_key,
             "sign the ground station's link and refuse what it does not sign;\n"
             "64 hex digits or 32 bytes, for its owner's eyes (chmod 600)"}};
}

void check(const GroundStationOptions& options, bool builtin) {
    if (options.wanted && !builtin) {
        throw InputError(
            "--ground-station is for the built-in autopilot; a PX4 speaks to its ground station "
            "itself");
    }
    (void)address(options);
    if (!options.signing_key.empty() && !options.wanted) {
        throw InputError(
            "--signing-key: there is no ground station's link to sign; give "
            "--ground-station too");
    }
}

GroundStation::GroundStation(const GroundStationOptions& options,
                             const simulation::FlightModel& model, Terminal& terminal)
    : terminal_(terminal),
      wanted_(model.autopilot.parameters),
      link_(open(options)),
      telemetry_(link_, setup(model), served(),
                 [this](std::string_view name, double value) { set(name, value); }) {
    terminal_.line(fmt::format("to a ground station on {}{}", options.address,
                               options.signing_key.empty() ? "" : ", signed"));
}

std::vector<ground_station::ServedParameter> GroundStation::served() {
    std::vector<ground_station::ServedParameter> parameters;
    for (const auto& row : autopilot::autopilot_table()) {
        if (row.name.size() <= kLongestName) {
            parameters.push_back({.name = std::string(row.name),
                                  .value = row.get(wanted_),
                                  .minimum = row.minimum,
                                  .maximum = row.maximum,
                                  .whole = row.of(wanted_).is_whole()});
        }
    }
    return parameters;
}

void GroundStation::set(std::string_view name, double value) {
    for (const auto& row : autopilot::autopilot_table()) {
        if (row.name == name) {
            row.of(wanted_).set(value);
            changed_ = true;
        }
    }
}

void GroundStation::tick(simulation::Flight& flight, const guidance::EventList& events) {
    for (std::size_t k = 0; k < events.count; ++k) {
        telemetry_.event(events.events[k]);
    }
    const simulation::FlightState& state = flight.state();
    if (!due(state.tick, kUpdates_Hz)) {
        return;
    }
    telemetry_.update({.time_s = seconds(state.tick),
                       .estimate = state.autopilot.estimate,
                       .readings = state.sensors.readings,
                       .armed = state.command.armed,
                       .rotors = state.command.command.size()});
    if (changed_) {
        flight.set_autopilot(wanted_);
        changed_ = false;
    }
    tell_of_refusals();
}

void GroundStation::tell_of_refusals() {
    if (std::string reasons = reasons_of(link_.count().refusals); reasons != told_) {
        told_ = std::move(reasons);
        terminal_.line(terminal_.dim(fmt::format("          ground station: refused: {}", told_)));
    }
}

void GroundStation::end(const simulation::FlightResult& result) {
    const bool amiss = result.outcome == Outcome::crashed || result.outcome == Outcome::timed_out ||
                       !bears_out(result.true_end, result.outcome);
    telemetry_.text(
        amiss ? ground_station::Severity::error : ground_station::Severity::info,
        fmt::format("{}: {}", told_with_truth(result.outcome, result.true_end), result.reason));
}

std::string GroundStation::report() const {
    const mavlink::LinkCount count = link_.count();
    const std::string refused = text_of(count.refusals);
    return fmt::format("{} sent, {} received, {} damaged{}{}", count.sent, count.received,
                       count.damaged, refused.empty() ? "" : ", ", refused);
}

}  // namespace limpet::app
