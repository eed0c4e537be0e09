// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace limpet {

struct Finished {
    int exit_code = -1;
    std::string out;
    std::string err;

    [[nodiscard]] bool one_line_of_error() const;
};

/// A program that goes on until it is told to end. Killed when it has not been.
class Running {
public:
    Running(int pid, std::filesystem::path out, std::filesystem::path err);
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    [[nodiscard]] Finished wait();
    /// Ctrl-C, and its end.
    [[nodiscard]] Finished interrupt();

private:
    int pid_;
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
    /// The same, without waiting for its end.
    [[nodiscard]] std::unique_ptr<Running> start(const std::vector<std::string>& arguments) const;
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
