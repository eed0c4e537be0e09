// SPDX-License-Identifier: Apache-2.0
#include "limpet/simulation/snapshot.hpp"

#include <cstring>

#include "limpet/core/errors.hpp"
#include "limpet/core/visit.hpp"

namespace limpet::simulation {
namespace {

/// Before the numbers: which walk they are of, and their digest.
struct Header {
    std::uint64_t layout = 0;
    std::uint64_t digest = 0;
};

/// The sizes of all leaves of a fresh state, in their order.
std::uint64_t layout() {
    Digest sizes;
    const Snapshot fresh;
    visit_leaves(fresh, [&sizes](const auto& leaf) { sizes(sizeof leaf); });
    return sizes.hash;
}

std::uint64_t digest_of(std::span<const std::byte> bytes) {
    Digest digest;
    for (const std::byte byte : bytes) {
        digest(byte);
    }
    return digest.hash;
}

}  // namespace

std::vector<std::byte> to_bytes(const Snapshot& snapshot) {
    std::vector<std::byte> bytes(sizeof(Header));
    visit_leaves(snapshot, [&bytes](const auto& leaf) {
        const auto part = std::as_bytes(std::span(&leaf, 1));
        bytes.insert(bytes.end(), part.begin(), part.end());
    });
    const Header header{.layout = layout(),
                        .digest = digest_of(std::span(bytes).subspan(sizeof(Header)))};
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

Snapshot snapshot_from(std::span<const std::byte> bytes) {
    Header header;
    if (bytes.size() < sizeof header) {
        throw InputError("a saved flight is cut short");
    }
    std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof header);
    bytes = bytes.subspan(sizeof header);
    if (header.layout != layout()) {
        throw InputError("a saved flight is of another Limpet: its state has other numbers");
    }
    if (header.digest != digest_of(bytes)) {
        throw InputError("a saved flight is damaged or cut short");
    }
    Snapshot snapshot;
    visit_leaves(snapshot, [&bytes](auto& leaf) {
        require(bytes.size() >= sizeof leaf, "a saved flight has all its numbers");
        std::memcpy(&leaf, bytes.data(), sizeof leaf);
        bytes = bytes.subspan(sizeof leaf);
    });
    return snapshot;
}

std::vector<double*> numbers_of(FlightState& state) {
    std::vector<double*> numbers;
    visit_leaves(state, [&numbers](auto& leaf) {
        if constexpr (std::is_same_v<decltype(leaf), double&>) {
            numbers.push_back(&leaf);
        }
    });
    return numbers;
}

}  // namespace limpet::simulation
