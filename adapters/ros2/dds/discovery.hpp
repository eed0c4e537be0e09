// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "adapters/ros2/dds/codec.hpp"
#include "adapters/ros2/dds/entities.hpp"

// What a participant publishes of its nodes on the topic ros_discovery_info, laid out as
// rmw_dds_common's ParticipantEntitiesInfo: by it the ros2 command line knows nodes, and whose a
// topic is.
namespace limpet::ros2 {

inline constexpr const char* kDiscoveryTopic = "ros_discovery_info";
inline constexpr const char* kDiscoveryType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

/// @tparam N  16 bytes, 24 until Humble: a GUID, then zeros
template <std::size_t N>
struct DiscoveryInfo {
    using Gid = std::array<std::uint8_t, N>;
    struct NodeInfo {
        std::string space, name;
        std::vector<Gid> readers, writers;
        template <class Self, class Visit>
        static void visit(Self& self, Visit&& each) {
            each(self.space);
            each(self.name);
            each(self.readers);
            each(self.writers);
        }
    };
    Gid participant{};
    std::vector<NodeInfo> nodes;
    template <class Self, class Visit>
    static void visit(Self& self, Visit&& each) {
        each(self.participant);
        each(self.nodes);
    }
};

/// Of a participant with one node.
template <std::size_t N>
[[nodiscard]] Bytes discovery_bytes(const NodeSettings& node, const dds::Guid& participant,
                                    const std::set<dds::Guid>& readers,
                                    const std::set<dds::Guid>& writers) {
    const auto gid = [](const dds::Guid& guid) {
        typename DiscoveryInfo<N>::Gid made{};
        std::copy(guid.begin(), guid.end(), made.begin());
        return made;
    };
    DiscoveryInfo<N> info{.participant = gid(participant), .nodes = {}};
    auto& entry = info.nodes.emplace_back();
    entry.space = node.space;
    entry.name = node.name;
    std::transform(readers.begin(), readers.end(), std::back_inserter(entry.readers), gid);
    std::transform(writers.begin(), writers.end(), std::back_inserter(entry.writers), gid);
    return encode(info);
}

}  // namespace limpet::ros2
