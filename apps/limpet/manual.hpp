// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// The command line as texts for the system that it is installed in, from the definitions of its
/// verbs: manual page, completion in bash and zsh.
namespace limpet::app {

struct OptionText {
    std::vector<std::string> names = {};  ///< "--jobs", "-j"; none of a positional argument
    std::string value = {};               ///< "DIR"; empty: a flag
    std::string about = {};
    std::vector<std::string> choices = {};  ///< of the value; empty: it is free
    bool required = false;
    bool many = false;  ///< values by their place: as many as are given
};

struct VerbText {
    std::string name = {};
    std::string about = {};
    std::vector<OptionText> options = {};
    std::string footer = {};
    std::string group = {};  ///< heading of those that belong together
};

struct ProgramText {
    std::string name = {};
    std::string about = {};
    std::string footer = {};
    std::string version = {};
    std::vector<VerbText> verbs = {};
};

/// Section 1, for man(1).
[[nodiscard]] std::string man_page(const ProgramText& program);
/// Verbs, options, their choices, names of what there is to fly, keys of --set.
[[nodiscard]] std::string bash_completion(const ProgramText& program);
[[nodiscard]] std::string zsh_completion(const ProgramText& program);

}  // namespace limpet::app
