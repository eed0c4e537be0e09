// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace limpet::lab {

/// @throws InputError when it is no JSON object
[[nodiscard]] nlohmann::json object_in(std::string_view request);

/// A count, read in the width that it came in.
/// @param otherwise  where it is left out; nothing: it must be there
/// @throws InputError naming `key` unless it is a whole number in least..most
[[nodiscard]] std::uint32_t whole_in(const nlohmann::json& request, const char* key,
                                     std::uint32_t least, std::uint32_t most,
                                     std::optional<std::uint32_t> otherwise = {});

/// A scenario with what differs from it.
struct FlightRequest {
    std::string scenario;
    std::vector<std::string> changes;  ///< "key=value" each
    bool brief = false;
    std::vector<std::string> topics;  ///< that the recording is to have; none: all of them
};
/// @param first  scenario where none is named
/// @throws InputError when it is none, or its scenario a path
[[nodiscard]] FlightRequest flight_request_in(const nlohmann::json& request,
                                              const std::string& first);

/// What ended work on other threads, for the next request of its state.
class Trouble {
public:
    /// Within a catch: keeps the first.
    void keep();
    void clear();
    /// @throws what was kept, if anything
    void say() const;

private:
    mutable std::mutex guards_it_;
    std::exception_ptr first_;
};

/// @param running  set, and cleared again where there is no thread to be had: that is thrown
template <class Work>
[[nodiscard]] std::jthread begin_thread(std::atomic<bool>& running, Work work) {
    running = true;
    try {
        return std::jthread(std::move(work));
    } catch (...) {
        running = false;
        throw;
    }
}

/// @return a file's bytes; the file is removed
[[nodiscard]] std::string taken(const std::filesystem::path& file);

}  // namespace limpet::lab
