// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/core/parallel.hpp"
#include "limpet/draw/gnuplot.hpp"
#include "limpet/paper/flights.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/paper/rigs.hpp"
#include "limpet/record/story.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/report/filmstrip.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

const std::vector<FlightOrder>& orders() {
    static const std::vector<FlightOrder> all = {
        {.name = "perch_concrete", .scenario = "perch_concrete"},
        {.name = "perch_metal", .scenario = "perch_metal"},
        {.name = "perch_metal_valve", .scenario = "perch_metal_valve"},
        {.name = "failed_perch", .scenario = "failed_perch"},
        {.name = "failed_perch_stiff_slider",
         .scenario = "failed_perch",
         .overrides = {"vehicle.slider.stiffness_N_m=20000", "guidance.attempts=1"}},
        {.name = "perch_cad",
         .scenario = "perch_concrete",
         .overrides = {"vehicle=" +
                       (scenario::data_root() / "vehicles" / "cad_uav" / "cad_uav.yaml").string()}},
        {.name = "perch_motors",
         .scenario = "perch_concrete",
         .overrides = {"vehicle.rotor.motor_kv_rpm_V=380"}},
        {.name = "perch_near",
         .scenario = "perch_concrete",
         .overrides = {"guidance.pre_distance_m=1.2"}},
        {.name = "perch_low_wall",
         .scenario = "perch_concrete",
         .overrides = {"wall.height_m=0.8", "guidance.attempts=1"}},
    };
    return all;
}

/// A picture of a flight under the paper's number.
struct PaperFigure {
    const char* id;
    const char* flight;
    const char* picture;  ///< as plot() and film() call it
};

constexpr std::array<PaperFigure, 7> kFigures = {{
    {"fig9", "perch_concrete", "perching_film"},
    {"fig10", "perch_concrete", "take_off_film"},
    {"fig11", "perch_concrete", "perching"},
    {"fig12", "perch_concrete", "take_off"},
    {"fig13", "perch_metal", "perching"},
    {"fig14", "perch_metal", "take_off"},
    {"fig15", "failed_perch", "failed_attempt"},
}};

const PaperFlight& flight_of(const std::vector<PaperFlight>& flights, const std::string& name) {
    for (const PaperFlight& flight : flights) {
        if (flight.name == name) {
            return flight;
        }
    }
    throw InternalError("no flight " + name);
}

/// Values of one flight that need another.
void measure_together(const record::Recording& concrete, Evidence& evidence) {
    evidence.set("perch_concrete.pitch_off_legs_deg",
                 std::abs(evidence.get("perch_concrete.perched_pitch_deg") -
                          evidence.get("vehicle.pitch_on_legs_deg")));
    evidence.set("slider.contact_ratio", evidence.get("failed_perch.contact_s") /
                                             evidence.get("failed_perch_stiff_slider.contact_s"));
    evidence.set("perch_near.approach_ratio", evidence.get("perch_near.spike_after_s") /
                                                  evidence.get("perch_concrete.spike_after_s"));
    evidence.set("perch_low_wall.was_needed", evidence.get("perch_low_wall.approached") > 0.5 &&
                                                      evidence.get("perch_low_wall.rested") < 0.5
                                                  ? 1.0
                                                  : 0.0);
    const record::RecordedEvent* approach = first_event(concrete, EventName::approach_started);
    const auto chapter = perching(concrete);
    evidence.set("fig11.approach_at_s",
                 approach != nullptr && chapter ? approach->time_s - chapter->window.from_s : kNaN);
}

double pitch_on_legs_deg(const FlightOrder& order) {
    return degrees(vehicle::pitch_on_legs_rad(
        scenario::load_scenario(order.scenario, {.overrides = order.overrides}).airframe));
}

/// Of all evidence of the flights.
std::vector<std::string> names_of_flights() {
    Evidence named;  // of flights that never were: every name, no value
    for (const FlightOrder& order : orders()) {
        measure(PaperFlight{.name = order.name, .result = {}, .recording = {}}, named);
    }
    measure_together({}, named);
    std::vector<std::string> names;
    for (const auto& [name, value] : named.all()) {
        names.push_back(name);
    }
    return names;
}

/// The flights that evidence of a name is measured on.
std::vector<std::string> flights_behind(const std::string& name) {
    static const std::map<std::string, std::vector<std::string>> kTogether = {
        {"slider.contact_ratio", {"failed_perch", "failed_perch_stiff_slider"}},
        {"perch_near.approach_ratio", {"perch_near", "perch_concrete"}},
        {"fig11.approach_at_s", {"perch_concrete"}}};
    const auto found = kTogether.find(name);
    return found == kTogether.end() ? std::vector{name.substr(0, name.find('.'))} : found->second;
}

/// Those behind statements that are said to rest on a key.
std::set<std::string> flights_resting_on(const std::string& key, const Study& study) {
    std::set<std::string> flights;
    for (const PaperStatement& statement : study.statements) {
        const auto& assumes = statement.claim.assumes;
        if (std::find(assumes.begin(), assumes.end(), key) != assumes.end()) {
            for (std::string& flight : flights_behind(statement.evidence)) {
                flights.insert(std::move(flight));
            }
        }
    }
    return flights;
}

