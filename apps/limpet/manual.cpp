// SPDX-License-Identifier: Apache-2.0
#include "manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace limpet::app {
namespace {

/// For troff: no line begins with a command, no hyphen of an option is typeset.
std::string troff(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (out.empty() || out.back() == '\n') {
            out += c == '.' || c == '\'' ? "\\&" : "";
        }
        out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
    }
    return out;
}

/// As it stands, line by line.
std::string verbatim(const std::string& text) {
    return text.empty() ? "" : ".nf\n" + troff(text) + (text.back() == '\n' ? "" : "\n") + ".fi\n";
}

/// As sections of a manual page are headed.
std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string bold(const std::string& text) {
    return "\\fB" + troff(text) + "\\fR";
}

std::string italic(const std::string& text) {
    return "\\fI" + troff(text) + "\\fR";
}

std::string man_option(const OptionText& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.names) {
        names.push_back(bold(name));
    }
    std::string head = fmt::format("{}", fmt::join(names, ", "));
    if (!option.value.empty()) {
        head += (head.empty() ? "" : " ") + italic(option.value);
    }
    std::string text = fmt::format(".TP\n{}\n{}\n", head, troff(option.about));
    if (!option.choices.empty()) {
        text += troff(fmt::format("One of {}.", fmt::join(option.choices, ", "))) + "\n";
    }
    return text;
}

std::string synopsis(const ProgramText& program, const VerbText& verb) {
    std::string text = bold(program.name) + " " + bold(verb.name);
    bool options = false;
    for (const OptionText& option : verb.options) {
        options = options || !option.names.empty();
    }
    text += options ? " [" + italic("options") + "]" : "";
    for (const OptionText& option : verb.options) {
        if (option.names.empty()) {
            const std::string value = italic(option.value) + (option.many ? " ..." : "");
            text += option.required ? " " + value : " [" + value + "]";
        }
    }
    return text;
}

/// Lists of `limpet list` whose names may stand for a value; empty: none.
std::string listed(std::string_view value) {
    constexpr std::pair<std::string_view, const char*> kLists[] = {
        {"SCENARIO", "scenarios"},
        {"CAMPAIGN", "campaigns"},
        {"VEHICLE", "vehicles"},
        {"COMPANION", "companions"},
        {"CONFIG", "companions"},
        {"KEY=VALUE", "keys"},
        {"CSV", "samples"},
        {"TXT", "samples"},
        {"NAME|FILE", "scenarios vehicles campaigns companions surfaces samples"}};
    std::string lists;
    for (const auto& [name, list] : kLists) {
        if (value.find(name) != value.npos) {
            lists += (lists.empty() ? "" : " ") + std::string(list);
        }
    }
    return lists;
}

/// The bash command that offers what may stand for a value.
std::string bash_offer(const OptionText& option) {
    if (!option.choices.empty()) {
        return fmt::format("_limpet_words \"{}\"", fmt::join(option.choices, " "));
    }
    if (const std::string list = listed(option.value); !list.empty()) {
        return "_limpet_listed " + list;
    }
    return option.value == "DIR" ? "_limpet_folders" : "_limpet_files";
}

std::string bash_verb(const VerbText& verb) {
    std::string values, words, lists, place = "_limpet_files";
    for (const OptionText& option : verb.options) {
        if (option.names.empty()) {
            // Which of several places it is, is not looked at.
            lists += (lists.empty() ? "" : " ") + listed(option.value);
            place = lists.empty() ? bash_offer(option) : "_limpet_listed " + lists;
            continue;
        }
        words += fmt::format("{}{}", words.empty() ? "" : " ", fmt::join(option.names, " "));
        if (!option.value.empty()) {
            values += fmt::format("            {}) {}; return ;;\n", fmt::join(option.names, "|"),
                                  bash_offer(option));
        }
    }
    return fmt::format(
        "    {})\n        case $before in\n{}        esac\n"
        "        if [[ $word == -* ]]; then _limpet_words \"{} --help\"; else {}; fi ;;\n",
        verb.name, values, words, place);
}

/// In single quotes, for zsh's _arguments: with brackets and colons escaped.
std::string zsh_text(std::string text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '\'') {
            text.replace(at, 1, "'\\''");
            at += 3;
        } else if (text[at] == ':' || text[at] == '[' || text[at] == ']') {
            text.insert(at++, "\\");
        }
    }
    return text;
}

std::string zsh_offer(const OptionText& option) {
    if (!option.choices.empty()) {
        return fmt::format("({})", fmt::join(option.choices, " "));
    }
    if (const std::string list = listed(option.value); !list.empty()) {
        return "_limpet_listed " + list;
    }
    return option.value == "DIR" ? "_directories" : "_files";
}

