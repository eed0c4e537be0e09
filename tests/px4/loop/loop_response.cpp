// SPDX-License-Identifier: Apache-2.0
#include "loop_response.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "limpet/paper/oscillation.hpp"
#include "limpet/scenario/loader.hpp"
#include "limpet/simulation/bring_up.hpp"
#include "limpet/simulation/flight.hpp"

namespace limpet {
namespace {

// All sines have whole periods in kPeriod_s; frequencies as a chirp has them, closer the lower.
constexpr double kPeriod_s = 10.0;
constexpr int kPeriods = 2;
constexpr double kSettle_s = 5.0;  ///< of what switching them on has stirred up
constexpr std::array kSines = {4,  5,  6,  7,  8,  10, 12, 14, 17, 20,
                               24, 28, 33, 39, 46, 55, 65, 77, 91, 100};
/// Of each sine, torque command. Small against what the rotors have, large against noise: it rises
/// with the frequency as the vehicle's answer falls.
constexpr double kAmplitude = 0.004;
constexpr double kTwoPi = 2.0 * kPi;

double sines(double time_s) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kSines.size(); ++k) {
        // Schroeder's phases keep the sum low.
        const double phase = -kPi * static_cast<double>(k * k) / static_cast<double>(kSines.size());
        const double frequency_Hz = kSines[k] / kPeriod_s;
        sum += kAmplitude * std::max(1.0, std::sqrt(frequency_Hz)) *
               std::cos(kTwoPi * frequency_Hz * time_s + phase);
    }
    return sum;
}

/// The built-in autopilot where the loop looks for one behind a wire.
class BuiltIn final : public autopilot::ExternalAutopilot {
public:
    explicit BuiltIn(const simulation::FlightModel& model, const simulation::FlightState& state)
        : model_(model.autopilot), state_(state.autopilot) {}

    Estimate estimate(double) override { return state_.estimate; }
    void tell(const Readings& readings, const Setpoint& setpoint, double time_s) override {
        autopilot::estimate(model_, state_, readings);
        command_ = autopilot::control(model_, state_, setpoint, time_s);
    }
    RotorCommand command() override { return command_; }
    [[nodiscard]] std::optional<std::string_view> failure() const override { return {}; }
    [[nodiscard]] double waited_s() const override { return 0.0; }
    [[nodiscard]] std::string obstacle() const override { return {}; }

private:
    autopilot::AutopilotModel model_;
    autopilot::AutopilotState state_;
    RotorCommand command_;
};

/// An autopilot whose commands are pushed on their way to the rotors, and what went in and out.
class Pushed final : public autopilot::ExternalAutopilot {
public:
    struct Row {
        double rate_rad_s = 0.0;  ///< as the gyro told it
        double torque = 0.0;      ///< as the autopilot commanded it
    };
    explicit Pushed(const autopilot::Mixer& mixer) : mixer_(mixer) {}

    void fly(autopilot::ExternalAutopilot& inner) { inner_ = &inner; }
    /// From now on, by the time since then.
    void push(std::function<double(double time_s)> torque) {
        push_ = std::move(torque);
        rows_.clear();
    }
    [[nodiscard]] bool pushes() const { return push_ != nullptr; }
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

    Estimate estimate(double time_s) override { return inner_->estimate(time_s); }
    void tell(const Readings& readings, const Setpoint& setpoint, double time_s) override {
        rate_rad_s_ = readings.imu.value.rate_B_rad_s.y();
        inner_->tell(readings, setpoint, time_s);
    }
    RotorCommand command() override {
        RotorCommand told = inner_->command();
        told.command.resize(mixer_.rotors());  // a wire has places for more
        if (!push_) {
            return told;
        }
        double torque = 0.0;
        const double push = push_(static_cast<double>(rows_.size()) * kControl_s);
        for (std::size_t i = 0; i < told.command.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            torque += mixer_.effect(1, at) * told.command[i];
            told.command[i] = std::clamp(told.command[i] + mixer_.pitch[at] * push, 0.0, 1.0);
        }
        rows_.push_back({rate_rad_s_, torque});
        return told;
    }
    [[nodiscard]] std::optional<std::string_view> failure() const override {
        return inner_->failure();
    }
    [[nodiscard]] double waited_s() const override { return inner_->waited_s(); }
    [[nodiscard]] std::string obstacle() const override { return inner_->obstacle(); }

    static constexpr double kControl_s = 0.004;

private:
    const autopilot::Mixer& mixer_;
    autopilot::ExternalAutopilot* inner_ = nullptr;
    std::function<double(double time_s)> push_;
    double rate_rad_s_ = 0.0;  ///< told last
    std::vector<Row> rows_;
};

using Overrides = std::vector<std::string>;

std::shared_ptr<const simulation::FlightModel> model_of(Place place, const Overrides& more) {
    Overrides overrides = loop_overrides(place);
    overrides.insert(overrides.end(), more.begin(), more.end());
    auto model = simulation::build_model(
        scenario::load_scenario(loop_scenario(place), {.overrides = overrides}));
    require(model->control_rate_Hz == 250, "rows are counted by that rate");
    return model;
}

