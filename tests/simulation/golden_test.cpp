// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>

#include "flown.hpp"

namespace limpet::simulation {
namespace {

/// A flight's digest as it was before the architecture was rebuilt around it. Who means to change a
/// flight changes its line, and says why in CHANGELOG.md.
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
                         testing::Values(Golden{"hover", {}, 0xe8ec6e642853f902},
                                         Golden{"perch_concrete", {}, 0x7aebe0860aeb550e},
                                         Golden{"perch_metal_valve", {}, 0x50221006c4a794f1},
                                         Golden{"failed_perch", {}, 0x8e2ec7753ec258ee},
                                         Golden{"pendulum_concrete", {}, 0x683d96a0955e5242}),
                         [](const auto& row) { return std::string(row.param.scenario); });
INSTANTIATE_TEST_SUITE_P(OnMujoco, GoldenHash,
                         testing::Values(Golden{
                             "perch_concrete", {"simulation.engine=mujoco"}, 0xc8d9e9f9dba1db79}),
                         [](const auto& row) { return std::string(row.param.scenario); });

}  // namespace
}  // namespace limpet::simulation
