// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <initializer_list>
#include <iterator>

#include "limpet/core/user_text.hpp"
#include "limpet/models/cad_model.hpp"
#include "limpet/scenario/derived.hpp"
#include "limpet/scenario/fault_table.hpp"

namespace limpet::scenario {
namespace {

class Writer {
public:
    void line(int indent, std::string_view text) {
        fmt::format_to(std::back_inserter(text_), "{:{}}{}\n", "", 2 * indent, text);
    }
    void value(int indent, std::string_view key, std::string_view text) {
        line(indent, fmt::format("{}: {}", key, text));
    }
    void rows(int indent, const std::vector<BoundParameter>& rows) {
        for (const BoundParameter& row : rows) {
            value(indent, row.name, value_text(row.value));
        }
    }
    void choices(const std::vector<Choice>& choices) {
        for (const Choice& choice : choices) {
            value(1, choice.key, choice.names[choice.chosen].name);
        }
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    std::string text_;
};

void write_model(Writer& writer, const models::CadModel& cad, bool has_cup) {
    const auto names = [&](const char* key, std::initializer_list<std::string_view> parts) {
        writer.line(2, fmt::format("{}:", key));
        for (const std::string_view part : parts) {
            writer.value(3, part, in_yaml(models::called(cad.names, part)));
        }
    };
    writer.line(1, "model:");
    writer.value(2, "urdf", in_yaml(cad.file));
    if (!has_cup) {
        names("links", {"base"});
        return;
    }
    names("links", {"base", "carriage", "cup_yoke", "cup"});
    names("joints", {"slider", "cup_pitch", "cup_yaw"});
}

void write_vehicle(Writer& writer, vehicle::Airframe& airframe) {
    writer.line(0, "vehicle:");
    writer.value(1, "name", in_yaml(airframe.name));
    writer.value(1, "description", in_yaml(airframe.description));
    writer.value(1, "has_cup", airframe.has_cup ? "true" : "false");
    if (const models::CadModel* cad = models::cad_of(airframe)) {
        write_model(writer, *cad, airframe.has_cup);
    }
    for (const Section& section : vehicle_sections(airframe)) {
        if (section.name.empty()) {
            writer.rows(1, section.rows);
        } else {
            writer.line(1, section.name + ":");
            writer.rows(2, section.rows);
        }
    }
    writer.line(1, "rotors:");
    for (vehicle::Rotor& rotor : airframe.rotors) {
        const vehicle::Rotor usual;
        std::string item;
        for (const BoundParameter& row : rotor_rows(rotor)) {
            const bool place = row.name == "x_m" || row.name == "y_m";
            const bool stated =
                rotor.below_m != usual.below_m || rotor.thrust_share != usual.thrust_share;
            if (place || stated) {
                item += fmt::format("{}: {}, ", row.name, value_text(row.value));
            }
        }
        writer.line(2,
                    fmt::format("- {{{}direction: {}}}", item, rotor.direction > 0 ? "ccw" : "cw"));
    }
}

/// @param first  of the lines: "surface:" or the dash of a list's item
void write_surface(Writer& writer, int indent, std::string_view first, Surface surface) {
    writer.line(indent, first);
    writer.value(indent + 1, "name", in_yaml(surface.name));
    writer.value(indent + 1, "description", in_yaml(surface.description));
    writer.value(indent + 1, "source", in_yaml(surface.source));
    writer.rows(indent + 1, bind(suction::surface_table(), surface));
}

void write_wall(Writer& writer, const Section& section, const WallSetup& wall) {
    if (!wall.present) {
        writer.value(0, "wall", "none");
        return;
    }
    writer.line(0, "wall:");
    writer.choices(section.choices);
    writer.rows(1, section.rows);
    write_surface(writer, 1, "surface:", wall.surface);
    if (!wall.first_touches.empty()) {
        writer.line(1, "first_touches:");
        for (const Surface& surface : wall.first_touches) {
            write_surface(writer, 2, "-", surface);
        }
    }
}

/// Those that are not as they are where nothing is stated.
std::vector<Choice> chosen_ones(std::vector<Choice> choices) {
    std::erase_if(choices, [](const Choice& choice) { return choice.chosen == 0; });
    return choices;
}

/// Rows of a section but for those that would be derived alike.
void write_section(Writer& writer, const Section& section, const Scenario& scenario) {
    writer.line(0, section.name + ":");
    for (const BoundParameter& row : section.rows) {
        if (row.value.get() != derived(section.name, row.name, scenario)) {
            writer.value(1, row.name, value_text(row.value));
        }
    }
}

}  // namespace

std::string noise_text(const NoiseBlend& noise) {
    std::string text;
    for (const NoiseTerm& term : noise) {
        text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", term.seed,
                            number_text(term.weight));
    }
    return fmt::format("[{}]", text);
}

std::string to_yaml(const Scenario& scenario) {
    Scenario copy = scenario;  // sections bind to what may be written
    Writer writer;
    writer.value(0, "description", in_yaml(copy.description));
    writer.value(0, "mission", to_string(copy.mission));
    writer.value(0, "mount", to_string(copy.mount));
    writer.value(0, "seed", fmt::format("{}", copy.seed));
    if (!copy.noise.empty()) {
        writer.value(0, "noise", noise_text(copy.noise));
    }
    write_vehicle(writer, copy.airframe);
    const std::vector<Section> sections = scenario_sections(copy);
    write_wall(writer, find_section(sections, "wall"), copy.wall);
    if (!copy.faults.empty()) {
        writer.line(0, "faults:");
        for (const faults::Fault& fault : copy.faults) {
            writer.line(1, "- " + fault_text(fault));
        }
    }
    for (const std::string_view name : {"pendulum", "press_rig", "environment", "suction",
                                        "guidance", "autopilot", "sensors", "simulation"}) {
        const Section& section = find_section(sections, name);
        write_section(writer, section, scenario);
        if (name == "suction") {
            writer.value(1, "pressure_model", suction::model_of(copy.cup).name);
        } else {
            writer.choices(name == "autopilot" ? chosen_ones(section.choices) : section.choices);
        }
    }
    return writer.take();
}

}  // namespace limpet::scenario
