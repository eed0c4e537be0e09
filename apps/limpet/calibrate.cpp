// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/flight_data.hpp"
#include "limpet/identification/vehicle_fit.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/samples.hpp"
#include "limpet/simulation/model.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

using identification::Fitted;
using CalibrateJson = nlohmann::ordered_json;

struct CalibrateOptions {
    std::string log;
    std::string vehicle = "perching_uav";
    identification::FlightSpan span;
    bool json = false;
};

/// A number of the log, by the key that a scenario sets it with.
struct Calibrated {
    std::string key;
    std::string unit;
    std::optional<Fitted> fitted;
    double there = kNaN;  ///< the vehicle's own
};

std::vector<Calibrated> rows_of(const identification::VehicleFit& fit,
                                const vehicle::AirframeNumbers& airframe) {
    std::vector<Calibrated> rows;
    constexpr const char* kAxes[] = {"xx", "yy", "zz"};
    for (int axis = 0; axis < 3; ++axis) {
        rows.push_back({fmt::format("vehicle.inertia_kg_m2.{}", kAxes[axis]), "kg m2",
                        fit.inertia_kg_m2[static_cast<std::size_t>(axis)],
                        airframe.inertia_kg_m2[axis]});
    }
    const vehicle::RotorParameters& rotor = airframe.rotor;
    const vehicle::SliderParameters& slider = airframe.slider;
    rows.push_back(
        {"vehicle.rotor.time_constant_up_s", "s", fit.lag_up_s, rotor.time_constant_up_s});
    rows.push_back(
        {"vehicle.rotor.time_constant_down_s", "s", fit.lag_down_s, rotor.time_constant_down_s});
    rows.push_back(
        {"vehicle.rotor.drag_constant_kg", "kg", fit.drag_constant_kg, rotor.drag_constant_kg});
    rows.push_back(
        {"vehicle.slider.stiffness_N_m", "N/m", fit.slider_stiffness_N_m, slider.stiffness_N_m});
    rows.push_back(
        {"vehicle.slider.damping_N_s_m", "N s/m", fit.slider_damping_N_s_m, slider.damping_N_s_m});
    rows.push_back({"vehicle.slider.preload_N", "N", fit.slider_preload_N, slider.preload_N});
    const auto of_pressure = [&fit](auto member) {
        return fit.pressure ? (*fit.pressure).*member : std::optional<Fitted>();
    };
    using P = identification::PressureFit;
    rows.push_back({"wall.surface.vacuum_pressure_Pa", "Pa", of_pressure(&P::vacuum_Pa)});
    rows.push_back({"wall.surface.sealing_time_constant_s", "s", of_pressure(&P::sealing_time_s)});
    rows.push_back(
        {"wall.surface.unsealing_time_constant_s", "s", of_pressure(&P::unsealing_time_s)});
    return rows;
}

std::string number_text(double value, double half_width) {
    const int digits =
        half_width > 0.0
            ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 9)
            : 4;
    return fmt::format("{:>12.{}f} +- {:<10.{}f}", value, digits, half_width, digits);
}

std::string text_of(const identification::VehicleFit& fit, const std::vector<Calibrated>& rows) {
    std::string text =
        fmt::format("{:<42}{:>12}    {:<10}{:<7}{}\n", "", "value", "95 %", "", "vehicle file");
    for (const Calibrated& row : rows) {
        if (row.fitted) {
            text += fmt::format("{:<42}{}{:<7}", row.key,
                                number_text(row.fitted->value, row.fitted->half_width), row.unit);
            text += std::isfinite(row.there) ? fmt::format("{:.4g}\n", row.there) : "\n";
        }
    }
    if (fit.free_s > 0.0) {
        text += fmt::format("free flight: {:.1f} s\n", fit.free_s);
    }
    for (const std::string& note : fit.notes) {
        text += "note  " + note + "\n";
    }
    return text;
}

CalibrateJson json_of(const identification::VehicleFit& fit, const std::vector<Calibrated>& rows,
                      const std::string& kind) {
    CalibrateJson json{{"log", kind}, {"confidence", identification::kConfidence}};
    CalibrateJson found = CalibrateJson::object();
    for (const Calibrated& row : rows) {
        found[row.key] = nullptr;
        if (row.fitted) {
            found[row.key] = {{"value", row.fitted->value},
                              {"low", row.fitted->value - row.fitted->half_width},
                              {"high", row.fitted->value + row.fitted->half_width},
                              {"unit", row.unit}};
        }
    }
    json["numbers"] = found;
    json["free_flight_s"] = fit.free_s;
    json["notes"] = fit.notes;
    return json;
}

