// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/probe_ring.hpp>
#include <tactus/run/run.hpp>

#include <span>
#include <string>
#include <vector>

namespace tactus
{

/// Samples ports of a run about 1000 times a second, without disturbing the ticks. [main thread]
class PortProbes final : public RunListener
{
public:
    /// From now on, probes these ports of the graph instead of the previous ones. Returns the names of their components, each
    /// listed once. If this fails, the previous ports are still probed. Ids: those of compile() for a port, probe/several, probe/too_many.
    Result<std::vector<std::string>> probe (Run&, const graph::Graph&, const std::vector<std::string>& ports);

    /// Stops probing; returns the probed ports, so that they can be probed again.
    std::vector<std::string> clear();
    void restore (std::vector<std::string> ports) { probed = std::move (ports); }

    /// Calls f (tick, values by component) for all samples of the newest plan since the last call.
    template <typename F>
    void drain (F&& f)
    {
        ring.drain ([&] (const ProbeRing::Frame& frame) {
            if (frame.plan == serial) f (frame.tick, std::span (frame.values).first (frame.size));
        });
    }

    std::uint64_t lost() const noexcept { return ring.lost(); }   ///< samples that were not drained in time

    std::vector<std::string> ports() const override { return probed; }
    bool isOptional (const std::string&) const override { return false; }
    void planComes (const Plan&) override;
    void after (const Plan& plan, std::uint64_t tick, bool) noexcept override { ring.note (plan, tick); }

private:
    ProbeRing ring;
    std::vector<std::string> probed;
    std::uint64_t serial = 0;   // serial number of the newest plan
};

}   // namespace tactus
