// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <deque>
#include <memory>

namespace tactus
{

/// Hands things from the main thread to the tick thread, one after another, and frees each on the main thread once the
/// tick thread has gone on to a later one. The tick thread never waits, allocates or frees.
template <typename T>
class Handover
{
public:
    explicit Handover (std::unique_ptr<T> first) : used (first.get()) { kept.push_back (std::move (first)); }

    /// What will be used last, as things stand. [main thread]
    T& newest() noexcept { return *kept.back(); }

    /// Something to go on with. Nothing may be waiting. [main thread]
    void give (std::unique_ptr<T> next)
    {
        kept.push_back (std::move (next));
        waiting.store (kept.back().get(), std::memory_order_release);
    }

    /// What was given and not taken yet, if anything: it will not be taken any more. [main thread]
    std::unique_ptr<T> takeBack()
    {
        if (waiting.exchange (nullptr, std::memory_order_acquire) == nullptr) return nullptr;
        auto back = std::move (kept.back());
        kept.pop_back();
        return back;
    }

    /// Frees what is used no more. [main thread]
    void clear()
    {
        const auto* now = used.load (std::memory_order_acquire);
        while (kept.front().get() != now)
            kept.pop_front();
    }

    /// How many there are: 1 or 2, or 3 while the tick thread has not caught up. [main thread]
    std::size_t size() const noexcept { return kept.size(); }

    /// What is waiting, or null. What is used stays until done() says that this is used instead. [tick thread]
    T* take() noexcept { return waiting.load (std::memory_order_relaxed) ? waiting.exchange (nullptr, std::memory_order_acquire) : nullptr; }
    void done (const T* now) noexcept { used.store (now, std::memory_order_release); }

private:
    std::deque<std::unique_ptr<T>> kept;   // in the order they were given; the last may be waiting
    std::atomic<T*> waiting = nullptr;
    std::atomic<const T*> used;
};

}   // namespace tactus
