// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

// A verb and its options as data. The parser behind them (CLI11) takes ten seconds to compile:
// command_line.cpp alone includes it.
namespace limpet::app {

/// What the program hands back to the shell.
enum class ExitCode {
    ok = 0,
    other_outcome = 1,  ///< --expect named another one; companion: control handed back
    bad_input = 2,      ///< also a damaged recording
    our_fault = 70,
    interrupted = 130,  ///< by Ctrl-C, as a shell has it
};

/// Where an option's value goes: to a variable, which makes it a flag where that is a bool, or to a
/// function that is called with the text.
using OptionTarget =
    std::variant<bool*, int*, std::uint32_t*, double*, std::optional<double>*, std::string*,
                 std::vector<std::string>*, std::function<void(const std::string&)>>;

/// What an option takes.
struct OptionRules {
    bool required = false;
    std::vector<std::string> one_of = {};
    std::optional<std::pair<double, double>> range = {};  ///< least and most
    bool told = true;  ///< the help says what is allowed; a range that it does not refuses NaN
    std::optional<std::pair<int, int>> values = {};  ///< fewest and most of them
    bool repeatable = false;         ///< a list: a value each time the option is named
    bool value_each_time = false;    ///< the same, and the help shows that there may be more
    bool default_told = false;       ///< the help says what the variable holds
    const char* not_with = nullptr;  ///< an option described before this one
};

struct Option {
    const char* name;  ///< "--out", "--jobs,-j"; without dashes it is told by its place
    OptionTarget target;
    const char* about;
    const char* value_name = nullptr;  ///< in the help: DIR; none for a flag
    OptionRules rules = {};
};
using OptionList = std::vector<Option>;

/// --set, of the verbs that load a scenario or a companion.
[[nodiscard]] Option overrides_option(std::vector<std::string>& overrides, const char* about);
/// In the order of the help.
[[nodiscard]] OptionList joined(std::initializer_list<OptionList> parts);

/// Whether an option stands on the command line: given("--out").
using Given = std::function<bool(const char* option)>;

/// Refuses options that would do nothing without another: none is ignored in silence.
/// @throws InputError naming the first that was given, and what it needs
void only_with(const Given& given, bool used, std::initializer_list<const char*> options,
               const std::string& with);

struct Verb {
    std::string name;
    std::string about;
    OptionList options;
    std::string footer = {};                    ///< of its help; empty: the program's
    std::function<ExitCode(const Given&)> run;  ///< owns what the options point to
};

/// The program as a whole.
struct Program {
    std::string name;
    std::string about;
    std::string footer;
    std::string version;
    std::vector<Verb> verbs;
};

/// Does what the command line asks for: runs a verb, or prints help or version.
/// @throws InputError naming what cannot be read in it; and what the verb throws
[[nodiscard]] ExitCode run(const Program& program, int argc, char** argv);

}  // namespace limpet::app
