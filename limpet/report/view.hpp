// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// Flights in three dimensions, in a browser: one page that has all it needs in it (adapters/web/).
namespace limpet::report {

/// Whether the program was built where Node was, which makes the page.
[[nodiscard]] bool has_view_page();

/// The page without any recording in it.
/// @throws InputError when there is none
[[nodiscard]] std::string_view view_page();

/// The page with recordings in it; the first is the flight, the others are its ghosts.
/// @throws InputError  naming a recording that is none, or that was recorded without a scene, and
///         when there is no page
[[nodiscard]] std::string view_html(const std::vector<std::filesystem::path>& recordings);

}  // namespace limpet::report
