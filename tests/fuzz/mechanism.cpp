// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <span>

#include "limpet/devices/mechanism_line.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    limpet::devices::MechanismParser parser;
    for (const std::byte byte : std::as_bytes(std::span(data, size))) {
        (void)parser.parse(byte);
    }
    return 0;
}
