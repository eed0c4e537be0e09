// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "wires.hpp"

using namespace limpet;
using namespace limpet::wire;
using namespace limpet::wire::wires;
namespace fs = std::filesystem;

namespace {

struct PseudoTerminal : testing::Test {
    fs::path folder =
        fs::temp_directory_path() / ("limpet_pty_" + std::to_string(::getpid()) + "_" +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
    PseudoTerminal() { fs::create_directories(folder); }
    ~PseudoTerminal() override { fs::remove_all(folder); }
};

}  // namespace

TEST_F(PseudoTerminal, IsOpenedAsASerialPortAndCarriesBothWays) {
    const auto device = open_pseudo_terminal(folder / "lidar");
    const auto port = open_transport(device->address(), Role::connect);
    EXPECT_EQ(say(*device, "YY frame"), TransferStatus::done);
    EXPECT_EQ(heard(*port), "YY frame");
    EXPECT_EQ(say(*port, "Y\r\n"), TransferStatus::done);
    EXPECT_EQ(heard(*device), "Y\r\n");  // line ends arrive as they were
    EXPECT_EQ(heard(*device, 10ms), "<timed out>") << "nothing is echoed";
    EXPECT_EQ(device->describe(), "pty:" + (folder / "lidar").string());
}

TEST_F(PseudoTerminal, WhatIsSaidBeforeAnybodyHasOpenedItIsNotEchoed) {
    const auto device = open_pseudo_terminal(folder / "lidar");
    EXPECT_EQ(say(*device, "early\n"), TransferStatus::done);
    EXPECT_EQ(heard(*device, 10ms), "<timed out>");
}

TEST_F(PseudoTerminal, WhatNobodyReadsIsDroppedAndNobodyWaits) {
    const auto device = open_pseudo_terminal(folder / "lidar");
    TransferStatus status = TransferStatus::done;
    for (int i = 0; i < 20000 && status == TransferStatus::done; ++i) {
        status = device->send(many_bytes(9), 0ns).status;
    }
    EXPECT_EQ(status, TransferStatus::timed_out);
}

TEST_F(PseudoTerminal, TheLinkGoesWithItAndReplacesOneThatWasLeftBehind) {
    const fs::path link = folder / "lidar";
    fs::create_symlink("/nowhere", link);
    {
        const auto device = open_pseudo_terminal(link);
        EXPECT_EQ(fs::read_symlink(link).parent_path(), "/dev/pts");
    }
    EXPECT_FALSE(fs::is_symlink(link));
}

TEST_F(PseudoTerminal, AFileInTheWayIsLeftAlone) {
    const fs::path link = folder / "notes";
    std::ofstream(link) << "mine";
    EXPECT_THROW((void)open_pseudo_terminal(link), InputError);
    EXPECT_TRUE(fs::is_regular_file(link));
    EXPECT_THROW((void)open_pseudo_terminal(folder / "no" / "such" / "folder"), InputError);
}
