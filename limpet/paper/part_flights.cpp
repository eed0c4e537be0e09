// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "limpet/core/errors.hpp"
#include "limpet/paper/flights.hpp"
#include "limpet/paper/parallel.hpp"
#include "limpet/paper/rigs.hpp"
#include "limpet/paper/study.hpp"
#include "limpet/record/story.hpp"
#include "limpet/report/figures.hpp"
#include "limpet/report/filmstrip.hpp"

namespace limpet::paper {
namespace {

namespace fs = std::filesystem;

const std::vector<FlightOrder>& orders() {
    static const std::vector<FlightOrder> all = {
        {.name = "perch_concrete", .scenario = "perch_concrete"},
        {.name = "perch_metal", .scenario = "perch_metal"},
        {.name = "perch_metal_valve", .scenario = "perch_metal_valve"},
        {.name = "failed_perch", .scenario = "failed_perch"},
        {.name = "failed_perch_stiff_slider",
         .scenario = "failed_perch",
         .overrides = {"vehicle.slider.stiffness_N_m=20000", "guidance.attempts=1"}},
    };
    return all;
}

/// A picture of a flight under the paper's number.
struct PaperFigure {
    const char* id;
    const char* flight;
    const char* picture;  ///< as plot() and film() call it
    const char* title;
    const char* caption;
    const char* alt;
};

constexpr std::array<PaperFigure, 7> kFigures = {{
    {"fig9", "perch_concrete", "perching_film", "Fig. 9: perching on porous concrete",
     "Rendered from the recording of `perch_concrete`.",
     "Eight pictures of the vehicle from the approach to the rest on the wall"},
    {"fig10", "perch_concrete", "take_off_film", "Fig. 10: take-off from porous concrete",
     "Rendered from the recording of `perch_concrete`.",
     "Pictures of the vehicle from the rest on the wall back to the pre-position"},
    {"fig11", "perch_concrete", "perching", "Fig. 11: perching on concrete",
     "The impact is the negative spike of the force; the pressure falls below P_land within the "
     "hold; then the pitch rises while the thrust falls and the force on the cup grows.",
     "Cup pressure, pitch, force, thrust and distance against time, from approach to rest"},
    {"fig12", "perch_concrete", "take_off", "Fig. 12: take-off and detachment on concrete",
     "Pump off once level; the air that leaks in releases the cup in about a second.",
     "The same five curves from the rest on the wall back to the pre-position"},
    {"fig13", "perch_metal", "perching", "Fig. 13: perching on metal",
     "A tighter seal and a pump that can rest: the strokes of Fig. 11 give way to a slow "
     "saw-tooth, "
     "since by Table II even metal lets the pressure rise once the pump is off.",
     "The same five curves on metal, from approach to rest"},
    {"fig14", "perch_metal", "take_off", "Fig. 14: take-off attempt on metal",
     "After 16 s the cup still holds and the release is given up, as in the paper. The pitch stays "
     "flat, as in the paper's simulation and unlike its flight; see the open question.",
     "The same five curves on metal until the release is given up"},
    {"fig15", "failed_perch", "failed_attempt", "Fig. 15: a failed perching",
     "The same spike and downward pitch, but no seal: after 0.5 s it goes back.",
     "The same five curves through an impact without a seal and the retreat"},
}};

const PaperFlight& find(const std::vector<PaperFlight>& flights, const std::string& name) {
    for (const PaperFlight& flight : flights) {
        if (flight.name == name) {
            return flight;
        }
    }
    throw InternalError("no flight " + name);
}

/// Values of one flight that need another.
void measure_together(const std::vector<PaperFlight>& flights, Evidence& evidence) {
    evidence.set("perch_concrete.pitch_off_legs_deg",
                 std::abs(evidence.get("perch_concrete.perched_pitch_deg") -
                          evidence.get("vehicle.pitch_on_legs_deg")));
    evidence.set("slider.contact_ratio", evidence.get("failed_perch.contact_s") /
                                             evidence.get("failed_perch_stiff_slider.contact_s"));
    const record::Recording& concrete = find(flights, "perch_concrete").recording;
    const record::RecordedEvent* approach = first_event(concrete, "approach_started");
    const auto chapter = perching(concrete);
    evidence.set("fig11.approach_at_s", approach != nullptr && chapter
                                            ? approach->time_s - chapter->window.from_s
                                            : std::numeric_limits<double>::quiet_NaN());
}

report::PageTable flight_table(const std::vector<PaperFlight>& flights) {
    report::PageTable table{
        .id = "flights-table",
        .title = "Flights",
        .columns = {"flight", "outcome", "docks", "impact, m/s", "press, N", "880 hPa after, s",
                    "perched pitch, deg", "release, s", "hash"},
        .caption =
            "One row a flight; each recording lies beside this page in "
            "`flights/NAME/flight.mcap` (Foxglove, PlotJuggler, ros2 bag). An "
            "empty value did not come to pass."};
    const auto cell = [](double value) {
        return std::isfinite(value) ? report::Quantity(value) : report::Quantity(std::string("–"));
    };
    for (const PaperFlight& flight : flights) {
        const simulation::Metrics& m = flight.result.metrics;
        table.rows.push_back({flight.name, std::string(to_string(flight.result.outcome)),
                              static_cast<double>(flight.result.attempts), cell(m.impact_speed_m_s),
                              cell(m.impact_force_N), cell(m.time_to_land_pressure_s),
                              cell(m.perched_pitch_deg), cell(m.release_s),
                              fmt::format("{:08x}", flight.result.state_hash >> 32U)});
    }
    return table;
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
    measure_together(flights, study.evidence);

    study.say("figures of the flights");
    const std::vector<std::string> drawn = {"perch_concrete", "perch_metal", "failed_perch"};
    for_each_index(drawn.size(), study.jobs, [&](std::size_t i) {
        const PaperFlight& flight = find(flights, drawn[i]);
        (void)report::plot(flight.recording, study.folder / "flights" / flight.name);
    });
    study.say("filmstrips");
    (void)report::film(find(flights, "perch_concrete").recording,
                       study.folder / "flights" / "perch_concrete");

    report::PageSection section{.id = "part-flights"};
    section.blocks.emplace_back(
        "The paper's flights, flown by the same method (its Fig. 7) on the simulated vehicle. Dark "
        "lines are the truth, light ones under them what the sensors said; events are those of the "
        "method.");
    section.blocks.emplace_back(flight_table(flights));
    for (const PaperFigure& figure : kFigures) {
        section.blocks.emplace_back(study.flight_figure(figure.flight, figure.picture,
                                                        {.id = figure.id,
                                                         .title = figure.title,
                                                         .caption = figure.caption,
                                                         .alt = figure.alt}));
    }
    study.sections.push_back(std::move(section));
}

}  // namespace

StudyPart flights_part() {
    StudyPart part{"flights",
                   "Perching and take-off: Figs. 9 to 15",
                   study_flights,
                   {"vehicle.mass_kg", "vehicle.wheelbase_m", "vehicle.propeller_diameter_in",
                    "vehicle.battery_cells", "vehicle.battery_capacity_Ah", "vehicle.pump_x_m",
                    "vehicle.lidar_rate_Hz", "vehicle.lidar_x_m", "vehicle.cup_joint_freedoms",
                    "free_body.relative_error", "estimator.motion_capture_only"}};
    Evidence told;  // of flights that never were: every name, no value
    std::vector<PaperFlight> flights(orders().size());
    for (std::size_t i = 0; i < flights.size(); ++i) {
        flights[i].name = orders()[i].name;
        measure(flights[i], told);
    }
    measure_together(flights, told);
    const std::vector<std::string> names = told.names();
    part.measures.insert(part.measures.end(), names.begin(), names.end());
    return part;
}

}  // namespace limpet::paper