/// The flights again in which a value is assumed; of --quick those behind statements that name it.
class TurnedFlights {
public:
    /// @param concrete  the recording of perch_concrete as it is
    TurnedFlights(const Study& study, const record::Recording& concrete)
        : study_(study), as_it_is_(study.evidence), concrete_(concrete) {
        for (const FlightOrder& order : orders()) {
            scenarios_.push_back(
                scenario::load_scenario(order.scenario, {.overrides = order.overrides}));
        }
    }

    [[nodiscard]] const std::vector<scenario::Scenario>& scenarios() const { return scenarios_; }

    /// What the flights tell that were flown again.
    [[nodiscard]] Evidence measure_again(const Turn& turn) const {
        const draw::gnuplot::TemporaryFolder scratch;
        const std::set<std::string> wanted = flights_resting_on(turn.key, study_);
        std::set<std::string> again;
        Evidence evidence = as_it_is_;
        std::optional<record::Recording> concrete;
        for (std::size_t i = 0; i < orders().size(); ++i) {
            FlightOrder order = orders()[i];
            const auto set = override_of(turn, scenarios_[i]);
            if (!set || (study_.quick && !wanted.contains(order.name))) {
                continue;
            }
            order.overrides.push_back(*set);
            again.insert(order.name);
            PaperFlight flight = fly_recorded(order, scratch.path());
            measure(flight, evidence);
            if (flight.name == "perch_concrete") {
                evidence.set("vehicle.pitch_on_legs_deg", pitch_on_legs_deg(order));
                concrete = std::move(flight.recording);
            }
        }
        measure_together(concrete ? *concrete : concrete_, evidence);
        Evidence told;
        for (const auto& [name, value] : evidence.all()) {
            const std::vector<std::string> behind = flights_behind(name);
            if (std::any_of(behind.begin(), behind.end(), [&again](const std::string& flight) {
                    return again.contains(flight);
                })) {
                told.set(name, value);
            }
        }
        return told;
    }

private:
    const Study& study_;
    Evidence as_it_is_;
    const record::Recording& concrete_;
    std::vector<scenario::Scenario> scenarios_;
};

void turn_flights(Study& study, const record::Recording& concrete) {
    const TurnedFlights flights(study, concrete);
    do_again(study, {.name = "flights",
                     .evidence = names_of_flights(),
                     .turns = turns_of(flights.scenarios()),
                     .measure = [&](const Turn& turn) { return flights.measure_again(turn); }});
}

TableRows flight_rows(const std::vector<PaperFlight>& flights) {
    TableRows rows;
    for (const PaperFlight& flight : flights) {
        const simulation::Metrics& m = flight.result.metrics;
        rows.push_back({flight.name, told_with_truth(flight.result.outcome, flight.result.true_end),
                        static_cast<double>(flight.result.attempts),
                        number_or(m.impact_speed_m_s, "–"), number_or(m.impact_force_N, "–"),
                        number_or(m.time_to_land_pressure_s, "–"),
                        number_or(m.perched_pitch_deg, "–"), number_or(m.release_s, "–"),
                        fmt::format("{:08x}", flight.result.state_hash >> 32U)});
    }
    return rows;
}

void study_flights(Study& study) {
    measure_vehicle(study.evidence);
    std::vector<PaperFlight> flights(orders().size());
    for_each_index(flights.size(), study.jobs, [&](std::size_t i) {
        flights[i] = fly_recorded(orders()[i], study.folder / "flights");
    });
    for (const PaperFlight& flight : flights) {
        measure(flight, study.evidence);
    }
    measure_together(flight_of(flights, "perch_concrete").recording, study.evidence);
    turn_flights(study, flight_of(flights, "perch_concrete").recording);

    study.say("figures of the flights");
    const std::vector<std::string> drawn = {"perch_concrete", "perch_metal", "failed_perch"};
    for_each_index(drawn.size(), study.jobs, [&](std::size_t i) {
        const PaperFlight& flight = flight_of(flights, drawn[i]);
        study.show(flight.name);
        (void)report::plot(flight.recording, study.folder / "flights" / flight.name);
    });
    study.say("filmstrips");
    (void)report::film(flight_of(flights, "perch_concrete").recording,
                       study.folder / "flights" / "perch_concrete");

    study.table("flights-table", flight_rows(flights));
    for (const PaperFigure& figure : kFigures) {
        study.picture(figure.id, figure.flight, figure.picture);
    }
}

}  // namespace

StudyPart flights_part() {
    StudyPart part{"flights",
                   "Perching and take-off: Figs. 9 to 15",
                   study_flights,
                   {"vehicle.mass_kg", "vehicle.wheelbase_m", "vehicle.propeller_diameter_in",
                    "vehicle.battery_cells", "vehicle.battery_capacity_Ah", "vehicle.pump_x_m",
                    "vehicle.lidar_rate_Hz", "vehicle.lidar_x_m", "vehicle.cup_joint_freedoms",
                    "free_body.relative_error", "estimator.motion_capture_only"},
                   {"flights-table"}};
    for (const PaperFigure& figure : kFigures) {
        part.shows.emplace_back(figure.id);
    }
    for (const std::string& name : names_of_flights()) {
        part.measures.push_back(name);
    }
    return part;
}

}  // namespace limpet::paper
