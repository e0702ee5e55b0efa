// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace tactus::examine
{

/// Remembers which hook of a node was entered last. If the process ends in the hook or never leaves the hook, another process that
/// shares the memory can name it. [any thread]
class Stage
{
public:
    /// `hook` is a literal.
    static void enter (const char* hook) noexcept { place.load (std::memory_order_relaxed)->store (hook, std::memory_order_relaxed); }

    /// From now on, the name is stored at `where`; if that is null, in a variable that is never read.
    static void keepIn (std::atomic<const char*>* where) noexcept { place.store (where != nullptr ? where : &unseen, std::memory_order_relaxed); }

private:
    static inline std::atomic<const char*> unseen { nullptr };
    static inline std::atomic<std::atomic<const char*>*> place { &unseen };
};

}   // namespace tactus::examine
