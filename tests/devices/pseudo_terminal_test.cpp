// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/pseudo_terminal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "limpet/core/errors.hpp"
#include "limpet/devices/tfmini.hpp"

namespace limpet::devices {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

struct Folder {
    fs::path path =
        fs::temp_directory_path() / ("limpet_pty_" + std::to_string(::getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

std::vector<TfminiFrame> heard(wire::Transport& wire, std::size_t count) {
    TfminiParser parser;
    std::vector<TfminiFrame> frames;
    std::array<std::byte, 256> in;
    while (frames.size() < count) {
        const wire::Transfer transfer = wire.receive(in, 5s);
        if (transfer.status != wire::TransferStatus::done) {
            break;
        }
        for (const std::byte byte : std::span(in).first(transfer.bytes)) {
            if (const auto frame = parser.parse(byte)) {
                frames.push_back(*frame);
            }
        }
    }
    return frames;
}

TEST(PseudoTerminal, IsOpenedAsASerialPortAndCarriesBothWays) {
    const Folder folder;
    const auto device = open_pseudo_terminal(folder.path / "lidar");
    const auto port = open_transport(device->address(), wire::Role::connect);
    for (int i = 0; i < 3; ++i) {
        const auto frame = encode(TfminiFrame{.distance_cm = 200, .strength = 900});
        ASSERT_EQ(device->send(frame, 1s).status, wire::TransferStatus::done);
    }
    EXPECT_EQ(heard(*port, 3).size(), 3U);

    const auto back = encode(TfminiFrame{.distance_cm = 0x0A0D, .strength = 900});
    ASSERT_EQ(port->send(back, 1s).status, wire::TransferStatus::done);
    const auto frames = heard(*device, 1);
    ASSERT_EQ(frames.size(), 1U);  // line ends arrive as they were, nothing is echoed
    EXPECT_EQ(frames[0].distance_cm, 0x0A0D);
}

TEST(PseudoTerminal, WhatNobodyReadsIsDroppedAndNobodyWaits) {
    const Folder folder;
    const auto device = open_pseudo_terminal(folder.path / "lidar");
    const auto frame = encode(TfminiFrame{.distance_cm = 200, .strength = 900});
    wire::TransferStatus status = wire::TransferStatus::done;
    for (int i = 0; i < 20000 && status == wire::TransferStatus::done; ++i) {
        status = device->send(frame, 0ns).status;
    }
    EXPECT_EQ(status, wire::TransferStatus::timed_out);
}

TEST(PseudoTerminal, TheLinkGoesWithItAndReplacesOneThatWasLeftBehind) {
    const Folder folder;
    const fs::path link = folder.path / "lidar";
    fs::create_symlink("/nowhere", link);
    {
        const auto device = open_pseudo_terminal(link);
        EXPECT_EQ(fs::read_symlink(link).parent_path(), "/dev/pts");
    }
    EXPECT_FALSE(fs::is_symlink(link));
}

TEST(PseudoTerminal, AFileInTheWayIsLeftAlone) {
    const Folder folder;
    const fs::path link = folder.path / "notes";
    std::ofstream(link) << "mine";
    EXPECT_THROW((void)open_pseudo_terminal(link), InputError);
    EXPECT_TRUE(fs::is_regular_file(link));
    EXPECT_THROW((void)open_pseudo_terminal(folder.path / "no" / "such" / "folder"), InputError);
}

}  // namespace
}  // namespace limpet::devices
