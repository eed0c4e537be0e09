// SPDX-License-Identifier: Apache-2.0
#include "as_file.hpp"
#include "limpet/meshes/readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return limpet::fuzz::read_or_refuse([&] {
        const limpet::fuzz::AsFile file(data, size);
        (void)limpet::meshes::read_stl(file.path());
    });
}
