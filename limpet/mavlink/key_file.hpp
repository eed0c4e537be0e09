// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "limpet/mavlink/signing.hpp"

namespace limpet::mavlink {

/// A signing key from a file: 64 hex digits, blanks and line ends around them, or 32 bytes as they
/// are. QGroundControl makes its key of a pass phrase by SHA-256:
/// `printf %s PHRASE | sha256sum | cut -c1-64 > key`.
/// @throws InputError naming the file, never what is in it: cannot be read, not a file, others than
///         its owner may read or write it (its mode), neither of both forms, all zeros
[[nodiscard]] SigningKey read_signing_key(const std::filesystem::path& path);

}  // namespace limpet::mavlink
