// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"

namespace limpet {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Porous concrete by eqs. (5) and (6), as a sensor of 0.5 hPa with 6 hPa of pump measures it.
std::string concrete_log(double from_s = 0.0, double to_s = 7.0) {
    std::string csv = "# bench\nnote,pressure_Pa,t_s\n";
    const int first = static_cast<int>(std::lround(100.0 * from_s));
    const int last = static_cast<int>(std::lround(100.0 * to_s));
    for (int k = first; k < last; ++k) {
        const double t_s = 0.01 * k;
        double pressure_Pa = 101600.0;
        if (t_s >= 4.0) {
            pressure_Pa = 101600.0 - 36600.0 * std::exp(-(t_s - 4.0) / 0.40);
        } else if (t_s >= 1.0) {
            pressure_Pa = 65000.0 + 36600.0 * std::exp(-(t_s - 1.0) / 0.33);
            pressure_Pa += 600.0 * (101600.0 - pressure_Pa) / 36600.0 * std::sin(50.0 * t_s);
        }
        const double read_Pa = 50.0 * std::round(pressure_Pa / 50.0);
        csv += "x," + std::to_string(read_Pa) + "," + std::to_string(t_s) + "\n";
    }
    return csv;
}

TEST(Identify, FindsTheNumbersOfALogAndDrawsThem) {
    const Bench bench;
    (void)bench.write("log.csv", concrete_log());
    const Finished finished = bench.run({"identify", "log.csv"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.err, "");
    EXPECT_THAT(finished.out,
                AllOf(HasSubstr("tau_1"), HasSubstr("tau_2"),
                      HasSubstr("Table II: porous_concrete"), Not(HasSubstr("note"))));
    EXPECT_THAT(bench.files(), Contains("out/identify/identify.png"));
    EXPECT_THAT(bench.files(), Contains("out/identify/identify.svg"));
}

/// Named from a folder that is not the checkout's, as scenarios are; as pages print it, too.
TEST(Identify, FindsASampleByItsName) {
    const Bench bench;
    const Finished by_name = bench.run({"identify", "pressure_log"});
    EXPECT_EQ(by_name.exit_code, 0) << by_name.err;
    EXPECT_THAT(by_name.out, HasSubstr("650.5"));
    EXPECT_EQ(bench.run({"identify", "samples/pressure_log.csv"}).out, by_name.out);
    const Finished calibrated = bench.run({"calibrate", "pressure_log"});
    EXPECT_THAT(calibrated.out, HasSubstr("vacuum_pressure_Pa")) << calibrated.err;
    const Finished wrong = bench.run({"identify", "pressure_lag"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_EQ(
        wrong.err,
        "limpet: \"pressure_lag\": no such file or sample (did you mean pressure_log?); there "
        "is pressure_log\n");
    const Finished other_kind = bench.run({"identify", "propeller_static"});
    EXPECT_EQ(other_kind.exit_code, 2);
    EXPECT_TRUE(other_kind.one_line_of_error()) << other_kind.err;
    const Finished rotor = bench.run({"rotor", "propeller_static", "--diameter", "12in"});
    EXPECT_EQ(rotor.exit_code, 0) << rotor.err;
    EXPECT_EQ(bench.run({"rotor", "samples/propeller_static.txt", "--diameter", "12in"}).out,
              rotor.out);
}

/// Its model of a flight has neither: numbers would come out, and be wrong.
TEST(Calibrate, RefusesWhatItDoesNotKnow) {
    const Bench bench;
    for (const auto& [change, error] :
         {std::pair("vehicle.payload.mass_kg=0.2", "a payload on a cable"),
          std::pair("vehicle.rotor.motor_kv_rpm_V=380", "motors by motor_kv_rpm_V")}) {
        ASSERT_EQ(bench
                      .run({"fly", "hover", "--set", change, "--set", "simulation.hover_s=1",
                            "--no-figures", "--out", "flown"})
                      .exit_code,
                  0);
        const Finished finished = bench.run({"calibrate", "flown/flight.mcap"});
        EXPECT_EQ(finished.exit_code, 2);
        EXPECT_EQ(finished.out, "");
        EXPECT_EQ(finished.err, "limpet: flown/flight.mcap: the vehicle that flew has " +
                                    std::string(error) + ", which calibrate does not know\n");
    }
}

/// Another's numbers would come out, with intervals.
TEST(Calibrate, TakesTheRecordingsVehicleAlsoWithoutACup) {
    const Bench bench;
    ASSERT_EQ(bench
                  .run({"fly", "hover", "--set", "vehicle=iris", "--set",
                        "simulation.record_rate_Hz=250", "--no-figures", "--quiet", "--out", "."})
                  .exit_code,
              0);
    const Finished own = bench.run({"calibrate", "flight.mcap"});
    EXPECT_EQ(own.exit_code, 0) << own.err;
    EXPECT_THAT(own.out, Not(HasSubstr("slider")));
    EXPECT_THAT(own.out, AllOf(HasSubstr("limpet fly hover \\\n  --set vehicle=iris"),
                               HasSubstr("--set vehicle.inertia_kg_m2.xx=0.0")));
    EXPECT_EQ(bench.run({"calibrate", "flight.mcap", "--vehicle", "iris"}).out, own.out);
    const auto fit = nlohmann::json::parse(bench.run({"calibrate", "flight.mcap", "--json"}).out);
    EXPECT_EQ(fit["vehicle"], "iris");
    const auto& xx = fit["numbers"]["vehicle.inertia_kg_m2.xx"];
    EXPECT_LT(xx["low"].get<double>(), 0.029125);  // vehicles/iris.yaml
    EXPECT_GT(xx["high"].get<double>(), 0.029125);
    EXPECT_EQ(xx["plausible"], true);
    const Finished other = bench.run({"calibrate", "flight.mcap", "--vehicle", "perching_uav"});
    EXPECT_THAT(other.out, HasSubstr("the recording's vehicle is iris, taken as known is "
                                     "perching_uav"));
}

TEST(Calibrate, AsksWhichVehicleWhereNothingSaysIt) {
    const Bench bench;
    std::string csv =
        "t_s,gyro_x_rad_s,gyro_y_rad_s,gyro_z_rad_s,command_0,command_1,command_2,"
        "command_3\n";
    for (int k = 0; k < 1000; ++k) {
        csv += fmt::format("{},0,0,0,0.6,0.6,0.6,0.6\n", 0.004 * k);
    }
    (void)bench.write("log.csv", csv);
    const Finished finished = bench.run({"calibrate", "log.csv"});
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.err, HasSubstr("log.csv: the log does not say which vehicle flew: "
                                        "--vehicle NAME|FILE"));
    // A relative path counts from here.
    (void)bench.write("mine.yaml", "mass_kg: 3.3\n");
    const Finished named = bench.run({"calibrate", "log.csv", "--vehicle", "mine.yaml"});
    EXPECT_THAT(named.err, Not(HasSubstr("mine.yaml"))) << named.err;
}

/// A log that does not determine the inertia: what comes out is not offered.
TEST(Calibrate, OffersNoImplausibleInertia) {
    const Bench bench;
    std::string csv =
        "t_s,gyro_x_rad_s,gyro_y_rad_s,gyro_z_rad_s,command_0,command_1,command_2,"
        "command_3\n";
    std::uint32_t noise = 1;
    const auto next = [&noise] {
        noise = 1664525U * noise + 1013904223U;
        return static_cast<double>(noise >> 8U) / 16777216.0 - 0.5;
    };
    for (int k = 0; k < 2000; ++k) {
        csv += fmt::format("{},{},{},{}", 0.004 * k, 1e-3 * next(), 1e-3 * next(), 1e-3 * next());
        csv += fmt::format(",{},{},{},{}\n", 0.6 + 0.1 * next(), 0.6 + 0.1 * next(),
                           0.6 + 0.1 * next(), 0.6 + 0.1 * next());
    }
    (void)bench.write("log.csv", csv);
    const Finished finished = bench.run({"calibrate", "log.csv", "--vehicle", "perching_uav"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_THAT(finished.out, Not(HasSubstr("--set vehicle.inertia_kg_m2")));
    EXPECT_THAT(finished.out, HasSubstr("note  vehicle.inertia_kg_m2.xx: "));
}

TEST(Calibrate, WhatItSaysToFlyHasItsVehicle) {
    const Bench bench;
    ASSERT_EQ(bench
                  .run({"fly", "perch_concrete", "--quiet", "--out", ".", "--set",
                        "vehicle=perching_x8", "--set", "simulation.record_rate_Hz=250"})
                  .exit_code,
              0);
    const Finished done = bench.run({"calibrate", "flight.mcap", "--vehicle", "perching_x8"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("limpet fly perch_concrete \\\n  --set vehicle=perching_x8 "));
}

TEST(Identify, JsonIsInSiAndHoldsTheTruth) {
    const Bench bench;
    (void)bench.write("log.csv", concrete_log());
    const Finished finished = bench.run({"identify", "log.csv", "--json"});
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    const auto printed = nlohmann::json::parse(finished.out);
    const std::pair<const char*, double> truths[] = {
        {"vacuum_pressure_Pa", 65000.0},     {"sealing_time_constant_s", 0.33},
        {"unsealing_time_constant_s", 0.40}, {"atmosphere_Pa", 101600.0},
        {"atmosphere_offset_Pa", 275.0},     {"sealing_begins_s", 1.0},
        {"unsealing_begins_s", 4.0}};
    for (const auto& [key, truth] : truths) {
        EXPECT_NEAR(printed[key]["value"].get<double>(), truth, 0.005 * truth) << key;
        EXPECT_LT(printed[key]["low"].get<double>(), printed[key]["value"].get<double>()) << key;
        EXPECT_GT(printed[key]["high"].get<double>(), printed[key]["value"].get<double>()) << key;
    }
    EXPECT_NEAR(printed["ripple_Hz"]["value"].get<double>(), 50.0 / 6.283185307, 0.02);
    EXPECT_EQ(printed["nearest_surface"], "porous_concrete");
    EXPECT_THAT(bench.files(), testing::ElementsAre("log.csv"));
}

TEST(Identify, SaysWhatIsMissingAndFitsTheRest) {
    const Bench bench;
    (void)bench.write("seal.csv", concrete_log(0.0, 3.9));
    (void)bench.write("unseal.csv", concrete_log(3.0, 7.0));
    const auto seal = nlohmann::json::parse(bench.run({"identify", "seal.csv", "--json"}).out);
    EXPECT_TRUE(seal["unsealing_time_constant_s"].is_null());
    EXPECT_NEAR(seal["sealing_time_constant_s"]["value"].get<double>(), 0.33, 0.005);
    EXPECT_THAT(seal["notes"].dump(), HasSubstr("no unsealing"));
    const auto unseal = nlohmann::json::parse(
        bench.run({"identify", "unseal.csv", "--json", "--pump-off", "4"}).out);
    EXPECT_TRUE(unseal["sealing_time_constant_s"].is_null());
    EXPECT_NEAR(unseal["unsealing_time_constant_s"]["value"].get<double>(), 0.40, 0.005);
    EXPECT_THAT(unseal["notes"].dump(), HasSubstr("no sealing"));
}

/// One clear line, exit code 2, nothing written.
void expect_refused(const std::string& log, const std::vector<std::string>& texts,
                    std::vector<std::string> options = {}) {
    const Bench bench;
    (void)bench.write("log.csv", log);
    options.insert(options.begin(), {"identify", "log.csv"});
    const Finished finished = bench.run(options);
    EXPECT_EQ(finished.exit_code, 2) << finished.err;
    EXPECT_TRUE(finished.one_line_of_error()) << finished.err;
    EXPECT_EQ(finished.out, "");
    for (const std::string& text : texts) {
        EXPECT_THAT(finished.err, HasSubstr(text));
    }
    EXPECT_THAT(bench.files(), testing::ElementsAre("log.csv"));
}

std::string at_unix_time(const std::string& log) {
    std::istringstream lines(log);
    std::string out;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t comma = line.rfind(',');
        out += line.starts_with("x,") ? fmt::format("{}{:.6f}", line.substr(0, comma + 1),
                                                    1.71e9 + std::stod(line.substr(comma + 1)))
                                      : line;
        out += '\n';
    }
    return out;
}

TEST(Identify, ALogWithAClocksTimesGivesTheSameNumbers) {
    const Bench bench;
    (void)bench.write("rel.csv", concrete_log());
    (void)bench.write("unix.csv", at_unix_time(concrete_log()));
    const auto numbers = [&](const std::string& log, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"identify", log, "--json"});
        const Finished finished = bench.run(more);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        return nlohmann::json::parse(finished.out);
    };
    const auto rel = numbers("rel.csv"), unix_time = numbers("unix.csv");
    for (const char* key :
         {"sealing_time_constant_s", "unsealing_time_constant_s", "sealing_begins_s"}) {
        for (const char* part : {"value", "low", "high"}) {
            EXPECT_NEAR(unix_time[key][part].get<double>(), rel[key][part].get<double>(), 2e-6)
                << key;
        }
    }
    EXPECT_EQ(unix_time["time_origin_s"], 1.71e9);
    EXPECT_EQ(rel["time_origin_s"], 0.0);
    // Times are taken in the clock, too.
    EXPECT_EQ(numbers("unix.csv", {"--to", "1710000005"})["samples"],
              numbers("rel.csv", {"--to", "5"})["samples"]);
    EXPECT_THAT(bench.run({"identify", "unix.csv"}).out,
                HasSubstr("note            times are from the first sample, at 1710000000.000 s"));
}

TEST(Identify, RefusesBadInputInOneLine) {
    const std::string header = "t_s,pressure_Pa\n0,101325\n";
    expect_refused("", {"log.csv", "empty"});
    expect_refused("t_s,pressure_Pa\n", {"log.csv", "no samples"});
    expect_refused("time,p\n0,1\n", {"log.csv:1", "t_s", "\"time\", \"p\""});
    expect_refused(header + "0.1,much\n", {"log.csv:3", "pressure_Pa", "much"});
    expect_refused(header + "nan,101325\n", {"log.csv:3", "t_s", "nan"});
    expect_refused(header + "0.1,inf\n", {"log.csv:3", "inf"});
    expect_refused(header + "-0.1,101325\n", {"log.csv:3", "times must rise"});
    expect_refused(header + "0,101325\n", {"log.csv:3", "times must rise"});
    expect_refused(header + "0.1,-4\n", {"log.csv:3", "below zero"});
    expect_refused(header + "0.1,101325\n", {"log.csv", "2 samples are too few"});
    expect_refused(concrete_log(0.0, 0.9), {"log.csv", "no change of pressure"});
    expect_refused(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), {"log.csv:"});
}

TEST(Identify, RefusesBadOptionsInOneLine) {
    expect_refused(concrete_log(), {"pump on at 70 s", "outside"}, {"--pump-on", "70"});
    expect_refused(concrete_log(), {"must be a time"}, {"--pump-off", "nan"});
    expect_refused(concrete_log(), {"on before it goes off"},
                   {"--pump-on", "4", "--pump-off", "1"});
    expect_refused(concrete_log(), {"too few"}, {"--from", "6.95"});
    expect_refused(concrete_log(), {"must be before"}, {"--from", "5", "--to", "2"});
    expect_refused(concrete_log(), {"--atmosphere"}, {"--atmosphere", "5"});
    expect_refused(concrete_log(), {"atmosphere"}, {"--atmosphere", "nan"});
    expect_refused(concrete_log(), {"log.csv"}, {"--out", "log.csv"});
    const Finished missing = Bench{}.run({"identify", "nowhere.csv"});
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_THAT(missing.err, AllOf(HasSubstr("nowhere.csv"), HasSubstr("No such file")));
    const Finished folder = Bench{}.run({"identify", "."});
    EXPECT_EQ(folder.exit_code, 2);
    EXPECT_THAT(folder.err, HasSubstr("is a directory"));
}

}  // namespace
}  // namespace limpet
