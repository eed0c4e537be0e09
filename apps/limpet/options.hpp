// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "limpet/wire/address.hpp"

namespace limpet::app {

/// The address that an option names.
/// @param media  what the option can do with
/// @throws InputError naming the option and what it may be
[[nodiscard]] wire::TransportAddress address_of(const std::string& option, const std::string& text,
                                                std::initializer_list<wire::Medium> media);

}  // namespace limpet::app
