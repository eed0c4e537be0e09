// SPDX-License-Identifier: Apache-2.0
#include "as_file.hpp"
#include "limpet/draw/picture_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return limpet::fuzz::read_or_refuse([&] {
        const std::string picture =
            limpet::draw::picture_model(std::string(reinterpret_cast<const char*>(data), size));
        // What passed once is such a model, and names no file.
        if (limpet::draw::picture_model(picture) != picture) {
            std::abort();
        }
    });
}
