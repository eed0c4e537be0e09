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

std::uint32_t whole_in(const nlohmann::json& request, const char* key, std::uint32_t least,
                       std::uint32_t most, std::optional<std::uint32_t> otherwise) {
    const auto found = request.find(key);
    if (found == request.end() && otherwise) {
        return *otherwise;
    }
    // As it came: get<int>() would take the lowest bits of 10^18.
    const bool is_count = found != request.end() && found->is_number_unsigned();
    const std::uint64_t value = is_count ? found->get<std::uint64_t>() : 0;
    if (!is_count || value < least || value > most) {
        throw InputError(fmt::format("\"{}\": {}; a whole number, allowed {}..{}", key,
                                     found == request.end() ? "is missing" : found->dump(), least,
                                     most));
    }
    return static_cast<std::uint32_t>(value);
}

void Trouble::keep() {
    const std::lock_guard lock(guards_it_);
    if (!first_) {
        first_ = std::current_exception();
    }
}

void Trouble::clear() {
    const std::lock_guard lock(guards_it_);
    first_ = nullptr;
}

void Trouble::say() const {
    const std::lock_guard lock(guards_it_);
    if (first_) {
        std::rethrow_exception(first_);
    }
}

FlightRequest flight_request_in(const nlohmann::json& request, const std::string& first) {
    try {
        FlightRequest asked{.scenario = request.value("scenario", first),
                            .changes = request.value("set", std::vector<std::string>{}),
                            .brief = request.value("brief", false),
                            .topics = request.value("topics", std::vector<std::string>{})};
        if (asked.changes.size() > kMostChanges) {
            throw InputError(fmt::format("\"set\": {} changes, allowed are {}",
                                         asked.changes.size(), kMostChanges));
        }
        // A page names what is installed, not files.
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
