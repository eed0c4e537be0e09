// SPDX-License-Identifier: Apache-2.0
#include "terminal.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>

namespace limpet::app {

Terminal::Terminal(Voice voice)
    : out_(voice == Voice::quiet     ? nullptr
           : voice == Voice::machine ? stderr
                                     : stdout) {
    live_ = out_ != nullptr && isatty(fileno(out_)) != 0 && std::getenv("NO_COLOR") == nullptr;
}

Terminal::~Terminal() {
    clear_progress();
}

void Terminal::line(const std::string& text) {
    if (out_ == nullptr) {
        return;
    }
    clear_progress();
    fmt::print(out_, "{}\n", text);
    std::fflush(out_);
}

void Terminal::progress(const std::string& text) {
    if (!live_) {
        return;
    }
    fmt::print(out_, "\r\033[K{}", text);
    std::fflush(out_);
    progress_shown_ = true;
}

std::string Terminal::bold(const std::string& text) const {
    return live_ ? "\033[1m" + text + "\033[0m" : text;
}

std::string Terminal::dim(const std::string& text) const {
    return live_ ? "\033[2m" + text + "\033[0m" : text;
}

void Terminal::clear_progress() {
    if (progress_shown_) {
        fmt::print(out_, "\r\033[K");
        std::fflush(out_);
        progress_shown_ = false;
    }
}

}  // namespace limpet::app
