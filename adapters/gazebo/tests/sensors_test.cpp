// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gazebo/sensors/sensors.hh>
#include <limits>
#include <vector>

#include "adapters/gazebo/frames.hpp"
#include "hosted.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"

/// Gazebo's own sensors against the truth that ours read, in one flight at real time: hover,
/// approach, impact, landing, the first seconds of rest.
namespace limpet::gazebo11 {
namespace {

using gazebo_frames::turn_F;

constexpr double kFlight_s = 12.8;
constexpr double kContacts_s = 12.3;  ///< from here on the vehicle rests on its legs

/// A reading of one sensor, by the world's clock.
struct Reading {
    double time_s = 0.0;
    Vector3 value = Vector3::Zero();
    Vector3 second = Vector3::Zero();
};

/// A state of the flight by the world's clock.
struct Was {
    double time_s = 0.0;
    Truth truth;
};

class GazeboSensorsTest : public HostedTest {
protected:
    GazeboSensorsTest() {
        open(scenario::load_scenario("perch_concrete"), true);
        gazebo::sensors::run_once(true);
        gazebo::sensors::run_threads();
        left = find<gazebo::sensors::RaySensor>("lidar_left");
        right = find<gazebo::sensors::RaySensor>("lidar_right");
        imu = find<gazebo::sensors::ImuSensor>("imu");
        force = find<gazebo::sensors::ForceTorqueSensor>("slider_force");
        for (const auto& sensor : gazebo::sensors::SensorManager::Instance()->GetSensors()) {
            if (auto contact = std::dynamic_pointer_cast<gazebo::sensors::ContactSensor>(sensor)) {
                contacts.push_back(contact);
            }
        }
    }
    ~GazeboSensorsTest() override { gazebo::sensors::stop(); }

    template <class Sensor>
    static std::shared_ptr<Sensor> find(const std::string& name) {
        const auto sensor = std::dynamic_pointer_cast<Sensor>(gazebo::sensors::get_sensor(name));
        require(sensor != nullptr, "the vehicle has Gazebo's own sensors");
        return sensor;
    }

    void fly() {
        flight.conduct.speed = 1.0;
        flight.watch.on_tick = [this](simulation::Flight& flown, const guidance::EventList&) {
            // The world's clock is ahead by the step that is about to be taken.
            now_s = world->SimTime().Double() - world->Physics()->GetMaxStepSize();
            was.push_back({now_s, flown.state().truth});
            listen();
        };
        host_it();
        while (now_s < kFlight_s) {
            gazebo::runWorld(world, 100);
        }
        on_update.reset();
    }

    /// What is new since the last tick.
    void listen() {
        take(*left, left_readings, [this] { return Reading{0, {left->Range(0), 0, 0}, {}}; });
        take(*right, right_readings, [this] { return Reading{0, {right->Range(0), 0, 0}, {}}; });
        take(*imu, imu_readings, [this] {
            return Reading{0, turn_F(imu->LinearAcceleration(true)),
                           turn_F(imu->AngularVelocity(true))};
        });
        take(*force, force_readings, [this] { return Reading{0, turn_F(force->Force()), {}}; });
        if (now_s > kContacts_s) {
            legs_W_N.push_back(legs());
        }
    }
    template <class Read>
    static void take(gazebo::sensors::Sensor& sensor, std::vector<Reading>& readings, Read read) {
        const double time_s = sensor.LastMeasurementTime().Double();
        if (time_s > 0.0 && (readings.empty() || time_s > readings.back().time_s)) {
            Reading reading = read();
            reading.time_s = time_s;
            if (sensor.LastMeasurementTime().Double() == time_s) {  // not torn by its thread
                readings.push_back(reading);
            }
        }
    }
    /// The forces of the contact sensors of both tips, turned into the world.
    [[nodiscard]] Vector3 legs() const {
        Vector3 sum = Vector3::Zero();
        for (const auto& sensor : contacts) {
            const gazebo::msgs::Contacts all = sensor->Contacts();
            if (all.contact_size() == 0) {
                continue;
            }
            // The last one is the newest.
            const gazebo::msgs::Contact& contact = all.contact(all.contact_size() - 1);
            const bool first = contact.collision1().find(vehicle->GetName()) == 0;
            for (const auto& wrench : contact.wrench()) {
                const auto& part = first ? wrench.body_1_wrench() : wrench.body_2_wrench();
                const Vector3 on_body_N = turn_F(gazebo::msgs::ConvertIgn(part.force()));
                sum += was.back().truth.base.q_WF * on_body_N;
            }
        }
        return sum;
    }

    /// @return nullptr before the first tick and after the last
    [[nodiscard]] const Truth* truth_at(double time_s) const {
        const auto after = std::lower_bound(was.begin(), was.end(), time_s - 2e-4,
                                            [](const Was& w, double t) { return w.time_s < t; });
        return after == was.end() || after->time_s > time_s + 5e-4 ? nullptr : &after->truth;
    }

