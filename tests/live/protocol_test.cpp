// SPDX-License-Identifier: Apache-2.0
#include "limpet/live/protocol.hpp"

#include <gmock/gmock.h>

using namespace limpet::live;

namespace {

std::string bytes_of(std::initializer_list<int> bytes) {
    std::string text;
    for (const int byte : bytes) {
        text += static_cast<char>(byte);
    }
    return text;
}

TEST(Protocol, BytesByHand) {
    const auto head = message_head(0x01020304, 0x0A0B0C0D0E0F1011);
    EXPECT_EQ(std::string(head.data(), head.size()),
              bytes_of({1, 4, 3, 2, 1, 0x11, 0x10, 0x0F, 0x0E, 0x0D, 0x0C, 0x0B, 0x0A}));
    const auto time = time_message(5);
    EXPECT_EQ(std::string(time.data(), time.size()), bytes_of({2, 5, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(service_response(1, 2, true, "ok"),
              bytes_of({3, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0}) + "cdr" +
                  bytes_of({0, 1, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0}) + "ok" + bytes_of({0}));
}

TEST(Protocol, AssetsByHand) {
    EXPECT_EQ(asset_response(258, "STL"), bytes_of({4, 2, 1, 0, 0, 0, 0, 0, 0, 0}) + "STL");
    EXPECT_EQ(asset_failure(1, "no"), bytes_of({4, 1, 0, 0, 0, 1, 2, 0, 0, 0}) + "no");
}

TEST(Protocol, ServiceCallsAreReadWithinTheirBounds) {
    const std::string good = bytes_of({2, 1, 0, 0, 0, 7, 0, 0, 0, 3, 0, 0, 0}) + "cdr" + "data";
    const auto call = read_service_call(good);
    ASSERT_TRUE(call);
    EXPECT_EQ(call->service, 1U);
    EXPECT_EQ(call->call, 7U);
    EXPECT_EQ(call->encoding, "cdr");
    for (std::size_t bytes = 0; bytes < 16; ++bytes) {
        EXPECT_FALSE(read_service_call(good.substr(0, bytes))) << bytes;
    }
    std::string endless = good;
    endless[9] = endless[10] = endless[11] = endless[12] = '\xFF';
    EXPECT_FALSE(read_service_call(endless));
    std::string published = good;
    published[0] = 1;
    EXPECT_FALSE(read_service_call(published));
}

}  // namespace
