// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/flight_log.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "limpet/autopilot/consistency.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/find_by.hpp"
#include "limpet/core/version.hpp"
#include "limpet/meshes/readers.hpp"
#include "limpet/models/drawing.hpp"
#include "limpet/models/finish.hpp"
#include "limpet/models/model_writer.hpp"

namespace limpet::simulation {
namespace {

/// The meshes that the description names.
void attach_meshes(const vehicle::Airframe& airframe, std::vector<mcap::Attachment>& all) {
    for (const models::Part& part : models::draw(airframe)) {
        if (part.shape != models::Shape::mesh) {
            continue;
        }
        require(part.mesh != nullptr, "a vehicle's meshes are read with it");
        if (find_named(all, part.mesh_name) == nullptr) {
            all.push_back({.name = part.mesh_name,
                           .media_type = std::string(record::kMeshMediaType),
                           .text = meshes::stl_of(*part.mesh)});
        }
    }
}

}  // namespace

record::Scene scene_of_recording(const FlightModel& model) {
    const scenario::Scenario& scenario = *model.scenario;
    const vehicle::Airframe& airframe = scenario.airframe;
    record::Scene scene{.robot_description = models::write_robot_description(airframe),
                        .has_cup = airframe.has_cup,
                        .lidar_p_B_m = model.sensors.mounts.lidar_p_B_m,
                        .joint_B_m = {airframe.cup.joint_x_m, 0.0, airframe.cup.joint_z_m},
                        .lip_m = airframe.cup.lip_offset_m,
                        .rotor_p_B_m = model.autopilot.vehicle.rotor_p_B_m,
                        .thrust_N_s2 = RotorList<double>(airframe.rotors.size())};
    for (std::size_t i = 0; i < airframe.rotors.size(); ++i) {
        scene.thrust_N_s2[i] =
            airframe.rotors[i].thrust_share * airframe.rotor.thrust_per_speed_2_kg_m();
    }
    if (model.payload.hangs) {
        scene.hook_B_m = model.payload.hook_B_m;
    }
    if (scenario.wall.present) {
        const models::FinishLook& finish =
            models::look(models::finish_of(scenario.wall.surface.name));
        scene.wall = scenario.wall.geometry;
        scene.surface = finish.name;
        std::copy_n(finish.rgb, 3, scene.wall_colour.begin());
    }
    return scene;
}

namespace {

record::RecordingInfo describe(const FlightModel& model, const FlightLog::Options& options) {
    const scenario::Scenario& scenario = *model.scenario;
    record::RecordingInfo info;
    info.mirror = options.mirror;
    info.compress = options.compress;
    info.topics = options.topics;
    info.scenario = scenario.name;
    info.seed = scenario.seed;
    info.version = kVersion;
    info.rotors = scenario.airframe.rotors.size();
    if (scenario.airframe.has_cup) {
        info.numbers["land_pressure_Pa"] = fmt::format("{}", scenario.guidance.land_pressure_Pa);
        info.numbers["detach_pressure_Pa"] =
            fmt::format("{}", scenario.guidance.detach_pressure_Pa);
    }
    info.attachments.push_back(
        {.name = "scenario.yaml", .media_type = "application/yaml", .text = to_yaml(scenario)});
    for_each_type(sensors::Sensors{}, [&](auto type) {
        using Sensor = typename decltype(type)::type;
        if constexpr (!sensors::kIsRead<Sensor>) {
            info.columns.push_back(
                {.topic = Sensor::kTopic, .type = Sensor::kMessage, .columns = Sensor::kColumns});
        }
    });
    if (model.payload.hangs) {
        info.columns.push_back({.topic = record::kPayloadTopic,
                                .type = record::kPayloadType,
                                .columns = record::kPayloadColumns});
    }
    info.attachments.push_back({.name = "model.xml",
                                .media_type = "application/xml",
                                .text = write_mjcf(scenario.airframe, scene_of(scenario))});
    attach_meshes(scenario.airframe, info.attachments);
    info.scene = scene_of_recording(model);
    info.range_sensor.minimum_m = scenario.sensors.lidar_range_min_m;
    info.range_sensor.maximum_m = scenario.sensors.lidar_range_max_m;
    return info;
}

}  // namespace

FlightLog::FlightLog(const std::filesystem::path& path, const FlightModel& model,
                     const Options& options)
    : recorder_(path, describe(model, options)), brief_(options.brief) {}

Moment moment_of(const FlightState& state) {
    Moment now{.tick = state.tick,
               .fine_until = state.fine_until,
               .truth = state.truth,
               .readings = state.sensors.readings,
               .heard = {},
               .estimate = state.autopilot.estimate,
               .setpoint = state.guidance.setpoint,
               .state = state.guidance.state,
               .attempt = state.guidance.attempt,
               .command = state.command,
               .consistency = {}};
    for_each_type(sensors::Sensors{}, [&](auto type) {
        using Sensor = typename decltype(type)::type;
        if constexpr (!sensors::kIsRead<Sensor>) {
            std::get<Moment::Heard<Sensor>>(now.heard.of).sample =
                state.sensors.template units<Sensor>()[0].heard;
        }
    });
    return now;
}

std::optional<Consistency> ConsistencyWatch::next(const FlightModel& model,
                                                  const FlightState& state) {
    constexpr double kEvery_s = 0.04 - 1e-9;
    const autopilot::EstimatorState& filter = state.autopilot.estimator;
    std::optional<Consistency> now;
    if (before_s_ - last_s_ >= kEvery_s && filter.time_s == before_s_ &&
        filter.covariance_s == before_s_) {
        const auto& imu = state.sensors.units<sensors::ImuSensor>()[0].state;
        now = consistency_of(model.autopilot.parameters, filter,
                             error_of(filter, before_, imu.gyro_turn_on_rad_s + imu.gyro_bias_rad_s,
                                      imu.accel_turn_on_m_s2 + imu.accel_bias_m_s2));
        last_s_ = before_s_;
    }
    before_ = state.truth.base;
    before_s_ = state.truth.time_s;
    return now;
}

void FlightLog::tick(const FlightModel& model, const FlightState& state,
                     const guidance::EventList& events) {
    for (std::size_t k = 0; k < events.count; ++k) {
        recorder_.event(events.events[k]);
    }
    Moment now = moment_of(state);
    now.consistency = honesty_.next(model, state);
    moment(model, now);
}

void FlightLog::record_payload(std::size_t channel, const Truth& truth) {
    const PayloadStatus& payload = truth.payload;
    const Vector3 &p = payload.p_W_m, &v = payload.v_W_m_s;
    const std::array<double, record::kPayloadColumns.size()> numbers = {
        p.x(), p.y(), p.z(), v.x(), v.y(), v.z(), payload.tension_N, payload.parted ? 1.0 : 0.0};
    recorder_.columns(channel, Sample<PayloadStatus>{truth.time_s, payload}, numbers);
}

void FlightLog::moment(const FlightModel& model, const Moment& now) {
    constexpr int kBrief_Hz = 25;
    if (brief_ && !due(now.tick, kBrief_Hz)) {
        return;
    }
    recorder_.new_readings(now.readings, last_);
    if (now.consistency) {
        recorder_.consistency(*now.consistency);
    }
    std::size_t channel = 0;
    for_each_type(sensors::Sensors{}, [&](auto type) {
        using Sensor = typename decltype(type)::type;
        if constexpr (!sensors::kIsRead<Sensor>) {
            const auto& heard = std::get<Moment::Heard<Sensor>>(now.heard.of).sample;
            recorder_.columns(channel++, heard, Sensor::numbers(heard.value));
        }
    });
    const bool regular = due(now.tick, model.record_rate_Hz);
    // Around a touch the truth is as dense as what is measured of it.
    const bool touch = now.tick < now.fine_until &&
                       sensors::sampled(now.tick, model.sensors.parameters.force_rate_Hz);
    if (regular || touch) {
        recorder_.truth(now.truth);
        if (model.payload.hangs) {
            record_payload(channel, now.truth);
        }
    }
    const int marks_Hz = brief_ ? 5 : 25;
    if (due(now.tick, marks_Hz)) {
        recorder_.scene(now.truth, now.readings, now.setpoint);
    }
    if (regular) {
        const double time_s = seconds(now.tick);
        recorder_.estimate(now.estimate);
        recorder_.setpoint(time_s, now.setpoint);
        recorder_.guidance(time_s, to_string(now.state), now.attempt);
        recorder_.rotor_command(time_s, now.command);
    }
}

}  // namespace limpet::simulation
