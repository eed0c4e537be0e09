// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "limpet/cup.hpp"
#include "limpet/guidance.hpp"
#include "limpet/simulation/outside.hpp"

// A user's stations in the places that the loop has for them.
namespace limpet {

/// Guidance at its rate; what it remembers is here.
class GuidanceSeat final : public simulation::ExternalGuidance {
public:
    GuidanceSeat(std::shared_ptr<const Guidance> guidance, int rate_Hz);

    void exchange(const Readings& readings, const Estimate& estimate, double time_s,
                  guidance::PerchingMemory& guidance, guidance::EventList& events) override;
    [[nodiscard]] std::string obstacle() const override { return {}; }
    /// That it has commanded.
    [[nodiscard]] const std::optional<Outcome>& outcome() const { return output_.outcome; }
    [[nodiscard]] std::string_view reason() const { return output_.reason; }

    std::vector<double> memory;

private:
    std::shared_ptr<const Guidance> guidance_;
    int rate_Hz_;
    GuidanceOutput output_;
};

/// The cup as it is, except for the pressure while it is sealed.
class CupSeat final : public simulation::ExternalCup {
public:
    explicit CupSeat(std::shared_ptr<const CupPressure> pressure);

    suction::CupOutput step(const suction::CupModel& model, suction::CupState& state,
                            const suction::Surface& surface, const Kinematics& cup,
                            const suction::CupInput& input, double dt_s) override;

    std::vector<double> memory;

private:
    std::shared_ptr<const CupPressure> pressure_;
};

}  // namespace limpet
