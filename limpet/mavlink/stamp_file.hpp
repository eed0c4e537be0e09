// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "limpet/mavlink/signing.hpp"

namespace limpet::mavlink {

/// Signing timestamps in a file, so that they outlive a restart:
///
///   limpet signing stamps 1
///   time 37700000000000          the last one used or seen
///   1 1 0 37699999999000         system, component, link id, timestamp of a sender's last frame
///   ended                        nothing came after these; missing: a session runs, or was killed
///
/// A thread of its own writes what changed every kEvery and at the end: next to its place, then
/// renamed.
class StampFile {
public:
    /// What is used and received within it is lost when the process is killed or the power cut.
    static constexpr std::chrono::seconds kEvery{10};

    /// Reads it, if it is there, and writes it anew, to know that it can be.
    /// @throws InputError  one line: over 1 MB, not of this form, cannot be read or written
    explicit StampFile(std::filesystem::path path, std::chrono::milliseconds every = kEvery);
    /// Writes what was offered last.
    ~StampFile();
    StampFile(const StampFile&) = delete;
    StampFile& operator=(const StampFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// As it was in the file; all zeros: there was none.
    [[nodiscard]] const SigningStamps& before() const { return before_; }

    /// To be written; never waits: what meets the thread at work is left to the next offer.
    void offer(const SigningStamps& stamps);
    /// The last ones, for its end; waits.
    void close_with(const SigningStamps& stamps);
    /// Why the last writing failed; empty: it did not.
    [[nodiscard]] std::string trouble() const;

private:
    void work(const std::stop_token& over, std::chrono::milliseconds every);

    std::filesystem::path path_;
    SigningStamps before_;
    mutable std::mutex mutex_;
    std::condition_variable_any wake_;
    SigningStamps offered_;
    bool changed_ = false;
    std::string trouble_;
    std::jthread thread_;  ///< last: starts when all the rest is there
};

/// @throws InputError as StampFile; a file that is not there is all zeros
[[nodiscard]] SigningStamps read_stamps(const std::filesystem::path& path);

}  // namespace limpet::mavlink
