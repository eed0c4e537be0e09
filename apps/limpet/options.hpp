// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>

#include "limpet/mavlink/address.hpp"

namespace limpet::app {

/// A number within both bounds; CLI's own range lets NaN pass.
[[nodiscard]] CLI::Validator between(double least, double most);

/// The address that an option names.
/// @param media  what the option can do with
/// @throws InputError naming the option and what it may be
[[nodiscard]] TransportAddress address_of(const std::string& option, const std::string& text,
                                          std::initializer_list<Medium> media);

/// Refuses options that would do nothing without another: none is ignored in silence.
/// @throws InputError naming the first that was given, and what it needs
void only_with(const CLI::App& verb, bool used, std::initializer_list<const char*> options,
               const std::string& with);

}  // namespace limpet::app