    /// Distance from a LiDAR to the wall's plane by the truth alone.
    [[nodiscard]] double range_m(const Truth& truth, double side) const {
        const vehicle::Airframe& frame = flight.scenario.airframe;
        const Vector3 p_B_m(frame.lidar_x_m, side * 0.5 * frame.lidar_separation_m,
                            frame.lidar_z_m);
        const Vector3 origin_W_m = truth.base.p_WF_m + truth.base.q_WF * p_B_m;
        const Vector3 along_W = truth.base.q_WF * Vector3::UnitX();
        const WallGeometry& wall = flight.scenario.wall.geometry;
        const Vector3 into_W = wall.R_WT.col(0);
        return into_W.dot(wall.p_WT_m - origin_W_m) / into_W.dot(along_W);
    }

    /// Sensors run in threads of their own, and machines may be busy: few readings are no fault of
    /// theirs, too few are no comparison.
    /// @param difference  of a reading, given the one before, from the truth; NaN: not compared
    /// @param rms,largest  what it must stay below
    template <class Difference>
    static void compare(const char* what, const char* unit, const std::vector<Reading>& readings,
                        double rms, double largest, Difference difference) {
        double squares = 0.0;
        double most = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 1; i < readings.size(); ++i) {
            const double d = difference(readings[i - 1], readings[i]);
            if (!std::isnan(d)) {
                squares += d * d;
                most = std::max(most, std::abs(d));
                ++count;
            }
        }
        ASSERT_GT(count, 200u) << what;
        const double root = std::sqrt(squares / static_cast<double>(count));
        const double rate_Hz = static_cast<double>(readings.size() - 1) /
                               (readings.back().time_s - readings.front().time_s);
        fmt::print("{:<28} {:5.1f} Hz  {:5d} readings  RMS {:8.4f}  largest {:8.4f} {}\n", what,
                   rate_Hz, count, root, most, unit);
        EXPECT_LT(root, rms) << what;
        EXPECT_LT(most, largest) << what;
    }

    double now_s = 0.0;

    std::shared_ptr<gazebo::sensors::RaySensor> left, right;
    std::shared_ptr<gazebo::sensors::ImuSensor> imu;
    std::shared_ptr<gazebo::sensors::ForceTorqueSensor> force;
    std::vector<std::shared_ptr<gazebo::sensors::ContactSensor>> contacts;
    std::vector<Was> was;
    std::vector<Reading> left_readings, right_readings, imu_readings, force_readings;
    std::vector<Vector3> legs_W_N;
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST_F(GazeboSensorsTest, SayAtRealTimeWhatOursAreMadeOf) {
    fly();

    const auto range_off = [this](double side) {
        return [this, side](const Reading&, const Reading& reading) {
            const Truth* truth = truth_at(reading.time_s);
            const bool level =
                truth != nullptr &&
                std::abs(euler_from_quaternion(truth->base.q_WF).pitch_rad) < radians(45.0);
            return level ? reading.value.x() - range_m(*truth, side) : kNone;
        };
    };
    compare("LiDAR left", "m", left_readings, 0.005, 0.03, range_off(-1.0));
    compare("LiDAR right", "m", right_readings, 0.005, 0.03, range_off(1.0));
    compare("IMU rates", "rad/s", imu_readings, 0.01, 0.2,
            [this](const Reading&, const Reading& reading) {
                const Truth* truth = truth_at(reading.time_s);
                return truth != nullptr ? (reading.second - truth->base.w_WF_F_rad_s).norm()
                                        : kNone;
            });

    // The mean specific force between two readings, from the speeds; off the wall.
    const auto accelerometer = [this](const Reading& before, const Reading& reading) {
        const Truth* a = truth_at(before.time_s);
        const Truth* b = truth_at(reading.time_s);
        if (a == nullptr || b == nullptr || b->cup_status.phase != CupPhase::free) {
            return kNone;
        }
        const Vector3 gravity_W(0.0, 0.0, kGravity_m_s2);
        const Vector3 force_W =
            (b->base.v_WF_W_m_s - a->base.v_WF_W_m_s) / (reading.time_s - before.time_s) -
            gravity_W;
        return (reading.value - b->base.q_WF.conjugate() * force_W).norm();
    };
    compare("IMU specific force", "m/s^2", imu_readings, 0.02, 0.2, accelerometer);

    // Gazebo's sensor reports what is put on the joint from outside: spring, damper and stops, all
    // of which the plant works out.
    const auto slider = [this](const Reading&, const Reading& reading) {
        const Truth* truth = truth_at(reading.time_s);
        return truth == nullptr ? kNone : reading.value.x() - truth->slider.force_N;
    };
    // Largest at the impact, whose edge is a step wide.
    compare("force through the slider", "N", force_readings, 0.2, 8.0, slider);

    Vector3 heard_N = Vector3::Zero();
    for (const Vector3& legs_N : legs_W_N) {
        heard_N += legs_N / static_cast<double>(legs_W_N.size());
    }
    const Vector3 truth_N = was.back().truth.legs_force_W_N;
    fmt::print(
        "contacts of the legs         {:.2f} {:.2f} {:.2f} N, truth {:.2f} {:.2f} {:.2f} N\n",
        heard_N.x(), heard_N.y(), heard_N.z(), truth_N.x(), truth_N.y(), truth_N.z());
    EXPECT_GT(legs_W_N.size(), 200u);
    EXPECT_GT(truth_N.norm(), 5.0) << "it rests on its legs";
    EXPECT_LT((heard_N - truth_N).norm(), 0.5);
}

}  // namespace
}  // namespace limpet::gazebo11
