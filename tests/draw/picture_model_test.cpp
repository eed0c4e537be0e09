// SPDX-License-Identifier: Apache-2.0
#include "limpet/draw/picture_model.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>

#include "../support/flights.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::draw::picture {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string ours() {
    vehicle::Airframe airframe;
    airframe.payload.mass_kg = 0.2;
    return write_mjcf(airframe, models::Scene{});
}

std::string refusal(const std::string& mjcf) {
    const auto start = std::chrono::steady_clock::now();
    std::string said;
    try {
        (void)picture_model(mjcf);
    } catch (const InputError& error) {
        said = error.what();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    return said;
}

/// A model of somebody else around what is looked at; on its second line.
std::string with(const std::string& inside) {
    return "<mujoco model=\"x\">\n" + inside +
           "<worldbody><body name=\"base\"><freejoint/><geom size=\".1\"/></body></worldbody>"
           "</mujoco>";
}
std::string in_asset(const std::string& inside) {
    return with("<asset>" + inside + "</asset>");
}

TEST(PictureModel, KeepsWhatIsSeenOfOurModelsAndNoPhysics) {
    const std::string picture = picture_model(ours());
    for (const char* seen :
         {"<body name=\"base\"", "name=\"leg_left\"", "<site name=\"hook\"",
          "<texture name=\"sky\" type=\"skybox\"", "<camera name=\"side\"", "<light name=\"sun\"",
          "<headlight", "<spatial name=\"cable\"", "material name=\"rubber\"", "mocap=\"true\"",
          "<joint name=\"slider\""}) {
        EXPECT_THAT(picture, HasSubstr(seen));
    }
    for (const char* physics : {"<option", "<size", "nstack", "stiffness", "fullinertia", "<pair",
                                "range=", "<default"}) {
        EXPECT_THAT(ours() + "fullinertia", HasSubstr(physics));
        EXPECT_THAT(picture, Not(HasSubstr(physics)));
    }
    EXPECT_EQ(picture_model(picture), picture) << "what is written is such a model itself";
}

TEST(PictureModel, WritesNumbersThatReadBackTheSame) {
    const std::string picture =
        picture_model(with("<statistic center=\"0.1 -1.23456789012345e-05 3\" extent=\" 1.5 \"/>"));
    EXPECT_THAT(picture, HasSubstr("center=\"0.10000000000000001 -1.23456789012345e-05 3\""));
    EXPECT_THAT(picture, HasSubstr("extent=\"1.5\""));
}

TEST(PictureModel, NoFileIsNamedWhateverBlanksStandAround) {
    EXPECT_EQ(refusal(with("")), "");
    for (const char* blank : {" ", "\t", "\n", "\r\n", "\v", "\f", "\v\f ", "/", "\xC2\xA0"}) {
        for (const char* shape :
             {"<include{}file=\"/etc/passwd\"/>", "<include file{}=\"/etc/passwd\"/>",
              "<include file={}\"/etc/passwd\"/>"}) {
            EXPECT_THAT(refusal(with(fmt::vformat(shape, fmt::make_format_args(blank)))),
                        HasSubstr("model.xml:"))
                << shape << " " << static_cast<int>(*blank);
        }
        for (const char* kind : {"texture", "mesh", "hfield", "skin"}) {
            for (const char* name : {"file", "fileright", "content_type", "fileup"}) {
                EXPECT_THAT(refusal(in_asset(fmt::format("<{}{}name=\"a\"{}{}{}=\"/etc/passwd\"/>",
                                                         kind, blank, blank, name, blank))),
                            HasSubstr("model.xml:"))
                    << kind << name;
            }
        }
    }
    for (const char* compiler : {"<compiler meshdir=\"/etc\"/>", "<compiler texturedir=\"/etc\"/>",
                                 "<compiler assetdir=\"/etc\"/>", "<compiler angle=\"degree\"/>",
                                 "<compiler strippath=\"false\"/>"}) {
        EXPECT_THAT(refusal(with(compiler)), HasSubstr("model.xml:2: <compiler>")) << compiler;
    }
    EXPECT_THAT(refusal("<!DOCTYPE a [<!ENTITY e SYSTEM \"/etc/passwd\">]>" +
                        with("<statistic center=\"&e; 0 0\"/>")),
                HasSubstr("model.xml:2: <statistic> center="));
}

TEST(PictureModel, NothingAsksForMemory) {
    for (const char* size : {"nkey=\"2000000000\"", "nuser_body=\"2000000000\"",
                             "nuserdata=\"2000000000\"", "memory=\"10G\"", "nuser_geom=\"9\""}) {
        EXPECT_THAT(refusal(with(fmt::format("<size {}/>", size))),
                    HasSubstr("model.xml:2: <size>"));
    }
    EXPECT_EQ(picture_model(with("<size nstack=\"2000000000\"/>")), picture_model(with("")));
    EXPECT_THAT(
        refusal(in_asset("<hfield name=\"h\" nrow=\"65536\" ncol=\"65536\" size=\"1 1 1 1\"/>")),
        HasSubstr("model.xml:2: <hfield> in <asset>"));
    for (const char* side : {"40000", "-1", "0", "1e9", "2.5", "nan", "", "1 2", "0x10"}) {
        EXPECT_THAT(refusal(in_asset(fmt::format(
                        "<texture name=\"q\" type=\"2d\" builtin=\"gradient\" width=\"{}\" "
                        "height=\"64\"/>",
                        side))),
                    HasSubstr("model.xml:2: <texture> width="))
            << side;
    }
    EXPECT_THAT(refusal(with("<visual><quality shadowsize=\"100000\"/></visual>")),
                HasSubstr("<quality> shadowsize="));
    EXPECT_THAT(refusal(with("<visual><quality numslices=\"1000000000\"/></visual>")),
                HasSubstr("<quality> numslices="));
    std::string many;
    for (int i = 0; i < 9; ++i) {
        many += "<texture builtin=\"flat\" width=\"9\" height=\"9\"/>";
    }
    EXPECT_THAT(refusal(in_asset(many)), HasSubstr("<texture>: at most 8 in a model"));
    std::string deep;
    for (int i = 0; i < 100'000; ++i) {
        deep += "<body>";
    }
    EXPECT_THAT(refusal("<mujoco><worldbody>" + deep), HasSubstr("model.xml"));
    std::string nested;
    for (int i = 0; i < 17; ++i) {
        nested = "<body>" + nested + "</body>";
    }
    EXPECT_THAT(refusal("<mujoco><worldbody>" + nested + "</worldbody></mujoco>"),
                HasSubstr("<body>: at most 16"));
    EXPECT_THAT(refusal("<mujoco>" + std::string(200'000'000, ' ')), HasSubstr("must have 1 to"));
    EXPECT_THAT(refusal(""), HasSubstr("must have 1 to"));
}

TEST(PictureModel, OtherElementsOfMjcfAreNotOfAModelOfOurs) {
    for (const char* element :
         {"<keyframe/>", "<custom/>", "<sensor/>", "<actuator/>", "<equality/>", "<extension/>",
          "<deformable/>", "<visual><rgba/></visual>", "<asset><skin/></asset>",
          "<worldbody><replicate/></worldbody>", "<worldbody><body><composite/></body></worldbody>",
          "<tendon><fixed/></tendon>", "<asset><body/></asset>", "<mujoco/>", "<geom/>",
          "<default><mesh/></default>", "<default><default/></default>"}) {
        EXPECT_THAT(refusal(with(element)), AllOf(HasSubstr("model.xml:2: <"),
                                                  HasSubstr("no model that limpet writes has")))
            << element;
    }
    EXPECT_THAT(refusal("<robot/>"), HasSubstr("model.xml:1: <robot>"));
    EXPECT_THAT(refusal("mujoco"), HasSubstr("model.xml:1: "));
}

TEST(PictureModel, MeshesHaveTheirPoints) {
    const auto mesh = [](const std::string& points, const std::string& corners) {
        return refusal(
            in_asset(fmt::format("<mesh name=\"m\" vertex=\"{}\" face=\"{}\"/>", points, corners)));
    };
    const std::string four = "0 0 0 1 0 0 0 1 0 0 0 1";
    EXPECT_EQ(mesh(four, "0 1 2"), "");
    for (const char* corners : {"0 1 4", "0 1 -1", "0 1", "0 1 0.5", "", "0 1 nan", "0 1 1e300"}) {
        EXPECT_THAT(mesh(four, corners), HasSubstr("model.xml:2: <mesh> face=")) << corners;
    }
    for (const char* points : {"0 0", "0 0 1e30", "0 0 nan", "0 0 inf", "0 0 x"}) {
        EXPECT_THAT(mesh(points, "0 0 0"), HasSubstr("model.xml:2: <mesh> vertex=")) << points;
    }
    EXPECT_THAT(refusal(with("<statistic extent=\"1e300\"/>")), HasSubstr("<statistic> extent="));
    EXPECT_THAT(refusal(in_asset("<material name=\"" + std::string(300, 'n') + "\"/>")),
                HasSubstr("<material> name="));
    EXPECT_THAT(refusal(in_asset("<material name=\"\x01\"/>")), HasSubstr("<material> name="));
}

}  // namespace
}  // namespace limpet::draw::picture
