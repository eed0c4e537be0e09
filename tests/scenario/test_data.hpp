// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "limpet/core/errors.hpp"
#include "limpet/scenario/loader.hpp"

namespace limpet::scenario {

/// A data folder of its own for one test: a vehicle `small`, surfaces `stone` and `glass`.
class TestData {
public:
    TestData()
        : root_(std::filesystem::temp_directory_path() /
                ("limpet_scenario_" + std::to_string(::getpid()))) {
        std::filesystem::remove_all(root_);
        write("vehicles/small.yaml",
              "description: a small one\n"
              "mass_kg: 2.0\n"
              "slider: {stiffness_N_m: 600}\n");
        write("surfaces.yaml",
              "stone: {description: grey, friction: 0.7}\n"
              "glass: {description: clear, friction: 0.4, pump_cycles: true}\n");
        write("scenarios/first.yaml",
              "description: the first\nvehicle: small\n"
              "wall: {surface: stone}\n");
    }
    ~TestData() { std::filesystem::remove_all(root_); }
    TestData(const TestData&) = delete;
    TestData& operator=(const TestData&) = delete;

    [[nodiscard]] const std::filesystem::path& root() const { return root_; }

    /// @return the file's path
    std::string write(const std::string& name, const std::string& text) const {
        const std::filesystem::path path = root_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << text;
        return path.string();
    }

    /// A hovering `small` with `text` besides.
    [[nodiscard]] Scenario load_text(const std::string& text,
                                     const std::vector<std::string>& overrides = {}) const {
        return load_scenario_text(text, "x.yaml", {overrides, std::nullopt, root_});
    }
    [[nodiscard]] Scenario load(const std::string& wanted,
                                const std::vector<std::string>& overrides = {}) const {
        return load_scenario(wanted, {overrides, std::nullopt, root_});
    }

private:
    std::filesystem::path root_;
};

/// @return what `run` complains of; "" when it does not
template <class Run>
std::string error_of(const Run& run) {
    try {
        static_cast<void>(run());
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace limpet::scenario
