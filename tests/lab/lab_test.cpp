// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/lab.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"
#include "limpet/record/recording.hpp"
#include "limpet/report/view.hpp"

namespace limpet::lab {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LabOf : public testing::Test {
protected:
    void SetUp() override {
        if (!report::has_view_page()) {
            GTEST_SKIP() << "built without Node";
        }
        lab_.emplace("hover");
    }
    [[nodiscard]] record::Recording flown(const std::string& request) {
        const std::filesystem::path file = folder_ / "a.mcap";
        std::ofstream(file, std::ios::binary) << lab_->fly(request);
        return record::read_recording(file);
    }
    [[nodiscard]] std::string refusal(const std::string& request) {
        try {
            (void)lab_->fly(request);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    TestFolder folder_;
    std::optional<Lab> lab_;
};

TEST_F(LabOf, KnowsWhatThereIs) {
    const json known = json::parse(lab_->catalogue());
    EXPECT_EQ(known["scenario"], "hover");
    EXPECT_GT(known["scenarios"].size(), 10U);
    EXPECT_EQ(known["surfaces"][0].size(), 2U);
}

TEST_F(LabOf, EveryParameterHasItsRangeAndSource) {
    const json schema = json::parse(lab_->schema(R"({"scenario": "perch_metal"})"));
    EXPECT_EQ(schema["surface"], "metal");
    std::size_t rows = 0;
    for (const json& section : schema["sections"]) {
        for (const json& row : section["rows"]) {
            EXPECT_LE(row["minimum"], row["maximum"]) << row["key"];
            EXPECT_FALSE(row["what"].get<std::string>().empty()) << row["key"];
            EXPECT_FALSE(row["source"].get<std::string>().empty()) << row["key"];
            ++rows;
        }
    }
    EXPECT_GT(rows, 200U);
}

TEST_F(LabOf, FliesWhatIsAskedFor) {
    const record::Recording whole = flown(R"({"set": ["simulation.time_limit_s=2"]})");
    const record::Recording brief =
        flown(R"({"set": ["simulation.time_limit_s=2"], "brief": true})");
    EXPECT_GT(whole.table("/truth/vehicle").time_s.size(), 190U);
    EXPECT_THAT(brief.table("/truth/vehicle").time_s.size(),
                testing::AllOf(testing::Ge(49U), testing::Le(52U)));
    const record::Recording few = flown(
        R"({"set": ["simulation.time_limit_s=2"], "topics": ["/truth/vehicle", "/tf", "/none"]})");
    EXPECT_EQ(few.tables.size(), 1U) << "/tf is not read back as columns";
    EXPECT_EQ(few.table("/truth/vehicle").time_s, whole.table("/truth/vehicle").time_s);
    EXPECT_TRUE(few.events.empty());
    // Where both have a sample it is the same flight's.
    const auto pitch = [](const record::Recording& r, double time_s) {
        const auto series = r.series("/truth/vehicle", "pitch_rad");
        for (std::size_t i = 0; i < series.time_s.size(); ++i) {
            if (std::abs(series.time_s[i] - time_s) < 1e-6) {
                return series.values[i];
            }
        }
        return kNaN;
    };
    EXPECT_EQ(pitch(brief, 1.0), pitch(whole, 1.0));
}

TEST_F(LabOf, WhatCannotBeIsALine) {
    EXPECT_THAT(refusal(R"({"set": ["guidance.rest_s=-1"]})"), HasSubstr("allowed 0..86400 s"));
    EXPECT_THAT(refusal(R"({"scenario": "hovver"})"), HasSubstr("did you mean hover"));
    EXPECT_THAT(refusal(R"({"scenario": "../hover.yaml"})"), HasSubstr("not a path"));
    EXPECT_THAT(refusal("[1]"), HasSubstr("JSON object"));
    EXPECT_THAT(refusal(R"({"set": [1]})"), HasSubstr("list of texts"));
    EXPECT_THAT(refusal(R"({"topics": 1})"), HasSubstr("list of texts"));
    EXPECT_THROW(Lab("hovver"), InputError);
}

TEST_F(LabOf, SavesAScenarioThatFliesTheSame) {
    const std::string text = lab_->yaml(R"({"set": ["simulation.time_limit_s=3"]})");
    EXPECT_THAT(text, HasSubstr("time_limit_s: 3"));
}

class ManyOf : public testing::Test {
protected:
    /// The state once nothing flies any more.
    static json ended(Many& many) {
        json state = json::parse(many.rows("{}"));
        while (state["running"]) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            state = json::parse(many.rows("{}"));
        }
        return state;
    }
    static std::string refusal(Many& many, const std::string& request) {
        try {
            many.begin(request);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    static constexpr const char* kHovers =
        R"({"set": ["seed=5", "simulation.time_limit_s=60"], "repeats": 2, "axes": [
            {"key": "simulation.hover_s", "from": 0.5, "to": 1.5, "count": 3},
            {"key": "simulation.start_offset_m", "from": 0, "to": 0.1, "count": 2}]})";
    TestFolder folder_;
};

TEST_F(ManyOf, FliesAGridAndEachOfItsRunsAgain) {
    Many many("hover", folder_ / "scratch", {});
    EXPECT_EQ(json::parse(many.rows("{}"))["id"], 0);
    many.begin(kHovers);
    const json state = ended(many);
    EXPECT_EQ(state["problem"], "");
    EXPECT_EQ(state["points"], 6);
    ASSERT_EQ(state["rows"].size(), 12U);
    EXPECT_EQ(state["keys"][0]["values"], json({0.5, 1.0, 1.5}));  // in the order asked for
    EXPECT_EQ(state["keys"][1]["key"], "simulation.start_offset_m");
    EXPECT_EQ(state["success"]["runs"], 12);
    EXPECT_EQ(state["metrics"].size(), state["rows"][0]["metrics"].size());

    const std::filesystem::path file = folder_ / "run.mcap";
    const auto longest = [&](int run) {
        std::ofstream(file, std::ios::binary)
            << many.flight(json{{"id", state["id"]}, {"run", run}}.dump());
        return record::read_recording(file).table("/truth/vehicle").time_s.back();
    };
    EXPECT_NEAR(longest(10) - longest(6), 1.0, 0.02);  // hover 1.5 s, hover 0.5 s
    EXPECT_THROW((void)many.flight(R"({"id": 1, "run": 12})"), InputError);
    EXPECT_THROW((void)many.flight(R"({"id": 2, "run": 0})"), InputError);
    EXPECT_THROW((void)many.flight("{}"), InputError);
    EXPECT_THROW((void)many.flight(R"({"id": 1, "run": 4294967296})"), InputError);
    EXPECT_THROW((void)many.flight(R"({"id": 4294967297, "run": 0})"), InputError);
    EXPECT_EQ(json::parse(many.rows(R"({"from": 11})"))["rows"].size(), 1U);
}

TEST_F(ManyOf, StopsAndKeepsWhereAsked) {
    {
        Many many("hover", folder_ / "scratch", folder_ / "kept");
        many.begin(R"({"campaign": "smoke"})");
        many.stop();
        EXPECT_LT(ended(many)["rows"].size(), 16U);
        many.begin(R"({"campaign": "smoke"})");
        EXPECT_EQ(ended(many)["rows"].size(), 16U);
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "kept/smoke_3"));
    campaign::Results kept(campaign::Results::file_of(folder_ / "kept/smoke_2"),
                           campaign::Access::read);
    EXPECT_EQ(kept.finished(), 16U);
}

