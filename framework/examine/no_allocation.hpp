// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/sanitizers.hpp>

#include <cstddef>   // defines __GLIBC__, even if this header is included first

namespace tactus::examine
{

/// Counts operations that the tick thread must avoid. While an instance exists, it counts, on this thread, every call to malloc and
/// its family and every lock of a mutex or a shared mutex. Under ASan and TSan, which have their own allocator, it counts nothing.
/// A program counts only if it links this class: malloc and the locks of the C library are then replaced by functions that count.
class NoAllocation
{
public:
    static constexpr bool watches =
#if TACTUS_SANITIZED || ! defined(__GLIBC__)
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

}   // namespace tactus::examine
