// SPDX-License-Identifier: Apache-2.0
// Stands before a reader and counts what it is given to read; `.ci/fuzz` calls the reader
// `read_one`.
#undef LLVMFuzzerTestOneInput
#include <cinttypes>
#include <cstdio>

extern "C" int read_one(const std::uint8_t* data, std::size_t size);

namespace {

struct Count {
    std::uint64_t bytes = 0;
    ~Count() { std::fprintf(stderr, "bytes_read: %" PRIu64 "\n", bytes); }
} count;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    count.bytes += size;
    return read_one(data, size);
}
