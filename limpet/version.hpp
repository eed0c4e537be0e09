// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limpet/core/version.hpp"

/// Of these headers: kVersion. Before 1.0 a minor version may change what an outsider implements or
/// calls, and CHANGELOG.md says how; a patch never does.
namespace limpet {

/// Of the library that is linked, to be held against kVersion.
[[nodiscard]] std::string_view library_version();

}  // namespace limpet
