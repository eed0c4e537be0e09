// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/report/page.hpp"

namespace limpet::report {

/// @throws InternalError naming the claim, table or figure that breaks a promise of page.hpp
void check(const Page& page);

/// The page's style sheet, page.css: a sheet of paper on a screen, cards on a phone, ink on paper.
extern const char* const kPageStyle;

}  // namespace limpet::report
