// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace limpet::report {

/// The style sheet of page.hpp's page: a sheet of paper on a screen, cards on a phone, ink on
/// paper.
[[nodiscard]] const char* page_style();

}  // namespace limpet::report