std::string zsh_verb(const VerbText& verb) {
    std::string text = fmt::format("        {}) _arguments", verb.name);
    for (const OptionText& option : verb.options) {
        const std::string value =
            option.value.empty() ? ""
                                 : fmt::format(":{}:{}", zsh_text(option.value), zsh_offer(option));
        if (option.names.empty()) {
            text += fmt::format(" '{}{}'", option.many ? "*" : "", value.empty() ? ":" : value);
        }
        for (const std::string& name : option.names) {
            text += fmt::format(" '*{}[{}]{}'", name, zsh_text(option.about), value);
        }
    }
    return text + " '--help[what it takes]' ;;\n";
}

/// A shell's script with the verbs, and what each takes, in their places.
std::string with(std::string script, const std::string& verbs, const std::string& cases) {
    script.replace(script.find("@VERBS@"), 7, verbs);
    return script.replace(script.find("@CASES@"), 7, cases);
}

}  // namespace

std::string man_page(const ProgramText& program) {
    std::string text = fmt::format(
        ".TH LIMPET 1 \"\" \"{}\"\n.SH NAME\n{} \\- simulate, reproduce and fly perching with a "
        "suction "
        "cup\n.SH SYNOPSIS\n{} {} [{}]\n.br\n{} {} [{}]\n.SH DESCRIPTION\n",
        troff(program.version), program.name, bold(program.name), italic("verb"),
        italic("arguments"), bold(program.name), bold("help"), italic("verb"));
    text += verbatim(program.about);
    std::string group;
    for (const VerbText& verb : program.verbs) {
        if (verb.group != group) {
            group = verb.group;
            text += fmt::format(".SH \"{}\"\n", troff(upper(group)));
        }
        text +=
            fmt::format(".SS {}\n{}\n.PP\n{}.\n", synopsis(program, verb), "", troff(verb.about));
        for (const OptionText& option : verb.options) {
            text += man_option(option);
        }
        if (!verb.footer.empty()) {
            text += ".PP\n" + verbatim(verb.footer);
        }
    }
    text += ".SH EXAMPLES AND EXIT STATUS\n" + verbatim(program.footer);
    text += ".SH ENVIRONMENT\n.TP\n\\fBLIMPET_DATA\\fR\n";
    return text + "Folder of scenarios, vehicles and surfaces, instead of those installed.\n";
}

std::string bash_completion(const ProgramText& program) {
    std::string verbs, cases;
    for (const VerbText& verb : program.verbs) {
        verbs += (verbs.empty() ? "" : " ") + verb.name;
        cases += bash_verb(verb);
    }
    return with(
        R"sh(# bash completion for limpet, made by limpet help --completion bash
_limpet_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }
_limpet_files() { compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$word"); }
_limpet_folders() { compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -d -- "$word"); }
_limpet_listed() { # names of `limpet list`, and files; a key is followed by its value
    local names list
    for list in "$@"; do names+=" $("${COMP_WORDS[0]}" list "$list" 2>/dev/null | cut -d ' ' -f 1)"; done
    if [[ $1 == keys ]]; then
        compopt -o nospace 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -W "$names" -S = -- "$word")
    else
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word"; compgen -f -- "$word")
    fi
}
_limpet() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
    COMPREPLY=()
    if [[ $COMP_CWORD -eq 1 || $before == help ]]; then
        _limpet_words "@VERBS@ help --help --version"
        return
    fi
    case ${COMP_WORDS[1]} in
@CASES@    esac
}
complete -F _limpet limpet
)sh",
        verbs, cases);
}

std::string zsh_completion(const ProgramText& program) {
    std::string verbs, cases;
    for (const VerbText& verb : program.verbs) {
        verbs += fmt::format(" '{}:{}'", verb.name, zsh_text(verb.about));
        cases += zsh_verb(verb);
    }
    return with(R"sh(#compdef limpet
# zsh completion for limpet, made by limpet help --completion zsh
_limpet_listed() { # names of `limpet list`, and files; a key is followed by its value
    local -a names
    local list
    for list in $@; do names+=(${(f)"$(limpet list $list 2>/dev/null | cut -d ' ' -f 1)"}); done
    if [[ $1 == keys ]]; then compadd -S = -a names; else compadd -a names; _files; fi
}
_limpet() {
    local -a verbs
    verbs=(@VERBS@ 'help:what a verb takes')
    if (( CURRENT == 2 )) || [[ $words[2] == help ]]; then
        _describe verb verbs
        return
    fi
    local verb=$words[2]
    shift words
    (( CURRENT-- ))
    case $verb in
@CASES@    esac
}
_limpet "$@"
)sh",
                verbs, cases);
}

}  // namespace limpet::app
