// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/flight_host.hpp"

#include <fmt/format.h>

#include <boost/coroutine2/protected_fixedsize_stack.hpp>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::gazebo11 {
namespace {

/// fly() keeps its large things on the heap; the compressor of recordings wants some stack, and so
/// does an error on its way out: with 1 MiB the one of a folder that cannot be made overran it.
constexpr std::size_t kStack_bytes = 2 * 1024 * 1024;

}  // namespace

std::filesystem::path flight_file(const std::filesystem::path& file, int flight) {
    if (file.empty() || flight == 1) {
        return file;
    }
    return file.parent_path() /
           fmt::format("{}-{}{}", file.stem().string(), flight, file.extension().string());
}

FlightHost::FlightHost(gazebo::physics::ModelPtr vehicle, HostedFlight flight)
    : flight_(std::move(flight)) {
    const auto plant = std::make_shared<const GazeboModel>(std::move(vehicle), flight_.scenario,
                                                           [this] { return wait_for_gazebo(); });
    flight_.conduct.stop = &interrupted_;
    if (flight_.live != nullptr) {
        flight_.conduct.mirror = &flight_.live->live();
        flight_.watch.on_tick = [this, more = std::move(flight_.watch.on_tick)](
                                    simulation::Flight& flown, const guidance::EventList& events) {
            if (more) {
                more(flown, events);
            }
            flight_.live->tick(flown);
        };
    }
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

bool FlightHost::wait_for_gazebo() {
    if (!interrupted_) {
        (*to_gazebo_)();
    }
    return !interrupted_;
}

void FlightHost::restart() {
    if (under_way()) {
        try {
            interrupt();
        } catch (const Interrupted&) {  // it had not begun
        }
    }
    interrupted_ = false;
    flights_ += coroutine_ != nullptr ? 1 : 0;
    coroutine_.reset();
    result_.reset();
}

void FlightHost::run(Coroutine::push_type& to_gazebo) {
    to_gazebo_ = &to_gazebo;
    try {
        result_ = fly(model_, flight_file(flight_.recording, flights_), flight_.watch, 0,
                      flight_.conduct);
        if (flight_.live != nullptr) {
            flight_.live->end(*result_);
        }
    } catch (const boost::context::detail::forced_unwind&) {
        throw;  // restart() or the end of the world, in the middle of a flight
    } catch (...) {
        failure_ = std::current_exception();
    }
}

}  // namespace limpet::gazebo11