TEST_F(ManyOf, WhatCannotBeIsALine) {
    Many many("hover", folder_ / "scratch", {});
    many.begin(kHovers);
    EXPECT_THAT(refusal(many, R"({"campaign": "../smoke.yaml"})"), HasSubstr("not a path"));
    EXPECT_THAT(refusal(many, R"({"campaign": "smok"})"), HasSubstr("did you mean smoke"));
    EXPECT_THAT(refusal(many, R"({"axes": [{"key": "guidance.hover"}]})"), HasSubstr("\"from\""));
    EXPECT_THAT(
        refusal(many,
                R"({"axes": [{"key": "simulation.hove_s", "from": 1, "to": 2, "count": 2}]})"),
        testing::StartsWith("parameters.simulation.hove_s: unknown key"));
    EXPECT_THAT(
        refusal(many,
                R"({"axes": [{"key": "simulation.hover_s", "from": 1, "to": 2, "count": 30000}]})"),
        HasSubstr("\"count\": 30000; a whole number, allowed 1..20000"));
    // The lowest 32 bits of the first are 3, of the second 1.
    for (const char* count : {"4294967299", "1000000000000000001", "1e18", "2.5", "-1", "\"2\""}) {
        EXPECT_THAT(refusal(many, fmt::format(R"({{"axes": [{{"key": "simulation.hover_s",
                                                  "from": 1, "to": 2, "count": {}}}]}})",
                                              count)),
                    HasSubstr("\"count\": " + json::parse(count).dump() + "; a whole number"))
            << count;
        EXPECT_THAT(refusal(many, fmt::format(R"({{"axes": [], "repeats": {}}})", count)),
                    HasSubstr("\"repeats\": "))
            << count;
    }
    EXPECT_THAT(refusal(many, R"({"axes": [
                    {"key": "simulation.hover_s", "from": 1, "to": 2, "count": 200},
                    {"key": "simulation.start_offset_m", "from": 0, "to": 1, "count": 200}]})"),
                HasSubstr("40000 runs, the lab flies at most 20000"));
    EXPECT_EQ(ended(many)["rows"].size(), 12U);  // the last one stood
}

