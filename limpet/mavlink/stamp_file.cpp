// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/stamp_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "limpet/core/errors.hpp"
#include "limpet/core/read_file.hpp"

namespace limpet::mavlink {
namespace {

constexpr std::string_view kHead = "limpet signing stamps 1";
constexpr std::string_view kEnded = "ended\n";

enum class Flush {
    later,    ///< when the system likes: a flush may hold up who writes a recording to that disk
    at_once,  ///< also a power cut leaves it whole
};

/// @return errno, 0: written
int write_whole(const std::filesystem::path& path, const SigningStamps& stamps, Flush flush) {
    std::string text = fmt::format("{}\ntime {}\n", kHead, stamps.timestamp);
    for (std::size_t k = 0; k < stamps.senders; ++k) {
        const SigningStamps::Heard& heard = stamps.heard[k];
        text += fmt::format("{} {} {} {}\n", heard.system, heard.component, heard.link_id,
                            heard.timestamp);
    }
    text += stamps.are_last ? kEnded : "";
    const std::string part = path.string() + ".part";
    const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0) {
        return errno;
    }
    int error = 0;
    const ssize_t written = write(file, text.data(), text.size());
    if (written != static_cast<ssize_t>(text.size())) {
        error = written < 0 ? errno : ENOSPC;
    } else if (flush == Flush::at_once && fsync(file) != 0) {
        error = errno;
    }
    close(file);
    if (error == 0 && std::rename(part.c_str(), path.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) {
        (void)unlink(part.c_str());
    }
    return error;
}

/// @return the numbers of a line, parted by blanks; nothing where it holds others
template <std::size_t kCount>
std::optional<std::array<std::uint64_t, kCount>> numbers(std::string_view line) {
    std::array<std::uint64_t, kCount> values = {};
    for (std::size_t k = 0; k < kCount; ++k) {
        if (k > 0 && (line.empty() || line.front() != ' ')) {
            return std::nullopt;
        }
        line.remove_prefix(k > 0 ? 1 : 0);
        const auto [end, error] =
            std::from_chars(line.data(), line.data() + line.size(), values[k]);
        if (error != std::errc()) {
            return std::nullopt;
        }
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    }
    return line.empty() ? std::optional(values) : std::nullopt;
}

std::optional<SigningStamps::Heard> sender_of(std::string_view line) {
    const auto values = numbers<4>(line);
    if (!values || (*values)[0] > 255 || (*values)[1] > 255 || (*values)[2] > 255 ||
        (*values)[3] > kLargestTimestamp) {
        return std::nullopt;
    }
    return SigningStamps::Heard{.system = static_cast<std::uint8_t>((*values)[0]),
                                .component = static_cast<std::uint8_t>((*values)[1]),
                                .link_id = static_cast<std::uint8_t>((*values)[2]),
                                .timestamp = (*values)[3]};
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::size_t line) {
    throw InputError(
        fmt::format("{}:{}: is broken; put a whole one back, or delete it (frames of the last "
                    "session can then be played again)",
                    path.string(), line));
}

}  // namespace

SigningStamps read_stamps(const std::filesystem::path& path) {
    SigningStamps stamps;
    std::error_code ignored;
    if (!std::filesystem::exists(std::filesystem::symlink_status(path, ignored))) {
        return stamps;
    }
    std::string text = read_file(path, {.what = "file of signing stamps", .most_MB = 1});
    stamps.are_last = text.ends_with(kEnded);
    text.resize(text.size() - (stamps.are_last ? kEnded.size() : 0));
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        ++number;
        if (end == std::string::npos) {
            refuse(path, number);
        }
        const std::string_view line = std::string_view(text).substr(begin, end - begin);
        begin = end + 1;
        constexpr std::string_view kTime = "time ";
        if (number == 1 && line == kHead) {
            continue;
        }
        if (number == 2 && line.starts_with(kTime)) {
            if (const auto time = numbers<1>(line.substr(kTime.size()));
                time && (*time)[0] <= kLargestTimestamp) {
                stamps.timestamp = (*time)[0];
                continue;
            }
        }
        const auto sender = number > 2 ? sender_of(line) : std::nullopt;
        if (!sender || stamps.senders == SigningStamps::kMaxSenders) {
            refuse(path, number);
        }
        stamps.heard[stamps.senders++] = *sender;
    }
    if (number < 2) {
        refuse(path, number + 1);
    }
    return stamps;
}

StampFile::StampFile(std::filesystem::path path, std::chrono::milliseconds every)
    : path_(std::move(path)), before_(read_stamps(path_)), offered_(before_) {
    offered_.are_last = false;
    if (const int error = write_whole(path_, offered_, Flush::at_once); error != 0) {
        throw InputError(fmt::format("signing stamps {}: cannot be written: {}", path_.string(),
                                     std::strerror(error)));
    }
    thread_ = std::jthread([this, every](const std::stop_token& over) { work(over, every); });
}

StampFile::~StampFile() {
    thread_.request_stop();
    thread_.join();
    try {
        (void)write_whole(path_, offered_, Flush::at_once);
    } catch (const std::bad_alloc&) {  // as if it had been cut off: what was written last stands
    }
}

void StampFile::offer(const SigningStamps& stamps) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock) {
        offered_ = stamps;
        offered_.are_last = false;
        changed_ = true;
    }
}

void StampFile::close_with(const SigningStamps& stamps) {
    const std::lock_guard lock(mutex_);
    offered_ = stamps;
    offered_.are_last = true;
}

std::string StampFile::trouble() const {
    const std::lock_guard lock(mutex_);
    return trouble_;
}

void StampFile::work(const std::stop_token& over, std::chrono::milliseconds every) {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, over, every, [] { return false; }) && !over.stop_requested()) {
        if (!std::exchange(changed_, false)) {
            continue;
        }
        const SigningStamps stamps = offered_;
        lock.unlock();
        std::string trouble;
        try {
            const int error = write_whole(path_, stamps, Flush::later);
            trouble = error == 0 ? "" : fmt::format("{}: {}", path_.string(), std::strerror(error));
        } catch (const std::bad_alloc&) {
            trouble = "no memory";  // short enough to lie in the object
        }
        lock.lock();
        trouble_ = std::move(trouble);
    }
}

}  // namespace limpet::mavlink
