// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "transport.hpp"

#include <host/platform/doorbell.hpp>

#include <atomic>
#include <memory>
#include <utility>

namespace tactus::host::hid
{

/// Which of two threads reads a device: its reading thread, or the tick thread that it clocks, which then need not be woken by the other
/// one. Whoever has the turn may read from the transport and write into the ring of reports. Nothing here takes a lock.
class ReadTurn
{
public:
    //==========================================================================
    // [tick thread]

    void ask() noexcept { is_wanted.store (true, std::memory_order_relaxed); }   ///< the reading thread gives it after its next report

    bool isMine() const noexcept { return is_given.load (std::memory_order_acquire); }
    Transport& transport() const noexcept { return *direct; }   ///< only while it is mine

    /// Ends the turn, if it is mine. `is_lost`: the transport has failed.
    void giveBack (bool is_lost = false) noexcept
    {
        is_wanted.store (false, std::memory_order_relaxed);
        if (! isMine()) return;
        has_failed = is_lost;
        is_given.store (false, std::memory_order_release);
        back.ring();
    }

    //==========================================================================
    // [reading thread]

    bool isWanted() const noexcept { return is_wanted.load (std::memory_order_relaxed); }

    /// Gives the turn away. Ring for the tick thread only afterwards: it may be waiting for this thread.
    void give (std::shared_ptr<Transport> to_read)
    {
        direct = std::move (to_read);
        has_failed = false;
        is_given.store (true, std::memory_order_release);
    }

    /// Waits until the turn is back, or until `isOver`. Returns true if the transport has failed meanwhile.
    template <typename IsOver>
    bool await (const IsOver& isOver)
    {
        using namespace std::chrono_literals;
        while (isMine() && ! isOver())
            back.wait (Doorbell::Clock::now() + 20ms);
        if (isMine()) return false;   // the tick thread has ended: nobody reads any more
        direct.reset();
        return has_failed;
    }

private:
    std::atomic<bool> is_wanted = false, is_given = false;
    Doorbell back;
    std::shared_ptr<Transport> direct;   // written by the reading thread while the turn is its own
    bool has_failed = false;             // written by the tick thread while the turn is its own
};

}   // namespace tactus::host::hid
