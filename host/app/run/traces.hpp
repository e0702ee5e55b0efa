// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/plan/plan.hpp>
#include <tactus/run/probe_ring.hpp>
#include <tactus/run/run.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The latest values of one component of a port, one per tick. Ticks that were missed because the window was busy are nan. [main thread]
class Trace
{
public:
    static constexpr double seconds = 10.0;   ///< length of a trace

    Trace (const Tap& tap, double rate_hz);

    const std::string& name() const noexcept { return tap_name; }   ///< "drag.force.x"
    Quantity quantity() const noexcept { return what; }
    const std::string& unit() const noexcept { return si; }
    double rate() const noexcept { return rate_hz; }

    std::uint64_t begin() const noexcept { return end_tick - std::min<std::uint64_t> (end_tick - first_tick, values.size()); }
    std::uint64_t end() const noexcept { return end_tick; }             ///< one after the latest tick
    std::uint64_t beginnings() const noexcept { return times_begun; }   ///< the number of times it was started over
    double at (std::uint64_t tick) const noexcept { return values[tick % values.size()]; }

    /// Calls f (tick, value) for each tick in [from, to) that is stored.
    template <typename F>
    void each (std::uint64_t from, std::uint64_t to, F&& f) const
    {
        from = std::max (from, begin());
        to = std::min (to, end());
        auto place = static_cast<std::size_t> (from % values.size());
        for (; from < to; ++from)
        {
            f (from, values[place]);
            if (++place == values.size()) place = 0;
        }
    }

    void add (std::uint64_t tick, double) noexcept;

private:
    std::string tap_name;
    Quantity what;
    std::string si;
    double rate_hz;
    std::vector<double> values;   // a ring buffer
    std::uint64_t first_tick = 0, end_tick = 0, times_begun = 0;
};

/// Records the ports that its clients request. A port that several clients request is recorded once. [main thread]
class Traces final : public RunListener
{
public:
    /// The order in which clients are served, because a run records only so many components.
    enum class Rank
    {
        first,   ///< levels: a few numbers; without them, a layer would seem silent
        usual,
        spare   ///< whole ports, in the room that the others leave; a port left out counts as not requested
    };

    /// Requests ports for as long as it lives.
    class Client
    {
    public:
        explicit Client (Traces& t, Rank r = Rank::usual) : traces (t), rank (r) { traces.clients.push_back (this); }
        ~Client();
        Client (const Client&) = delete;
        Client& operator= (const Client&) = delete;

        /// Requests these ports, such as "drag.force", and no others. A port that does not exist is left out until it exists.
        void want (std::vector<std::string>);
        const std::vector<std::string>& wanted() const noexcept { return ports; }

        /// The components of a port, in order. Empty if the port does not exist, or if nothing has run yet.
        std::vector<std::shared_ptr<const Trace>> of (const std::string& port) const { return traces.of (port); }

        /// Of all clients: see Traces.
        const std::vector<std::string>& leftOut() const noexcept { return traces.leftOut(); }

        std::uint64_t changes() const noexcept { return traces.changes; }   ///< counts what has changed any trace

    private:
        friend Traces;
        Traces& traces;
        Rank rank;
        std::vector<std::string> ports;
    };

    /// All requested ports, each once, in the order in which they are served.
    std::vector<std::string> ports() const override;

    std::vector<std::shared_ptr<const Trace>> of (const std::string& port) const;

    std::function<void()> onWanted;   ///< called when the requested ports have changed

    /// The requested components that exist, but exceed the number that can be recorded.
    const std::vector<std::string>& leftOut() const noexcept { return too_many; }

    /// Drops the traces of earlier runs.
    void clear()
    {
        by_name.clear();
        ++changes;
    }

    void planComes (const Plan&) override;
    void after (const Plan& plan, std::uint64_t tick, bool) noexcept override { ring.note (plan, tick); }
    void collect();   ///< call many times a second

private:
    std::vector<std::pair<std::string, Rank>> requests() const;

    static constexpr std::size_t most_plans = 64;   ///< plans whose frames may still be in the ring

    ProbeRing ring;
    std::vector<std::uint64_t> selected;   ///< serials of plans that all have the same taps
    std::vector<std::size_t> taps;
    std::vector<std::shared_ptr<Trace>> in_frame;   ///< the trace of each value in a frame
    std::map<std::string, std::shared_ptr<Trace>> by_name;
    std::vector<std::string> too_many;
    std::vector<Client*> clients;
    std::uint64_t changes = 0;
};

}   // namespace tactus::host