TEST(LearnOf, TurnsEachNumberAloneAndTheRestStays) {
    Learn learn("hover");
    learn.begin(R"({"set": ["simulation.hover_s=1"], "share": 0.2})");
    json state = json::parse(learn.state());
    while (state["running"]) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        state = json::parse(learn.state());
    }
    EXPECT_EQ(state["flown"], state["flights"]);
    const auto found = std::find_if(
        state["rows"].begin(), state["rows"].end(),
        [](const json& row) { return row["key"] == "vehicle.battery.avionics_power_W"; });
    ASSERT_NE(found, state["rows"].end());
    const auto energy =
        std::find(state["metrics"].begin(), state["metrics"].end(), "energy_flying_Wh") -
        state["metrics"].begin();
    const auto of = [&](const json& flight) { return flight["metrics"][energy].get<double>(); };
    EXPECT_GT(of((*found)["more"]), of(state["base"]));
    EXPECT_LT(of((*found)["less"]), of(state["base"]));
    // An inertia that no body has is not flown, and says nothing of the energy.
    const auto refused =
        std::find_if(state["rows"].begin(), state["rows"].end(),
                     [](const json& row) { return row["key"] == "vehicle.inertia_kg_m2.zz"; });
    ASSERT_NE(refused, state["rows"].end());
    EXPECT_EQ((*refused)["more"]["outcome"], "refused");
    EXPECT_TRUE((*refused)["more"]["metrics"][energy].is_null());
    EXPECT_THROW(learn.begin(R"({"share": 0})"), InputError);
    EXPECT_THROW(learn.begin(R"({"scenario": "hovver"})"), InputError);
}

TEST(LearnOf, StopsAndBeginsAnew) {
    Learn learn("hover");
    EXPECT_EQ(json::parse(learn.state())["id"], 0);
    learn.begin("{}");
    learn.stop();
    learn.begin(R"({"set": ["simulation.hover_s=1"]})");
    const json state = json::parse(learn.state());
    EXPECT_EQ(state["id"], 2);
    EXPECT_TRUE(state["running"]);
}

constexpr const char* kLags =
    R"(["vehicle.rotor.time_constant_up_s", "vehicle.rotor.time_constant_down_s"])";

std::string swing_request(const std::string& set) {
    return fmt::format(
        R"({{"scenario": "slow_motors_metal", "set": [{}],
            "across": {{"keys": {}, "from": 0.02, "to": 0.08, "count": 3}},
            "up": {{"keys": ["autopilot.MC_PITCHRATE_I"], "from": 0.1, "to": 0.3, "count": 2}}}})",
        set, kLags);
}

json ended(Swing& swing) {
    json state = json::parse(swing.state());
    while (state["running"]) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        state = json::parse(swing.state());
    }
    return state;
}

