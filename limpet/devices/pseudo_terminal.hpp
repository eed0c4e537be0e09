// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "limpet/wire/transport.hpp"

namespace limpet::devices {

/// A serial cable within this machine: other programs open `link` as they open a serial port, at
/// any baud (nobody keeps to it), and this end plays the device. What nobody reads is dropped when
/// the kernel's buffer is full, as on a real cable.
/// @param link  made as a symbolic link to the terminal, removed at the end; it must not exist, or
///              be such a link
/// @throws InputError when the link cannot be made or no terminal is to be had
[[nodiscard]] std::unique_ptr<wire::Transport> open_pseudo_terminal(
    const std::filesystem::path& link);

}  // namespace limpet::devices
