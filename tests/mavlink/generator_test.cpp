// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace limpet::mavlink {
namespace {

using testing::HasSubstr;

struct Answer {
    int exit_code = -1;
    std::string text;  ///< standard error
};

/// generate_messages.py with an XML of one enumeration and one message, either of which is ours.
class Generator : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove_all(folder_); }

    Answer make(const std::string& message, const std::string& enumeration = "") {
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ + "/m.xml") << "<mavlink><enums>\n"
                                          << enumeration << "</enums><messages>\n"
                                          << message << "</messages></mavlink>\n";
        const std::string command = fmt::format(
            "cd '{}' && python3 '{}/limpet/mavlink/generate_messages.py' m.xml m.hpp 2>&1 "
            ">/dev/null",
            folder_, LIMPET_SOURCE_DIR);
        Answer answer;
        if (FILE* pipe = popen(command.c_str(), "r")) {
            std::array<char, 4096> part;
            while (const std::size_t n = fread(part.data(), 1, part.size(), pipe)) {
                answer.text.append(part.data(), n);
            }
            const int status = pclose(pipe);
            answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        }
        return answer;
    }

    std::string folder_ = testing::TempDir() + "limpet_generator_" +
                          testing::UnitTest::GetInstance()->current_test_info()->name();
};

constexpr const char* kField = "<field type=\"uint8_t\" name=\"a\"/>\n";

TEST_F(Generator, MakesAHeader) {
    const Answer answer =
        make(fmt::format("<message id=\"7\" name=\"ONE_TWO\">\n{}</message>\n", kField));
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    std::ifstream header(folder_ + "/m.hpp");
    const std::string text((std::istreambuf_iterator<char>(header)), {});
    EXPECT_THAT(text, HasSubstr("struct OneTwo {\n"));
    EXPECT_THAT(text, HasSubstr("using AllMessages = std::tuple<OneTwo>;"));
}

/// An enumeration is as wide as its largest value; a name in C++ begins with no digit.
TEST_F(Generator, MakesEnumerations) {
    const Answer answer =
        make(fmt::format("<message id=\"7\" name=\"ONE_TWO\">\n{}</message>\n", kField),
             "<enum name=\"A_BIT\"><entry value=\"255\" name=\"A_BIT_3D\"/></enum>"
             "<enum name=\"B\"><entry value=\"256\" name=\"B_C\"/></enum>"
             "<enum name=\"C\"><entry value=\"65536\" name=\"C_D\"/></enum>"
             "<enum name=\"MAV_COMPONENT\"><entry value=\"1\" name=\"MAV_COMP_ID_D\"/></enum>");
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    std::ifstream header(folder_ + "/m.hpp");
    const std::string text((std::istreambuf_iterator<char>(header)), {});
    EXPECT_THAT(text, HasSubstr("struct ABit {\n    enum Value : std::uint8_t { bit_3d = 255 };"));
    EXPECT_THAT(text, HasSubstr("struct B {\n    enum Value : std::uint16_t { c = 256 };"));
    EXPECT_THAT(text, HasSubstr("struct C {\n    enum Value : std::uint32_t { d = 65536 };"));
    EXPECT_THAT(text, HasSubstr("struct MavComponent {\n    enum Value : std::uint8_t { d = 1 };"));
}

TEST_F(Generator, StopsWithTheLineAtWhatItDoesNotKnow) {
    const auto with = [](const std::string& fields) {
        return "<message id=\"7\" name=\"M\">\n" + fields + "</message>\n";
    };
    const auto refusal = [&](const std::string& message, const std::string& enumeration = "") {
        const Answer answer = make(message, enumeration);
        EXPECT_EQ(answer.exit_code, 1) << answer.text;
        EXPECT_FALSE(std::filesystem::exists(folder_ + "/m.hpp"));
        return answer.text;
    };
    EXPECT_EQ(refusal(with("<field type=\"uint9_t\" name=\"a\"/>")),
              "m.xml:4: field a: type uint9_t is not known\n");
    EXPECT_EQ(refusal(with("<field type=\"char[0]\" name=\"a\"/>")),
              "m.xml:4: field a: type char[0] is not known\n");
    EXPECT_EQ(refusal(with(std::string(kField) + kField)),
              "m.xml:5: field a: name a stands twice\n");
    EXPECT_EQ(refusal(with("<field type=\"char\"/>")),
              "m.xml:4: field : attribute name is missing\n");
    EXPECT_EQ(refusal(with("<field type=\"char\" name=\"a\" unit=\"m\"/>")),
              "m.xml:4: field a: attribute unit is not known\n");
    EXPECT_EQ(refusal(with("<wip name=\"a\"/>")), "m.xml:4: wip a: is not known here\n");
    EXPECT_EQ(refusal(with("")), "m.xml:3: message M: 0 bytes, must be 1 to 255\n");
    EXPECT_EQ(refusal(with("<field type=\"float[64]\" name=\"a\"/>")),
              "m.xml:3: message M: 256 bytes, must be 1 to 255\n");
    EXPECT_EQ(refusal(with(kField) + with(kField)), "m.xml:6: message M: name M stands twice\n");
    EXPECT_EQ(refusal(with(kField) + "<message id=\"7\" name=\"N\"></message>"),
              "m.xml:6: message N: id 7 stands twice\n");
    EXPECT_EQ(refusal("<message id=\"16777216\" name=\"M\"></message>"),
              "m.xml:3: message M: id = '16777216', must be a whole number up to 16777215\n");
    EXPECT_EQ(refusal(with(kField), "<enum name=\"E\"><entry value=\"1\" name=\"F_A\"/></enum>"),
              "m.xml:2: entry F_A: must begin with E_\n");
    EXPECT_EQ(
        refusal(with(kField), "<enum name=\"E\"><entry value=\"4294967296\" name=\"E_A\"/></enum>"),
        "m.xml:2: entry E_A: value = '4294967296', must be a whole number up to 4294967295\n");
    EXPECT_THAT(refusal(with("<field")), HasSubstr("m.xml:4: "));
}

}  // namespace
}  // namespace limpet::mavlink
