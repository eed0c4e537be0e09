// SPDX-License-Identifier: Apache-2.0
#include "allocations.hpp"

#include <cstdlib>
#include <new>

namespace {
thread_local long count = 0;
thread_local unsigned long bytes = 0;
}  // namespace

/// As std::stable_sort() and std::inplace_merge() ask; a sanitizer's own would not go with our
/// delete.
void* operator new(std::size_t size, const std::nothrow_t& /*none*/) noexcept {
    ++count;
    bytes += size;
    return std::malloc(size > 0 ? size : 1);
}
void* operator new(std::size_t size) {
    if (void* memory = operator new(size, std::nothrow)) {
        return memory;
    }
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

long limpet::allocations() {
    return count;
}
unsigned long limpet::allocated_bytes() {
    return bytes;
}
