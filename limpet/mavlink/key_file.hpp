// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/mavlink/link.hpp"

namespace limpet::mavlink {

/// A signing key from a file: 64 hex digits, blanks and line ends around them, or 32 bytes as they
/// are. QGroundControl makes its key of a pass phrase by SHA-256:
/// `printf %s PHRASE | sha256sum | cut -c1-64 > key`.
/// @throws InputError naming the file, never what is in it: cannot be read, not a file, others than
///         its owner may read or write it (its mode), neither of both forms, all zeros
[[nodiscard]] SigningKey read_signing_key(const std::filesystem::path& path);

/// Signs a link with the key in a file, by the machine's clock; an empty path leaves it unsigned.
/// @throws InputError as read_signing_key
void sign(Link& link, const std::filesystem::path& key_file, std::uint8_t link_id = 0);

}  // namespace limpet::mavlink
