// SPDX-License-Identifier: Apache-2.0
#include "limpet/ulog/ulog.hpp"

#include "as_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return limpet::fuzz::read_or_refuse([&] {
        const limpet::fuzz::AsFile file(data, size);
        (void)limpet::ulog::read_ulog(file.path());
    });
}
