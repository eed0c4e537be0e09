// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/identification/flight_data.hpp"
#include "limpet/identification/vehicle_fit.hpp"
#include "limpet/scenario/catalogue.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/scenario/sections.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/vehicle/airframe.hpp"
#include "output.hpp"

namespace limpet::app {
namespace {

using identification::Fitted;
using CalibrateJson = nlohmann::ordered_json;

constexpr std::string_view kDefaultName = "perching_uav";  ///< of perch_concrete

struct CalibrateOptions {
    std::string log;
    std::optional<std::string> vehicle;
    identification::FlightSpan span;
    bool json = false;
};

/// A number of the log, by the key that a scenario sets it with.
struct Calibrated {
    std::string key;
    std::string unit;
    std::optional<Fitted> fitted;
    double there = kNaN;     ///< of the vehicle's file
    std::string doubt = {};  ///< why no vehicle has such a number; empty: it may have
};

/// Whose rotors, mass and cup are taken as known.
struct Known {
    vehicle::Airframe airframe;
    std::string vehicle;                  ///< by which a scenario names it; empty: by nothing
    bool named = true;                    ///< false: the vehicle is unknown
    std::vector<std::string> notes = {};  ///< a sentence each
};

/// Why an inertia or a lag that came out is no vehicle's.
std::string doubt_of(const Fitted& fitted, std::optional<int> axis,
                     const vehicle::AirframeNumbers& airframe) {
    constexpr double kFactor = 8.0;  ///< to either side of what is usual
    if (!std::isfinite(fitted.value) || !std::isfinite(fitted.half_width)) {
        return "the log does not determine it";
    }
    if (fitted.value <= fitted.half_width) {
        return "its interval reaches down to 0: the log does not determine it";
    }
    if (axis && !is_plausible_inertia(airframe, fitted.value, *axis, kFactor)) {
        return fmt::format(
            "{:.3g} kg m2 is implausible: a vehicle of {:.3g} kg with its hubs {:.3g} m out has "
            "some {:.2g}; the wrong vehicle, or the log does not determine it",
            fitted.value, airframe.mass_kg, hubs_reach_m(airframe),
            usual_inertia_kg_m2(airframe)[*axis]);
    }
    return {};
}

/// What a scenario does not take is no number of a vehicle either.
void doubt_what_is_out_of_range(std::vector<Calibrated>& rows) {
    scenario::Scenario bounds;
    for (const scenario::Section& section : scenario_sections(bounds)) {
        for (const BoundParameter& number : section.rows) {
            const std::string key = fmt::format("{}.{}", section.name, number.name);
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const Calibrated& each) {
                return each.key == key && each.fitted;
            });
            if (row != rows.end() && row->doubt.empty() && !number.allows(row->fitted->value)) {
                row->doubt =
                    fmt::format("{:.4g} {} is out of range, allowed {:g}..{:g}", row->fitted->value,
                                number.unit, number.minimum, number.maximum);
            }
        }
    }
}

std::vector<Calibrated> rows_of(const identification::VehicleFit& fit, const Known& known) {
    const vehicle::AirframeNumbers& airframe = known.airframe;
    const vehicle::RotorParameters& rotor = airframe.rotor;
    const vehicle::SliderParameters& slider = airframe.slider;
    const Vector3& inertia_kg_m2 = airframe.inertia_kg_m2;
    const identification::PressureFit pressure =
        fit.pressure.value_or(identification::PressureFit{});
    std::vector<Calibrated> rows = {
        {"vehicle.inertia_kg_m2.xx", "kg m2", fit.inertia_kg_m2[0], inertia_kg_m2.x()},
        {"vehicle.inertia_kg_m2.yy", "kg m2", fit.inertia_kg_m2[1], inertia_kg_m2.y()},
        {"vehicle.inertia_kg_m2.zz", "kg m2", fit.inertia_kg_m2[2], inertia_kg_m2.z()},
        {"vehicle.rotor.time_constant_up_s", "s", fit.lag_up_s, rotor.time_constant_up_s},
        {"vehicle.rotor.time_constant_down_s", "s", fit.lag_down_s, rotor.time_constant_down_s},
        {"vehicle.rotor.drag_constant_kg", "kg", fit.drag_constant_kg, rotor.drag_constant_kg},
        {"vehicle.slider.stiffness_N_m", "N/m", fit.slider_stiffness_N_m, slider.stiffness_N_m},
        {"vehicle.slider.damping_N_s_m", "N s/m", fit.slider_damping_N_s_m, slider.damping_N_s_m},
        {"vehicle.slider.preload_N", "N", fit.slider_preload_N, slider.preload_N},
        {"wall.surface.vacuum_pressure_Pa", "Pa", pressure.vacuum_Pa},
        {"wall.surface.sealing_time_constant_s", "s", pressure.sealing_time_s},
        {"wall.surface.unsealing_time_constant_s", "s", pressure.unsealing_time_s}};
    constexpr int kAxes = 3, kDoubted = 5;  // inertia, lags
    for (int i = 0; i < kDoubted; ++i) {
        if (Calibrated& row = rows[static_cast<std::size_t>(i)]; row.fitted) {
            row.doubt =
                doubt_of(*row.fitted, i < kAxes ? std::optional(i) : std::nullopt, airframe);
        }
    }
    doubt_what_is_out_of_range(rows);
    for (Calibrated& row : rows) {
        row.there = known.named ? row.there : kNaN;
    }
    return rows;
}

