// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

namespace tactus::examine
{

/// Remembers which hook of a node was entered last. If the process ends in the hook or never leaves the hook, another process that
/// shares the memory can name it. [any thread]
class Stage
{
public:
    struct Place
    {
        std::atomic<const char*> hook;
        std::atomic<std::uint32_t> calls;   ///< changes whenever a hook is entered
    };

    /// `hook` is a literal.
    static void enter (const char* hook) noexcept
    {
        auto& here = *place.load (std::memory_order_relaxed);
        here.hook.store (hook, std::memory_order_relaxed);
        here.calls.store (here.calls.load (std::memory_order_relaxed) + 1, std::memory_order_relaxed);   // cheaper than an exact count, which nobody needs
    }

    /// From now on, the name is stored at `where`; if that is null, in a variable that is never read.
    static void keepIn (Place* where) noexcept { place.store (where != nullptr ? where : &unseen, std::memory_order_relaxed); }

private:
    static inline Place unseen;
    static inline std::atomic<Place*> place { &unseen };
};

}   // namespace tactus::examine
