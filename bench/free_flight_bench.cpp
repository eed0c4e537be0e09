// SPDX-License-Identifier: Apache-2.0
//
// Free flight with motor lag alone, what simulators for learning do: rotors that follow commands,
// their forces, rigid bodies; no sensors, no control, nothing to touch. Steps a second of one core,
// alone and as many side by side as the machine's vectors hold, without and with slider and cup.
//   build/release/bench/free_flight_bench

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "limpet/plant/lane_bodies.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/vehicle/rotor.hpp"

namespace limpet {
namespace {

constexpr plant::StepMode kStep{.step_s = 4e-3, .contacts = false};
constexpr int kFlight = 500;  ///< steps: two seconds, then from the start again
constexpr int kSteps = 40 * kFlight;
constexpr int kRounds = 9;
constexpr double kHighest_m = 10.0;

/// A vehicle's rotors, flown by commands that hold it level: nothing is known ahead.
class Rotors {
public:
    explicit Rotors(const simulation::FlightModel& model)
        : airframe_(model.airframe),
          lag_(vehicle::make_lag(airframe_.rotor, kStep.step_s)),
          hover_(vehicle::hover_command(airframe_)),
          state_(vehicle::spinning(airframe_.rotor, airframe_.rotors.size(), hover_)) {
        command_.command.resize(airframe_.rotors.size());
        command_.armed = true;
    }
    [[nodiscard]] Wrench step_W(const Kinematics& base) {
        const Vector3 down_B = base.q_WF.conjugate() * Vector3::UnitZ();
        const double roll_back = base.w_WF_F_rad_s.x() + 2.0 * down_B.y();
        const double pitch_back = base.w_WF_F_rad_s.y() - 2.0 * down_B.x();
        for (std::size_t i = 0; i < command_.command.size(); ++i) {
            const Vector3& at = airframe_.rotors[i].p_B_m;
            command_.command[i] = hover_ + 0.1 * (at.y() * roll_back - at.x() * pitch_back);
        }
        vehicle::step(airframe_.rotor, lag_, state_, command_);
        const Wrench by_B =
            vehicle::rotor_wrench_B(airframe_, state_.speed_rad_s, base, Vector3::Zero());
        return {.force_N = base.q_WF * by_B.force_N, .moment_N_m = base.q_WF * by_B.moment_N_m};
    }

private:
    const vehicle::AirframeNumbers& airframe_;
    vehicle::RotorLag lag_;
    double hover_;
    vehicle::RotorsState state_;
    RotorCommand command_;
};

/// @return steps a second of the fastest round
template <class Fly>
double fastest(double steps, const Fly& fly) {
    double rate = 0.0;
    for (int round = 0; round < kRounds; ++round) {
        const auto begin = std::chrono::steady_clock::now();
        fly();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        rate = std::max(rate, steps / took.count());
    }
    return rate;
}

void check(double z_W_m) {
    require(std::abs(z_W_m) < kHighest_m, "a vehicle that hovers");
}

double alone(const simulation::FlightModel& model) {
    plant::ReducedPlant bodies(model.plant);
    const plant::PlantState start = bodies.save();
    return fastest(kSteps, [&] {
        for (int flight = 0; flight < kSteps / kFlight; ++flight) {
            bodies.restore(start);
            Rotors rotors(model);
            for (int k = 0; k < kFlight; ++k) {
                const Kinematics base = bodies.kinematics(plant::Body::base);
                bodies.apply(plant::Body::base, rotors.step_W(base), base.p_WF_m);
                bodies.step(kStep);
            }
            check(bodies.kinematics(plant::Body::base).p_WF_m.z());
        }
    });
}

double side_by_side(const simulation::FlightModel& model, const plant::LaneKind& kind) {
    const auto own = std::dynamic_pointer_cast<const plant::ReducedModel>(model.plant);
    require(own != nullptr, "a model of the reduced engine's");
    const std::unique_ptr<plant::LaneBodies> bodies(kind.make(*own));
    return fastest(kind.lanes * double{kSteps}, [&] {
        for (int flight = 0; flight < kSteps / kFlight; ++flight) {
            std::vector<Rotors> rotors;
            for (int lane = 0; lane < kind.lanes; ++lane) {
                bodies->enter(lane, *own);
                bodies->set_mode(lane, kStep);
                rotors.emplace_back(model);
            }
            for (int k = 0; k < kFlight; ++k) {
                for (int lane = 0; lane < kind.lanes; ++lane) {
                    const Kinematics base = bodies->kinematics(lane, plant::Body::base);
                    bodies->apply(lane, plant::Body::base,
                                  rotors[static_cast<std::size_t>(lane)].step_W(base), base.p_WF_m);
                }
                bodies->step();
            }
            check(bodies->kinematics(0, plant::Body::base).p_WF_m.z());
        }
    });
}

void report(const char* what, const std::string& vehicle) {
    const auto model = simulation::build_model(scenario::load_scenario(
        "hover", {.overrides = {"vehicle=" + vehicle, "simulation.engine=reduced"}}));
    const plant::LaneKind& kind = plant::widest_lanes();
    fmt::print("{:<28} {:6.2f} million steps a second alone, {:6.2f} with {} side by side ({})\n",
               what, alone(*model) * 1e-6, side_by_side(*model, kind) * 1e-6, kind.lanes,
               kind.name);
}

}  // namespace
}  // namespace limpet

int main() {
    limpet::report("four rotors, one body", "iris");
    limpet::report("and slider, cup, two hinges", "perching_uav");
    return 0;
}
