// SPDX-License-Identifier: Apache-2.0
#include "limpet/px4/process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "limpet/core/errors.hpp"

namespace limpet::px4 {
namespace {

namespace fs = std::filesystem;

/// Not one that has ended and that nobody has waited for, as in a container whose first process
/// does not.
bool runs(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string stat;
    return std::getline(file, stat) && stat.substr(stat.rfind(')')).rfind(") Z", 0) != 0;
}
using testing::HasSubstr;

Px4Airframe a_vehicle() {
    Px4Airframe airframe;
    airframe.name = "mine";
    airframe.rotors = {autopilot::RotorGeometry{{0.2, 0.2, 0.0}, +1.0, 0.02},
                       autopilot::RotorGeometry{{-0.2, -0.2, 0.0}, +1.0, 0.02},
                       autopilot::RotorGeometry{{0.2, -0.2, 0.0}, -1.0, 0.02},
                       autopilot::RotorGeometry{{-0.2, 0.2, 0.0}, -1.0, 0.02}};
    airframe.autopilot.MC_PITCHRATE_P = 0.123;
    return airframe;
}

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What it has written there, once it has.
std::string comes_to_be(const fs::path& path) {
    for (int k = 0; k < 500 && !fs::exists(path); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return text_of(path);
}

class Px4ProcessTest : public testing::Test {
protected:
    Px4ProcessTest() { fs::create_directories(build_ / "bin"); }
    ~Px4ProcessTest() override { fs::remove_all(folder_); }

    void write(const fs::path& path, const std::string& text) const {
        fs::create_directories(path.parent_path());
        std::ofstream(path) << text;
    }

    fs::path folder_ = fs::temp_directory_path() / ("limpet_process_" + std::to_string(getpid()));
    fs::path build_ = folder_ / "build of mine";
};

TEST_F(Px4ProcessTest, ABuildFliesTheAirframeAmongItsOwn) {
    write(build_ / "etc/init.d/rc.mc_defaults", "theirs");
    write(build_ / "etc/init.d-posix/rcS", "theirs");
    write(build_ / "etc/init.d-posix/airframes/10016_none_iris", "theirs");
    write(build_ / "etc/init.d-posix/airframes/22001_limpet_mine", "an older one");
    write(build_ / "etc/init.d-posix/airframes/22001_limpet_of_another", "of the same number");
    write(build_ / "etc/init.d-posix/airframes/220010_not_ours", "of another number");
    write(build_ / "bin/px4",
          "#!/bin/sh\ncd \"$5\"; cat etc/init.d/rc.mc_defaults etc/init.d-posix/rcS > \"$OUT\"\n"
          "ls etc/init.d-posix/airframes >> \"$OUT\"\n"
          "grep MC_PITCHRATE_P etc/init.d-posix/airframes/22001_limpet_mine >> \"$OUT\"\n"
          "echo \"$PX4_SYS_AUTOSTART $1 $2 $3 $4\" >> \"$OUT\"; mv \"$OUT\" \"$OUT.whole\"\n"
          "sleep 60\n");
    fs::permissions(build_ / "bin/px4", fs::perms::owner_all);
    const fs::path out = folder_ / "out";
    ASSERT_EQ(setenv("OUT", out.c_str(), 1), 0);
    {
        Px4Process px4(build_.string(), a_vehicle(), {.number = 2});
        EXPECT_EQ(comes_to_be(folder_ / "out.whole"),
                  "theirstheirs10016_none_iris\n220010_not_ours\n22001_limpet_mine\n"
                  "param set-default MC_PITCHRATE_P 0.123\n22001 -d -i 2 -w\n");
        px4.require_running();
    }
    EXPECT_EQ(text_of(build_ / "etc/init.d-posix/airframes/22001_limpet_mine"), "an older one");
}

TEST_F(Px4ProcessTest, ACommandHasItsInstanceAndItsFolderAndEndsWithAllItStarted) {
    const fs::path out = folder_ / "told";
    pid_t child = 0;
    std::string its_folder;
    {
        Px4Process px4("sleep 60 & echo {instance} {folder} $! > '" + out.string() +
                           ".part'; ls {folder} >> '" + out.string() + ".part'; mv '" +
                           out.string() + ".part' '" + out.string() + "'; wait",
                       a_vehicle(), {.number = 4});
        std::istringstream told(comes_to_be(out));
        int instance = 0;
        told >> instance >> its_folder >> child;
        EXPECT_EQ(instance, 4);
        EXPECT_TRUE(fs::is_directory(its_folder));
        EXPECT_THAT(text_of(out), HasSubstr("mine.params"));
        EXPECT_TRUE(runs(child));
    }
    EXPECT_FALSE(fs::exists(its_folder));
    for (int k = 0; k < 500 && runs(child); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_FALSE(runs(child));
}

TEST_F(Px4ProcessTest, ABuildIsNotToldWhatItHasNoParameterFor) {
    write(build_ / "etc/init.d-posix/airframes/10016_none_iris", "theirs");
    write(build_ / "parameters.json",
          R"({"parameters": [{"name": "MC_PITCHRATE_P", "type": "Float", "default": 0.15}]})");
    write(build_ / "bin/px4",
          "#!/bin/sh\ngrep -h '^param' \"$5\"/etc/init.d-posix/airframes/22* > \"$OUT\"\n"
          "mv \"$OUT\" \"$OUT.whole\"\nsleep 60\n");
    fs::permissions(build_ / "bin/px4", fs::perms::owner_all);
    const fs::path out = folder_ / "fitted";
    ASSERT_EQ(setenv("OUT", out.c_str(), 1), 0);
    const Px4Process px4(build_.string(), a_vehicle(), {});
    EXPECT_EQ(comes_to_be(folder_ / "fitted.whole"), "param set-default MC_PITCHRATE_P 0.123\n");
    EXPECT_THAT(px4.left_out(), testing::Contains("MPC_USE_HTE"));
}

/// Its folder goes; what it printed and logged is what a failed flight is looked into with.
TEST_F(Px4ProcessTest, ItsConsoleAndItsLogsAreKept) {
    const fs::path there = folder_ / "there";
    write(there / "px4.ulg", "of an earlier flight");
    write(there / "px4_2.ulg", "of an earlier flight");
    write(there / "px4_3.ulg", "of an earlier flight");
    write(there / "flight.mcap", "a recording");
    Px4Process px4(
        "cd {folder}; mkdir -p log/1970-01-01; echo b > log/1970-01-01/00_00_31.ulg;"
        "echo a > log/1970-01-01/00_00_02.ulg; echo no > log/params.bson;"
        "echo ERROR; echo > '" +
            (folder_ / "done").string() + "'; sleep 60",
        a_vehicle(), {});
    (void)comes_to_be(folder_ / "done");
    EXPECT_EQ(px4.keep(there),
              (std::vector<fs::path>{there / "px4.log", there / "px4.ulg", there / "px4_2.ulg"}));
    EXPECT_EQ(text_of(there / "px4.log"), "ERROR\n");
    EXPECT_EQ(text_of(there / "px4.ulg"), "a\n");
    EXPECT_EQ(text_of(there / "px4_2.ulg"), "b\n");
    EXPECT_FALSE(fs::exists(there / "px4_3.ulg"));
    EXPECT_EQ(text_of(there / "flight.mcap"), "a recording");
    EXPECT_THROW(px4.require_running(), InputError) << "it has been ended";
    EXPECT_THROW((void)px4.keep(folder_ / "not there"), InputError);
}

/// Of a flight that was killed (SIGKILL), which could not clean up.
TEST_F(Px4ProcessTest, AFolderThatNobodyIsAtWorkInGoesWithTheNext) {
    const auto make = [](const std::string& name, std::chrono::seconds old) {
        const fs::path folder =
            fs::temp_directory_path() / (name + std::to_string(getpid()) + "_swept");
        fs::create_directories(folder / "log");
        fs::last_write_time(folder, fs::file_time_type::clock::now() - old);
        return folder;
    };
    const fs::path killed = make("limpet_px4_run_a", std::chrono::hours(1));
    const fs::path young = make("limpet_px4_run_b", std::chrono::seconds(0));
    const fs::path at_work = make("limpet_px4_run_c", std::chrono::hours(1));
    const fs::path others = make("limpet_px4_", std::chrono::hours(1));
    {
        const FolderLock lock(at_work);
        const Px4Process px4("sleep 60", a_vehicle(), {});
    }
    EXPECT_FALSE(fs::exists(killed));
    for (const fs::path& folder : {young, at_work, others}) {
        EXPECT_TRUE(fs::exists(folder)) << folder;
        fs::remove_all(folder);
    }
}

TEST_F(Px4ProcessTest, OneThatEndsByItselfIsToldWithItsLastLine) {
    Px4Process px4("echo port in use; exit 1", a_vehicle(), {});
    std::string told;
    for (int k = 0; k < 500 && told.empty(); ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        try {
            px4.require_running();
        } catch (const InputError& error) {
            told = error.what();
        }
    }
    EXPECT_THAT(told, HasSubstr("ended by itself, its last line: port in use"));
    EXPECT_THROW(px4.require_running(), InputError);
}

}  // namespace
}  // namespace limpet::px4
