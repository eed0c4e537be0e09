// SPDX-License-Identifier: Apache-2.0
// Stands before a reader, counts what it is given to read and times the slowest of it; `.ci/fuzz`
// calls the reader `read_one`.
#undef LLVMFuzzerTestOneInput
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <ctime>

extern "C" int read_one(const std::uint8_t* data, std::size_t size);

namespace {

struct Count {
    std::uint64_t bytes = 0;
    double slowest_s = 0.0;  // of this processor, however loaded the machine is
    ~Count() {
        std::fprintf(stderr, "bytes_read: %" PRIu64 "\nslowest_ms: %.0f\n", bytes, 1e3 * slowest_s);
    }
} count;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    count.bytes += size;
    const std::clock_t begin = std::clock();
    const int told = read_one(data, size);
    count.slowest_s =
        std::max(count.slowest_s, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    return told;
}
