// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace limpet::gazebo11 {

/// How a gzserver came to its end.
struct Ended {
    int code = -1;
    std::string text;  ///< both outputs
};

/// gzserver on a world whose body carries the plugin, next to a ball that moves.
[[nodiscard]] Ended serve(const std::string& library, const std::string& inside,
                          const std::string& limit_s = "30", const std::string& engine = "ode");

inline constexpr const char* kCup = "libLimpetSuctionCupPlugin.so";
inline constexpr const char* kVehicle = "libLimpetVehiclePlugin.so";
inline constexpr const char* kRosVehicle = "libLimpetRosVehiclePlugin.so";

struct Refused {
    std::string name;
    const char* library;
    std::string inside;
    std::string line;  ///< of it, what follows "limpet: "
};
void PrintTo(const Refused& refused, std::ostream* out);

/// The cup's plugin on the link that the body has.
[[nodiscard]] Refused cup(const std::string& name, const std::string& inside,
                          const std::string& line);
/// A vehicle's, hovering.
[[nodiscard]] Refused vehicle(const std::string& name, const std::string& inside,
                              const std::string& line, const char* library = kVehicle);

/// Its one test is in refusal_test.cpp.
class WhatCannotBeUsed : public ::testing::TestWithParam<Refused> {
public:
    static std::string name(const ::testing::TestParamInfo<Refused>& row) { return row.param.name; }
};

}  // namespace limpet::gazebo11
