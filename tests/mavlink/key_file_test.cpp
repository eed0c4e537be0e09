// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/key_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "limpet/core/errors.hpp"

namespace limpet::mavlink {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class KeyFile : public testing::Test {
protected:
    void write(const std::string& text, fs::perms mode = fs::perms::owner_read) {
        fs::remove(path_);
        std::ofstream(path_, std::ios::binary) << text;
        fs::permissions(path_, mode);
    }
    void TearDown() override { fs::remove_all(path_); }
    std::string refusal() {
        try {
            static_cast<void>(read_signing_key(path_));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    fs::path path_ =
        fs::path(testing::TempDir()) /
        (std::string("key_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(KeyFile, MayBeHexDigitsOrBytes) {
    SigningKey key = {};
    std::string bytes;
    std::string hex;
    for (std::size_t i = 0; i < key.size(); ++i) {
        key[i] = static_cast<std::uint8_t>(7 * i + 1);
        bytes += static_cast<char>(key[i]);
        constexpr char kDigits[] = "0123456789aBcDeF";
        hex += kDigits[key[i] / 16];
        hex += kDigits[key[i] % 16];
    }
    write(hex);
    EXPECT_EQ(read_signing_key(path_), key);
    write(" " + hex + "\r\n");
    EXPECT_EQ(read_signing_key(path_), key);
    write(bytes);
    EXPECT_EQ(read_signing_key(path_), key);
}

TEST_F(KeyFile, OfAnyOtherFormIsRefusedWithoutBeingShown) {
    const std::string secret = "c0ffee";
    for (const std::string& text :
         {secret, std::string(63, 'a'), std::string(65, 'a'), std::string(64, 'g'),
          std::string(31, '\1'), std::string(5000, 'a'), std::string()}) {
        write(text);
        EXPECT_EQ(refusal(),
                  "signing key " + path_.string() + ": must be 64 hex digits, or 32 bytes");
    }
    write(std::string(64, '0'));
    EXPECT_THAT(refusal(), HasSubstr("all zeros"));
}

TEST_F(KeyFile, ThatOthersMayReadIsRefusedWithItsMode) {
    write(std::string(64, 'a'), fs::perms::owner_read | fs::perms::group_read);
    EXPECT_EQ(refusal(), "signing key " + path_.string() +
                             ": others may read or write it (mode 0440); chmod 600 " +
                             path_.string());
    write(std::string(64, 'a'), fs::perms::owner_read | fs::perms::others_write);
    EXPECT_THAT(refusal(), HasSubstr("mode 0402"));
    write(std::string(64, 'a'), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(refusal(), "");
}

TEST_F(KeyFile, ThatIsNotThereIsNamed) {
    EXPECT_EQ(refusal(), "signing key " + path_.string() + ": No such file or directory");
    fs::create_directory(path_);
    EXPECT_THAT(refusal(), HasSubstr("is not a file"));
}

}  // namespace
}  // namespace limpet::mavlink