TEST(SwingOf, IsTheLinearisedLoopsWithTheVehicleInIt) {
    Swing swing("hover");
    EXPECT_EQ(json::parse(swing.state())["id"], 0);
    swing.begin(swing_request(""));
    json state = ended(swing);
    EXPECT_EQ(state["id"], 1);
    EXPECT_EQ(state["done"], 6);
    const stability::StabilityMap map{.scenario = "slow_motors_metal",
                                      .across = {json::parse(kLags), {0.02, 0.05, 0.08}},
                                      .up = {{"autopilot.MC_PITCHRATE_I"}, {0.1, 0.3}}};
    for (const std::size_t i : {0U, 2U, 4U}) {
        EXPECT_EQ(state["growth_1_s"][i].get<double>(), swing_at(map, i)->growth_1_s) << i;
    }
    EXPECT_EQ(state["own"]["growth_1_s"].get<double>(),
              stability::linear_swing("slow_motors_metal", {})->growth_1_s);
    EXPECT_EQ(state["across"]["own"], json({0.065, 0.065}));
    EXPECT_EQ(state["up"]["own"], json({0.2}));

    // A number of an axis moves the vehicle within its map, another one makes another map.
    swing.begin(swing_request(R"("autopilot.MC_PITCHRATE_I=0")"));
    const json moved = json::parse(swing.state());
    EXPECT_EQ(moved["id"], 1);
    EXPECT_EQ(moved["growth_1_s"], state["growth_1_s"]);
    EXPECT_EQ(moved["up"]["own"], json({0.0}));
    EXPECT_LT(moved["own"]["growth_1_s"].get<double>(), state["own"]["growth_1_s"].get<double>());
    swing.begin(swing_request(R"("autopilot.MC_PITCHRATE_P=0.2")"));
    const json other = ended(swing);
    EXPECT_EQ(other["id"], 2);
    EXPECT_LT(other["growth_1_s"][2].get<double>(), state["growth_1_s"][2].get<double>());
}

/// A fault of ours, at the vehicle's own point or on a thread, is not a vehicle without a swing.
TEST(SwingOf, AFaultComesOut) {
    std::atomic<int> asked = 0;
    Swing swing("slow_motors_metal",
                [&](const auto&, const auto&) -> std::optional<stability::Mode> {
                    if (++asked == 3) {
                        throw InternalError("a broken promise");
                    }
                    return std::nullopt;
                });
    swing.begin(swing_request(""));
    EXPECT_THAT([&] { (void)ended(swing); },
                testing::ThrowsMessage<InternalError>("a broken promise"));
    swing.begin(swing_request(""));  // anew, and what is none is said to be
    EXPECT_EQ(ended(swing)["growth_1_s"], json(std::vector<std::string>(6, "none")));
    asked = 2;
    EXPECT_THROW(swing.begin(swing_request("")), InternalError);
}

TEST(SwingOf, WhatCannotBeIsALineAndTheLastMapStands) {
    Swing swing("slow_motors_metal");
    swing.begin(swing_request(""));
    const auto refusal = [&](const std::string& request) {
        try {
            swing.begin(request);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto up = [](const char* key, int count) {
        return fmt::format(
            R"({{"across": {{"keys": {}, "from": 0.02, "to": 0.08, "count": 3}},
                "up": {{"keys": ["{}"], "from": 0.1, "to": 0.3, "count": {}}}}})",
            kLags, key, count);
    };
    EXPECT_THAT(refusal("{}"), HasSubstr("\"across\" is"));
    EXPECT_THAT(refusal(up("autopilot.MC_PITCHRATE_I", 65)),
                HasSubstr("\"count\": 65; a whole number, allowed 2..64"));
    EXPECT_THAT(refusal(up("autopilot.nothing", 2)), HasSubstr("is no number of the scenario"));
    std::string hover = up("autopilot.MC_PITCHRATE_I", 2);
    hover.insert(1, R"("scenario": "hover", )");
    EXPECT_THAT(refusal(hover), HasSubstr("needs a wall"));
    EXPECT_EQ(ended(swing)["id"], 1);
    // Two numbers that do not go together leave a hole, not a line.
    swing.begin(R"({"across": {"keys": ["vehicle.rotor.time_constant_up_s"], "from": 0.01,
                               "to": 0.02, "count": 2},
                    "up": {"keys": ["autopilot.MC_PITCHRATE_I"], "from": -0.2, "to": 0.2,
                           "count": 2}})");
    const json holed = ended(swing);
    EXPECT_EQ(holed["growth_1_s"][0], "none");
    EXPECT_TRUE(holed["growth_1_s"][2].is_number());
}

}  // namespace
}  // namespace limpet::lab
