// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>

namespace limpet::gazebo11 {

/// How a gzserver came to its end.
struct Ended {
    int code = -1;
    std::string text;  ///< both outputs
};

/// gzserver on a world whose body carries the plugin.
[[nodiscard]] Ended serve(const std::string& library, const std::string& inside,
                          const std::string& more_models = "", const std::string& limit_s = "30");

struct Refused {
    std::string name;
    std::string inside;
    std::string line;
};
void PrintTo(const Refused& refused, std::ostream* out);

}  // namespace limpet::gazebo11
