// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/flight.hpp"

namespace limpet::python {

/// One number of a flight against time.
struct Channel {
    const char* name;  ///< with its SI unit
    const char* what;
    double (*of)(const Flight& flight);
};
[[nodiscard]] const std::vector<Channel>& channel_table();

/// A column a channel, a row a sample.
struct ChannelLog {
    std::vector<std::vector<double>> columns =
        std::vector<std::vector<double>>(channel_table().size());

    void sample(const Flight& flight);
};

}  // namespace limpet::python
