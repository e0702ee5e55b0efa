// SPDX-License-Identifier: MIT
#include "counted_memory.hpp"

#include <tactus/kit/sanitizers.hpp>

#include <algorithm>
#include <cstdlib>
#include <new>

// A sanitizer has its own memory, and free() of Windows takes no aligned memory.
#if ! TACTUS_SANITIZED && ! defined(_WIN32)
#define TACTUS_COUNTS_MEMORY 1
#endif

namespace tactus::host
{

namespace
{
thread_local CountedMemory* counting = nullptr;
}

#if defined(TACTUS_COUNTS_MEMORY)
const bool CountedMemory::counts = true;
#else
const bool CountedMemory::counts = false;
#endif

CountedMemory::CountedMemory() noexcept : outer (counting)
{
    counting = this;
}
CountedMemory::~CountedMemory() { counting = outer; }

void CountedMemory::take (const void* place, std::size_t size) noexcept
{
    if (is_node_next)
    {
        is_node_next = false;
        node_bytes += size;
        return;
    }
    constexpr std::size_t alignment = alignof (std::max_align_t);
    last[count++ % last.size()] = { place, now };
    now += (size + alignment - 1) / alignment * alignment;
    most = std::max (most, now);
}

void CountedMemory::give (const void* place) noexcept
{
    auto& newest = last[(count + last.size() - 1) % last.size()];
    if (count == 0 || newest.place != place) return;
    now = newest.begin;
    newest = {};
    --count;
}

#if defined(TACTUS_COUNTS_MEMORY)

namespace
{
void* allocated (std::size_t size, std::size_t alignment)
{
    const auto whole = std::max<std::size_t> (size, 1);
    for (;;)
    {
        const bool is_usual = alignment <= alignof (std::max_align_t);
        void* const place = is_usual ? std::malloc (whole) : std::aligned_alloc (alignment, (whole + alignment - 1) / alignment * alignment);
        if (place != nullptr)
        {
            if (counting != nullptr) counting->take (place, size);
            return place;
        }
        const auto handler = std::get_new_handler();
        if (handler == nullptr) throw std::bad_alloc();
        handler();
    }
}

void freed (void* place) noexcept
{
    if (counting != nullptr && place != nullptr) counting->give (place);
    std::free (place);
}
}   // namespace

#endif

}   // namespace tactus::host

#if defined(TACTUS_COUNTS_MEMORY)

// The forms for arrays and without exceptions call these.
void* operator new (std::size_t size) { return tactus::host::allocated (size, 0); }
void* operator new (std::size_t size, std::align_val_t alignment) { return tactus::host::allocated (size, static_cast<std::size_t> (alignment)); }
void operator delete (void* place) noexcept { tactus::host::freed (place); }
void operator delete (void* place, std::size_t) noexcept { tactus::host::freed (place); }
void operator delete (void* place, std::align_val_t) noexcept { tactus::host::freed (place); }
void operator delete (void* place, std::size_t, std::align_val_t) noexcept { tactus::host::freed (place); }

#endif
