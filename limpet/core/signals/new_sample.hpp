// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "limpet/core/signals/readings.hpp"

namespace limpet {

/// A sample that has not been sent. Stamps start again when a flight begins: not only later ones
/// are new.
template <class T>
[[nodiscard]] bool is_new(const Sample<T>& sample, const Sample<T>& last) {
    return sample.ever() && sample.time_s != last.time_s;
}

}  // namespace limpet
