// SPDX-License-Identifier: Apache-2.0
#include "limpet/models/urdf_reader.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::models {
namespace {

using testing::HasSubstr;

std::string urdf_refusal(const std::string& urdf) {
    const TestFolder folder;
    std::ofstream(folder / "x.urdf") << urdf;
    try {
        (void)models::read_urdf(folder / "x.urdf");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string robot_with(const std::string& mass, const std::string& ixy) {
    return fmt::format(
        "<robot name=\"r\">\n<link name=\"a\"><inertial><origin xyz=\"0 0 0\" rpy=\"0 0 0.1\"/>"
        "<mass value=\"{}\"/><inertia ixx=\"1\" ixy=\"{}\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
        "izz=\"1\"/></inertial></link></robot>",
        mass, ixy);
}

TEST(UrdfReader, AnInertiaIsAFiniteMatrixOfABody) {
    EXPECT_EQ(urdf_refusal(robot_with("1", "0.1")), "");
    for (const char* bad : {"1e300", "-1e155", "1e308", "nan", "inf", "1e999", "5", ""}) {
        EXPECT_THAT(urdf_refusal(robot_with("1", bad)), HasSubstr("x.urdf:2: ")) << bad;
    }
    EXPECT_THAT(urdf_refusal(robot_with("1e300", "0.1")), HasSubstr("below 1e+100"));
}

TEST(UrdfReader, BoundsWhatIsLookedUpAmongAll) {
    std::string links = "<robot name=\"r\">";
    for (int i = 0; i < 501; ++i) {
        links += fmt::format("<link name=\"l{}\"/>", i);
    }
    EXPECT_THAT(urdf_refusal(links + "</robot>"), HasSubstr("more than 500 links"));
    std::string visuals = "<robot name=\"r\"><link name=\"a\">";
    for (int i = 0; i < 501; ++i) {
        visuals += "<visual><geometry><sphere radius=\"1\"/></geometry></visual>";
    }
    EXPECT_THAT(urdf_refusal(visuals + "</link></robot>"), HasSubstr("more than 500 visuals"));
    EXPECT_THAT(urdf_refusal(std::string(2'000'001, ' ')), HasSubstr("larger than 2 MB"));
    EXPECT_THAT(urdf_refusal(""), HasSubstr("an empty file"));
}

}  // namespace
}  // namespace limpet::models
