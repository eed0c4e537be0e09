// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/stamp_file.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "limpet/core/errors.hpp"
#include "limpet/mavlink/key_file.hpp"
#include "scripted_wire.hpp"

namespace limpet::mavlink {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::uint64_t kKept = 37'700'000'000'001;

struct Stamps : testing::Test {
    Stamps() {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    ~Stamps() override { fs::remove_all(folder); }

    [[nodiscard]] std::string text() const {
        std::ostringstream out;
        out << std::ifstream(path).rdbuf();
        return out.str();
    }
    [[nodiscard]] std::string refusal(const std::string& broken) const {
        std::ofstream(path, std::ios::binary) << broken;
        try {
            (void)StampFile(path);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
    fs::path folder =
        fs::path(testing::TempDir()) /
        (std::string("stamps_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::path path = folder / "key.stamps";
};

SigningStamps two_senders() {
    SigningStamps stamps;
    stamps.timestamp = kKept + 9;
    stamps.heard[0] = {.system = 1, .component = 1, .link_id = 0, .timestamp = kKept};
    stamps.heard[1] = {.system = 255, .component = 190, .link_id = 7, .timestamp = kKept + 9};
    stamps.senders = 2;
    return stamps;
}

TEST_F(Stamps, ThatAreNotThereAreZeros) {
    const StampFile file(path);
    EXPECT_EQ(file.before().timestamp, 0U);
    EXPECT_EQ(file.before().senders, 0U);
    EXPECT_EQ(text(), "limpet signing stamps 1\ntime 0\n") << "to know that it can be written";
    EXPECT_FALSE(read_stamps(path).are_last) << "it runs";
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Stamps, AreThereAgainAfterAnEnd) {
    StampFile(path).close_with(two_senders());
    EXPECT_EQ(text(),
              "limpet signing stamps 1\ntime 37700000000010\n1 1 0 37700000000001\n"
              "255 190 7 37700000000010\nended\n");
    const SigningStamps again = read_stamps(path);
    EXPECT_TRUE(again.are_last);
    EXPECT_EQ(again.timestamp, kKept + 9);
    ASSERT_EQ(again.senders, 2U);
    EXPECT_EQ(again.heard[1].system, 255);
    EXPECT_EQ(again.heard[1].component, 190);
    EXPECT_EQ(again.heard[1].link_id, 7);
    EXPECT_EQ(again.heard[1].timestamp, kKept + 9);
}

TEST_F(Stamps, AreWrittenWhileItRuns) {
    StampFile file(path, 5ms);
    const auto end = std::chrono::steady_clock::now() + 10s;
    while (read_stamps(path).timestamp == 0 && std::chrono::steady_clock::now() < end) {
        file.offer(two_senders());
        std::this_thread::sleep_for(1ms);
    }
    EXPECT_EQ(read_stamps(path).timestamp, kKept + 9);
    EXPECT_EQ(file.trouble(), "");
    for (const auto& each : fs::directory_iterator(folder)) {
        EXPECT_THAT(each.path().string(), HasSubstr("key.stamps"));
    }
}

TEST_F(Stamps, ThatCannotBeWrittenAnyMoreAreToldAndStopNobody) {
    StampFile file(path, 5ms);
    fs::remove_all(folder);
    const auto end = std::chrono::steady_clock::now() + 10s;
    while (file.trouble().empty() && std::chrono::steady_clock::now() < end) {
        file.offer(two_senders());
        std::this_thread::sleep_for(1ms);
    }
    EXPECT_THAT(file.trouble(), HasSubstr("key.stamps: No such file or directory"));
}

TEST_F(Stamps, ThatAreBrokenAreRefusedByLine) {
    const std::string head = "limpet signing stamps 1\n";
    const auto at = [&](const std::string& broken) {
        const std::string line = refusal(broken);
        EXPECT_THAT(line, HasSubstr("is broken; put a whole one back, or delete it")) << broken;
        EXPECT_EQ(text(), broken) << "left as it was";
        return line.substr(path.string().size(), 3);
    };
    EXPECT_EQ(at(""), ":1:");
    EXPECT_EQ(at("limpet signing stamps 2\n"), ":1:");
    EXPECT_EQ(at(head), ":2:");
    EXPECT_EQ(at(head + "ended\n"), ":2:");
    EXPECT_EQ(at(head + "time 5\nended\n1 1 0 5\n"), ":3:");
    EXPECT_EQ(at(head + "time 5"), ":2:") << "cut";
    EXPECT_EQ(at(head + "time -5\n"), ":2:");
    EXPECT_EQ(at(head + "time 281474976710656\n"), ":2:") << "of 48 bits";
    EXPECT_EQ(at(head + "time 5\n1 1 0\n"), ":3:");
    EXPECT_EQ(at(head + "time 5\n256 1 0 5\n"), ":3:");
    EXPECT_EQ(at(head + "time 5\n1 1 0 5 6\n"), ":3:");
    std::string many = head + "time 5\n";
    for (int k = 0; k < 17; ++k) {
        many += "1 1 " + std::to_string(k) + " 5\n";
    }
    EXPECT_EQ(at(many), ":19");
    EXPECT_THAT(refusal(std::string(1'000'001, '5')), HasSubstr("1 MB"));
}

TEST_F(Stamps, OfAFolderThatIsNotThereAreRefused) {
    path = folder / "nowhere" / "key.stamps";
    try {
        (void)StampFile(path);
        FAIL() << "written";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("cannot be written: No such file or directory"));
    }
}

/// A companion's link and its autopilot's, of which the first one ends and comes back.
struct Restart : Stamps {
    Restart() {
        std::ofstream(key) << std::string(64, 'a');
        fs::permissions(key, fs::perms::owner_read);
        autopilot.link.sign({.key = read_signing_key(key), .link_id = 0, .unix_us = [] {
                                 return unix_time_us(kKept);
                             }});
    }
    /// A session: what is brought, heard and said, and the notice of its beginning.
    struct Session {
        std::size_t heard = 0;
        std::string notice;
        std::string refused;
        std::vector<std::byte> said;
    };
    Session session(std::uint64_t now, const std::vector<std::vector<std::byte>>& frames) const {
        ScriptedLink wire;
        Session session;
        session.notice = sign_and_keep(wire.link, key, {}, 0, [now] { return unix_time_us(now); });
        for (const auto& frame : frames) {
            wire.ends->to_receive.push_back(frame);
            session.heard += wire.link.receive() ? 1 : 0;
        }
        EXPECT_EQ(wire.link.send(Heartbeat{}), wire::TransferStatus::done);
        session.said = wire.ends->sent.back();
        session.refused = text_of(wire.link.count().refusals);
        return session;
    }
    [[nodiscard]] std::vector<std::byte> beat() {
        EXPECT_EQ(autopilot.link.send(Heartbeat{}), wire::TransferStatus::done);
        return autopilot.ends->sent.back();
    }
    fs::path key = folder / "key.txt";
    ScriptedLink autopilot;
};

std::uint64_t stamp_in(const std::vector<std::byte>& frame) {
    return boost::endian::load_little_u48(
        reinterpret_cast<const std::uint8_t*>(&frame[frame.size() - kSignature_bytes + 1]));
}

TEST_F(Restart, WhatWasHeardBeforeIsPlayedAgainInVain) {
    const std::vector<std::vector<std::byte>> recorded = {beat(), beat(), beat()};
    EXPECT_EQ(session(kKept, recorded).heard, 3U);
    const Session after = session(kKept, recorded);
    EXPECT_EQ(after.heard, 0U);
    EXPECT_EQ(after.refused, "3 frames refused: 3 played again");
    EXPECT_EQ(session(kKept, {beat()}).heard, 1U) << "who goes on is heard";
}

TEST_F(Restart, AClockThatWasSetBackGoesOnWhereItWas) {
    const Session before = session(kKept, {beat()});
    EXPECT_EQ(before.notice, "");
    const Session after = session(kKept - 3600 * kSigningSecond, {beat()});
    EXPECT_THAT(after.notice, HasSubstr("clock is 3600 s behind"));
    EXPECT_THAT(after.notice, HasSubstr("key.txt.stamps-"));
    EXPECT_GT(stamp_in(after.said), stamp_in(before.said));
    EXPECT_LT(stamp_in(after.said), stamp_in(before.said) + 5 * kSigningSecond) << "there";
    EXPECT_EQ(after.heard, 1U);
    // Its peer, which knows it, takes what it says now.
    autopilot.ends->to_receive.push_back(before.said);
    EXPECT_TRUE(autopilot.link.receive());
    autopilot.ends->to_receive.push_back(after.said);
    EXPECT_TRUE(autopilot.link.receive());
}

TEST_F(Restart, AfterACrashTimeGoesOnBehindAllThatMayHaveBeenUsed) {
    std::ofstream(stamp_path(key, {}, ScriptedLink().link.self(), 0))
        << "limpet signing stamps 1\ntime " << kKept << "\n";  // ten seconds ago at most
    const Session after = session(kKept - kSigningSecond, {});
    EXPECT_GT(stamp_in(after.said), kKept + 10 * kSigningSecond);
    EXPECT_LT(stamp_in(after.said), kKept + Signing::kLargestAge / 2);
    // Ended in good order, no further: else a few restarts would leave all others behind.
    const Session again = session(kKept - kSigningSecond, {});
    EXPECT_GT(stamp_in(again.said), stamp_in(after.said));
    EXPECT_LT(stamp_in(again.said), stamp_in(after.said) + 5 * kSigningSecond);
}

TEST_F(Restart, AFolderOfItsOwnTakesTheStamps) {
    ScriptedLink wire;
    fs::create_directories(folder / "state");
    EXPECT_EQ(sign_and_keep(wire.link, key, folder / "state", 5), "");
    EXPECT_TRUE(fs::exists(stamp_path(key, folder / "state", wire.link.self(), 5)));
    EXPECT_EQ(stamp_path(key, "/s", {.system = 1, .component = 191}, 5),
              "/s/key.txt.stamps-1-191-5");
}

}  // namespace
}  // namespace limpet::mavlink
