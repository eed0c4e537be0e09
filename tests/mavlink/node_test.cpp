// SPDX-License-Identifier: Apache-2.0
// An independent codec, npm's node-mavlink, reads our frames and writes its own for us to read.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "limpet/mavlink/signing.hpp"
#include "samples.hpp"
#include "vectors.hpp"

namespace limpet::mavlink {
namespace {

using testing::IsEmpty;

constexpr std::uint64_t kNow = 37'700'000'000'000;
/// check.js signs at 2027-01-01 UTC, 4383 days after MAVLink's epoch [10 us].
constexpr std::uint64_t kTheirTime = 4383ULL * 86'400 * 100'000;
constexpr int kNothingThere = 3;      // check.js: no node-mavlink
constexpr int kCommandMissing = 127;  // the shell: no node

template <class T>
std::string json_element(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        return fmt::format("{:.9g}", value);
    } else if constexpr (sizeof(T) == 8) {
        return fmt::format("\"{}\"", value);
    } else {
        return fmt::format("{}", static_cast<long long>(value));
    }
}

template <class Value>
std::string json_value(const Value& value) {
    std::string text;
    for_each_element(value, [&](const auto& element) {
        if constexpr (std::is_same_v<decltype(element), const char&>) {
            text += fmt::format("\\u{:04x}", static_cast<unsigned char>(element));
        } else {
            text += text.empty() ? "" : ",";
            text += json_element(element);
        }
    });
    if constexpr (std::is_arithmetic_v<Value>) {
        return text;
    } else if constexpr (std::is_same_v<typename Value::value_type, char>) {
        return '"' + text + '"';
    } else {
        return '[' + text + ']';
    }
}

/// A line of what check.js reads.
template <class Message>
std::string json_case(const Message& message, std::uint8_t sequence, Signing& signing) {
    Sender from{1, 191, sequence};
    FrameBuffer buffer = {};
    const std::string plain = to_hex(encode(message, from, buffer));
    from.sequence = sequence;
    const ByteView frame = encode(message, from, buffer);
    std::string fields;
    for_each_field(message, [&](std::string_view name, const auto& value) {
        fields += fmt::format("{}\"{}\":{}", fields.empty() ? "" : ",", name, json_value(value));
    });
    return fmt::format(R"({{"id":{},"sequence":{},"frame":"{}","signed":"{}","fields":{{{}}}}})",
                       Message::kId, sequence, plain, to_hex(signing.sign(buffer, frame, kNow)),
                       fields);
}

struct NodeAnswer {
    int exit_code = -1;
    std::string text;
};

NodeAnswer ask_node(const std::string& cases, const SigningKey& key) {
    std::string pattern = (std::filesystem::temp_directory_path() / "limpet_node_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
        return {};
    }
    const std::filesystem::path folder = pattern;
    std::ofstream(folder / "cases.jsonl") << cases;
    const std::string source = LIMPET_SOURCE_DIR;
    const std::string command = fmt::format(
        "NODE_PATH='{0}/build/node/node_modules' node '{0}/tests/mavlink/node/check.js' "
        "'{1}/cases.jsonl' {2} 2>/dev/null",
        source, folder.string(), to_hex(key));
    NodeAnswer answer;
    if (FILE* pipe = popen(command.c_str(), "r")) {
        char part[4096];
        for (std::size_t n = 0; (n = fread(part, 1, sizeof part, pipe)) > 0;) {
            answer.text.append(part, n);
        }
        const int status = pclose(pipe);
        answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::filesystem::remove_all(folder);
    return answer;
}

/// One of theirs, read here.
class Theirs {
public:
    explicit Theirs(const std::string& hex) : bytes_(from_hex(hex)) {
        ByteView left = bytes_;
        frame_ = parser_.next(left);
    }
    [[nodiscard]] const std::optional<Frame>& frame() const { return frame_; }
    [[nodiscard]] bool is_of_zeros() const { return bytes_[1] == 0; }

    template <class Message>
    void expect(const Message& message) const {
        ASSERT_TRUE(frame_.has_value()) << Message::kName;
        const auto decoded = decode<Message>(*frame_);
        ASSERT_TRUE(decoded.has_value()) << Message::kName;
        EXPECT_THAT(differences(*decoded, message), IsEmpty()) << Message::kName;
        Sender from{frame_->system, frame_->component, frame_->sequence};
        FrameBuffer buffer = {};
        const ByteView ours = encode(message, from, buffer);
        // It sends no byte of an empty payload, MAVLink asks for one.
        if (!frame_->is_signed && !is_of_zeros()) {
            EXPECT_EQ(to_hex(ours), to_hex(bytes_)) << Message::kName;
        }
    }

private:
    std::vector<std::uint8_t> bytes_;
    Parser parser_;
    std::optional<Frame> frame_;
};

class NodeMavlink : public testing::TestWithParam<Filling> {};

TEST_P(NodeMavlink, ReadsOurFramesAndWeReadIts) {
    SigningKey key = {};
    key.fill(0x5A);
    Signing signing(key, 5);
    std::string cases;
    std::uint8_t sequence = 200;
    for_each_message([&](const auto& sample) {
        using Message = std::remove_cvref_t<decltype(sample)>;
        cases += json_case(filled<Message>(GetParam()), sequence++, signing) + '\n';
    });
    const NodeAnswer answer = ask_node(cases, key);
    if (answer.exit_code == kNothingThere || answer.exit_code == kCommandMissing) {
        GTEST_SKIP() << "node or node-mavlink is not there; ./test fetches it where npm is";
    }
    ASSERT_EQ(answer.exit_code, 0) << answer.text;

    std::vector<std::string> frames;
    std::vector<std::string> signed_frames;
    std::vector<std::string> others;
    std::istringstream lines(answer.text);
    for (std::string kind, rest; lines >> kind && std::getline(lines >> std::ws, rest);) {
        if (kind == "frame") {
            frames.push_back(rest);
        } else if (kind == "signed") {
            signed_frames.push_back(rest);
        } else {
            others.push_back(kind + ' ' + rest);
        }
    }
    // The one message of PX4 that it does not know.
    EXPECT_THAT(others, testing::ElementsAre("unknown 410"));
    ASSERT_EQ(frames.size(), std::tuple_size_v<AllMessages> - 1);
    ASSERT_EQ(signed_frames.size(), frames.size());

    std::size_t i = 0;
    for_each_message([&](const auto& sample) {
        using Message = std::remove_cvref_t<decltype(sample)>;
        if (Message::kId == EventMessage::kId) {
            return;
        }
        const auto message = filled<Message>(GetParam());
        Theirs(frames[i]).expect(message);
        const Theirs with_signature(signed_frames[i++]);
        with_signature.expect(message);
        if (with_signature.frame()) {
            // All have one time: each meets an end that knows nobody yet.
            Signing fresh(key, 0);
            EXPECT_EQ(fresh.check(*with_signature.frame(), kTheirTime), Verdict::accepted)
                << Message::kName;
            EXPECT_EQ(fresh.timestamp(), kTheirTime);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Values, NodeMavlink,
                         testing::Values(Filling::lowest, Filling::highest, Filling::counted));

}  // namespace
}  // namespace limpet::mavlink
