// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace limpet::draw {

/// What a picture needs of the MJCF that a recording carries, written anew: the elements and
/// attributes that models::write_mjcf puts in, each of its kind and within its bounds, and nothing
/// else. MuJoCo sees no byte of the recording's own text, no name of a file, and nothing that
/// determines how much memory to take.
/// @param mjcf  whole, from anybody
/// @throws InputError "model.xml:line: what": not XML, larger than 200 MB, an element, an attribute
///         or a value that no such model has, more of one than a model has
[[nodiscard]] std::string picture_model(const std::string& mjcf);

}  // namespace limpet::draw
