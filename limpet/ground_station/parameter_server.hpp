// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "limpet/mavlink/link.hpp"

namespace limpet::ground_station {

/// One parameter that a ground station may read and set.
struct ServedParameter {
    std::string name;  ///< 1 to 16 characters, once in the list
    double value = 0.0;
    double minimum = 0.0;  ///< allowed, inclusive
    double maximum = 0.0;  ///< allowed, inclusive
    bool whole = false;    ///< a count: no fractions
    bool int32 = false;    ///< INT32 on the wire, as PX4 has counts; else REAL32
};

/// The vehicle's side of MAVLink's parameter protocol, over any list. A value that cannot be taken
/// is answered with the one that stays, as the protocol has it, and refused in words.
/// Source: MAVLink parameter protocol guide
class ParameterServer {
public:
    using Set = std::function<void(std::string_view name, double value)>;
    using Refused = std::function<void(std::string_view why)>;

    /// Values of one PARAM_REQUEST_LIST that go in one update: a datagram each, and a ground
    /// station's buffers are small.
    static constexpr std::size_t kPerUpdate = 20;

    /// @param set      called with values within their range that differ from the present one
    /// @param refused  called with one line; the text lives during the call
    /// @throws InternalError for names that do not fit the wire or stand twice
    ParameterServer(std::vector<ServedParameter> parameters, Set set, Refused refused);

    /// @return whether the frame was one of the protocol's; answers but a list's are sent at once
    bool handle(const mavlink::Frame& frame, mavlink::Link& link);
    /// Goes on with a list that was requested.
    void update(mavlink::Link& link);

    [[nodiscard]] const std::vector<ServedParameter>& parameters() const { return parameters_; }

private:
    [[nodiscard]] std::size_t find(std::string_view name) const;
    void answer(std::size_t index, mavlink::Link& link) const;
    void set(const mavlink::ParamSet& message, mavlink::Link& link);

    std::vector<ServedParameter> parameters_;
    Set set_;
    Refused refused_;
    std::size_t next_;  ///< of the list that is being sent; its end: none
};

}  // namespace limpet::ground_station
