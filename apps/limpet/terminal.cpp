// SPDX-License-Identifier: Apache-2.0
#include "terminal.hpp"

#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace limpet::app {
namespace {

/// A signal handler can reach nothing else.
std::atomic<bool> interrupted = false;

/// What does not get there is known to the stream: main() asks standard output in the end.
void put(std::FILE* out, const std::string& text) {
    (void)std::fwrite(text.data(), 1, text.size(), out);
    (void)std::fflush(out);
}

}  // namespace

Terminal::Terminal(Voice voice)
    : out_(voice == Voice::quiet     ? nullptr
           : voice == Voice::machine ? stderr
                                     : stdout) {
    live_ = out_ != nullptr && voice != Voice::relayed && isatty(fileno(out_)) != 0 &&
            std::getenv("NO_COLOR") == nullptr;
}

Terminal::~Terminal() {
    clear_progress();
}

void Terminal::line(const std::string& text) {
    if (out_ == nullptr) {
        return;
    }
    clear_progress();
    put(out_, text + "\n");
}

void Terminal::line(const std::string& about, const std::string& text) {
    line(bold(fmt::format("{:<11}", about)) + text);
}

void Terminal::written(const std::vector<std::filesystem::path>& files) {
    std::string about = "written";
    for (const std::filesystem::path& file : files) {
        line(std::exchange(about, ""), file.string());
    }
}

void Terminal::progress(const std::string& text) {
    if (!live_) {
        return;
    }
    put(out_, "\r\033[K" + text);
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
        put(out_, "\r\033[K");
        progress_shown_ = false;
    }
}

void complain(std::string message) {
    constexpr std::size_t kLongest = 4000;
    if (message.size() > kLongest) {
        message.resize(kLongest);
        message += "...";
    }
    std::replace_if(
        message.begin(), message.end(), [](char c) { return c == 127 || (c >= 0 && c < ' '); },
        ' ');
    put(stderr, "limpet: " + message + "\n");
}

const std::atomic<bool>* stop_on_signals() {
    struct sigaction action = {};
    action.sa_handler = [](int) { interrupted = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);  // the terminal is gone
    return &interrupted;
}

}  // namespace limpet::app
