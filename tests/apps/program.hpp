// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace limpet {

struct Finished {
    int exit_code = -1;
    std::string out;
    std::string err;

    [[nodiscard]] bool one_line_of_error() const;
};

/// Expects one line on standard error that has all of the texts.
void expect_line_of_error(const Finished& finished, int exit_code,
                          const std::vector<std::string>& texts);
/// As bad input.
inline void expect_refused(const Finished& finished, const std::vector<std::string>& texts) {
    expect_line_of_error(finished, 2, texts);
}

/// limpet in the background; killed when this goes while it still runs.
class Started {
public:
    Started(const std::filesystem::path& folder, const std::string& name,
            const std::vector<std::string>& arguments);
    ~Started();
    Started(const Started&) = delete;
    Started& operator=(const Started&) = delete;

    void signal(int number) const;
    /// @return exit code -1 when it does not end in time, or by a signal
    [[nodiscard]] Finished wait(std::chrono::seconds limit);
    /// @return whether it prints the text before it ends and in time
    [[nodiscard]] bool prints(const std::string& text, std::chrono::seconds limit);
    /// Its standard output so far.
    [[nodiscard]] std::string output() const;

private:
    /// @return whether it has ended by then
    bool ended(std::chrono::milliseconds limit);

    std::filesystem::path out_;
    std::filesystem::path err_;
    pid_t child_ = 0;
    bool running_ = false;
    int exit_code_ = -1;
};

/// A folder for one test, removed at its end.
class Bench {
public:
    Bench();
    ~Bench();
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    /// Runs limpet in the folder, without a shell.
    [[nodiscard]] Finished run(const std::vector<std::string>& arguments) const;
    /// Runs limpet in another folder.
    [[nodiscard]] Finished run_in(const std::filesystem::path& folder,
                                  const std::vector<std::string>& arguments) const;
    [[nodiscard]] std::filesystem::path write(const std::string& name,
                                              const std::string& text) const;
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// Everything in it, relative, sorted.
    [[nodiscard]] std::vector<std::string> files() const;

private:
    std::filesystem::path folder_;
};

/// What limpet prints at a terminal so wide.
[[nodiscard]] std::string on_terminal(std::vector<std::string> arguments, unsigned short columns);

[[nodiscard]] std::string text_of(const std::filesystem::path& path);

}  // namespace limpet
