// SPDX-License-Identifier: Apache-2.0
#include "limpet/core/read_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"

namespace limpet {
namespace {

using testing::HasSubstr;

std::string refusal(const std::filesystem::path& path) {
    try {
        (void)read_file(path, {"small thing", 1}, "it");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(ReadFile, ReadsAFileUpToItsBound) {
    const std::filesystem::path path = testing::TempDir() + "limpet_read_file";
    std::ofstream(path, std::ios::binary) << std::string(1'000'000, '\0');
    EXPECT_EQ(read_file(path, {"small thing", 1}).size(), 1'000'000U);
    std::ofstream(path, std::ios::app) << 'x';
    EXPECT_EQ(refusal(path), "it: is larger than 1 MB, which no small thing is");
    std::filesystem::remove(path);
}

TEST(ReadFile, RefusesWhatIsNoFileOrNeverEnds) {
    EXPECT_EQ(refusal("/nowhere"), "it: cannot be read: No such file or directory");
    EXPECT_EQ(refusal("/tmp"), "it: is a directory, not a file");
    EXPECT_EQ(refusal("/dev/zero"), "it: is larger than 1 MB, which no small thing is");
}

TEST(UserText, KnowsUtf8) {
    for (const char* good : {"", "abc", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x9A\x81"}) {
        EXPECT_TRUE(is_utf8(good)) << good;
    }
    for (const char* bad : {"\xE9", "caf\xE9 x", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80",
                            "\xF4\x90\x80\x80", "\xF0\x9F\x9A", "\x80", "\xFF"}) {
        EXPECT_FALSE(is_utf8(bad));
    }
}

}  // namespace
}  // namespace limpet
