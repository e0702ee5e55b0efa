// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/run/probe/port_probes.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::capi
{

/// The probes of a run for a program: the latest values, and a queue of the samples that it has not collected. A full queue loses new samples,
/// and counts them. [main thread; one thread at a time]
class ProbeQueue
{
public:
    static constexpr std::size_t most = 4096;   ///< samples in the queue: about 4 s

    /// The listener to add to the run.
    RunListener& listener() noexcept { return ports; }

    /// See PortProbes::probe. Samples of earlier ports that were not collected are gone.
    Result<> probe (Run& run, const graph::Graph& graph, const std::vector<std::string>& wanted)
    {
        auto probed = ports.probe (run, graph, wanted);
        if (! probed) return std::move (probed).error();
        begin (std::move (*probed));
        return {};
    }

    /// Call it after an edit of the run: a port of instances may have other components now.
    void follow (const Plan& plan)
    {
        if (auto now = namesOf (plan, tapsOf (plan, ports.ports())); now != all_names) begin (std::move (now));
    }

    /// Takes what the tick thread has sampled.
    void drain()
    {
        ports.drain ([&] (std::uint64_t tick, std::span<const double> now) {
            if (! queue || now.size() != latest.size()) return;
            std::ranges::copy (now, latest.begin());
            if (const auto row = queue->claim(); ! row.empty())
            {
                row[0] = static_cast<double> (tick);
                std::ranges::copy (now, row.begin() + 1);
            }
            queue->commit();
        });
    }

    /// Moves samples, the oldest first, into up to `count` rows, and their ticks, if `ticks` is not null. Returns how many.
    std::size_t collect (std::uint64_t* ticks, double* rows, std::size_t count)
    {
        drain();
        if (rows == nullptr || ! queue) return 0;
        const auto width = latest.size();
        std::size_t got = 0;
        for (; got < count; ++got)
        {
            const auto row = queue->front();
            if (row.empty()) break;
            if (ticks != nullptr) ticks[got] = static_cast<std::uint64_t> (row[0]);
            std::copy_n (row.begin() + 1, width, rows + got * width);
            queue->take (1);
        }
        return got;
    }

    const std::vector<std::string>& names() const noexcept { return all_names; }   ///< of the components
    const std::vector<double>& values() const noexcept { return latest; }          ///< the latest ones; not a number until there are some
    std::uint64_t lost() const noexcept { return lost_before + ports.lost() + (queue ? queue->lost() : 0); }

private:
    void begin (std::vector<std::string> names)
    {
        all_names = std::move (names);
        latest.assign (all_names.size(), std::numeric_limits<double>::quiet_NaN());
        lost_before += queue ? queue->lost() : 0;
        queue = all_names.empty() ? nullptr : std::make_unique<SpscRing<double>> (most, 1 + all_names.size());
    }

    PortProbes ports;
    std::vector<std::string> all_names;
    std::vector<double> latest;
    std::unique_ptr<SpscRing<double>> queue;   // rows of the tick, which is exact below 2^53, and the values
    std::uint64_t lost_before = 0;             // by earlier queues
};

}   // namespace tactus::capi
