// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "limpet/core/errors.hpp"

namespace limpet::fuzz {

/// Bytes in memory that a reader of files can open.
class AsFile {
public:
    AsFile(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("fuzz", 0)) {
        if (descriptor_ < 0 || write(descriptor_, data, size) != static_cast<ssize_t>(size)) {
            std::abort();
        }
    }
    ~AsFile() { close(descriptor_); }
    AsFile(const AsFile&) = delete;
    AsFile& operator=(const AsFile&) = delete;

    [[nodiscard]] std::filesystem::path path() const {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

private:
    int descriptor_;
};

/// Reads or refuses with one line; all else ends the fuzzer.
template <class Read>
int read_or_refuse(const Read& read) {
    try {
        read();
    } catch (const InputError& error) {
        if (std::string(error.what()).empty()) {
            std::abort();
        }
    }
    return 0;
}

}  // namespace limpet::fuzz
