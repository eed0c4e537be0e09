// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto packet = std::as_bytes(std::span(data, size));
    for (const limpet::devices::NatNetVersion version :
         {limpet::devices::NatNetVersion{3, 0}, limpet::devices::NatNetVersion{4, 1}}) {
        const auto frame = limpet::devices::decode_frame(packet, version, 1);
        if (frame && frame->body && !frame->body->pose.p_MP_m.allFinite()) {
            std::abort();
        }
    }
    (void)limpet::devices::decode_server(packet);
    return 0;
}
