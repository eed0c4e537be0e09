// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace limpet {

/// Ctrl-C or SIGTERM before there was anything to conclude; one line that says what was going on.
/// The command line turns it into exit code 130.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace limpet