/// One flight: whoever flies it is pushed once it stands still where it is to be.
class Trial {
public:
    Trial(Place place, const Overrides& more, autopilot::ExternalAutopilot* external)
        : place_(place), model_(model_of(place, more)), pushed_(model_->autopilot.mixer) {
        if (external != nullptr) {
            pushed_.fly(*external);
            flight_.emplace(model_, simulation::bring_up(*model_, {.autopilot = &pushed_}, {}),
                            simulation::Outside{.autopilot = &pushed_});
        } else {
            const simulation::Flight fresh(model_);
            built_in_.emplace(*model_, fresh.state());
            pushed_.fly(*built_in_);
            flight_.emplace(model_, fresh.save(), simulation::Outside{.autopilot = &pushed_});
        }
    }

    void push(std::function<double(double)> torque) {
        constexpr double kStill_s = 2.0;
        while (!there() || seconds(flight_->state().tick) < since_s_ + kStill_s) {
            tick();
            if (!there()) {
                since_s_ = seconds(flight_->state().tick);
            }
        }
        pushed_.push(std::move(torque));
    }
    /// @param each  after each stride, with the time since then [s]
    void go_on(
        double time_s, const std::function<void(double since_s)>& each = [](double) {}) {
        const Tick began = flight_->state().tick;
        for (double since_s = 0.0; since_s < time_s;) {
            tick();
            since_s = seconds(flight_->state().tick - began);
            each(since_s);
        }
    }
    [[nodiscard]] const std::vector<Pushed::Row>& rows() const { return pushed_.rows(); }
    [[nodiscard]] double pitch_deg() const {
        return degrees(euler_from_quaternion(flight_->state().truth.base.q_WF).pitch_rad);
    }

private:
    [[nodiscard]] bool there() const {
        return place_ == Place::hover ||
               flight_->state().guidance.state == guidance::PerchingState::releasing;
    }
    void tick() {
        (void)flight_->tick();
        if (flight_->ended()) {
            throw std::runtime_error("the flight ended before it was identified: " +
                                     std::string(flight_->state().ending->reason.view()));
        }
    }

    Place place_;
    std::shared_ptr<const simulation::FlightModel> model_;
    Pushed pushed_;
    std::optional<BuiltIn> built_in_;
    std::optional<simulation::Flight> flight_;
    double since_s_ = 0.0;
};

}  // namespace

std::string loop_scenario(Place place) {
    return place == Place::hover ? "hover" : "perch_metal";
}

std::vector<std::string> loop_overrides(Place place) {
    if (place == Place::hover) {
        return {"simulation.hover_s=100"};
    }
    // Holds for as long as it takes, on motors that let the swing decay.
    return {
        "wall.surface.unsealing_time_constant_s=500", "guidance.release_limit_s=200",
        "guidance.oscillation_limit_deg=40",          "simulation.time_limit_s=200",
        "vehicle.rotor.time_constant_up_s=0.02",      "vehicle.rotor.time_constant_down_s=0.02"};
}

std::vector<ResponsePoint> loop_response(Place place, autopilot::ExternalAutopilot* external) {
    Trial trial(place, {}, external);
    trial.push(sines);
    const auto rows = static_cast<std::size_t>(std::lround(kSettle_s / Pushed::kControl_s));
    trial.go_on(kSettle_s + kPeriods * kPeriod_s + 2.0 * Pushed::kControl_s);
    const std::size_t count =
        static_cast<std::size_t>(std::lround(kPeriods * kPeriod_s / Pushed::kControl_s));
    require(trial.rows().size() >= rows + count, "whole periods of all sines");
    std::vector<ResponsePoint> points;
    for (const int sine : kSines) {
        const double frequency_Hz = sine / kPeriod_s;
        std::complex<double> in, out;
        for (std::size_t k = 0; k < count; ++k) {
            const Pushed::Row& row = trial.rows()[rows + k];
            const auto turn = std::polar(
                1.0, -kTwoPi * frequency_Hz * static_cast<double>(k) * Pushed::kControl_s);
            in += turn * row.rate_rad_s;
            out += turn * row.torque;
        }
        points.push_back({place, frequency_Hz, out / in});
    }
    return points;
}

Swing kicked_swing(double lag_s, double pivot_m, autopilot::ExternalAutopilot* external) {
    constexpr double kKick = 0.1;
    constexpr double kKick_s = 0.1;
    constexpr double kWatch_s = 14.0;
    constexpr double kSeen_deg = 0.15;  ///< half swings smaller than that are noise
    Trial trial(Place::cup,
                {fmt::format("vehicle.rotor.time_constant_up_s={}", lag_s),
                 fmt::format("vehicle.rotor.time_constant_down_s={}", lag_s),
                 fmt::format("vehicle.cup.joint_x_m={}", pivot_m)},
                external);
    trial.push([](double time_s) { return time_s < kKick_s ? kKick : 0.0; });
    std::vector<double> time_s, pitch_deg;
    trial.go_on(kWatch_s, [&](double since_s) {
        time_s.push_back(since_s);
        pitch_deg.push_back(trial.pitch_deg());
    });
    const paper::KickedSwing swing =
        paper::measure_swing(std::move(time_s), std::move(pitch_deg), kSeen_deg);
    return {swing.growth_1_s, swing.frequency_Hz};
}

std::string response_text(const std::vector<ResponsePoint>& points) {
    std::string text = "place,frequency_Hz,gain_s_rad,phase_deg\n";
    for (const ResponsePoint& point : points) {
        text += fmt::format("{},{:.1f},{:.5f},{:.2f}\n",
                            point.place == Place::hover ? "hover" : "cup", point.frequency_Hz,
                            std::abs(point.torque_s_rad), degrees(std::arg(point.torque_s_rad)));
    }
    return text;
}

}  // namespace limpet
