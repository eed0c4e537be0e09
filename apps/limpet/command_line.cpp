// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <type_traits>

#include "limpet/core/errors.hpp"

namespace limpet::app {
namespace {

/// A number within both bounds; CLI's own range lets NaN pass.
CLI::Validator between(double least, double most) {
    return CLI::Validator(
        [least, most](std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value);
            return number && value >= least && value <= most  // false for NaN
                       ? std::string()
                       : fmt::format("must be {:g} to {:g}, not '{}'", least, most, text);
        },
        "");
}

CLI::Validator range_of(const Option& option) {
    const auto [least, most] = *option.rules.range;
    if (!option.rules.told) {
        return between(least, most);
    }
    return std::holds_alternative<int*>(option.target)
               ? CLI::Range(static_cast<int>(least), static_cast<int>(most))
               : CLI::Range(least, most);
}

CLI::Option* add_plain(CLI::App& verb, const Option& option) {
    return std::visit(
        [&](const auto& target) {
            using Target = std::decay_t<decltype(target)>;
            if constexpr (std::is_same_v<Target, bool*>) {
                return verb.add_flag(option.name, *target, option.about);
            } else if constexpr (std::is_pointer_v<Target>) {
                return verb.add_option(option.name, *target, option.about);
            } else {
                return verb.add_option_function<std::string>(option.name, target, option.about);
            }
        },
        option.target);
}

void add(CLI::App& verb, const Option& option) {
    const OptionRules& rules = option.rules;
    CLI::Option* added = add_plain(verb, option);
    added->required(rules.required);
    if (option.value_name != nullptr) {
        added->type_name(option.value_name);
    }
    if (!rules.one_of.empty()) {
        CLI::Validator member = CLI::IsMember(rules.one_of);
        added->check(rules.told ? member : member.description(""));
    }
    if (rules.range) {
        added->check(range_of(option));
    }
    if (rules.values) {
        added->expected(rules.values->first, rules.values->second);
    }
    if (rules.repeatable) {
        added->expected(1)->take_all();
    }
    if (rules.value_each_time) {
        added->allow_extra_args(false);
    }
    if (rules.default_told) {
        added->capture_default_str();
    }
    if (rules.not_with != nullptr) {
        added->excludes(verb.get_option(rules.not_with));
    }
}

/// The first word must be a verb; said before the parser only misses one.
void require_verb(const std::vector<Verb>& verbs, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') {
        return;
    }
    std::string names;
    for (const Verb& verb : verbs) {
        if (verb.name == argv[1]) {
            return;
        }
        names += (names.empty() ? "" : ", ") + verb.name;
    }
    throw InputError("\"" + std::string(argv[1]) + "\": no such verb; there are " + names);
}

}  // namespace

Option overrides_option(std::vector<std::string>& overrides, const char* about) {
    return {"--set", &overrides, about, "KEY=VALUE", {.repeatable = true}};
}

OptionList joined(std::initializer_list<OptionList> parts) {
    OptionList all;
    for (const OptionList& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

void only_with(const Given& given, bool used, std::initializer_list<const char*> options,
               const std::string& with) {
    for (const char* option : options) {
        if (!used && given(option)) {
            throw InputError(fmt::format("{} is of use only with {}", option, with));
        }
    }
}

ExitCode run(const Program& program, int argc, char** argv) {
    require_verb(program.verbs, argc, argv);
    CLI::App app{program.about, program.name};
    app.footer(program.footer);
    app.set_version_flag("--version", program.version);
    app.require_subcommand(1);
    ExitCode code = ExitCode::ok;
    for (const Verb& verb : program.verbs) {
        CLI::App* parser = app.add_subcommand(verb.name, verb.about);
        for (const Option& option : verb.options) {
            add(*parser, option);
        }
        if (!verb.footer.empty()) {
            parser->footer(verb.footer);
        }
        parser->callback([&verb, &code, parser] {
            code = verb.run([parser](const char* option) { return parser->count(option) > 0; });
        });
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help) {
        (void)app.exit(help);
    } catch (const CLI::ParseError& error) {
        throw InputError(std::string(error.what()) + " (limpet --help)");
    }
    return code;
}

}  // namespace limpet::app
