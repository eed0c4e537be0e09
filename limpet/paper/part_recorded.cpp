// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "limpet/core/errors.hpp"
#include "limpet/paper/parts.hpp"
#include "limpet/scenario/data_folder.hpp"

namespace limpet::paper {
namespace {

constexpr std::array<const char*, 3> kRecorded = {"px4", "companion", "gazebo"};

double metric(const nlohmann::json& flown, const char* name) {
    const nlohmann::json& value = flown.at("metrics").at(name);
    return value.is_null() ? kNaN : value.get<double>();
}

void study_recorded(Study& study) {
    TableRows rows;
    for (const std::string name : kRecorded) {
        const nlohmann::json flown = read_recorded(name);
        try {
            const auto outcome = flown.at("outcome").get<std::string>();
            study.evidence.set("recorded." + name + "_is_released",
                               outcome == "released" ? 1.0 : 0.0);
            rows.push_back({flown.at("peer").get<std::string>(),
                            flown.at("command").get<std::string>(),
                            flown.at("date").get<std::string>(), outcome,
                            number_or(metric(flown, "impact_speed_m_s"), "–"),
                            number_or(metric(flown, "impact_force_N"), "–"),
                            number_or(metric(flown, "perched_pitch_deg"), "–"),
                            number_or(metric(flown, "release_s"), "–")});
        } catch (const nlohmann::json::exception& error) {
            throw InputError(fmt::format("paper/recorded/{}.json: {}", name, error.what()));
        }
    }
    study.table("recorded-table", rows);
}

}  // namespace

nlohmann::json read_recorded(const std::string& name) {
    const auto path = scenario::data_root() / "paper" / "recorded" / (name + ".json");
    std::ifstream file(path);
    try {
        return nlohmann::json::parse(file);
    } catch (const nlohmann::json::exception&) {
        throw InputError(path.string() + ": is no record of a flight");
    }
}

StudyPart recorded_part() {
    StudyPart part{
        "recorded", "On a real PX4 and in a real Gazebo", study_recorded, {}, {"recorded-table"}};
    for (const std::string name : kRecorded) {
        part.measures.push_back("recorded." + name + "_is_released");
    }
    return part;
}

}  // namespace limpet::paper
