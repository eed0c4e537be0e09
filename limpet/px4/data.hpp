// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// The JSON files of this folder, as they were when it was built; each says what it is.
namespace limpet::px4 {

extern const std::string_view kParametersJson;
extern const std::string_view kSettingsJson;

}  // namespace limpet::px4
