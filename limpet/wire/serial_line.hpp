// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet::wire {

/// Sets a serial port to raw bytes, 8N1, no flow control, modem lines ignored, and any baud.
/// @param descriptor  an open serial port
/// @param baud        [1/s]
/// @return 0, or errno; EINVAL also when the driver took another baud, 3 % off or more
[[nodiscard]] int set_line(int descriptor, unsigned baud);

/// Drops what has arrived and what has not gone out.
void flush_line(int descriptor);

}  // namespace limpet::wire
