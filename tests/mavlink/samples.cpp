// SPDX-License-Identifier: Apache-2.0
#include "samples.hpp"

#include <cstring>

namespace limpet::mavlink {

void note_difference(std::vector<std::string>& names, std::string_view name, const void* a,
                     const void* b, std::size_t bytes) {
    if (std::memcmp(a, b, bytes) != 0) {
        names.emplace_back(name);
    }
}

std::vector<std::vector<std::uint8_t>> frames_in(Parser& parser, ByteView bytes) {
    std::vector<std::vector<std::uint8_t>> frames;
    while (const auto frame = parser.next(bytes)) {
        frames.emplace_back(frame->bytes.begin(), frame->bytes.end());
    }
    return frames;
}

}  // namespace limpet::mavlink