/// @param whose  the log's, or a vehicle's name
void require_known_motion(const vehicle::Airframe& airframe, const std::string& whose) {
    const char* const has = airframe.payload.mass_kg > 0.0        ? "a payload on a cable"
                            : airframe.rotor.motor_kv_rpm_V > 0.0 ? "motors by motor_kv_rpm_V"
                                                                  : nullptr;
    if (has != nullptr) {
        throw InputError(fmt::format("{} has {}, which calibrate does not know", whose, has));
    }
}

/// The scenario in a recording of ours; none where another program flew, or where the scenario is
/// of a version that this one does not read.
std::optional<scenario::Scenario> flown_by(const identification::FlightData& data) {
    if (data.scenario_yaml.empty()) {
        return std::nullopt;
    }
    try {
        return scenario::load_scenario_text(data.scenario_yaml, "recording");
    } catch (const InputError&) {
        return std::nullopt;
    }
}

/// In what steps a flight of ours went on.
std::vector<int> strides_of(const scenario::Scenario& flown) {
    const auto model = simulation::build_model(flown);
    return {model->strides.begin(), model->strides.end()};
}

void calibrate(CalibrateOptions options) {
    options.log = scenario::find_sample(options.log, ".csv").string();
    const scenario::Scenario scenario =
        scenario::load_scenario("perch_concrete", {.overrides = {"vehicle=" + options.vehicle}});
    identification::VehicleFit fit;
    identification::FlightData data;
    try {
        data = identification::read_flight(options.log, options.span);
        if (const auto flown = flown_by(data)) {
            require_known_motion(flown->airframe, "the vehicle that flew");
            data.strides = strides_of(*flown);
        }
        require_known_motion(scenario.airframe, options.vehicle);
        fit = identify_vehicle(data, scenario.airframe);
        if (data.origin_s > 0.0) {
            fit.notes.push_back(
                fmt::format("times are from the first sample, at {:.3f} s", data.origin_s));
        }
    } catch (const InputError& error) {
        const std::string why = error.what();
        throw InputError(why.find(options.log) == std::string::npos ? options.log + ": " + why
                                                                    : why);
    }
    const std::vector<Calibrated> rows = rows_of(fit, scenario.airframe);
    if (std::none_of(rows.begin(), rows.end(),
                     [](const Calibrated& row) { return row.fitted.has_value(); })) {
        throw InputError(fmt::format("{}: tells none of the numbers: {}", options.log,
                                     fmt::join(fit.notes, "; ")));
    }
    fmt::print("{}",
               options.json ? json_of(fit, rows, data.kind).dump(2) + "\n" : text_of(fit, rows));
    if (!options.json) {
        std::string sets = options.vehicle == CalibrateOptions().vehicle
                               ? ""
                               : fmt::format(" \\\n  --set vehicle={}", for_shell(options.vehicle));
        const std::size_t vehicle = sets.size();
        for (const Calibrated& row : rows) {
            if (row.fitted && std::isfinite(row.there) && row.fitted->value > 0.0) {
                sets += fmt::format(" \\\n  --set {}={:.5g}", row.key, row.fitted->value);
            }
        }
        if (sets.size() > vehicle) {
            fmt::print("\nfly with it: limpet fly perch_concrete{}\n", sets);
        }
    }
    if (!data.damage.empty()) {
        std::fflush(stdout);
        throw InputError(options.log + ": " + data.damage);
    }
}

OptionList options_of(CalibrateOptions& options) {
    return {{"log LOG", &options.log,
             "a recording (.mcap), a PX4 log (.ulg), or CSV (docs/own_vehicle.md)"},
            {"--vehicle VEHICLE", &options.vehicle,
             "whose rotors and mass are taken as known (default: perching_uav)"},
            {"--from S", &options.span.from_s, "leave out what is before"},
            {"--to S", &options.span.to_s, "leave out what is after"},
            {"--json", &options.json, "one JSON object"}};
}

}  // namespace

Verb calibrate_verb() {
    return verb<CalibrateOptions>(
        "calibrate", "Tell inertia, motors' lag, drag, slider, pressure from a flight's log",
        options_of, calibrate,
        "Examples:\n"
        "  limpet fly perch_concrete --set simulation.record_rate_Hz=250\n"
        "  limpet calibrate out/perch_concrete/flight.mcap\n\n"
        "Intervals are for 95 %. What the log cannot tell is said and why: inertia and lag need "
        "the gyro and\nmotor commands at 200 Hz and more in free flight, drag a velocity, the "
        "slider its force sensor.\n");
}

}  // namespace limpet::app
