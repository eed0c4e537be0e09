// SPDX-License-Identifier: Apache-2.0
// An autopilot of your own: proportional-derivative on position, then on attitude, 30 lines. What
// it remembers (here an integral of the height error) are numbers of the flight.
#include <algorithm>
#include <iostream>
#include <limpet/limpet.hpp>

class SimpleAutopilot final : public limpet::Autopilot {
public:
    [[nodiscard]] std::size_t memory_size() const override { return 1; }

    [[nodiscard]] limpet::AutopilotOutput control(const limpet::AutopilotInput& input,
                                                  std::span<double> memory) const override {
        const auto* target = std::get_if<limpet::PositionSetpoint>(&input.setpoint.motion);
        if (target == nullptr) {
            return {.thrust = input.vehicle.hover_thrust};  // hover asks for positions alone
        }
        const limpet::Estimate& now = input.estimate;
        limpet::Vector3 a_W = 1.5 * (target->p_W_m - now.p_WB_m) - 2.0 * now.v_WB_m_s;
        memory[0] += 0.5 * a_W.z() * input.dt_s;
        a_W.z() += memory[0];
        // Lean so that the thrust, along -z of B, makes that acceleration.
        const double c = std::cos(target->yaw_rad);
        const double s = std::sin(target->yaw_rad);
        const double g = limpet::kGravity_m_s2;
        const limpet::Euler lean = {
            .roll_rad = std::clamp((c * a_W.y() - s * a_W.x()) / g, -0.3, 0.3),
            .pitch_rad = std::clamp(-(c * a_W.x() + s * a_W.y()) / g, -0.3, 0.3),
            .yaw_rad = target->yaw_rad};
        const limpet::Vector3 tilt_rad = limpet::rotation_vector_from_quaternion(
            now.q_WB.conjugate() * limpet::quaternion_from_euler(lean));
        return {
            .thrust = std::clamp(input.vehicle.hover_thrust * (1.0 - 0.5 * a_W.z() / g), 0.1, 0.9),
            .torque = 0.8 * tilt_rad - 0.15 * now.w_WB_B_rad_s};
    }
};

int main() {
    limpet::Flight flight(limpet::load("hover"),
                          {.autopilot = std::make_shared<SimpleAutopilot>()});
    const limpet::Vector3 start_W_m = flight.truth().base.p_WF_m;
    double farthest_m = 0.0;
    while (flight.tick()) {
        farthest_m = std::max(farthest_m, (flight.truth().base.p_WF_m - start_W_m).norm());
    }
    std::cout << to_string(flight.result().outcome) << ", " << farthest_m
              << " m from the start at most\n";
}
