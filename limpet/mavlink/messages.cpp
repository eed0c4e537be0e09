// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/messages.hpp"

#include <algorithm>
#include <array>

namespace limpet::mavlink {
namespace {

template <class Message>
constexpr MessageInfo info_of() {
    constexpr auto& kPlace = kLayout<Message>;
    static_assert(kPlace.payload_bytes <= 255, "a payload's length is one byte");
    static_assert(Message::kId < (1U << 24U), "an id is three bytes");
    return {Message::kId, Message::kName, kPlace.crc_extra, kPlace.payload_bytes,
            kPlace.bytes_without_extensions};
}

template <class... Messages>
constexpr std::array<MessageInfo, sizeof...(Messages)> infos(const std::tuple<Messages...>*) {
    return {info_of<Messages>()...};
}

constexpr auto kInfos = infos(static_cast<const AllMessages*>(nullptr));

constexpr bool ids_rise() {
    for (std::size_t i = 1; i < kInfos.size(); ++i) {
        if (kInfos[i].id <= kInfos[i - 1].id) {
            return false;
        }
    }
    return true;
}
static_assert(ids_rise(), "find_message searches by halves");

}  // namespace

const MessageInfo* find_message(std::uint32_t id) {
    const auto* at =
        std::lower_bound(kInfos.begin(), kInfos.end(), id,
                         [](const MessageInfo& info, std::uint32_t key) { return info.id < key; });
    return at != kInfos.end() && at->id == id ? at : nullptr;
}

}  // namespace limpet::mavlink
