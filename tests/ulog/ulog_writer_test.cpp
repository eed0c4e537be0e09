// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "../support/files.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/record/recorder.hpp"
#include "limpet/ulog/ulog.hpp"

// Read by another's reader in adapters/web/test/ulog.test.ts; here, byte by byte.
namespace limpet::ulog {
namespace {

using namespace record;  // of whose columns a log is made

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ULog, BeginsAsTheFormatSays) {
    const TestFolder folder;
    {
        Recorder recorder(folder / "a.mcap",
                          {.scenario = "s", .version = "1", .attachments = {}, .range_sensor = {}});
        recorder.rotor_command(1.5, {{0.25, 0.5, 0.75, 1.0}, true});
        recorder.finish("{}");
    }
    write_ulog(read_recording(folder / "a.mcap"), folder / "a.ulg");
    const std::string log = text_of(folder / "a.ulg");
    EXPECT_EQ(log.substr(0, 8), std::string("ULog\x01\x12\x35\x01", 8));
    EXPECT_EQ(log.substr(16, 3), std::string("\x28\x00"
                                             "B",
                                             3));  // 40 bytes of flags, none set
    EXPECT_NE(log.find("actuator_motors:uint64_t timestamp;float[12] control;"), std::string::npos);
    // the only row: 58 bytes of data, subscription 0, 1.5 s, a quarter
    const std::string row(
        "\x3a\x00"
        "D\x00\x00\x60\xe3\x16\x00\x00\x00\x00\x00\x00\x00\x80\x3e",
        17);
    EXPECT_EQ(log.find(row), log.size() - 61);
}

TEST(ULog, RefusesARecordingWithNothingForIt) {
    const TestFolder folder;
    {
        Recorder recorder(folder / "a.mcap",
                          {.scenario = "s", .version = "1", .attachments = {}, .range_sensor = {}});
        recorder.finish("{}");
    }
    EXPECT_THROW(write_ulog(read_recording(folder / "a.mcap"), folder / "a.ulg"), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.ulg"));
}

}  // namespace
}  // namespace limpet::ulog
