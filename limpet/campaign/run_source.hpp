// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <exception>
#include <optional>

#include "limpet/campaign/results.hpp"

namespace limpet::campaign {

/// Assigns runs to the threads that fly and takes their rows. All threads call it at once.
class RunSource {
public:
    virtual ~RunSource() = default;
    /// The next run to fly; none: there are no more, or it is time to stop.
    [[nodiscard]] virtual std::optional<std::uint32_t> next() = 0;
    virtual void land(const RunRow& row) = 0;
    /// A thread ends because this was thrown.
    virtual void fail(std::exception_ptr why) noexcept = 0;
};

}  // namespace limpet::campaign
