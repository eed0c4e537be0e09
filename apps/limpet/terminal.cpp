// SPDX-License-Identifier: Apache-2.0
#include "terminal.hpp"

#include <fmt/core.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace limpet::app {
namespace {

/// What a text is about stands in so many columns before it.
constexpr std::size_t kLabel = 11;

/// A signal handler can reach nothing else.
std::atomic<bool> interrupted = false;
std::atomic<long long> first_signal_ns = 0;
std::atomic<bool> only_the_first = false;

long long now_ns() {
    timespec now = {};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1'000'000'000LL * now.tv_sec + now.tv_nsec;
}

/// timeout(1) and some terminals send one twice, to the program and to its group.
void take_signal(int number) {
    constexpr long long kTheSame_ns = 1'000'000'000;
    if (!interrupted.exchange(true)) {
        first_signal_ns = now_ns();
    } else if (!only_the_first && now_ns() - first_signal_ns > kTheSame_ns) {
        signal(number, SIG_DFL);
        (void)raise(number);
    }
}

/// A failed write is kept by the stream: main() checks standard output at the end.
void put(std::FILE* out, const std::string& text) {
    (void)std::fwrite(text.data(), 1, text.size(), out);
    (void)std::fflush(out);
}

}  // namespace

Terminal::Terminal(Voice voice)
    : out_(voice == Voice::quiet     ? nullptr
           : voice == Voice::machine ? stderr
                                     : stdout) {
    columns_ = out_ == nullptr || voice == Voice::relayed ? 0 : columns_of(out_);
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
    put(out_, folded(text, columns_, kLabel) + "\n");
}

void Terminal::line(const std::string& about, const std::string& text) {
    line(bold(fmt::format("{:<{}}", about, kLabel)) + text);
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

void Terminal::slow_progress(const std::string& text) {
    if (live_ || out_ == nullptr) {
        progress(text);
        return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!text.empty() && now >= next_line_) {
        constexpr std::chrono::seconds kEvery{5};
        next_line_ = now + kEvery;
        line(text);
    }
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

std::size_t columns_of(std::FILE* stream) {
    struct winsize size = {};
    return isatty(fileno(stream)) != 0 && ioctl(fileno(stream), TIOCGWINSZ, &size) == 0
               ? size.ws_col
               : 0;
}

std::string folded(const std::string& line, std::size_t columns, std::size_t indent) {
    if (columns <= 2 * indent || line.size() <= columns) {
        return line;
    }
    std::string all;
    std::size_t width = 0;  // of the line that is being filled
    std::size_t blank = 0;  // in `all`: where it can be broken; 0: nowhere
    std::size_t after = 0;  // columns from there on
    bool colour = false;
    for (const char c : line) {
        all += c;
        colour = colour || c == '\033';
        const bool continued = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;  // UTF-8
        if (!colour && !continued) {
            ++width;
            ++after;
        }
        colour = colour && c != 'm';
        if (c == ' ' && width > indent) {
            blank = all.size() - 1;
            after = 0;
        } else if (width > columns && blank > 0) {
            all.replace(blank, 1, "\n" + std::string(indent, ' '));
            width = indent + after;
            blank = 0;
        }
    }
    return all;
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

const std::atomic<bool>* stop_on_signals(SecondSignal second) {
    only_the_first = second == SecondSignal::changes_nothing;
    struct sigaction action = {};
    action.sa_handler = take_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);  // the terminal is gone
    return &interrupted;
}

}  // namespace limpet::app
