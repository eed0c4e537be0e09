// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "as_file.hpp"
#include "limpet/lab/request.hpp"
#include "limpet/scenario/overrides.hpp"

// What a page sends, up to a tree with its changes; no flight begins.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return limpet::fuzz::read_or_refuse([&] {
        const auto request = limpet::lab::object_in({reinterpret_cast<const char*>(data), size});
        const limpet::lab::FlightRequest asked = limpet::lab::flight_request_in(request, "hover");
        auto tree = limpet::scenario::parse_yaml("vehicle: perching_uav\n", "x.yaml");
        for (const std::string& change : asked.changes) {
            set_override(tree, change);
        }
    });
}
