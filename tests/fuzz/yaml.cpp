// SPDX-License-Identifier: Apache-2.0
#include "as_file.hpp"
#include "limpet/scenario/yaml_tree.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return limpet::fuzz::read_or_refuse([&] {
        (void)limpet::scenario::parse_yaml({reinterpret_cast<const char*>(data), size}, "x.yaml");
    });
}
