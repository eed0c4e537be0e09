// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limpet/serve/server.hpp"

// What a request's first lines say, and who may come in by them.
namespace limpet::serve {

/// Path and query of a request, its token taken out of them.
struct Target {
    Request request;    ///< path and query
    std::string token;  ///< as shown; empty without
};
/// @param wanted  the server's token: a path's first segment counts if it is that
/// @throws InputError if it is no path, or badly escaped
[[nodiscard]] Target parse_target(std::string_view target, std::string_view wanted);

/// In a time that does not depend on how much of it was right.
[[nodiscard]] bool same_token(std::string_view shown, std::string_view wanted);

/// `localhost` or an address in digits, with or without port: a name could be any page's, made to
/// point here (DNS rebinding).
[[nodiscard]] bool host_allowed(std::string_view host);

/// None, this server under the name it was called by, or one of `others`; one that ends in ":*" is
/// all of its ports.
[[nodiscard]] bool origin_allowed(std::string_view origin, std::string_view host,
                                  const std::vector<std::string>& others);

}  // namespace limpet::serve
