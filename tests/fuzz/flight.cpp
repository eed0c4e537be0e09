// SPDX-License-Identifier: Apache-2.0
// What calibrate and identify take: MCAP, packed or not, ULog, CSV.
#include "as_file.hpp"
#include "limpet/identification/flight_data.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return limpet::fuzz::read_or_refuse([&] {
        const limpet::fuzz::AsFile file(data, size);
        (void)limpet::identification::read_flight(file.path());
    });
}
