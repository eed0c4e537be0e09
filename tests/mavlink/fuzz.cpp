// SPDX-License-Identifier: Apache-2.0
// Any bytes through the parser, in pieces, then through every decoder and the check of signatures.
// fuzz_test.cpp drives it with mutated frames under any compiler; .ci/run with libFuzzer, from
// the seeds in corpus/, whose first byte says in what pieces the rest arrives.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "limpet/mavlink/codec.hpp"
#include "limpet/mavlink/signing.hpp"

namespace {

using limpet::mavlink::ByteView;

void must_hold(bool holds) {
    if (!holds) {
        std::abort();
    }
}

/// What arrived and is encoded anew has the payload that arrived, as far as its fields reach.
template <class Message>
void decode_one(const limpet::mavlink::Frame& frame) {
    const auto message = limpet::mavlink::decode<Message>(frame);
    must_hold(message.has_value() == (frame.id == Message::kId));
    if (!message) {
        return;
    }
    limpet::mavlink::Sender from{frame.system, frame.component, frame.sequence};
    limpet::mavlink::FrameBuffer buffer = {};
    const ByteView bytes = limpet::mavlink::encode(*message, from, buffer);
    const ByteView payload = bytes.subspan(limpet::mavlink::kHeader_bytes, bytes[1]);
    for (std::size_t i = 0; i < payload.size(); ++i) {
        must_hold(payload[i] == (i < frame.payload.size() ? frame.payload[i] : 0));
    }
}

template <class... Messages>
void decode_all(const limpet::mavlink::Frame& frame, const std::tuple<Messages...>*) {
    (decode_one<Messages>(frame), ...);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static limpet::mavlink::Signing signing({}, 0);
    limpet::mavlink::Parser parser;
    ByteView all(data, size);
    const std::size_t piece = size > 0 ? 1 + data[0] : 1;  // the input says how it arrives
    std::uint64_t handed_out = 0;
    std::uint64_t bytes_of_frames = 0;
    while (!all.empty()) {
        ByteView bytes = all.first(piece < all.size() ? piece : all.size());
        all = all.subspan(bytes.size());
        while (const auto frame = parser.next(bytes)) {
            ++handed_out;
            bytes_of_frames += frame->bytes.size();
            decode_all(*frame, static_cast<const limpet::mavlink::AllMessages*>(nullptr));
            (void)signing.check(*frame, 0);
        }
        must_hold(bytes.empty());
    }
    const auto& statistics = parser.statistics();
    must_hold(statistics.frames == handed_out);
    must_hold(statistics.discarded_bytes + bytes_of_frames <= size);
    return 0;
}
