// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>
#include <host/runtime/ring_index.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus::host::hid
{

/// When, by the steady clock, in ns.
using Nanoseconds = std::int64_t;

/// What a device sent, as it came.
struct ArrivedReport
{
    std::span<const std::uint8_t> bytes;
    Nanoseconds at = 0;
    std::uint64_t connection = 0;   ///< counted from 1: another one after the device was away
};

/// Reports from the thread that reads a device to the one that makes something of them. Neither ever waits: what finds no
/// room is lost, and whoever takes reports out is told so.
class ReportRing
{
public:
    /// Reports longer than `longest` are cut to one byte more, so that one sees that they were too long.
    ReportRing (std::size_t longest, std::size_t reports) : room (longest + 1), index (reports), entries (reports), bytes (room * reports) {}

    void push (std::span<const std::uint8_t> report, Nanoseconds at, std::uint64_t connection) noexcept   // [reading thread]
    {
        const auto slot = index.next();
        if (! slot)
        {
            lost_reports.fetch_add (1, std::memory_order_relaxed);
            return;
        }
        const auto size = std::min (report.size(), room);
        std::copy_n (report.begin(), size, bytes.begin() + static_cast<std::ptrdiff_t> (*slot * room));
        entries[*slot] = { size, at, connection };
        index.push();
    }

    template <typename F>
    void drain (F&& f)   // [taking thread]
    {
        index.drain ([&] (std::size_t slot)
                     { f (ArrivedReport { std::span (bytes).subspan (slot * room, entries[slot].size), entries[slot].at, entries[slot].connection }); });
    }

    std::uint64_t lost() const noexcept { return lost_reports.load (std::memory_order_relaxed); }   // [any thread]

private:
    struct Entry
    {
        std::size_t size = 0;
        Nanoseconds at = 0;
        std::uint64_t connection = 0;
    };

    std::size_t room;
    RingIndex index;
    std::vector<Entry> entries;
    std::vector<std::uint8_t> bytes;
    std::atomic<std::uint64_t> lost_reports = 0;
};

}   // namespace tactus::host::hid
