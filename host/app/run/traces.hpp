// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/plan/plan.hpp>
#include <host/runtime/probe_ring.hpp>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// What stood on one component of a port on the latest ticks. A tick that was missed, since the window was busy for long,
/// is nan. [main thread]
class Trace
{
public:
    static constexpr double seconds = 10.0;   ///< how far back it goes

    Trace (const Tap& tap, double rate_hz);

    const std::string& name() const noexcept { return tap_name; }   ///< "drag.force.x"
    Quantity quantity() const noexcept { return what; }
    const std::string& unit() const noexcept { return si; }
    double rate() const noexcept { return rate_hz; }

    std::uint64_t begin() const noexcept { return end_tick - std::min<std::uint64_t> (end_tick - first_tick, values.size()); }
    std::uint64_t end() const noexcept { return end_tick; }   ///< one after the latest tick
    double at (std::uint64_t tick) const noexcept { return values[tick % values.size()]; }

    /// f (tick, value) of each tick from one to before another; of those before or after what is held there is none.
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
    std::vector<double> values;   // a ring
    std::uint64_t first_tick = 0, end_tick = 0;
};

/// The ports that somebody wants to see, and what stood there. Several may want some each; what they have in common is
/// kept once. [main thread]
class Traces
{
public:
    /// One who wants to see something, for as long as it lives.
    class Client
    {
    public:
        explicit Client (Traces& t) : traces (t) { traces.clients.push_back (this); }
        ~Client();
        Client (const Client&) = delete;
        Client& operator= (const Client&) = delete;

        /// These ports and no others, as "drag.force". What is not there is left out, and comes when it is.
        void want (std::vector<std::string>);
        const std::vector<std::string>& wanted() const noexcept { return ports; }

        /// The components of a port, in order; none if it is not there or nothing has run yet.
        std::vector<std::shared_ptr<const Trace>> of (const std::string& port) const { return traces.of (port); }

    private:
        friend Traces;
        Traces& traces;
        std::vector<std::string> ports;
    };

    /// All that is wanted, each once.
    std::vector<std::string> ports() const;

    std::vector<std::shared_ptr<const Trace>> of (const std::string& port) const;

    std::function<void()> onWanted;   ///< something else is wanted now

    /// The components that are wanted and there, but too many to be looked at.
    const std::vector<std::string>& leftOut() const noexcept { return too_many; }

    /// From the tick that takes it, this plan is looked at; what it has not any more stays as it was.
    void select (const Plan&, double rate_hz, bool anew);

    void note (const Plan& plan, std::uint64_t tick) noexcept { ring.note (plan, tick); }   ///< [tick thread]
    void collect();                                                                         ///< to be called many times a second

private:
    static constexpr std::size_t most_plans = 64;   ///< whose frames may still be on their way

    ProbeRing ring;
    std::vector<const Plan*> selected;   ///< all of which have the same taps; never looked into
    std::vector<std::size_t> taps;
    std::vector<std::shared_ptr<Trace>> in_frame;   ///< by their place in a frame
    std::map<std::string, std::shared_ptr<Trace>> by_name;
    std::vector<std::string> too_many;
    std::vector<Client*> clients;
};

}   // namespace tactus::host
