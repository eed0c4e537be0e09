// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet.hpp"

#include <cstdlib>

using limpet::devices::NatNetRefusal;

namespace {

void must(bool holds) {
    if (!holds) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto packet = std::as_bytes(std::span(data, size));
    for (const limpet::devices::NatNetVersion version :
         {limpet::devices::NatNetVersion{3, 0}, limpet::devices::NatNetVersion{4, 1},
          limpet::devices::NatNetVersion{5, 0}}) {
        limpet::devices::NatNetSeen seen;
        const auto frame = limpet::devices::decode_frame(packet, version, 1, &seen);
        const bool tracked = frame && frame->body && frame->body->tracking_valid;
        must(tracked == (seen.refusal == NatNetRefusal::none));
        must(!frame || !frame->body || frame->body->pose.p_MP_m.allFinite());
        must(!tracked || frame->body->id == 1);
        must(!frame || understood(version));
    }
    (void)limpet::devices::decode_server(packet);
    return 0;
}
