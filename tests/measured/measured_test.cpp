// SPDX-License-Identifier: Apache-2.0
#include "limpet/measured/measured.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "limpet/core/errors.hpp"
#include "limpet/core/frames.hpp"

namespace limpet::measured {
namespace {

using testing::HasSubstr;

const Law& law(std::string_view name) {
    for (const Law& each : laws()) {
        if (each.name == name) {
            return each;
        }
    }
    throw InternalError("no such law");
}

Measurement of(std::string_view name, std::vector<Series> series) {
    return {.law = &law(name), .series = std::move(series), .scatter = 0.01};
}

TEST(Compare, FindsTheNumberThatMadeThePoints) {
    Series fast, slow;
    for (int i = 0; i < 12; ++i) {
        const double t_s = 0.1 * i;
        fast.x.push_back(t_s);
        fast.y.push_back(1.0 - std::exp(-t_s / 0.37));
    }
    slow = fast;
    const Comparison found = compare(of("sealing_first_order", {fast, slow}));
    ASSERT_TRUE(found.fitted);
    EXPECT_NEAR(*found.fitted, 0.37, 1e-6);
    EXPECT_LT(found.rms, 1e-6);
    EXPECT_EQ(found.verdict, Verdict::holds);
}

TEST(Compare, TurnsNothingThatIsGiven) {
    const Series points{.numbers = {{"tau_s", 0.5}}, .x = {0.0, 0.5}, .y = {0.0, 0.7}};
    const Comparison found = compare(of("sealing_first_order", {points}));
    EXPECT_FALSE(found.fitted);
    const double off = 0.7 - (1.0 - std::exp(-1.0));
    EXPECT_NEAR(found.largest, off, 1e-12);
    EXPECT_NEAR(found.rms, off / std::sqrt(2.0), 1e-12);
    EXPECT_EQ(found.verdict, Verdict::differs);
}

/// Of errors that are the scatter's own: chi-squared of as many degrees as points, less the fitted.
/// Tables: 4 degrees, 13.28 is beyond in 1 of 100.
TEST(Compare, AVerdictIsTheScattersOwnChance) {
    Measurement row = of("ground", {});
    Series points{.x = {1.0, 2.0, 3.0, 4.0}};
    for (const double z : points.x) {
        points.y.push_back(1.0 / (1.0 - 1.0 / (16.0 * z * z)) + 0.01);
    }
    row.series = {points};
    row.scatter = 0.01;
    EXPECT_NEAR(*compare(row).p, 0.406, 0.001);  // chi-squared 4
    row.scatter = 0.01 / std::sqrt(13.2 / 4.0);
    EXPECT_EQ(compare(row).verdict, Verdict::holds);
    row.scatter = 0.01 / std::sqrt(13.4 / 4.0);
    EXPECT_EQ(compare(row).verdict, Verdict::differs);
    row.scatter = 1e-200;  // whose square is 0
    EXPECT_EQ(*compare(row).p, 0.0);
    row.series[0].y = compare(row).said[0];
    EXPECT_EQ(*compare(row).p, 1.0);
}

/// One that cannot tell the law from a gain of 1 settles nothing; nor does one without a scatter.
TEST(Compare, WhatSettlesNothingIsOpen) {
    Measurement row = of("ground", {{.x = {1.0, 2.0}, .y = {1.06, 1.01}}});
    EXPECT_EQ(compare(row).verdict, Verdict::holds);
    row.scatter = 0.05;
    EXPECT_EQ(compare(row).verdict, Verdict::open);
    EXPECT_GT(*compare(row).p, 0.9);
    row.scatter.reset();
    EXPECT_EQ(compare(row).verdict, Verdict::open);
    EXPECT_FALSE(compare(row).p);
}

/// The nearer of two rotors' images is its own; at a distance of d the other's adds by hand
/// R^2/4 2z / (d^2 + 4 z^2)^(3/2).
TEST(Laws, NeighboursAddTheirImages) {
    const std::vector<double> x = {0.75, 1.0, 4.0};
    const double d = 2.5;
    const auto two = law("ground_neighbours").say({{"rotors", 2.0}, {"spacing_radii", d}}, x);
    const auto four = law("ground_neighbours").say({{"rotors", 4.0}, {"spacing_radii", d}}, x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double z = x[i];
        const double own = 1.0 / (16.0 * z * z);
        const auto beside = [z](double far) {
            return 0.5 * z / std::pow(far * far + 4.0 * z * z, 1.5);
        };
        EXPECT_NEAR(two[i], 1.0 / (1.0 - own - beside(d)), 1e-12);
        EXPECT_NEAR(four[i], 1.0 / (1.0 - own - 2.0 * beside(d) - beside(d * std::sqrt(2.0))),
                    1e-12);
    }
}

/// The textbook's formula, and the tilt's cosine.
TEST(Laws, GroundIsCheesemansAndBennetts) {
    const std::vector<double> x = {0.75, 1.0, 4.0};
    const auto level = law("ground").say({}, x);
    const auto tilted = law("ground").say({{"tilt_deg", 60.0}}, x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double share = 1.0 / (4.0 * x[i]);
        EXPECT_NEAR(level[i], 1.0 / (1.0 - share * share), 1e-12);
        EXPECT_NEAR(tilted[i] - 1.0, 0.5 * (level[i] - 1.0), 1e-12);
    }
}

/// Of a pump that goes down to nothing and a cup that gives way whole, by hand: with V = V_0
/// P/P_atm d(P V)/dt = -S P is dP/dt = -S P_atm / (2 V_0), a line. Here P_ult is 1 hPa and the hose
/// is wide.
TEST(Laws, ASoftCupDrawsALine) {
    const std::vector<double> x = {0.0, 0.1, 0.2, 0.3, 0.4};
    const Numbers numbers = {
        {"pump_speed_L_min", 14.0}, {"pump_ultimate_Pa", 100.0}, {"cup_gives_way", 1.0}};
    const auto soft = law("sealing_pneumatic").say(numbers, x);
    const double rate_1_s = 14.0 / 60e3 / (2.0 * 60e-6);  // of the atmosphere
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(soft[i], rate_1_s * x[i], 0.02) << x[i];
    }
    Numbers rigid = numbers;
    rigid["cup_gives_way"] = 0.0;
    EXPECT_NEAR(law("sealing_pneumatic").say(rigid, x)[2], 1.0 - std::exp(-2.0 * rate_1_s * 0.2),
                0.02);
}

TEST(Laws, TheMotorsIsItsDifferentialEquations) {
    const Numbers numbers = {{"damping_N_m_s", 2e-4},
                             {"torque_constant_N_m_s2", 1.5e-8},
                             {"inertia_kg_m2", 2e-6},
                             {"from_rad_s", 3000.0},
                             {"to_rad_s", 1000.0}};
    for (const bool brakes : {true, false}) {
        Numbers with = numbers;
        with["brakes"] = brakes ? 1.0 : 0.0;
        double w = 3000.0;
        constexpr double kStep_s = 1e-6;
        for (int i = 0; i < 10000; ++i) {
            const double driven = (2e-4 + 1.5e-8 * (w + 1000.0)) * (w - 1000.0) / 2e-6;
            w -= kStep_s * (brakes ? driven : std::min(driven, 1.5e-8 * w * w / 2e-6));
        }
        EXPECT_NEAR(law("motor_physical").say(with, std::vector{0.01})[0], (w - 3000.0) / -2000.0,
                    1e-3);
    }
}

/// A folder with one file.
class Folder {
public:
    explicit Folder(const std::string& text) {
        path_ = std::filesystem::temp_directory_path() /
                ("measured_test_" + std::to_string(::getpid()));
        std::filesystem::create_directories(path_);
        std::ofstream(path_ / "air.yaml") << text;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

const std::string kGood =
    "a:\n  what: thrust\n  source: somebody\n  x: z/R [-]\n  unit: \"-\"\n  law: ground\n"
    "  scatter: 0.1\n  scatter_of: so\n  series:\n    - x: [1, 2]\n      y: [1.1, 1]\n";

std::string with(const std::string& from, const std::string& to) {
    std::string text = kGood;
    return text.replace(text.find(from), from.size(), to);
}

TEST(MeasuredFile, ReadsRowsAndThoseThatShareASeries) {
    const Folder folder(kGood +
                        "b:\n  what: tilted\n  source: the same\n  x: z/R [-]\n"
                        "  unit: \"-\"\n  law: ground\n  numbers: {tilt_deg: 30}\n"
                        "  scatter_of: so\n  series: a\n"
                        "looked_at:\n  - {what: w, where: h, why: y}\n");
    const Measurements read = load_measurements(folder.path());
    ASSERT_EQ(read.rows.size(), 2U);
    EXPECT_EQ(read.rows[1].series[0].x, read.rows[0].series[0].x);
    EXPECT_EQ(read.rows[1].series[0].numbers.at("tilt_deg"), 30.0);
    EXPECT_EQ(read.rows[0].series[0].numbers.size(), 0U);
    EXPECT_EQ(read.rows[0].scatter, 0.1);
    EXPECT_FALSE(read.rows[1].scatter);
    ASSERT_EQ(read.looked_at.size(), 1U);
    EXPECT_EQ(read.looked_at[0].why, "y");
}

TEST(MeasuredFile, RefusesInOneLineWithItsPlace) {
    struct Case {
        std::string text;
        const char* error;
    };
    for (const Case& c :
         {Case{with("law: ground", "law: grund"), "air.yaml:6: a.law"},
          Case{with("y: [1.1, 1]", "y: [1.1]"), "air.yaml:11: a.series[0].y: must have 2 numbers"},
          Case{with("x: [1, 2]", "x: [2, 2]"), "must rise"},
          Case{with("x: [1, 2]", "x: [.nan, 2]"), "must be a number of at most 1e+100"},
          Case{with("scatter: 0.1", "scatter: 0"), "must be above 0"},
          Case{with("scatter_of: so", "scater_of: so"), "air.yaml:8: a.scater_of"},
          Case{with("  scatter_of: so\n", ""), "scatter_of"},
          Case{with("law: ground", "law: motor_physical"), "lacks the number damping_N_m_s"},
          Case{with("law: ground", "law: ground\n  numbers: {tilt: 1}"), "a.numbers.tilt"},
          Case{with("law: ground", "law: ground\n  numbers: {tilt_deg: 91}"),
               "air.yaml:7: a.numbers.tilt_deg: must be from -90 to 90"},
          Case{with("law: ground", "law: ground_neighbours\n  numbers: {rotors: 2.5}"),
               "a.numbers.rotors: must be a whole number"},
          Case{with("x: [1, 2]", "x: [-1, 2]"), "air.yaml:10: a.series[0].x: must be 0 or more"},
          Case{with("law: ground", "law: sealing_first_order\n  numbers: {seen_share: 0}"),
               "a.numbers.seen_share: must be from 0.01 to 1"},
          // a step of no height
          Case{with("law: ground",
                    "law: motor_physical\n  numbers: {damping_N_m_s: 1e-4, from_rad_s: 5, "
                    "torque_constant_N_m_s2: 1e-8, to_rad_s: 5}"),
               "gives motor_physical no finite answer"},
          Case{with("law: ground", "law: leak_first_order") +
                   "    - {numbers: {tau_s: 1}, x: [1], y: [1]}\n",
               "a.series: must have the number tau_s in each or in none"},
          Case{kGood + "looked_at:\n  - {what: w, where: h}\n", "why"},
          Case{with("  series:\n    - x: [1, 2]\n      y: [1.1, 1]\n", "  series: z\n"),
               "is no row above"}}) {
        const Folder folder(c.text);
        try {
            (void)load_measurements(folder.path());
            ADD_FAILURE() << c.error;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(c.error));
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
}

TEST(MeasuredFile, AFolderWithoutOneIsRefused) {
    EXPECT_THROW((void)load_measurements("/nowhere/at/all"), InputError);
}

/// Every row has its source; its verdict is that of docs/evidence.md, which says why it differs.
TEST(OthersData, EachRowIsComparedAndWhatDiffersSaysWhy) {
    const Measurements all = load_measurements(others_folder());
    EXPECT_GE(all.rows.size(), 20U);
    EXPECT_GE(all.looked_at.size(), 8U);
    std::set<std::string> ids;
    for (const Measurement& row : all.rows) {
        SCOPED_TRACE(row.id);
        EXPECT_TRUE(ids.insert(row.id).second) << "twice";
        const Comparison found = compare(row);
        EXPECT_TRUE(std::isfinite(found.rms));
        EXPECT_LE(found.rms, found.largest);
        EXPECT_EQ(found.p.has_value(), row.scatter.has_value());
        if (found.verdict == Verdict::differs) {
            EXPECT_FALSE(row.note.empty()) << "differs by " << found.rms << " and does not say why";
        }
    }
}

}  // namespace
}  // namespace limpet::measured
