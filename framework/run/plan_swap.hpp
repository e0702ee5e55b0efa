// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <deque>
#include <memory>

namespace tactus
{

/// Hands objects from the main thread to the tick thread, one after another. Each one is freed on the main thread after
/// the tick thread has switched to a later one. The tick thread never waits, allocates or frees.
template <typename T>
class PlanSwap
{
public:
    explicit PlanSwap (std::unique_ptr<T> first) : used (first.get()) { kept.push_back (std::move (first)); }

    /// The latest object. [main thread]
    T& newest() noexcept { return *kept.back(); }
    const T& newest() const noexcept { return *kept.back(); }

    /// Hands over the next object. No other object may be waiting. [main thread]
    void give (std::unique_ptr<T> next)
    {
        kept.push_back (std::move (next));
        waiting.store (kept.back().get(), std::memory_order_release);
    }

    /// Withdraws the waiting object, if there is one; the tick thread will not get it. [main thread]
    std::unique_ptr<T> takeBack()
    {
        if (waiting.exchange (nullptr, std::memory_order_acquire) == nullptr) return nullptr;
        auto back = std::move (kept.back());
        kept.pop_back();
        return back;
    }

    /// Frees objects that are no longer used. [main thread]
    void clear()
    {
        const auto* now = used.load (std::memory_order_acquire);
        while (kept.front().get() != now)
            kept.pop_front();
    }

    /// Number of objects: 1 or 2, or 3 while the tick thread has not caught up. [main thread]
    std::size_t size() const noexcept { return kept.size(); }

    /// The waiting object, or null. The old one stays in use until done() confirms the switch. [tick thread]
    T* take() noexcept { return waiting.load (std::memory_order_relaxed) ? waiting.exchange (nullptr, std::memory_order_acquire) : nullptr; }
    void done (const T* now) noexcept { used.store (now, std::memory_order_release); }

private:
    std::deque<std::unique_ptr<T>> kept;   // in the order in which they were handed over; the last one may be waiting
    std::atomic<T*> waiting = nullptr;
    std::atomic<const T*> used;
};

}   // namespace tactus
