// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>

#include "../apps/program.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/paper/reproduce.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::paper {
namespace {

using testing::HasSubstr;

/// An experiment of no flight: its figure is that of the turn.
struct Toy {
    Bench bench;
    Study study;
    std::atomic<int> done = 0;
    std::atomic<bool> stop = false;

    explicit Toy(double as_it_is = 1.0) { begin(as_it_is); }
    void begin(double as_it_is) {
        study = Study{.folder = bench.folder(), .jobs = 2, .stop = &stop};
        study.statements = {{.claim = {.id = "x", .basis = "measured", .assumes = {"a.named"}},
                             .evidence = "toy.x",
                             .accepted = {0.0, 2.0}}};
        study.evidence.set("toy.x", as_it_is);
    }
    void fly(std::vector<Turn> turns) {
        do_again(study, {.name = "toy",
                         .evidence = {"toy.x", "toy.unasked"},
                         .turns = std::move(turns),
                         .measure = [this](const Turn& turn) {
                             ++done;
                             if (turn.key == "a.wrong") {
                                 throw InputError("a.wrong: 3 does not go with a.b");
                             }
                             Evidence evidence;
                             evidence.set("toy.x", turn.more ? 3.0 : kNaN);
                             evidence.set("toy.unasked", 1.0);
                             return evidence;
                         }});
    }
    [[nodiscard]] std::vector<std::string> turned() const {
        std::vector<std::string> texts;
        for (const TurnedEvidence& one : study.turned_of("toy.x")) {
            texts.push_back(one.turn + ": " + std::to_string(one.value));
        }
        return texts;
    }
};

TEST(DoAgain, KeepsWhatTheStatementsAskFor) {
    Toy toy;
    toy.fly({{"a.b", true}, {"a.wrong", true}, {"a.named", true}});
    EXPECT_EQ(toy.done, 4) << "what a statement names is turned both ways, once";
    EXPECT_THAT(toy.turned(), testing::UnorderedElementsAre(HasSubstr("`a.named` 20 % less: nan"),
                                                            HasSubstr("`a.named` 20 % more: 3"),
                                                            HasSubstr("`a.b` 20 % more: 3")));
    EXPECT_TRUE(toy.study.turned_of("toy.unasked").empty());
}

TEST(DoAgain, QuickTurnsWhatTheStatementsName) {
    Toy toy;
    toy.study.quick = true;
    toy.fly({{"a.b", true}, {"a.b", false}});
    EXPECT_EQ(toy.done, 2);
}

TEST(DoAgain, TakesFromTheFolderWhatIsOfTheSameExperiment) {
    Toy toy;
    toy.fly({{"a.b", true}});
    const auto first = toy.turned();
    toy.begin(1.0);
    toy.fly({{"a.b", true}, {"a.c", false}});
    EXPECT_EQ(toy.done, 3 + 1) << "one more";
    EXPECT_EQ(toy.turned().size(), first.size() + 1);
    toy.begin(1.0 + 1e-15);  // another flight
    toy.fly({{"a.b", true}});
    EXPECT_EQ(toy.done, 4 + 3);
    std::ofstream(toy.bench.folder() / "assumptions" / "toy_turned.json") << "{";
    toy.begin(1.0);
    toy.fly({{"a.b", true}});
    EXPECT_EQ(toy.done, 7 + 3) << "a file that is none";
    EXPECT_EQ(toy.turned(), first);
    toy.begin(1.0);
    toy.study.quick = true;
    toy.fly({});
    EXPECT_EQ(toy.done, 10 + 2) << "--quick may measure less of each";
}

TEST(DoAgain, StopsAndGoesOnFromThere) {
    Toy toy;
    std::vector<Turn> turns;
    for (int k = 0; k < 62; ++k) {
        turns.push_back({"a.k" + std::to_string(k), true});
    }
    int parts = 0;
    toy.study.tell = [&](const std::string&) { toy.stop = ++parts == 4; };
    EXPECT_THROW(toy.fly(turns), Interrupted);
    const int before = toy.done;
    EXPECT_GT(before, 0);
    toy.stop = false;
    toy.begin(1.0);
    toy.fly(turns);
    EXPECT_LE(toy.done, 64 + 8) << "no more than the part that was under way is done twice";
    EXPECT_EQ(toy.turned().size(), 64U);
}

TEST(Turns, AreOfTheScenariosOwnValue) {
    const auto concrete = scenario::load_scenario("perch_concrete");
    const double damping = concrete.airframe.slider.damping_N_s_m;
    for (const bool more : {false, true}) {
        const auto set = override_of({"vehicle.slider.damping_N_s_m", more}, concrete);
        ASSERT_TRUE(set);
        EXPECT_NEAR(scenario::load_scenario("perch_concrete", {.overrides = {*set}})
                        .airframe.slider.damping_N_s_m,
                    damping * (more ? 1.2 : 0.8), 1e-12);
    }
    EXPECT_FALSE(override_of({"vehicle.mass_kg", true}, concrete)) << "the paper gives it";
    EXPECT_FALSE(override_of({"vehicle.no_such", true}, concrete));
    const auto all = turns_of({concrete, concrete});
    EXPECT_THAT(all, testing::Contains(Turn{"vehicle.slider.damping_N_s_m", true}));
    EXPECT_EQ(all.size(), turns_of({concrete}).size());
}

/// What is weighed stands in README, and each flight there is weighed.
TEST(ReadmeClaims, AreThoseOfReadme) {
    const std::string readme = text_of(LIMPET_SOURCE_DIR "/README.md");
    std::string shown;
    for (const ReadmeClaim& claim : load_readme_claims(readme_claims_file())) {
        EXPECT_THAT(readme, HasSubstr(claim.shown)) << claim.id;
        EXPECT_NO_THROW((void)scenario::load_scenario(claim.scenario, {.overrides = claim.set}));
        shown += claim.scenario + " " + claim.draws + "\n";
    }
    for (std::size_t at = 0; (at = readme.find("\n$ ./run ", at)) != std::string::npos; ++at) {
        std::istringstream line(readme.substr(at));
        std::string prompt, run, verb, name;
        line >> prompt >> run >> verb >> name;
        if (verb == "fly" || verb == "campaign") {
            EXPECT_THAT(shown, HasSubstr(name));
        }
    }
}

TEST(ReadmeClaims, RefusesAFileThatIsNotSo) {
    const Bench bench;
    const std::string good = "a:\n  says: so\n  shown: so\n  scenario: hover\n  figure: success\n";
    const auto error_of = [&](const std::string& text) -> std::string {
        try {
            (void)load_readme_claims(bench.write("r.yaml", text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(error_of(good), "");
    EXPECT_THAT(error_of(good + "  seeds: 0\n"), HasSubstr("6: a.seeds: must be a number"));
    EXPECT_THAT(error_of(good + "  seed: 1\n"), HasSubstr("unknown key"));
    EXPECT_THAT(error_of("a:\n  says: so\n  shown: so\n  scenario: hover\n  figure: perched\n"),
                HasSubstr("5: a.figure: \"perched\" is no metric and not success"));
    EXPECT_THAT(error_of(""), HasSubstr("is empty"));
}

}  // namespace
}  // namespace limpet::paper
