// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace limpet::app {

/// Where a verb talks to a person: standard output, or standard error when the output is for a
/// program; or nowhere.
class Terminal {
public:
    enum class Voice {
        normal,   ///< standard output
        machine,  ///< standard error: standard output carries JSON
        relayed,  ///< standard output, plain lines: who relays it hides whether a person watches
        quiet,    ///< nowhere
    };
    explicit Terminal(Voice voice);
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    void line(const std::string& text);
    /// What the text is about, then the text.
    void line(const std::string& about, const std::string& text);
    /// What was written, a line a file.
    void written(const std::vector<std::filesystem::path>& files);
    /// A line that the next one replaces; nothing where no person watches.
    void progress(const std::string& text);
    /// The same of work that may be long: where no person watches, a line now and then, from the
    /// third second on.
    void slow_progress(const std::string& text);
    /// Whether a person watches, so that progress() shows.
    [[nodiscard]] bool live() const { return live_; }
    [[nodiscard]] std::string bold(const std::string& text) const;
    [[nodiscard]] std::string dim(const std::string& text) const;

private:
    void clear_progress();

    std::FILE* out_;           ///< nullptr: quiet
    std::size_t columns_ = 0;  ///< lines are folded to; 0: never
    bool live_ = false;
    bool progress_shown_ = false;
    std::chrono::steady_clock::time_point next_line_ =
        std::chrono::steady_clock::now() + std::chrono::seconds(3);
};

/// Columns of the terminal behind a stream; 0 where there is none.
[[nodiscard]] std::size_t columns_of(std::FILE* stream);
/// A line broken at blanks into such of at most `columns`, all but the first indented. Colours do
/// not count. A word that is longer stays whole.
/// @param columns  0: any length
[[nodiscard]] std::string folded(const std::string& line, std::size_t columns, std::size_t indent);

/// One line on standard error, "limpet: " before it, so that scripts and people find it. A standard
/// error that takes nothing changes no exit code.
void complain(std::string message);

enum class SecondSignal {
    ends,             ///< the program as ever, if it comes a second or more after the first
    changes_nothing,  ///< a vehicle is in the air: what the first began goes on
};

/// From now on the first Ctrl-C, SIGTERM or SIGHUP sets the flag, for long work to end in good
/// order.
[[nodiscard]] const std::atomic<bool>* stop_on_signals(SecondSignal second = SecondSignal::ends);

}  // namespace limpet::app
