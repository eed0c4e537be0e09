// SPDX-License-Identifier: Apache-2.0
#include "limpet/lab/request.hpp"

#include <fmt/format.h>

#include <fstream>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::lab {
namespace {

constexpr std::size_t kMostChanges = 1000;

}  // namespace

nlohmann::json object_in(std::string_view request) {
    auto json = nlohmann::json::parse(request, nullptr, false);
    if (!json.is_object()) {
        throw InputError("a request is a JSON object: {\"scenario\": ..., \"set\": [...]}");
    }
    return json;
}

Asked asked_in(const nlohmann::json& request, const std::string& first) {
    try {
        Asked asked{.scenario = request.value("scenario", first),
                    .changes = request.value("set", std::vector<std::string>{}),
                    .brief = request.value("brief", false),
                    .topics = request.value("topics", std::vector<std::string>{})};
        if (asked.changes.size() > kMostChanges) {
            throw InputError(fmt::format("\"set\": {} changes, allowed are {}",
                                         asked.changes.size(), kMostChanges));
        }
        // A page asks for what is installed, not for files.
        if (scenario::is_path(asked.scenario)) {
            throw InputError("\"scenario\": a name, not a path");
        }
        return asked;
    } catch (const nlohmann::json::exception&) {
        throw InputError(
            "\"scenario\" is a text, \"set\" a list of texts \"key=value\", \"brief\" true or "
            "false, \"topics\" a list of texts");
    }
}

std::string taken(const std::filesystem::path& file) {
    std::string bytes;
    {
        std::ifstream in(file, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    std::filesystem::remove(file);
    return bytes;
}

}  // namespace limpet::lab
