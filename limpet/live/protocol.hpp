// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// Foxglove's WebSocket protocol, as far as it is spoken here: texts in JSON, messages, time and
// service calls in bytes, little endian. Source: https://github.com/foxglove/ws-protocol
namespace limpet::live {

/// The newer name first; they are the same language.
inline constexpr std::array<std::string_view, 2> kSubprotocols = {"foxglove.sdk.v1",
                                                                  "foxglove.websocket.v1"};

enum class StatusLevel {
    info,
    warning,
    error
};

struct LiveChannel {
    std::uint16_t id = 0;
    std::string topic, type, encoding, schema_encoding, schema;
};

/// A number that a viewer is shown, and may set if `settable`.
struct LiveParameter {
    std::string name;  ///< "autopilot.MC_PITCHRATE_P"
    double value = 0.0;
    double minimum = 0.0, maximum = 0.0;  ///< allowed, inclusive
    bool whole = false;
    bool settable = false;
};

// Texts to a viewer.

[[nodiscard]] std::string server_info(const std::string& name, const std::string& session,
                                      bool parameters, bool services);
[[nodiscard]] std::string advertise(std::span<const LiveChannel> channels);
/// All are of std_srvs/srv/Trigger: an empty request; the response is done or not, and why.
/// @param names  their place is their id
[[nodiscard]] std::string advertise_services(const std::vector<std::string>& names);
[[nodiscard]] std::string status(StatusLevel level, std::string_view text);
/// In addition to the protocol's keys: whether it may be set, and its range.
/// @param id  of the request that this answers; empty: none
[[nodiscard]] std::string parameter_values(std::span<const LiveParameter> parameters,
                                           const std::string& id);
[[nodiscard]] std::string service_failure(std::uint32_t service, std::uint32_t call,
                                          std::string_view text);

// Bytes to a viewer.

/// Stands before a message's bytes.
[[nodiscard]] std::array<char, 13> message_head(std::uint32_t subscription, std::uint64_t time_ns);
[[nodiscard]] std::array<char, 9> time_message(std::uint64_t time_ns);
/// A Trigger's answer.
[[nodiscard]] std::string service_response(std::uint32_t service, std::uint32_t call, bool done,
                                           std::string_view text);

/// A file that was requested.
[[nodiscard]] std::string asset_response(std::uint32_t request, std::string_view file);
/// Or why it is not there.
[[nodiscard]] std::string asset_failure(std::uint32_t request, std::string_view text);

// From a viewer.

struct ServiceCall {
    std::uint32_t service = 0, call = 0;
    std::string_view encoding;
};
/// @return nothing if it is no call of a service
[[nodiscard]] std::optional<ServiceCall> read_service_call(std::string_view bytes);

}  // namespace limpet::live
