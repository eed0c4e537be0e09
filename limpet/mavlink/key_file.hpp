// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

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

/// Where a link's signing timestamps lie: KEY_FILE's name, and who sends on which link.
/// @param folder  empty: next to the key
[[nodiscard]] std::filesystem::path stamp_path(const std::filesystem::path& key_file,
                                               const std::filesystem::path& folder,
                                               const Sender& self, std::uint8_t link_id);

/// Signs as above, and keeps the timestamps in stamp_path(): they outlive a restart and a clock
/// that was set back, which is then taken to stand where they ended.
/// @param now_us  the machine's clock [us since 1970 UTC]
/// @return that the clock is behind them, for people; empty: it is not
/// @throws InputError as read_signing_key and StampFile
[[nodiscard]] std::string sign_and_keep(Link& link, const std::filesystem::path& key_file,
                                        const std::filesystem::path& folder, std::uint8_t link_id,
                                        const std::function<std::uint64_t()>& now_us = {});

}  // namespace limpet::mavlink
