// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <gazebo/common/Events.hh>
#include <string>

#include "adapters/gazebo/suction_cup_plugin.hpp"
#include "server.hpp"

namespace limpet::gazebo11 {

/// A body of 1 kg with a cup, its lip 40 mm before a wall at x = 1, and a hand that pushes it.
struct PressBench {
    /// @param plugin   children of the plugin's element other than link and lip_pose
    /// @param gravity  "0 0 -9.81"
    /// @param more     further models
    /// @param engine   of the world
    explicit PressBench(const std::string& plugin, const std::string& gravity = "0 0 0",
                        const std::string& more = "", const std::string& engine = "ode");

    void run(unsigned int steps) { server.run(steps); }
    /// Steps until it is so. @return steps; -1: not within `limit`
    int run_until(const std::function<bool()>& is_so, int limit);
    int run_until(CupPhase wanted, int limit = 3000) {
        return run_until([&] { return phase() == wanted; }, limit);
    }
    /// Pushed with `hard_N` it comes to hold.
    [[nodiscard]] bool attaches(double hard_N = 40.0) {
        push_N.X(hard_N);
        return run_until(CupPhase::attached) >= 0;
    }
    [[nodiscard]] CupPhase phase() const { return cup.status().phase; }
    [[nodiscard]] double pressure_Pa() const { return cup.status().pressure_Pa; }

    GazeboServer server;
    gazebo::physics::ModelPtr body;
    ignition::math::Vector3d push_N;  ///< on the centre of mass, in the world
    double hand_N_s_m = 200.0;        ///< damping along x: 40 N come with 0.2 m/s, nothing bounces
    SuctionCupPlugin cup;
    gazebo::event::ConnectionPtr on_update;
};

/// Where the body begins, and the lip in its link.
inline constexpr double kBodyX_m = 0.9;
inline constexpr double kLip_m = 0.06;
inline constexpr double kWall_m = 1.0;
/// Its mass, of 1 kg, lies this far behind the link's origin.
inline constexpr double kBehind_m = 0.02;
inline constexpr double kInertia_kg_m2 = 0.004;

/// The <plugin> element of a model, as gzserver hands it to a plugin.
[[nodiscard]] sdf::ElementPtr plugin_element(const std::string& inside,
                                             const std::string& name = "suction_cup");

/// Walls, bodies and settings as text.
[[nodiscard]] std::string box_model(const std::string& name, const std::string& pose,
                                    const std::string& size, bool is_static = true);
[[nodiscard]] std::string bench_world(const std::string& gravity, const std::string& more,
                                      const std::string& in_body = "",
                                      const std::string& engine = "ode");
/// A surface of round numbers that seals at 20 N, always; no ripple.
[[nodiscard]] std::string plain_surface();
/// Of a cup on that surface, its pump on.
[[nodiscard]] std::string cup_settings(const std::string& attachment, const std::string& more = "");

}  // namespace limpet::gazebo11
