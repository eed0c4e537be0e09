// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>  // __GLIBC__

/// Before the definition of a function that is mostly plain loops or small matrices: it is compiled
/// twice, and the loader takes the one with wide vectors where the machine has them. Both give the
/// same bits: nothing is fused (-ffp-contract=off), and no sum is taken in another order. Not for
/// virtual functions. Where a compiler (GCC 10 with -fno-semantic-interposition) or a sanitizer
/// does not follow, the function is as written.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GLIBC__) && __GNUC__ >= 11 && \
    !defined(__clang__) && !defined(__AVX2__) && !defined(__SANITIZE_ADDRESS__) &&           \
    !defined(__SANITIZE_THREAD__)
#define LIMPET_FOR_MACHINES [[gnu::target_clones("avx2", "default")]]
#else
#define LIMPET_FOR_MACHINES
#endif
