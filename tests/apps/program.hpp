// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace limpet {

struct Finished {
    int exit_code = -1;
    std::string out;
    std::string err;

    [[nodiscard]] bool one_line_of_error() const;
};

/// A limpet that runs beside the test; killed if it is still there at the end.
class Running {
public:
    Running(int child, std::filesystem::path out, std::filesystem::path err)
        : child_(child), out_(std::move(out)), err_(std::move(err)) {}
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    /// @return exit_code -1 and what it has said so far when it is not done by then
    [[nodiscard]] Finished wait(double limit_s);
    void interrupt() const;  ///< as Ctrl-C
    /// Waits until its standard output holds the text.
    [[nodiscard]] bool says(std::string_view text, double limit_s) const;

private:
    int child_;
    std::filesystem::path out_;
    std::filesystem::path err_;
};

/// A folder of its own for one test, gone with it.
class Bench {
public:
    Bench();
    ~Bench();
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    /// Runs limpet in the folder. Arguments are taken as they are, no shell looks at them.
    [[nodiscard]] Finished run(const std::vector<std::string>& arguments) const;
    /// Starts limpet in the folder and does not wait for it.
    /// @param name  of this run, for its output
    [[nodiscard]] std::unique_ptr<Running> start(const std::string& name,
                                                 const std::vector<std::string>& arguments) const;
    [[nodiscard]] std::filesystem::path write(const std::string& name,
                                              const std::string& text) const;
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// Everything in it, relative, sorted.
    [[nodiscard]] std::vector<std::string> files() const;

private:
    std::filesystem::path folder_;
};

[[nodiscard]] std::string text_of(const std::filesystem::path& path);

}  // namespace limpet
