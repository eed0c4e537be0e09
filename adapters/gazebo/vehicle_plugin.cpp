// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo/vehicle_plugin.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <gazebo/transport/transport.hh>
#include <utility>

#include "adapters/gazebo/sdf_reader.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/simulation/flight_text.hpp"
#include "limpet/simulation/px4_setup.hpp"

namespace limpet::gazebo11 {
namespace {

void print_line(const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
}

void write_result(const std::filesystem::path& path, const simulation::FlightResult& result) {
    if (path.empty()) {
        return;
    }
    std::ofstream file(path);
    file << result_json(result) << "\n";
    file.close();
    if (!file) {
        throw InputError("cannot write " + path.string());
    }
}

/// Each sets the world's step and takes over ODE's messages: only one is possible.
std::atomic<const VehiclePlugin*> the_one{nullptr};

void quit() {
    gazebo::transport::NodePtr node(new gazebo::transport::Node());
    node->Init();
    const auto control = node->Advertise<gazebo::msgs::ServerControl>("/gazebo/server/control");
    gazebo::msgs::ServerControl stop;
    stop.set_stop(true);
    control->Publish(stop, true);
}

}  // namespace

VehiclePlugin::~VehiclePlugin() {
    end_flight();
    const VehiclePlugin* self = this;
    the_one.compare_exchange_strong(self, nullptr);
}

void VehiclePlugin::end_flight() noexcept {
    on_update_.reset();
    watched_ = true;
    if (watching_.joinable()) {
        watching_.join();
    }
    topics_.reset();  // the transport may be gone by now
    if (host_ == nullptr || !host_->under_way()) {
        return;
    }
    try {
        host_->interrupt();
        print_line("interrupted; the recording is whole up to here");
        write_result(flight_file(options_.result, host_->flights()), *host_->result());
    } catch (const Interrupted& error) {  // before it began: there is nothing to record
        print_line(error.what());
    } catch (const std::exception& error) {  // as of a full disk: destructors must not throw
        fmt::print(stderr, "limpet: the flight was not ended well: {}\n", error.what());
    }
}

void VehiclePlugin::Load(gazebo::physics::ModelPtr model, sdf::ElementPtr sdf) {
    const gazebo::physics::WorldPtr world = model->GetWorld();
    load_or_end(*world, [&] { configure(std::move(model), sdf); });
}

/// A wait for a PX4 or a viewer ends when the world is to stop: its destructor comes after
/// that wait.
void VehiclePlugin::watch_world() {
    constexpr std::chrono::milliseconds kEvery(50);
    while (!watched_) {
        if (!world_->Running()) {
            stop_ = true;
            return;
        }
        std::this_thread::sleep_for(kEvery);
    }
}

void VehiclePlugin::configure(gazebo::physics::ModelPtr model, const sdf::ElementPtr& sdf) {
    std::vector<std::string_view> elements = vehicle_elements();
    const std::vector<std::string_view> more = more_elements();
    elements.insert(elements.end(), more.begin(), more.end());
    const scenario::YamlNode parameters = sdf_tree(
        sdf, {.place = "model " + model->GetName() + ": " + sdf->Get<std::string>("filename"),
              .lists = {"set"},
              .from_environment = elements});
    options_ = read_vehicle_options(parameters, elements);
    world_ = model->GetWorld();
    if (the_one != nullptr) {
        throw InputError(
            fmt::format("model {}: a vehicle flies in this world already, allowed one a gzserver: "
                        "start another "
                        "one, with a GAZEBO_MASTER_URI of its own",
                        model->GetName()));
    }
    HostedFlight flight;
    flight.scenario = options_.scenario;
    flight.recording = options_.recording;
    flight.conduct.speed = options_.speed;
    flight.conduct.on_obstacle = [](const std::string& obstacle) {
        print_line("          " + (obstacle.empty() ? "armed" : obstacle));
    };
    topics_ = std::make_unique<FlightTopics>(*model, sdf->Get<std::string>("name"),
                                             options_.scenario.airframe);
    flight.watch.on_event = [this](const Event& event) {
        print_line(simulation::event_line(event));
        if (topics_) {
            topics_->publish(event);
        }
    };
    prepare(parameters, flight);
    flight.watch.on_tick = [this, more = std::move(flight.watch.on_tick)](
                               simulation::Flight& flown, const guidance::EventList& events) {
        if (topics_) {
            topics_->tick(flown);
        }
        if (more) {
            more(flown, events);
        }
    };
    const bool by_px4 = options_.autopilot == VehicleOptions::Autopilot::px4;
    if (by_px4 || options_.live) {
        watching_ = std::thread([this] { watch_world(); });
    }
    if (options_.live) {
        live_ = std::make_unique<live::LiveFlight>(
            live::LiveFlightOptions{.port = *options_.live, .tunes = !by_px4}, options_.scenario,
            stop_);
        flight.live = live_.get();
        print_line("live       " + live_->live().address());
    }
    if (by_px4) {
        const px4::Px4WireWatch watch{
            .on_open = [](const std::string& where) { print_line("waiting for PX4 on " + where); },
            .on_text = [](const std::string& text) { print_line("          PX4: " + text); },
            .on_difference =
                [](const std::vector<mavlink::ParameterDifference>& found) {
                    for (const std::string& line : lines_of(found)) {
                        print_line("parameters " + line);
                    }
                },
            .wait_key = "wait_s"};
        px4::Px4Addresses addresses = options_.px4;
        px4::Px4Airframe airframe = simulation::px4_airframe(options_.scenario);
        airframe.target = addresses.serial() ? px4::Px4Target::hitl : px4::Px4Target::sitl;
        addresses.expected = px4::expected_parameters(airframe);
        px4_ = std::make_unique<px4::Px4Wires>(
            addresses, std::round(options_.scenario.sensors.imu_rate_Hz), true, watch, &stop_);
        flight.conduct.outside.autopilot = &px4_->autopilot();
    }
    host_ = std::make_unique<FlightHost>(std::move(model), std::move(flight));
    the_one = this;
    world_->Physics()->SetRealTimeUpdateRate(0.0);
    print_line(fmt::format("{}, seed {}: {}", options_.scenario.name, options_.scenario.seed,
                           options_.scenario.description));
    print_line(simulation::event_head());
    on_update_ = gazebo::event::Events::ConnectWorldUpdateBegin(
        [this](const gazebo::common::UpdateInfo&) { run_or_end([this] { update(); }); });
}

void VehiclePlugin::update() {
    if (reported_) {
        world_->SetPaused(true);  // nothing flies it any more; a world reset begins anew
        return;
    }
    host_->update();
    if (host_->result() != nullptr) {
        reported_ = true;
        end();
    }
}

void VehiclePlugin::end() {
    const simulation::FlightResult& result = *host_->result();
    print_line("");
    for (const std::string& line :
         flight_summary(result, [](const std::string& text) { return text; })) {
        print_line(line);
    }
    if (const long long complaints = take_solver_complaints(); complaints > 0) {
        print_line(
            fmt::format("engine     ODE's contact solver stopped early {} times", complaints));
    }
    if (live_ != nullptr) {
        print_line("live       " + live_->live().report());
    }
    write_result(flight_file(options_.result, host_->flights()), result);
    world_->SetPaused(true);
    if (options_.when_over == VehicleOptions::WhenOver::quit) {
        quit();
    }
}

void VehiclePlugin::Reset() {
    if (px4_ != nullptr) {
        print_line("a flight with a PX4 does not begin anew with the world; start gzserver again");
        host_.reset();
        reported_ = true;  // from now on the world stands still
        return;
    }
    if (host_ == nullptr) {
        return;  // spawned, and not loaded
    }
    run_or_end([this] { host_->restart(); });
    print_line(fmt::format("flight {}", host_->flights()));
    reported_ = false;
}

}  // namespace limpet::gazebo11
