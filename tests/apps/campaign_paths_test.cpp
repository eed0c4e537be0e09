// SPDX-License-Identifier: Apache-2.0
// From where the relative paths in a campaign's file count.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "program.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// A campaign in `c`, of a scenario in `s`, run from the folder above.
class CampaignPaths : public ::testing::Test {
protected:
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((bench_.folder() / name).parent_path());
        (void)bench_.write(name, text);
    }
    /// The shipped vehicle with another mass.
    void write_vehicle(const std::string& name, const std::string& mass_kg) const {
        const std::string shipped =
            text_of(fs::path(LIMPET_SOURCE_DIR) / "data/vehicles/perching_uav.yaml");
        write(name, std::regex_replace(shipped, std::regex("(\n *mass_kg: )[0-9.]+"),
                                       "$01" + mass_kg, std::regex_constants::format_first_only));
    }
    void write_campaign(const std::string& rest) const {
        write("s/short.yaml",
              "mission: hover\nvehicle: perching_uav\nsimulation: {hover_s: 0.1}\n");
        write("c/campaign.yaml", "scenario: ../s/short.yaml\n" + rest);
    }
    /// The scenario that run `run` of the campaign flew.
    std::string flown(int run) const {
        fs::remove_all(bench_.folder() / "o");
        const Finished campaign =
            bench_.run({"campaign", "c/campaign.yaml", "--out", "o", "--jobs", "1", "--quiet"});
        EXPECT_EQ(campaign.exit_code, 0) << campaign.err;
        const Finished replay = bench_.run({"replay", "o", std::to_string(run), "--out", "r"});
        EXPECT_EQ(replay.exit_code, 0) << replay.err;
        EXPECT_EQ(bench_.run({"csv", "r/flight.mcap"}).exit_code, 0);
        return text_of(bench_.folder() / "r/csv/scenario.yaml");
    }

    Bench bench_;
};

TEST_F(CampaignPaths, AnOverridesVehicleIsNextToTheCampaignThenNextToTheScenario) {
    write_campaign("overrides:\n  - vehicle=mine.yaml\nruns: 1\n");
    write_vehicle("mine.yaml", "4.1");  // the working folder's counts in neither case
    const Finished none = bench_.run({"check", "c/campaign.yaml"});
    expect_refused(none, {"s/mine.yaml: cannot be read"});
    write_vehicle("s/mine.yaml", "3.7");
    EXPECT_THAT(flown(0), HasSubstr("mass_kg: 3.7\n"));
    write_vehicle("c/mine.yaml", "3.3");
    EXPECT_THAT(flown(0), HasSubstr("mass_kg: 3.3\n"));
}

TEST_F(CampaignPaths, AVariedVehicleIsLookedForInTheSamePlaces) {
    write_campaign("parameters:\n  vehicle: {grid: [one.yaml, two.yaml]}\nrepeats: 1\n");
    write_vehicle("one.yaml", "4.1");
    write_vehicle("two.yaml", "4.1");
    write_vehicle("c/one.yaml", "3.3");
    expect_refused(bench_.run({"check", "c/campaign.yaml"}), {"s/two.yaml: cannot be read"});
    write_vehicle("s/two.yaml", "3.7");
    EXPECT_THAT(flown(0), HasSubstr("mass_kg: 3.3\n"));
    EXPECT_THAT(flown(1), HasSubstr("mass_kg: 3.7\n"));
}

TEST_F(CampaignPaths, AScenarioCountsFromTheCampaign) {
    write_campaign("runs: 1\n");
    fs::rename(bench_.folder() / "s", bench_.folder() / "elsewhere");
    const Finished none = bench_.run({"check", "c/campaign.yaml"});
    expect_refused(none, {"s/short.yaml: cannot be read"});
    fs::rename(bench_.folder() / "elsewhere", bench_.folder() / "s");
    EXPECT_EQ(bench_.run({"check", "c/campaign.yaml"}).exit_code, 0);
    EXPECT_EQ(bench_.run_in(bench_.folder() / "c", {"check", "campaign.yaml"}).exit_code, 0);
}

}  // namespace
}  // namespace limpet
