// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "limpet/wire/address.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

// A verb and its options as data. The parser behind them (CLI11) takes ten seconds to compile:
// command_line.cpp alone includes it.
namespace limpet::app {

/// Exit codes of the program.
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
    std::variant<bool*, int*, std::optional<int>*, std::uint32_t*, double*, std::optional<double>*,
                 std::string*, std::optional<std::string>*, std::vector<std::string>*,
                 std::function<void(const std::string&)>>;

/// What an option takes, beyond its type.
using OptionRule = std::function<void(CLI::App& verb, CLI::Option& option)>;
[[nodiscard]] OptionRule required();
/// Of a positional argument, which is required otherwise.
[[nodiscard]] OptionRule optional();
/// @param in_help  the help lists the names; else `about` does
[[nodiscard]] OptionRule one_of(const std::vector<std::string>& names, bool in_help = true);
/// @param in_help  likewise; NaN is refused
[[nodiscard]] OptionRule range(double least, double most, bool in_help = true);
/// Fewest and most values.
[[nodiscard]] OptionRule values(int least, int most);
/// A value each time the option is named; the help shows that there may be more.
[[nodiscard]] OptionRule value_each_time();
/// The help shows the variable's value.
[[nodiscard]] OptionRule default_in_help();
/// @param option  described before this one
[[nodiscard]] OptionRule not_with(const char* option);

struct Option {
    /// Name and, behind a blank, what stands for the value in the help: "--out DIR", "--jobs,-j N";
    /// a flag has none. Without dashes it is positional: "scenario SCENARIO".
    std::string name;
    OptionTarget target;
    const char* about;
    OptionRule rule = {};
};
using OptionList = std::vector<Option>;

/// --set, of the verbs that load a scenario or a companion.
[[nodiscard]] Option overrides_option(std::vector<std::string>& overrides, const char* about);
/// --jobs, of those that keep many threads busy.
[[nodiscard]] Option jobs_option(int& jobs);
/// One a processor.
[[nodiscard]] int default_jobs();
/// In the order of the help.
[[nodiscard]] OptionList joined(std::initializer_list<OptionList> parts);

/// The address that an option names.
/// @param media  what the option can do with
/// @throws InputError naming the option and what it may be
[[nodiscard]] wire::TransportAddress address_of(const std::string& option, const std::string& text,
                                                std::initializer_list<wire::Medium> media);
/// @param by_default  where the option is not given
[[nodiscard]] wire::TransportAddress address_of(const std::string& option,
                                                const std::optional<std::string>& text,
                                                std::initializer_list<wire::Medium> media,
                                                const wire::TransportAddress& by_default);

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
    std::string footer;                         ///< of its help; empty: the program's
    std::function<ExitCode(const Given&)> run;  ///< owns what the options point to
    std::string group = {};                     ///< heading that it stands under in the help
};

/// The verb under that heading.
[[nodiscard]] inline Verb in_group(std::string group, Verb verb) {
    verb.group = std::move(group);
    return verb;
}

/// A verb whose options are the members of a struct, which it owns.
/// @param run  from const Options& to an ExitCode, or to nothing, which is ExitCode::ok; or from
///             const Options& and Given to an ExitCode
template <class Options, class Run>
[[nodiscard]] Verb verb(const char* name, const char* about, OptionList (*options_of)(Options&),
                        const Run& run, const std::string& footer = {}) {
    const auto options = std::make_shared<Options>();
    return {name,
            about,
            options_of(*options),
            footer,
            [options, run](const Given& given) {
                if constexpr (std::is_invocable_v<Run, const Options&, const Given&>) {
                    return run(*options, given);
                } else if constexpr (std::is_void_v<std::invoke_result_t<Run, const Options&>>) {
                    run(*options);
                    return ExitCode::ok;
                } else {
                    return run(*options);
                }
            },
            {}};
}

/// Every verb of the program, in the order of --help; apps/limpet/CMakeLists.txt lists them.
[[nodiscard]] std::vector<Verb> all_verbs();

/// The program as a whole.
struct Program {
    std::string name;
    std::string about;
    std::string footer;
    std::string version;
    std::vector<Verb> verbs;
};

/// Runs the command line: a verb, or help or version.
/// @throws InputError naming what cannot be read in it; and what the verb throws
[[nodiscard]] ExitCode run(const Program& program, int argc, char** argv);

}  // namespace limpet::app
