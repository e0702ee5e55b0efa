// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>   // so that __GLIBC__ is known where this comes first

/// Counts what has no place on the tick thread: while one of these lives, every call of malloc and its family and
/// every lock of a mutex, shared or not, on this thread. Under ASan and TSan, which have an allocator of their own, it counts nothing.
class NoAllocation
{
public:
    static constexpr bool watches =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || ! defined(__GLIBC__)
        false;
#else
        true;
#endif

    NoAllocation() noexcept;
    ~NoAllocation();
    NoAllocation (const NoAllocation&) = delete;
    NoAllocation& operator= (const NoAllocation&) = delete;

    int allocations() const noexcept;
    int locks() const noexcept;
};
