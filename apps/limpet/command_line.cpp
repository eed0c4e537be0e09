// SPDX-License-Identifier: Apache-2.0
#include "command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <sstream>
#include <string_view>
#include <thread>

#include "limpet/core/errors.hpp"
#include "limpet/core/user_text.hpp"
#include "limpet/scenario/suggestion.hpp"
#include "manual.hpp"
#include "terminal.hpp"

namespace limpet::app {
namespace {

/// Forms of an address, in the order of wire::Medium.
constexpr std::array<std::string_view, 5> kForms = {
    "tcp:HOST:PORT", "udp:HOST:PORT", "udp-broadcast:HOST:PORT",
    "udp-multicast:GROUP:PORT[@INTERFACE]", "serial:DEVICE:BAUD"};

/// A number within both bounds; the range of CLI11 accepts NaN.
CLI::Validator between(double least, double most) {
    return CLI::Validator(
        [least, most](std::string& text) {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value);
            return number && value >= least && value <= most  // false for NaN
                       ? std::string()
                       : fmt::format("must be {:.9g} to {:.9g}, not '{}'", least, most, text);
        },
        "");
}

/// An unset variable of a script would otherwise mean that the option was not given.
CLI::Validator not_empty() {
    return CLI::Validator(
        [](std::string& text) {
            return text.empty() ? std::string("must not be empty") : std::string();
        },
        "");
}

void add(CLI::App& verb, const Option& option) {
    const std::size_t blank = option.name.find(' ');
    const std::string name = option.name.substr(0, blank);
    CLI::Option* added = std::visit(
        [&](const auto& target) {
            using Target = std::decay_t<decltype(target)>;
            if constexpr (std::is_same_v<Target, bool*>) {
                return verb.add_flag(name, *target, option.about);
            } else if constexpr (std::is_pointer_v<Target>) {
                CLI::Option* made = verb.add_option(name, *target, option.about);
                if constexpr (std::is_same_v<Target, std::string*>) {
                    made->check(not_empty());
                }
                return made;
            } else {
                return verb.add_option_function<std::string>(name, target, option.about);
            }
        },
        option.target);
    added->required(name[0] != '-');
    if (blank != std::string::npos) {
        added->type_name(option.name.substr(blank + 1));
    }
    if (option.rule) {
        option.rule(verb, *added);
    }
}

/// Names of files and folders come into recordings, JSON and XML, which can hold nothing else.
void require_utf8(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        if (!is_utf8(argv[i])) {
            throw InputError(
                fmt::format("{}: is not UTF-8, the only text that is taken", in_quotes(argv[i])));
        }
    }
}

/// The first word must be a verb; checked here, as the parser's message names no verb.
void require_verb(const std::vector<Verb>& verbs, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') {
        return;
    }
    std::vector<std::string_view> names;
    for (const Verb& verb : verbs) {
        if (verb.name == argv[1]) {
            return;
        }
        names.push_back(verb.name);
    }
    const std::string_view near = scenario::nearest(argv[1], names);
    throw InputError(in_quotes(argv[1]) + ": no such verb" +
                     (near.empty()
                          ? fmt::format("; there are {} (limpet --help)", fmt::join(names, ", "))
                          : fmt::format(", did you mean {}? (limpet {} --help)", near, near)));
}

/// What the parser did not take, and what was probably meant.
/// @param parser  of the verb, or of the program where none was reached
/// @return empty: there is no such word
std::string stray_word(const CLI::App& parser, const std::vector<std::string>& words) {
    std::vector<std::string> names;
    for (const CLI::Option* option : parser.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back(name);
        }
    }
    const bool sets = parser.get_option_no_throw("--set") != nullptr;
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        const std::size_t letters = name.find_first_not_of('-');
        if (letters > 0 && letters != name.npos) {
            const std::string_view near =
                scenario::nearest(name.substr(letters), {names.begin(), names.end()});
            return in_quotes(name) + ": no such option" +
                   (near.empty() ? "" : fmt::format(", did you mean --{}?", near));
        }
        if (sets && name != word) {
            return fmt::format("{}: not expected, did you mean --set {}?", in_quotes(word), word);
        }
    }
    return {};
}

/// What an option takes, as in the help: "DIR", "KIND:{a,b}".
OptionText text_of(const CLI::Option& option) {
    OptionText text{.about = option.get_description(),
                    .required = option.get_required(),
                    .many = option.get_expected_max() > 1};
    for (const std::string& name : option.get_lnames()) {
        text.names.push_back("--" + name);
    }
    for (const std::string& name : option.get_snames()) {
        text.names.push_back("-" + name);
    }
    if (option.get_expected_max() > 0) {
        const std::string type = option.get_type_name();
        text.value = type.substr(0, type.find_first_of(":["));
        const std::size_t open = type.find('{'), close = type.find('}');
        if (open != type.npos && close != type.npos) {
            text.choices = CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
        }
    }
    return text;
}

ProgramText text_of(const Program& program, const CLI::App& app) {
    ProgramText text{.name = program.name,
                     .about = program.about,
                     .footer = program.footer,
                     .version = program.version};
    for (const Verb& verb : program.verbs) {
        VerbText& added = text.verbs.emplace_back(VerbText{
            .name = verb.name, .about = verb.about, .footer = verb.footer, .group = verb.group});
        for (const CLI::Option* option : app.get_subcommand(verb.name)->get_options()) {
            if (!option->check_lname("help")) {
                added.options.push_back(text_of(*option));
            }
        }
    }
    return text;
}

