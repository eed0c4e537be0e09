// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace limpet::campaign {

/// A part of a campaign's runs, one after the other: a part spans the grids as evenly as the whole,
/// since neighbouring runs stand on neighbouring points.
struct Shard {
    std::uint32_t part = 1;  ///< 1..parts
    std::uint32_t parts = 1;

    /// The first run of it, and the first after it.
    [[nodiscard]] std::uint32_t begin(std::uint32_t runs) const;
    [[nodiscard]] std::uint32_t end(std::uint32_t runs) const;
    [[nodiscard]] bool whole() const { return parts == 1; }
    friend bool operator==(const Shard&, const Shard&) = default;
};

/// @param text  "2/8"
/// @throws InputError saying what is allowed
[[nodiscard]] Shard parse_shard(const std::string& text);
/// @return "2/8"
[[nodiscard]] std::string shard_text(const Shard& shard);

}  // namespace limpet::campaign
