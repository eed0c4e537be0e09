// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "limpet/flight.hpp"
#include "module.hpp"

namespace limpet::python {

/// One number of a flight against time.
struct Channel {
    const char* name;  ///< with its SI unit
    const char* what;
    double (*of)(const Flight& flight);
};
[[nodiscard]] const std::vector<Channel>& channel_table();
/// @throws py::key_error naming those that there are
[[nodiscard]] std::size_t channel_index(const std::string& name);

/// A column a channel, a row a sample.
struct ChannelLog {
    std::vector<std::vector<double>> columns =
        std::vector<std::vector<double>>(channel_table().size());

    void sample(const Flight& flight);
};

}  // namespace limpet::python
