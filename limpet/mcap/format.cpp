// SPDX-License-Identifier: Apache-2.0
#include "limpet/mcap/format.hpp"

#include <zlib.h>

namespace limpet::mcap {

std::uint32_t crc32(ByteView bytes, std::uint32_t crc) {
    return static_cast<std::uint32_t>(::crc32_z(crc, bytes.data(), bytes.size()));
}

}  // namespace limpet::mcap
