// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

/// A flight's digest as it was before the house was rebuilt around it. Who means to change a flight
/// changes its line, and says why in CHANGELOG.md.
struct Golden {
    const char* scenario;
    std::vector<std::string> overrides;
    std::uint64_t state_hash;
};

class GoldenHash : public testing::TestWithParam<Golden> {};

TEST_P(GoldenHash, TheFlightIsTheSameBitForBit) {
    EXPECT_EQ(fly(model_of(GetParam().scenario, GetParam().overrides)).state_hash,
              GetParam().state_hash);
}

// Of Debian 12's compiler and mathematical library on x86-64 (docs/decisions/0006-determinism.md).
INSTANTIATE_TEST_SUITE_P(Shipped, GoldenHash,
                         testing::Values(Golden{"hover", {}, 0x056882120b6521b4},
                                         Golden{"perch_concrete", {}, 0x903882fc98d22035},
                                         Golden{"perch_metal_valve", {}, 0x63f8568ea91061d6},
                                         Golden{"failed_perch", {}, 0x6fe9166ab34b8fd8},
                                         Golden{"pendulum_concrete", {}, 0xb2037c25521dc880}),
                         [](const auto& row) { return std::string(row.param.scenario); });
INSTANTIATE_TEST_SUITE_P(OnMujoco, GoldenHash,
                         testing::Values(Golden{
                             "perch_concrete", {"simulation.engine=mujoco"}, 0xc6c6bbe3942d0b17}),
                         [](const auto& row) { return std::string(row.param.scenario); });

}  // namespace
}  // namespace limpet::simulation