/// `limpet help --man`, `limpet help --completion bash|zsh`: for who installs it.
/// @return whether one of them was given
bool print_manual(const Program& program, const CLI::App& app, int argc, char** argv) {
    if (argc < 3 || std::string_view(argv[1]) != "help") {
        return false;
    }
    const std::string_view what = argv[2], shell = argc > 3 ? argv[3] : "";
    if (what == "--man") {
        fmt::print("{}", man_page(text_of(program, app)));
        return true;
    }
    if (what != "--completion") {
        return false;
    }
    if (shell != "bash" && shell != "zsh") {
        throw InputError("help --completion: bash or zsh");
    }
    const ProgramText text = text_of(program, app);
    fmt::print("{}", shell == "bash" ? bash_completion(text) : zsh_completion(text));
    return true;
}

/// `limpet help fly` is `limpet fly --help`, and `limpet` alone is `limpet --help`.
std::vector<char*> without_help_verb(int argc, char** argv) {
    static char help[] = "--help";
    std::vector<char*> words(argv, argv + argc);
    const bool help_verb = argc >= 2 && std::string_view(argv[1]) == "help";
    if (help_verb) {
        words.erase(words.begin() + 1);
        words.resize(std::min<std::size_t>(words.size(), 2));
    }
    if (help_verb || argc == 1) {
        words.push_back(help);
    }
    return words;
}

}  // namespace

OptionRule required() {
    return [](CLI::App&, CLI::Option& option) { option.required(); };
}

OptionRule optional() {
    return [](CLI::App&, CLI::Option& option) { option.required(false); };
}

OptionRule one_of(const std::vector<std::string>& names, bool in_help) {
    return [names, in_help](CLI::App&, CLI::Option& option) {
        CLI::Validator member = CLI::IsMember(names);
        option.check(in_help ? member : member.description(""));
    };
}

OptionRule range(double least, double most, bool in_help) {
    return [=](CLI::App&, CLI::Option& option) {
        // the message is ours: that of CLI11 differs from version to version
        const std::string about = in_help ? CLI::Range(least, most).get_description() : "";
        option.check(between(least, most).description(about));
    };
}

OptionRule values(int least, int most) {
    return [=](CLI::App&, CLI::Option& option) { option.expected(least, most); };
}

OptionRule value_each_time() {
    return [](CLI::App&, CLI::Option& option) { option.allow_extra_args(false); };
}

OptionRule default_in_help() {
    return [](CLI::App&, CLI::Option& option) { option.capture_default_str(); };
}

OptionRule not_with(const char* other) {
    return
        [other](CLI::App& verb, CLI::Option& option) { option.excludes(verb.get_option(other)); };
}

Option overrides_option(std::vector<std::string>& overrides, const char* about) {
    return {"--set KEY=VALUE", &overrides, about,
            [](CLI::App&, CLI::Option& option) { option.expected(1)->take_all(); }};
}

Option jobs_option(int& jobs) {
    return {"--jobs,-j N", &jobs,
            "threads, several runs at once in each (default: one a processor)", range(1, 1024)};
}

int default_jobs() {
    return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

OptionList joined(std::initializer_list<OptionList> parts) {
    OptionList all;
    for (const OptionList& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

wire::TransportAddress address_of(const std::string& option, const std::string& text,
                                  std::initializer_list<wire::Medium> media) {
    std::vector<std::string_view> forms;
    for (const wire::Medium medium : media) {
        const std::string_view form = kForms.at(static_cast<std::size_t>(medium));
        if (text.starts_with(form.substr(0, form.find(':') + 1))) {
            try {
                return wire::parse_address(text);
            } catch (const InputError& error) {
                throw InputError(option + ": " + error.what());
            }
        }
        forms.push_back(form);
    }
    throw InputError(fmt::format("{} '{}': must be {}", option, text, fmt::join(forms, " or ")));
}
wire::TransportAddress address_of(const std::string& option, const std::optional<std::string>& text,
                                  std::initializer_list<wire::Medium> media,
                                  const wire::TransportAddress& by_default) {
    return text ? address_of(option, *text, media) : by_default;
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
    require_utf8(argc, argv);
    std::vector<char*> words = without_help_verb(argc, argv);
    const int count = static_cast<int>(words.size());
    require_verb(program.verbs, count, words.data());
    CLI::App app{program.about, program.name};
    app.footer(program.footer);
    app.get_formatter()->label("SUBCOMMAND", "VERB");
    app.set_version_flag("--version", program.version);
    app.require_subcommand(1);
    ExitCode code = ExitCode::ok;
    for (const Verb& verb : program.verbs) {
        CLI::App* parser = app.add_subcommand(verb.name, verb.about);
        parser->group(verb.group);
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
    if (print_manual(program, app, argc, argv)) {
        return code;
    }
    try {
        app.parse(count, words.data());
    } catch (const CLI::Success& help) {
        std::ostringstream text;
        (void)app.exit(help, text, text);
        std::istringstream lines(text.str());
        for (std::string line; std::getline(lines, line);) {
            constexpr std::size_t kAbout = 30;  // CLI11's column of descriptions
            const std::size_t start = line.find_first_not_of(' '), columns = columns_of(stdout);
            const bool described = line.size() > kAbout && start >= 2;
            // where that column leaves less than itself, a description goes on further left
            fmt::print("{}\n", folded(line, columns,
                                      !described             ? 2
                                      : columns > 2 * kAbout ? kAbout
                                                             : 6));
        }
    } catch (const CLI::ParseError& error) {
        const auto chosen = app.get_subcommands();
        const CLI::App& parser = chosen.empty() ? app : *chosen.front();
        const std::string stray = stray_word(parser, app.remaining(true));
        throw InputError(fmt::format("{} ({}{} --help)", stray.empty() ? error.what() : stray,
                                     program.name, chosen.empty() ? "" : " " + parser.get_name()));
    }
    return code;
}

}  // namespace limpet::app
