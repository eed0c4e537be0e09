// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/src/simulator.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/simulation/advance.hpp"
#include "limpet/simulation/collision.hpp"
#include "limpet/simulation/flight_text.hpp"
#include "limpet/suction/cup.hpp"

namespace limpet::ros {
namespace {

constexpr const char* kNoWorld = "no world is loaded";
constexpr const char* kEnded = "the flight has ended: reset the simulation";

/// "flight.mcap", "flight-2.mcap", ...
std::filesystem::path recording_of(const std::filesystem::path& file, int flight) {
    if (file.empty() || flight == 1) {
        return file;
    }
    return file.parent_path() /
           fmt::format("{}-{}{}", file.stem().string(), flight, file.extension().string());
}

void log_event(const Event& event) {
    ROS_INFO("%7.3f  %s %s%s%s", event.time_s, std::string(event.station).c_str(),
             std::string(to_string(event.name)).c_str(), event.reason.empty() ? "" : ": ",
             std::string(event.reason).c_str());
}

}  // namespace

Simulator::Simulator(const SimulatorOptions& options, const SetupArguments& flight,
                     record::MessageSink* seen)
    : options_(options), seen_(seen), pace_(options.speed) {
    load(flight);
    if (!options_.stopped) {
        static_cast<void>(play());
    }
}

Simulator::~Simulator() {
    unload();
}

Simulator::Acceleration Simulator::acceleration() const {
    if (!before_ || !flight_) {
        return {};
    }
    const Kinematics& now = flight_->state().truth.base;
    return {.linear_W = (now.v_WF_W_m_s - before_->v_WF_W_m_s) / kTick_s,
            .angular_W =
                (now.q_WF * now.w_WF_F_rad_s - before_->q_WF * before_->w_WF_F_rad_s) / kTick_s};
}

double Simulator::clock_s() const {
    return Received::kClockStart_s + (flight_ ? seconds(flight_->state().tick) : 0.0);
}

// --- one flight after another -------------------------------------------------------------------

void Simulator::begin() {
    flight_ = std::make_unique<simulation::Flight>(model_, 0, vehicle_->outside());
    events_.clear();
    before_.reset();
    pace_ = simulation::Pace(options_.speed);
    const std::filesystem::path recording = recording_of(options_.recording, ++flights_);
    if (!recording.empty() || seen_ != nullptr) {
        log_.emplace(recording, *model_, simulation::FlightLog::Options{.mirror = seen_});
    }
}

/// Its recording is whole, whatever comes next.
void Simulator::end() {
    if (!flight_) {
        return;
    }
    give_up_stepping("the flight is over");
    flight_->stop(Outcome::interrupted, "interrupted");
    simulation::FlightResult result = simulation::result_of(*flight_, pace_.elapsed_s());
    result.events = std::exchange(events_, {});
    result.recording = recording_of(options_.recording, flights_);
    if (log_) {
        log_->finish(summary_json(result));
        log_.reset();
    }
    fmt::print("{}: {}, after {:.2f} s\n", told_with_truth(result.outcome, result.true_end),
               result.reason, result.performance.simulated_s);
    flight_.reset();
}

void Simulator::load(const SetupArguments& flight) {
    const NodeSetup setup = load_setup(flight);
    auto model = simulation::build_model(setup.scenario);
    unload();
    arguments_ = flight;
    model_ = std::move(model);
    publish_flight(flight);
    vehicle_ = std::make_unique<RosVehicle>(setup.scenario, options_.vehicle);
    begin();
    state_ = SimulatorState::stopped;
}

void Simulator::unload() {
    end();
    vehicle_.reset();
    model_.reset();
    state_ = SimulatorState::no_world;
}

std::string Simulator::reset() {
    if (!flight_) {
        return kNoWorld;
    }
    // What is received begins anew by the flight's time going back, which after one tick it would
    // not.
    const bool has_hardly_begun = flight_->state().tick == 1;
    end();
    if (has_hardly_begun) {
        vehicle_.reset();
        vehicle_ = std::make_unique<RosVehicle>(*model_->scenario, options_.vehicle);
    }
    begin();
    return "";
}

std::string Simulator::stop() {
    std::string obstacle = reset();
    if (obstacle.empty()) {
        state_ = SimulatorState::stopped;
    }
    return obstacle;
}

// --- time ---------------------------------------------------------------------------------------

std::string Simulator::play() {
    if (!flight_ || flight_->ended()) {
        return flight_ ? kEnded : kNoWorld;
    }
    give_up_stepping("played on");
    state_ = SimulatorState::playing;
    return "";
}

std::string Simulator::pause() {
    if (!flight_) {
        return kNoWorld;
    }
    state_ = SimulatorState::paused;
    return "";
}

std::string Simulator::step(std::uint64_t ticks, std::function<void(const Stepping&)> report) {
    if (state_ != SimulatorState::paused) {
        return "the simulation is not paused";
    }
    if (moves()) {
        return "a step is under way";
    }
    if (flight_->ended()) {
        return kEnded;
    }
    if (ticks == 0) {
        return "0 steps: must be 1 or more";
    }
    stepping_ = {.left = ticks};
    report_ = std::move(report);
    return "";
}

void Simulator::give_up_stepping(const std::string& why) {
    if (stepping_.left > 0) {
        Stepping given_up = std::exchange(stepping_, {});
        given_up.obstacle = why;
        std::exchange(report_, nullptr)(given_up);
    }
}

bool Simulator::moves() const {
    return flight_ && !flight_->ended() &&
           (state_ == SimulatorState::playing || stepping_.left > 0);
}

void Simulator::tick() {
    before_ = flight_->state().truth.base;
    const guidance::EventList& happened = flight_->tick();
    for (std::size_t i = 0; i < happened.count; ++i) {
        events_.push_back(happened.events[i]);
        log_event(happened.events[i]);
    }
    if (log_) {
        log_->tick(*model_, flight_->state(), happened);
    }
    vehicle_->show(*flight_);
    if (stepping_.left > 0) {
        ++stepping_.done;
        --stepping_.left;
        const Stepping now = stepping_;
        const auto to = now.left == 0 ? std::exchange(report_, nullptr) : report_;
        to(now);
    } else {
        pace_.wait_until(seconds(flight_->state().tick));
    }
    if (flight_->ended()) {
        give_up_stepping(kEnded);
        state_ = options_.stopped ? SimulatorState::paused : SimulatorState::quitting;
    }
}

void Simulator::run(const std::function<void(double patience_s)>& listen) {
    constexpr double kPatience_s = 0.1;
    while (::ros::ok() && state_ != SimulatorState::quitting) {
        listen(moves() ? 0.0 : kPatience_s);
        if (moves()) {
            tick();
        }
    }
    end();
}

// --- places -------------------------------------------------------------------------------------

std::string Simulator::place(const Kinematics& base) {
    if (!flight_ || flight_->ended()) {
        return flight_ ? kEnded : kNoWorld;
    }
    simulation::Snapshot now = flight_->save();
    simulation::FlightState& state = now.state;
    if (suction::is_sealed(state.cup.status.phase)) {
        return "the cup holds the vehicle on the wall";
    }
    const simulation::FlightModel& model = flight_->model();
    const auto plant = model.plant->make();
    plant->restore(now.plant);
    plant->set_pose(base.p_WF_m, base.q_WF, base.v_WF_W_m_s, base.w_WF_F_rad_s);
    see_motion(model, state.truth, *plant);
    if (const auto hit = collision(model, state.truth)) {
        return fmt::format("not free there: {}", hit->reason.view());
    }
    now.plant = plant->save();
    // Else it would believe for a second that it is where it was.
    Estimate there = state.autopilot.estimate;
    there.time_s = state.autopilot.estimator.time_s;
    there.p_WB_m = base.p_WF_m;
    there.v_WB_m_s = base.v_WF_W_m_s;
    there.q_WB = base.q_WF;
    there.w_WB_B_rad_s = base.w_WF_F_rad_s;
    there.variance = {};
    const auto position = state.autopilot.position;
    state.autopilot = autopilot::start(model.autopilot, there);
    state.autopilot.position.integral_m_s2 = position.integral_m_s2;
    flight_->restore(now);
    before_.reset();
    return "";
}

}  // namespace limpet::ros
