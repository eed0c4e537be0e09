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
                         testing::Values(Golden{"hover", {}, 0xd9834ed888a7fd6c},
                                         Golden{"perch_concrete", {}, 0xaff5c0a9f137aa37},
                                         Golden{"perch_metal_valve", {}, 0x96e2650e84e52e90},
                                         Golden{"failed_perch", {}, 0xcaa499ed5d71de32},
                                         Golden{"pendulum_concrete", {}, 0x88c967b97a883f60}),
                         [](const auto& row) { return std::string(row.param.scenario); });

}  // namespace
}  // namespace limpet::simulation
