// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <memory>
#include <optional>
#include <vector>

#include "limpet/plant/reduced_plant.hpp"
#include "limpet/simulation/model.hpp"
#include "limpet/simulation/snapshot.hpp"

namespace limpet::stability {

/// A mode of a linear system: x ~ exp(growth t) sin(2 pi frequency t).
struct Mode {
    double growth_1_s = 0.0;  ///< > 0 grows
    double frequency_Hz = 0.0;
    double pitch_share = 0.0;  ///< of the base's turning, how much is about its pitch axis, 0..1
};

/// The vehicle level on a sealed cup with attitude and thrust held, as it waits for the release:
/// the loop of rigid bodies, cup, rotors and attitude control, from one control period to the next.
///
/// The stations are the simulation's own (advance(), control(), the rotors' step()); the estimator
/// is left out: control sees the true attitude, and the true rate as a gyro gives it, the mean over
/// the last period. Noise, gusts and the battery's sag are left out too, the cup's pressure stays.
class LevelOnCup {
public:
    /// @param model  its vehicle has a cup and its scenario a wall; the engine is the reduced one
    explicit LevelOnCup(std::shared_ptr<const simulation::FlightModel> model);

    /// Modes of the linearised loop, fastest growing first. Jacobian by central differences at the
    /// rest, which is found by Newton's method.
    /// @return none when the vehicle has no rest
    [[nodiscard]] std::optional<std::vector<Mode>> modes();

private:
    void put_on_wall();
    void period();
    void restore(const simulation::Snapshot& snapshot);
    [[nodiscard]] std::optional<Eigen::MatrixXd> map_at_rest();
    void find_carried();
    void keep_what_reaches(Eigen::Index group);
    [[nodiscard]] Eigen::Index size() const;
    [[nodiscard]] Eigen::VectorXd numbers(const plant::PlantState& origin);
    void add(const Eigen::VectorXd& step);
    [[nodiscard]] Eigen::VectorXd image(const simulation::Snapshot& from,
                                        const Eigen::VectorXd& step);
    [[nodiscard]] Eigen::MatrixXd jacobian(const simulation::Snapshot& at);

    std::shared_ptr<const simulation::FlightModel> model_;
    plant::ReducedPlant plant_;
    simulation::FlightState state_;
    int ticks_ = 1;           ///< of a control period
    int ticks_a_stride_ = 1;  ///< the bodies' steps
    /// Which of the state's numbers, in the order of the walk, the loop carries besides the bodies'
    /// own from one period to the next: rotors and their dead time, filters, integrators.
    std::vector<std::size_t> carried_;
};

/// It swings; an integrator's creeping back to the rest is no swing.
[[nodiscard]] inline bool is_swing(const Mode& mode) {
    constexpr double kCreeping_Hz = 0.1;
    return mode.frequency_Hz >= kCreeping_Hz;
}

/// The fastest-growing or slowest-decaying of the modes that are mostly pitch and below 3 Hz, of
/// those that swing or grow; where none does, of those that creep back.
/// @return none when no mode is
[[nodiscard]] std::optional<Mode> pitch_mode(const std::vector<Mode>& modes);

}  // namespace limpet::stability
