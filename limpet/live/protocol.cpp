// SPDX-License-Identifier: Apache-2.0
#include "limpet/live/protocol.hpp"

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>

#include "limpet/core/version.hpp"

namespace limpet::live {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kMessageData = 1, kTime = 2, kServiceResponse = 3, kAsset = 4;
constexpr char kServiceRequest = 2;  // from a viewer
constexpr const char* kEncoding = "cdr";

/// JSON, whatever the bytes.
std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// As the machine has it: little endian.
template <class Number>
void put_little(char* to, Number number) {
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(to, &number, sizeof number);
}

void append(std::string& to, std::uint32_t number) {
    std::array<char, 4> bytes{};
    put_little(bytes.data(), number);
    to.append(bytes.data(), bytes.size());
}

std::uint32_t read_little(std::string_view bytes) {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        number |= std::uint32_t{static_cast<unsigned char>(bytes[k])} << (8 * k);
    }
    return number;
}

}  // namespace

std::string server_info(const std::string& name, const std::string& session, bool parameters,
                        bool services) {
    Json capabilities = {"time", "assets"};
    if (parameters) {
        capabilities.push_back("parameters");
        capabilities.push_back("parametersSubscribe");
    }
    if (services) {
        capabilities.push_back("services");
    }
    return text_of({{"op", "serverInfo"},
                    {"name", name},
                    {"capabilities", capabilities},
                    {"supportedEncodings", {kEncoding}},
                    {"metadata", {{"limpet", kVersion}}},
                    {"sessionId", session}});
}

std::string advertise(std::span<const LiveChannel> channels) {
    Json all = Json::array();
    for (const LiveChannel& channel : channels) {
        all.push_back({{"id", channel.id},
                       {"topic", channel.topic},
                       {"encoding", channel.encoding},
                       {"schemaName", channel.type},
                       {"schema", channel.schema},
                       {"schemaEncoding", channel.schema_encoding}});
    }
    return text_of({{"op", "advertise"}, {"channels", all}});
}

std::string advertise_services(const std::vector<std::string>& names) {
    const std::string type = "std_srvs/srv/Trigger";
    const std::string response = "bool success\nstring message\n";
    Json all = Json::array();
    const auto part = [&type](const char* which, const std::string& schema) -> Json {
        return {{"encoding", kEncoding},
                {"schemaName", type + which},
                {"schemaEncoding", "ros2msg"},
                {"schema", schema}};
    };
    for (std::size_t id = 0; id < names.size(); ++id) {
        all.push_back({{"id", id},
                       {"name", names[id]},
                       {"type", type},
                       {"request", part("_Request", "")},
                       {"response", part("_Response", response)},
                       {"requestSchema", ""},  // as viewers until 2024 want them
                       {"responseSchema", response}});
    }
    return text_of({{"op", "advertiseServices"}, {"services", all}});
}

std::string status(StatusLevel level, std::string_view text) {
    return text_of({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", text}});
}

std::string parameter_values(std::span<const LiveParameter> parameters, const std::string& id) {
    Json all = Json::array();
    for (const LiveParameter& parameter : parameters) {
        Json row = {{"name", parameter.name}, {"value", parameter.value}};
        if (!parameter.whole) {
            row["type"] = "float64";  // else 1.0 is taken for a whole number
        } else {
            row["value"] = static_cast<std::int64_t>(parameter.value);
        }
        row["settable"] = parameter.settable;
        row["minimum"] = parameter.minimum;
        row["maximum"] = parameter.maximum;
        all.push_back(row);
    }
    Json values = {{"op", "parameterValues"}, {"parameters", all}};
    if (!id.empty()) {
        values["id"] = id;
    }
    return text_of(values);
}

std::string service_failure(std::uint32_t service, std::uint32_t call, std::string_view text) {
    return text_of({{"op", "serviceCallFailure"},
                    {"serviceId", service},
                    {"callId", call},
                    {"message", text}});
}

std::array<char, 13> message_head(std::uint32_t subscription, std::uint64_t time_ns) {
    std::array<char, 13> head{kMessageData};
    put_little(head.data() + 1, subscription);
    put_little(head.data() + 5, time_ns);
    return head;
}

std::array<char, 9> time_message(std::uint64_t time_ns) {
    std::array<char, 9> message{kTime};
    put_little(message.data() + 1, time_ns);
    return message;
}

std::string service_response(std::uint32_t service, std::uint32_t call, bool done,
                             std::string_view text) {
    std::string bytes(1, kServiceResponse);
    append(bytes, service);
    append(bytes, call);
    append(bytes, 3);
    bytes += kEncoding;
    // CDR, little endian: a bool, a text behind its length, with the zero that ends it.
    bytes += std::string("\0\1\0\0", 4);
    bytes += done ? '\1' : '\0';
    bytes += std::string(3, '\0');
    append(bytes, static_cast<std::uint32_t>(text.size() + 1));
    bytes += text;
    bytes += '\0';
    return bytes;
}

std::string asset_response(std::uint32_t request, std::string_view file) {
    constexpr char kDone = 0;
    std::string bytes(1, kAsset);
    append(bytes, request);
    bytes += kDone;
    append(bytes, 0);  // nothing to complain of
    bytes += file;
    return bytes;
}

std::string asset_failure(std::uint32_t request, std::string_view text) {
    constexpr char kFailed = 1;
    std::string bytes(1, kAsset);
    append(bytes, request);
    bytes += kFailed;
    append(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += text;
    return bytes;
}

std::optional<ServiceCall> read_service_call(std::string_view bytes) {
    constexpr std::size_t kHead = 1 + 4 + 4 + 4;
    if (bytes.size() < kHead || bytes.front() != kServiceRequest) {
        return std::nullopt;
    }
    const std::uint32_t encoding_bytes = read_little(bytes.substr(9));
    if (encoding_bytes > bytes.size() - kHead) {
        return std::nullopt;
    }
    return ServiceCall{read_little(bytes.substr(1)), read_little(bytes.substr(5)),
                       bytes.substr(kHead, encoding_bytes)};
}

}  // namespace limpet::live
