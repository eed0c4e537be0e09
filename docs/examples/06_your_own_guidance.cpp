// SPDX-License-Identifier: Apache-2.0
// A manoeuvre of your own: a circle before the wall, then the flight ends as it should.
#include <cmath>
#include <iostream>
#include <limpet/limpet.hpp>

class Circle final : public limpet::Guidance {
public:
    explicit Circle(double radius_m) : radius_m_(radius_m) {}

    [[nodiscard]] std::size_t memory_size() const override { return 3; }

    [[nodiscard]] limpet::GuidanceOutput update(const limpet::GuidanceInput& input,
                                                std::span<double> memory) const override {
        Eigen::Map<limpet::Vector3> start_W_m(memory.data());
        if (input.time_s == 0.0) {
            start_W_m = input.estimate.p_WB_m;
        }
        const double angle_rad = 2.0 * limpet::kPi * input.time_s / kRound_s;
        limpet::PositionSetpoint target;
        target.p_W_m = start_W_m + radius_m_ * limpet::Vector3(std::cos(angle_rad) - 1.0,
                                                               std::sin(angle_rad), 0.0);
        limpet::GuidanceOutput output{.setpoint = {.motion = target, .armed = true}};
        if (input.time_s >= kRound_s) {
            output.outcome = limpet::Outcome::released;
            output.reason = "once round";
        }
        return output;
    }

private:
    static constexpr double kRound_s = 15.0;
    double radius_m_;
};

int main() {
    limpet::Flight flight(limpet::load("hover"), {.guidance = std::make_shared<Circle>(1.0)});
    double farthest_m = 0.0;
    while (flight.tick()) {
        farthest_m = std::max(farthest_m, flight.truth().base.p_WF_m.norm());
    }
    const limpet::Result result = flight.result();
    std::cout << to_string(result.outcome) << " after " << result.simulated_s
              << " s: " << result.reason << ", " << farthest_m << " m away at the far side\n";
}