std::string number_text(double value, double half_width) {
    const int digits =
        half_width > 0.0
            ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 9)
            : 4;
    return fmt::format("{:>12.{}f} +- {:<10.{}f}", value, digits, half_width, digits);
}

/// What is missing, assumed or not to be believed.
std::vector<std::string> notes_of(const identification::VehicleFit& fit,
                                  const std::vector<Calibrated>& rows, const Known& known) {
    std::vector<std::string> notes;
    for (const Calibrated& row : rows) {
        if (!row.doubt.empty()) {
            notes.push_back(fmt::format("{}: {}", row.key, row.doubt));
        }
    }
    notes.insert(notes.end(), fit.notes.begin(), fit.notes.end());
    notes.insert(notes.end(), known.notes.begin(), known.notes.end());
    return notes;
}

std::string text_of(const identification::VehicleFit& fit, const std::vector<Calibrated>& rows,
                    const std::vector<std::string>& notes) {
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
    for (const std::string& note : notes) {
        text += "note  " + note + "\n";
    }
    return text;
}

CalibrateJson json_of(const identification::VehicleFit& fit, const std::vector<Calibrated>& rows,
                      const std::vector<std::string>& notes, const Known& known,
                      const std::string& kind) {
    CalibrateJson json{{"log", kind}, {"confidence", identification::kConfidence}};
    json["vehicle"] = known.named ? CalibrateJson(known.airframe.name) : CalibrateJson(nullptr);
    CalibrateJson found = CalibrateJson::object();
    for (const Calibrated& row : rows) {
        found[row.key] = nullptr;
        if (row.fitted) {
            found[row.key] = {{"value", row.fitted->value},
                              {"low", row.fitted->value - row.fitted->half_width},
                              {"high", row.fitted->value + row.fitted->half_width},
                              {"unit", row.unit},
                              {"plausible", row.doubt.empty()}};
        }
    }
    json["numbers"] = found;
    json["free_flight_s"] = fit.free_s;
    json["notes"] = notes;
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

vehicle::Airframe shipped_or_file(const std::string& vehicle) {
    return scenario::load_scenario("hover", {.overrides = {"vehicle=" + vehicle}}).airframe;
}

/// The numbers, whatever the air around was.
bool same_numbers(vehicle::Airframe a, const vehicle::Airframe& b) {
    a.rotor.density_ratio = b.rotor.density_ratio;
    a.rotor.nominal_voltage_V = b.rotor.nominal_voltage_V;
    return static_cast<const vehicle::AirframeNumbers&>(a) == b;
}

/// The vehicle that flew, as its recording has it.
Known from_recording(const scenario::Scenario& flown) {
    Known known{.airframe = flown.airframe, .vehicle = {}};
    const auto shipped = scenario::names_in(scenario::data_root() / "vehicles");
    if (std::find(shipped.begin(), shipped.end(), flown.airframe.name) == shipped.end()) {
        known.notes.push_back(
            fmt::format("the vehicle is the recording's, {}", known.airframe.name));
        return known;
    }
    known.vehicle = flown.airframe.name;
    if (!same_numbers(flown.airframe, shipped_or_file(known.vehicle))) {
        known.notes.push_back(fmt::format(
            "the vehicle is the recording's, {} with other numbers than its file's: fly "
            "with what was set then, too",
            known.vehicle));
    }
    return known;
}

/// @param options  `--vehicle` takes precedence over the recording's
Known known_of(const CalibrateOptions& options, const identification::FlightData& data,
               const std::optional<scenario::Scenario>& flown) {
    if (options.vehicle) {
        Known known{.airframe = shipped_or_file(*options.vehicle), .vehicle = *options.vehicle};
        if (flown && flown->airframe.name != known.airframe.name) {
            known.notes.push_back(fmt::format("the recording's vehicle is {}, taken as known is {}",
                                              flown->airframe.name, known.airframe.name));
        }
        return known;
    }
    if (flown) {
        return from_recording(*flown);
    }
    if (!data.imu_s.empty() && !data.command_s.empty()) {
        throw InputError(
            "the log does not say which vehicle flew: --vehicle NAME|FILE, whose rotors, mass and "
            "cup are taken as known");
    }
    return {.airframe = {}, .vehicle = {}, .named = false};  // nothing that is fitted depends on it
}

std::string sets_of(const std::vector<Calibrated>& rows) {
    std::string sets;
    for (const Calibrated& row : rows) {
        if (row.fitted && row.doubt.empty() && std::isfinite(row.there) &&
            row.fitted->value > 0.0) {
            sets += fmt::format(" \\\n  --set {}={:.5g}", row.key, row.fitted->value);
        }
    }
    return sets;
}

/// How a flight takes what was found.
void print_command(const std::vector<Calibrated>& rows, const Known& known) {
    const std::string sets = sets_of(rows);
    if (sets.empty()) {
        return;
    }
    const std::string vehicle =
        known.vehicle.empty() ? " --set vehicle=FILE"
        : known.vehicle == kDefaultName
            ? ""
            : fmt::format(" \\\n  --set vehicle={}", for_shell(known.vehicle));
    fmt::print("\nfly with it: limpet fly {}{}{}\n",
               known.airframe.has_cup ? "perch_concrete" : "hover", vehicle, sets);
}

/// @throws InputError that names the log
template <class Does>
void of_log(const std::string& log, const Does& does) {
    try {
        does();
    } catch (const InputError& error) {
        const std::string why = error.what();
        throw InputError(why.find(log) == std::string::npos ? log + ": " + why : why);
    }
}

void calibrate(CalibrateOptions options) {
    options.log = scenario::find_sample(options.log, ".csv").string();
    identification::VehicleFit fit;
    identification::FlightData data;
    Known known;
    if (options.vehicle) {
        (void)shipped_or_file(*options.vehicle);  // so that its errors do not name the log
    }
    of_log(options.log, [&] {
        data = identification::read_flight(options.log, options.span);
        const std::optional<scenario::Scenario> flown = flown_by(data);
        if (flown) {
            require_known_motion(flown->airframe, "the vehicle that flew");
            data.strides = strides_of(*flown);
        }
        known = known_of(options, data, flown);
        require_known_motion(known.airframe, known.vehicle);
        fit = identify_vehicle(data, known.airframe);
    });
    if (data.origin_s > 0.0) {
        known.notes.push_back(
            fmt::format("times are from the first sample, at {:.3f} s", data.origin_s));
    }
    fit.notes.insert(fit.notes.begin(), data.remarks.begin(), data.remarks.end());
    if (!data.damage.empty()) {
        fit.notes.insert(fit.notes.begin(), data.damage);
    }
    const std::vector<Calibrated> rows = rows_of(fit, known);
    if (std::none_of(rows.begin(), rows.end(),
                     [](const Calibrated& row) { return row.fitted.has_value(); })) {
        throw InputError(fmt::format("{}: determines none of the numbers: {}", options.log,
                                     fmt::join(fit.notes, "; ")));
    }
    const std::vector<std::string> notes = notes_of(fit, rows, known);
    fmt::print("{}", options.json
                         ? json_of(fit, rows, notes, known, data.kind)
                                   .dump(2, ' ', false, CalibrateJson::error_handler_t::replace) +
                               "\n"
                         : text_of(fit, rows, notes));
    if (!options.json) {
        print_command(rows, known);
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
             "name or file, whose rotors, mass and cup are taken as known\n"
             "(default: the recording's)"},
            {"--from S", &options.span.from_s, "leave out what is before"},
            {"--to S", &options.span.to_s, "leave out what is after"},
            {"--json", &options.json, "one JSON object"}};
}

}  // namespace

Verb calibrate_verb() {
    return verb<CalibrateOptions>(
        "calibrate", "Fit inertia, motors' lag, drag, slider, pressure to a flight's log",
        options_of, calibrate,
        "Examples:\n"
        "  limpet fly perch_concrete --set simulation.record_rate_Hz=250\n"
        "  limpet calibrate out/perch_concrete/flight.mcap\n\n"
        "Intervals are for 95 %. Numbers that the log cannot determine are named, with the "
        "reason:\ninertia and lag need the gyro and motor commands at 200 Hz and more in free "
        "flight, drag a\nvelocity, the slider its force sensor.\n");
}

}  // namespace limpet::app
