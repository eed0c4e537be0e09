// SPDX-License-Identifier: Apache-2.0
#include "gazebo/flight_host.hpp"

#include <boost/coroutine2/protected_fixedsize_stack.hpp>
#include <utility>

namespace limpet::gazebo11 {
namespace {

/// fly() keeps its large things on the heap; the compressor of recordings wants some stack.
constexpr std::size_t kStack_bytes = 1024 * 1024;

}  // namespace

FlightHost::FlightHost(gazebo::physics::ModelPtr vehicle, HostedFlight flight)
    : flight_(std::move(flight)) {
    const auto plant = std::make_shared<const GazeboModel>(std::move(vehicle), flight_.scenario,
                                                           [this] { wait_for_gazebo(); });
    flight_.conduct.stop = &interrupted_;
    model_ = simulation::build_model(flight_.scenario, plant);
}

void FlightHost::update() {
    if (result_) {
        return;
    }
    if (coroutine_ == nullptr) {
        coroutine_ = std::make_unique<Coroutine::pull_type>(
            boost::coroutines2::protected_fixedsize_stack(kStack_bytes),
            [this](Coroutine::push_type& to_gazebo) { run(to_gazebo); });
    } else if (*coroutine_) {
        (*coroutine_)();
    }
    if (failure_) {
        std::rethrow_exception(std::exchange(failure_, nullptr));
    }
}

void FlightHost::interrupt() {
    interrupted_ = true;
    update();
}

void FlightHost::wait_for_gazebo() {
    if (!interrupted_) {
        (*to_gazebo_)();
    }
}

void FlightHost::restart() {
    coroutine_.reset();
    result_.reset();
}

void FlightHost::run(Coroutine::push_type& to_gazebo) {
    to_gazebo_ = &to_gazebo;
    try {
        result_ = fly(model_, flight_.recording, flight_.watch, 0, flight_.conduct);
    } catch (const boost::context::detail::forced_unwind&) {
        throw;  // restart() or the end of the world, in the middle of a flight
    } catch (...) {
        failure_ = std::current_exception();
    }
}

}  // namespace limpet::gazebo11
