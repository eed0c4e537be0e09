// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/report/page.hpp"

namespace limpet::report {

/// @throws InternalError naming the claim, table or figure that breaks a promise of page.hpp
void check(const Page& page);

}  // namespace limpet::report
