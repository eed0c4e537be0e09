// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/wire/transport.hpp"

namespace limpet::wire {

/// A serial port: raw, 8N1, no flow control, any baud that the driver takes, for us alone
/// (TIOCEXCL, and a lock that also keeps out root). What had arrived before is dropped. An
/// unplugged port is lost for good: open it again.
/// @throws InputError when it is missing, no serial port, not allowed, in use, or refuses the baud
[[nodiscard]] std::unique_ptr<Transport> open_serial(const TransportAddress& address);

}  // namespace limpet::wire
