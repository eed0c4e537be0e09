// SPDX-License-Identifier: Apache-2.0
#include "limpet/faults/faults.hpp"

#include <algorithm>
#include <cmath>

namespace limpet::faults {
namespace {

constexpr int kLidarLeft = 0;
constexpr int kLidarRight = 1;

bool acts(const FaultProgress& progress) {
    return progress.began_s >= 0.0 && !progress.over;
}

bool hits(const Fault& fault, int unit) {
    return fault.unit == kEveryUnit || fault.unit == unit;
}

/// To the right of who looks along `ahead`, level; z of W points down.
Vector3 to_the_right(const Vector3& ahead_W) {
    return Vector3::UnitZ().cross(ahead_W);
}

Quaternion about_z(double angle_rad) {
    return Quaternion(Eigen::AngleAxisd(angle_rad, Vector3::UnitZ()));
}

Event event_of(EventName name, const Fault& fault, double time_s) {
    Event event = make_event(time_s, "faults", name, to_string(fault.kind));
    const KindRow& row = kind_row(fault.kind);
    if (row.units != 0 && fault.unit != kEveryUnit) {
        event.add("unit", fault.unit);
    }
    if (!row.size_unit.empty()) {
        event.add("size", fault.size);
    }
    return event;
}

/// The share of its speed at which a rotor gives this share of its thrust.
double speed_share(double thrust_share) {
    return std::sqrt(thrust_share);
}

void act(const FaultsModel& model, const Fault& fault, std::size_t rotors, Acting& now) {
    const auto slow = [&](double share) {
        now.rotors_hit = true;
        now.speed_share.resize(rotors, 1.0);
        for (std::size_t i = 0; i < rotors; ++i) {
            now.speed_share[i] *= hits(fault, static_cast<int>(i)) ? share : 1.0;
        }
    };
    switch (fault.kind) {
        case FaultKind::guidance_stalls: now.guidance_stalls = true; break;
        case FaultKind::link_lost: now.link_lost = true; break;
        case FaultKind::motor_lost: slow(0.0); break;
        case FaultKind::motor_weak: slow(speed_share(fault.size)); break;
        case FaultKind::battery_empty:
            now.charge_at_most = std::min(now.charge_at_most, fault.size);
            break;
        case FaultKind::pump_lost: now.pump_draws = false; break;
        case FaultKind::hose_leaks:
        case FaultKind::lip_torn: now.hole_mm2 += fault.size; break;
        case FaultKind::hose_blocked:
            now.pump_draws = false;
            now.valve_stuck_shut = true;
            break;
        case FaultKind::valve_stuck_open: now.valve_stuck_open = true; break;
        case FaultKind::valve_stuck_shut: now.valve_stuck_shut = true; break;
        case FaultKind::gust_along: now.gust_W_m_s += fault.size * model.ahead_W; break;
        case FaultKind::gust_across:
            now.gust_W_m_s += fault.size * to_the_right(model.ahead_W);
            break;
        case FaultKind::payload_shifts: now.payload_to_right_kg_m += fault.size; break;
        case FaultKind::payload_shifts_ahead: now.payload_ahead_kg_m += fault.size; break;
        case FaultKind::cable_breaks: now.cable_breaks = true; break;
        case FaultKind::leg_broken:
            for (std::size_t leg = 0; leg < now.legs_lost.size(); ++leg) {
                now.legs_lost[leg] = now.legs_lost[leg] || hits(fault, static_cast<int>(leg));
            }
            break;
        case FaultKind::clock_jumps: now.clock_ahead_s += fault.size; break;
        case FaultKind::none:
        case FaultKind::imu_lost:
        case FaultKind::imu_biased:
        case FaultKind::barometer_lost:
        case FaultKind::magnetometer_lost:
        case FaultKind::magnetometer_turned:
        case FaultKind::gps_lost:
        case FaultKind::mocap_lost:
        case FaultKind::mocap_frozen:
        case FaultKind::mocap_jumps:
        case FaultKind::mocap_drifts:
        case FaultKind::mocap_wrong_body:
        case FaultKind::lidar_lost:
        case FaultKind::lidar_offset:
        case FaultKind::lidar_ghost:
        case FaultKind::force_lost:
        case FaultKind::force_stuck:
        case FaultKind::force_offset:
        case FaultKind::pressure_lost:
        case FaultKind::pressure_stuck:
        case FaultKind::pressure_drifts:
        case FaultKind::battery_sensor_lost:
        case FaultKind::estimate_drifts: break;  // of what is received and believed: below
    }
}

/// What one fault makes of what was sensed.
/// @param known     what the vehicle knows
/// @param arriving  what it receives next, if that is newer
void corrupt(const Fault& fault, const FaultsModel& model, double since_s, const Readings& known,
             Readings& arriving) {
    const auto each_lidar = [&](auto change) {
        if (hits(fault, kLidarLeft)) {
            change(arriving.lidar_left, known.lidar_left);
        }
        if (hits(fault, kLidarRight)) {
            change(arriving.lidar_right, known.lidar_right);
        }
    };
    PoseReading& pose = arriving.motion_capture.value;
    switch (fault.kind) {
        case FaultKind::imu_lost: arriving.imu = known.imu; break;
        case FaultKind::imu_biased: arriving.imu.value.rate_B_rad_s.y() += fault.size; break;
        case FaultKind::barometer_lost: arriving.barometer = known.barometer; break;
        case FaultKind::magnetometer_lost: arriving.magnetometer = known.magnetometer; break;
        case FaultKind::magnetometer_turned: {
            Vector3& field = arriving.magnetometer.value.field_B_gauss;
            field = about_z(radians(fault.size)) * field;
            break;
        }
        case FaultKind::gps_lost: arriving.gps = known.gps; break;
        case FaultKind::mocap_lost: arriving.motion_capture = known.motion_capture; break;
        case FaultKind::mocap_frozen: pose = known.motion_capture.value; break;
        case FaultKind::mocap_drifts: pose.p_WB_m += fault.size * since_s * model.ahead_W; break;
        case FaultKind::mocap_jumps: pose.p_WB_m += fault.size * model.ahead_W; break;
        case FaultKind::mocap_wrong_body:
            pose.p_WB_m += fault.size * to_the_right(model.ahead_W);
            pose.q_WB = about_z(kPi / 2.0) * pose.q_WB;
            break;
        case FaultKind::lidar_lost:
            each_lidar([](auto& sample, const auto& last) { sample = last; });
            break;
        case FaultKind::lidar_offset:
            each_lidar([&](auto& sample, const auto& /*last*/) {
                sample.value.distance_m = std::max(
                    0.0, sample.value.distance_m + (sample.value.valid ? fault.size : 0.0));
            });
            break;
        case FaultKind::lidar_ghost:
            each_lidar([&](auto& sample, const auto& /*last*/) {
                sample.value = {.distance_m = fault.size, .valid = true};
            });
            break;
        case FaultKind::force_lost: arriving.force = known.force; break;
        case FaultKind::force_stuck: arriving.force.value = known.force.value; break;
        case FaultKind::force_offset: arriving.force.value.axial_N += fault.size; break;
        case FaultKind::pressure_lost: arriving.cup_pressure = known.cup_pressure; break;
        case FaultKind::pressure_stuck:
            arriving.cup_pressure.value = known.cup_pressure.value;
            break;
        case FaultKind::pressure_drifts:
            arriving.cup_pressure.value.pressure_Pa += fault.size * since_s;
            break;
        case FaultKind::battery_sensor_lost: arriving.battery = known.battery; break;
        case FaultKind::none:
        case FaultKind::estimate_drifts:
        case FaultKind::guidance_stalls:
        case FaultKind::link_lost:
        case FaultKind::motor_lost:
        case FaultKind::motor_weak:
        case FaultKind::battery_empty:
        case FaultKind::pump_lost:
        case FaultKind::hose_leaks:
        case FaultKind::hose_blocked:
        case FaultKind::valve_stuck_open:
        case FaultKind::valve_stuck_shut:
        case FaultKind::lip_torn:
        case FaultKind::gust_along:
        case FaultKind::gust_across:
        case FaultKind::payload_shifts:
        case FaultKind::payload_shifts_ahead:
        case FaultKind::cable_breaks:
        case FaultKind::leg_broken:
        case FaultKind::clock_jumps: break;  // of what acts: above
    }
}

template <class Visit, class... All>
void for_each_sample(Visit visit, All&... readings) {
    visit(readings.imu...);
    visit(readings.barometer...);
    visit(readings.magnetometer...);
    visit(readings.gps...);
    visit(readings.motion_capture...);
    visit(readings.lidar_left...);
    visit(readings.lidar_right...);
    visit(readings.force...);
    visit(readings.cup_pressure...);
    visit(readings.battery...);
}

template <class T>
void update(Sample<T>& known, const Sample<T>& arriving) {
    if (arriving.newer_than(known)) {
        known = arriving;
    }
}

}  // namespace

void step(const FaultsModel& model, FaultsState& state, guidance::PerchingState phase,
          std::size_t rotors, double time_s, guidance::EventList& events) {
    state.now = {};
    for (std::size_t i = 0; i < model.faults.size(); ++i) {
        const Fault& fault = model.faults[i];
        FaultProgress& progress = state.progress[i];
        if (progress.due_s < 0.0 && (!fault.phase || *fault.phase == phase)) {
            progress.due_s = (fault.phase ? time_s : 0.0) + fault.after_s;
        }
        const bool due = progress.due_s >= 0.0 && time_s >= progress.due_s;
        if (due && progress.began_s < 0.0 && fault.kind != FaultKind::none) {
            progress.began_s = time_s;
            events.add(event_of(EventName::fault_began, fault, time_s));
        }
        if (acts(progress) && time_s >= progress.due_s + fault.for_s) {
            progress.over = true;
            events.add(event_of(EventName::fault_ended, fault, time_s));
        }
        // A clock that has jumped does not jump back.
        if (acts(progress) || (fault.kind == FaultKind::clock_jumps && progress.over)) {
            act(model, fault, rotors, state.now);
        }
    }
}

void hear(const FaultsModel& model, const FaultsState& state, double time_s, Readings& received) {
    Readings arriving = state.sensed;
    for (std::size_t i = 0; i < model.faults.size(); ++i) {
        if (acts(state.progress[i])) {
            corrupt(model.faults[i], model, time_s - state.progress[i].began_s, received, arriving);
        }
    }
    for_each_sample([](auto& last, const auto& next) { update(last, next); }, received, arriving);
}

void stamp_anew(const FaultsModel& model, const FaultsState& state, Readings& readings,
                Estimate& estimate) {
    for (std::size_t i = 0; i < model.faults.size(); ++i) {
        const double began_s = state.progress[i].began_s;
        if (model.faults[i].kind != FaultKind::clock_jumps || began_s < 0.0) {
            continue;
        }
        const auto restamp = [&](double& time_s) {
            time_s += time_s >= began_s ? model.faults[i].size : 0.0;
        };
        for_each_sample([&](auto& sample) { restamp(sample.time_s); }, readings);
        restamp(estimate.time_s);
    }
}

void mislead(const FaultsModel& model, FaultsState& state, double time_s, Estimate& estimate) {
    if (estimate.time_s == state.estimated_s) {
        return;
    }
    state.estimated_s = estimate.time_s;
    for (std::size_t i = 0; i < model.faults.size(); ++i) {
        const Fault& fault = model.faults[i];
        if (fault.kind == FaultKind::estimate_drifts && acts(state.progress[i])) {
            const double since_s = time_s - state.progress[i].began_s;
            estimate.p_WB_m += fault.size * since_s * model.ahead_W;
            estimate.v_WB_m_s += fault.size * model.ahead_W;
        }
    }
}

}  // namespace limpet::faults
