// SPDX-License-Identifier: Apache-2.0
#include "limpet/mcap/format.hpp"

#include <libdeflate.h>

namespace limpet::mcap {

std::uint32_t crc32(ByteView bytes, std::uint32_t crc) {
    return libdeflate_crc32(crc, bytes.data(), bytes.size());
}

}  // namespace limpet::mcap
