// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <pugixml.hpp>

#include "limpet/models/cad_model.hpp"
#include "limpet/models/model_writer.hpp"
#include "limpet/scenario/data_folder.hpp"
#include "limpet/scenario/parts.hpp"
#include "tests/scenario/test_data.hpp"

// vehicles/cad_uav is perching_uav as a CAD program exports it: its base taken apart into plate,
// motors, propellers and legs, seen from an origin of its own, names of its own.

namespace limpet::scenario {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path kFolder = fs::path(LIMPET_SOURCE_DIR) / "data/vehicles/cad_uav";

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

vehicle::Airframe cad_uav() {
    return load_vehicle((kFolder / "cad_uav.yaml").string(), data_root());
}

void expect_same(const vehicle::BodyInertia& got, const vehicle::BodyInertia& wanted) {
    EXPECT_NEAR(got.mass_kg, wanted.mass_kg, 1e-9);
    EXPECT_LT((got.centre_B_m - wanted.centre_B_m).norm(), 1e-8);
    EXPECT_LT((got.inertia_kg_m2 - wanted.inertia_kg_m2).norm(), 1e-8);
}

TEST(CadVehicle, ItsPartsAddUpToTheVehicleThatTheyWereMadeFrom) {
    const vehicle::Airframe cad = cad_uav();
    const vehicle::Airframe made = load_vehicle("perching_uav", data_root());
    ASSERT_TRUE(cad.cad);
    EXPECT_NEAR(cad.mass_kg, 3.2, 1e-9);
    EXPECT_LT((cad.inertia_kg_m2 - made.inertia_kg_m2).norm(), 1e-8);
    EXPECT_NEAR(cad.cup.joint_x_m, 0.46, 1e-8);
    EXPECT_NEAR(cad.cup.joint_z_m, 0.0, 1e-8);
    EXPECT_NEAR(cad.cup.mass_kg, 0.10, 1e-9);
    EXPECT_NEAR(cad.slider.mass_kg, 0.10, 1e-9);
    expect_same(base_inertia(cad), base_inertia(made));
    expect_same(carriage_inertia(cad), carriage_inertia(made));
    expect_same(cup_inertia(cad), cup_inertia(made));
}

TEST(CadVehicle, SdfKeepsItsNamesItsMeshesAndTheirPlaces) {
    const vehicle::Airframe airframe = cad_uav();
    pugi::xml_document sdf;
    ASSERT_TRUE(sdf.load_string(models::write_sdf(airframe).c_str()));
    const auto model = sdf.child("sdf").child("model");
    for (const char* link : {"base_link", "slider_link", "yoke_link", "cup_link"}) {
        EXPECT_TRUE(model.find_child_by_attribute("link", "name", link)) << link;
    }
    const auto slider = model.find_child_by_attribute("joint", "name", "slider_joint");
    EXPECT_STREQ(slider.child("parent").text().get(), "base_link");
    EXPECT_STREQ(slider.child("child").text().get(), "slider_link");
    EXPECT_EQ(slider.child("axis").child("dynamics").child("spring_stiffness").text().as_double(),
              500.0);
    const auto base = model.find_child_by_attribute("link", "name", "base_link");
    const auto propeller =
        base.find_child_by_attribute("visual", "name", "propeller_front_right_link_visual");
    // Where perching_uav has its rotor 0: 0.205 m ahead, right is minus y, 0.04 m up.
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    ASSERT_EQ(std::sscanf(propeller.child("pose").text().get(), "%lf %lf %lf", &x, &y, &z), 3);
    EXPECT_NEAR(x, 0.205, 1e-8);
    EXPECT_NEAR(y, -0.205, 1e-8);
    EXPECT_NEAR(z, 0.04, 1e-8);
    const std::string uri = propeller.child("geometry").child("mesh").child("uri").text().get();
    EXPECT_EQ(uri.rfind("file:///", 0), 0U) << uri;
    EXPECT_TRUE(fs::is_regular_file(uri.substr(7)));
}

TEST(CadVehicle, MjcfHasEveryMeshInItsText) {
    pugi::xml_document mjcf;
    ASSERT_TRUE(mjcf.load_string(models::write_mjcf(cad_uav(), {}).c_str()));
    EXPECT_EQ(mjcf.select_nodes("//mesh").size(), 14U);  // of 14 links
    for (const auto& found : mjcf.select_nodes("//geom[@type='mesh']")) {
        const std::string mesh = found.node().attribute("mesh").value();
        EXPECT_TRUE(mjcf.select_node(("//mesh[@name='" + mesh + "']").c_str())) << mesh;
    }
    EXPECT_EQ(mjcf.select_nodes("//geom[@type='mesh']").size(), 14U);
}

TEST(CadVehicle, AScenariosOwnTextHasTheSameVehicleAgain) {
    const std::string vehicle = (kFolder / "cad_uav.yaml").string();
    const Scenario first = load_scenario("perch_concrete", {.overrides = {"vehicle=" + vehicle}});
    const Scenario again = load_scenario_text(to_yaml(first), "again");
    ASSERT_TRUE(again.airframe.cad);
    EXPECT_EQ(to_yaml(again), to_yaml(first));
    EXPECT_EQ(write_mjcf(again.airframe, scene_of(again)),
              write_mjcf(first.airframe, scene_of(first)));
}

/// A copy of the vehicle in which something is wrong.
class WrongCadVehicle : public ::testing::Test {
protected:
    WrongCadVehicle() {
        fs::create_directories(data_.root() / "cad_uav");
        fs::copy(kFolder, data_.root() / "cad_uav", fs::copy_options::recursive);
    }
    std::string error(const std::string& file, const std::string& what, const std::string& with) {
        const std::string good = text_of(kFolder / file);
        (void)data_.write("cad_uav/" + file, replaced(good, what, with));
        const std::string message = error_of([&] {
            return load_vehicle((data_.root() / "cad_uav/cad_uav.yaml").string(), data_root());
        });
        (void)data_.write("cad_uav/" + file, good);
        return message;
    }
    std::string in_yaml(const std::string& what, const std::string& with) {
        return error("cad_uav.yaml", what, with);
    }
    std::string in_urdf(const std::string& what, const std::string& with) {
        return error("urdf/cad_uav.urdf", what, with);
    }
    TestData data_;
};

TEST_F(WrongCadVehicle, AMissingLinkOrJointIsNamedWhereItIsAskedFor) {
    EXPECT_THAT(in_yaml("cup: cup_link", "cup: lip_link"),
                testing::AllOf(HasSubstr("cad_uav.yaml:8: model.links.cup: "),
                               HasSubstr("no link \"lip_link\""), HasSubstr("yoke_link")));
    EXPECT_THAT(in_yaml("slider: slider_joint, ", ""),
                testing::AllOf(HasSubstr("model: "), HasSubstr("no joint \"slider\""),
                               HasSubstr("pitch_joint")));
    EXPECT_THAT(in_yaml("cup_yaw: yaw_joint", "cup_jaw: yaw_joint"), HasSubstr("cup_jaw"));
    EXPECT_THAT(in_yaml("urdf/cad_uav.urdf", "urdf/none.urdf"), HasSubstr("none.urdf"));
}

TEST_F(WrongCadVehicle, AJointOfTheWrongKindOrAxisOrPlace) {
    EXPECT_THAT(in_urdf("type=\"prismatic\"", "type=\"fixed\""),
                testing::AllOf(testing::ContainsRegex("cad_uav.urdf:[0-9]+: "),
                               HasSubstr("slider_joint"), HasSubstr("must be prismatic")));
    EXPECT_THAT(in_urdf("<axis xyz=\"1 0 0\"/>", "<axis xyz=\"-1 0 0\"/>"), HasSubstr("axis"));
    EXPECT_THAT(in_urdf("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 1\"/>"), HasSubstr("cup_pitch"));
    EXPECT_THAT(in_urdf("<parent link=\"slider_link\"/>", "<parent link=\"base_link\"/>"),
                HasSubstr("must hang on the carriage"));
    EXPECT_THAT(in_urdf("<child link=\"cup_link\"/>", "<child link=\"lip_link\"/>"),
                HasSubstr("\"lip_link\" is no link"));
}

TEST_F(WrongCadVehicle, ABodyThatCannotBe) {
    EXPECT_THAT(in_urdf("<mass value=\"2.52\"/>", "<mass value=\"-1\"/>"),
                testing::AllOf(testing::ContainsRegex("cad_uav.urdf:[0-9]+: "),
                               HasSubstr("base_link"), HasSubstr("must be > 0")));
    EXPECT_THAT(in_urdf("izz=\"0.06464451386\"", "izz=\"0.6\""), HasSubstr("principal"));
    EXPECT_THAT(in_urdf("<mass value=\"2.52\"/>", "<mass value=\"much\"/>"), HasSubstr("\"much\""));
    EXPECT_THAT(
        in_urdf("meshes/leg.STL", "meshes/foot.STL"),
        testing::AllOf(testing::ContainsRegex("cad_uav.urdf:[0-9]+: "), HasSubstr("foot.STL")));
    EXPECT_THAT(in_urdf("</robot>", ""), testing::ContainsRegex("cad_uav.urdf:[0-9]+: "));
}

TEST_F(WrongCadVehicle, ANumberThatDiffersFromTheModel) {
    EXPECT_THAT(in_yaml("has_cup: true", "has_cup: true\nmass_kg: 3.5"),
                testing::AllOf(testing::ContainsRegex("cad_uav.yaml:[0-9]+: mass_kg: "),
                               HasSubstr("3.5"), HasSubstr("3.2"), HasSubstr("leave it out")));
    EXPECT_EQ(in_yaml("has_cup: true", "has_cup: true\nmass_kg: 3.21"), "");
}

}  // namespace
}  // namespace limpet::scenario
