// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <charconv>

#include "limpet/campaign/results.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::campaign {
namespace {

constexpr std::uint32_t kMostParts = 1'000'000;

std::uint32_t runs_before(std::uint64_t parts_before, std::uint32_t parts, std::uint32_t runs) {
    return static_cast<std::uint32_t>(parts_before * runs / parts);
}

}  // namespace

std::uint32_t Shard::begin(std::uint32_t runs) const {
    return runs_before(part - 1, parts, runs);
}

std::uint32_t Shard::end(std::uint32_t runs) const {
    return runs_before(part, parts, runs);
}

Shard parse_shard(const std::string& text) {
    Shard shard;
    const char* const last = text.data() + text.size();
    const auto part = std::from_chars(text.data(), last, shard.part);
    if (part.ec == std::errc() && part.ptr != last && *part.ptr == '/') {
        const auto parts = std::from_chars(part.ptr + 1, last, shard.parts);
        if (parts.ec == std::errc() && parts.ptr == last && shard.part >= 1 &&
            shard.part <= shard.parts && shard.parts <= kMostParts) {
            return shard;
        }
    }
    throw InputError(fmt::format(
        "--shard '{}': must be I/N, part I of N, as 2/8; I in 1..N, N up to {}", text, kMostParts));
}

std::string shard_text(const Shard& shard) {
    return fmt::format("{}/{}", shard.part, shard.parts);
}

}  // namespace limpet::campaign
