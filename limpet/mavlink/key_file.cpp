// SPDX-License-Identifier: Apache-2.0
#include "limpet/mavlink/key_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "limpet/core/errors.hpp"

namespace limpet::mavlink {
namespace {

constexpr std::size_t kMostBytes = 200;  // 64 digits and any blanks that people leave

void check_mode(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        throw InputError(fmt::format("signing key {}: {}", path, std::strerror(errno)));
    }
    if (!S_ISREG(status.st_mode)) {
        throw InputError(fmt::format("signing key {}: is not a file", path));
    }
    constexpr unsigned kOthers = 077;
    if ((status.st_mode & kOthers) != 0) {
        throw InputError(
            fmt::format("signing key {}: others may read or write it (mode {:04o}); chmod 600 {}",
                        path, status.st_mode & 07777U, path));
    }
}

std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text(kMostBytes + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (!file.is_open() || file.bad()) {
        throw InputError(fmt::format("signing key {}: cannot be read", path));
    }
    return text;
}

std::optional<SigningKey> from_hex(std::string_view text) {
    SigningKey key = {};
    if (text.size() != 2 * key.size()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < key.size(); ++i) {
        const char* at = text.data() + 2 * i;
        if (std::from_chars(at, at + 2, key[i], 16).ptr != at + 2) {
            return std::nullopt;
        }
    }
    return key;
}

std::string_view without_blanks(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::uint64_t machine_time_us() {
    using namespace std::chrono;
    return static_cast<std::uint64_t>(
        duration_cast<microseconds>(system_clock::now().time_since_epoch()).count());
}

/// A clock that stands at the timestamp kept at least; where the last ones used are not known, as
/// far beyond as they may be.
std::function<std::uint64_t()> not_before(const SigningStamps& kept,
                                          std::function<std::uint64_t()> clock) {
    using namespace std::chrono;
    const microseconds lost = kept.are_last ? 0s : 2 * StampFile::kEvery;
    const std::uint64_t begin_us =
        unix_time_us(kept.timestamp) + static_cast<std::uint64_t>(lost.count());
    return [begin_us, clock = std::move(clock), begin = steady_clock::now()] {
        const auto gone = duration_cast<microseconds>(steady_clock::now() - begin).count();
        return std::max(clock(), begin_us + static_cast<std::uint64_t>(gone));
    };
}

}  // namespace

SigningKey read_signing_key(const std::filesystem::path& path) {
    check_mode(path.string());
    const std::string text = content(path.string());
    std::optional<SigningKey> key = from_hex(without_blanks(text));
    if (!key && text.size() == SigningKey{}.size()) {
        key.emplace();
        std::copy(text.begin(), text.end(), key->begin());
    }
    if (!key) {
        throw InputError(
            fmt::format("signing key {}: must be 64 hex digits, or 32 bytes", path.string()));
    }
    if (std::all_of(key->begin(), key->end(), [](std::uint8_t byte) { return byte == 0; })) {
        throw InputError(
            fmt::format("signing key {}: all zeros is nobody's secret", path.string()));
    }
    return *key;
}

void sign(Link& link, const std::filesystem::path& key_file, std::uint8_t link_id) {
    if (key_file.empty()) {
        return;
    }
    link.sign({.key = read_signing_key(key_file), .link_id = link_id, .unix_us = machine_time_us});
}

std::filesystem::path stamp_path(const std::filesystem::path& key_file,
                                 const std::filesystem::path& folder, const Sender& self,
                                 std::uint8_t link_id) {
    return (folder.empty() ? key_file.parent_path() : folder) /
           fmt::format("{}.stamps-{}-{}-{}", key_file.filename().string(), self.system,
                       self.component, link_id);
}

std::string sign_and_keep(Link& link, const std::filesystem::path& key_file,
                          const std::filesystem::path& folder, std::uint8_t link_id,
                          const std::function<std::uint64_t()>& now_us) {
    if (key_file.empty()) {
        return "";
    }
    LinkSigning signing{.key = read_signing_key(key_file),
                        .link_id = link_id,
                        .unix_us = now_us ? now_us : machine_time_us};
    signing.stamps =
        std::make_shared<StampFile>(stamp_path(key_file, folder, link.self(), link_id));
    const SigningStamps& kept = signing.stamps->before();
    const std::uint64_t now = signing_time(signing.unix_us());
    std::string notice;
    if (now < kept.timestamp) {
        notice =
            fmt::format("signing: this machine's clock is {} s behind {}; time goes on from there",
                        (kept.timestamp - now) / kSigningSecond, signing.stamps->path().string());
        signing.unix_us = not_before(kept, std::move(signing.unix_us));
    }
    link.sign(std::move(signing));
    return notice;
}

}  // namespace limpet::mavlink
