// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/tfmini.hpp"

#include <cstdint>
#include <span>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    limpet::devices::TfminiParser parser;
    for (const std::byte byte : std::as_bytes(std::span(data, size))) {
        (void)parser.parse(byte);
    }
    return 0;
}
