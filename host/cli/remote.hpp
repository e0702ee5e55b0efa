// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "session.hpp"

#include <framework/refused.hpp>
#include <framework/turn.hpp>
#include <host/osc/remote_control.hpp>
#include <host/runtime/runner.hpp>

namespace tactus::host
{

/// A session that runs, for those who reach it by OSC. [main thread]
class Remote final : public Controlled
{
public:
    Remote (Session& s, Runner& r) : session (s), running (r) {}

    std::optional<Message> setParam (const std::string& name, const Json& value) override { return turnParam (session.engine(), name, value); }
    std::optional<Message> turnControl (const std::string& id, double value) override { return tactus::turnControl (session.engine(), session.graph(), id, value); }
    std::optional<Message> strike (const std::string& input, double speed) override { return tactus::strike (session.engine(), input, speed); }
    std::variant<std::vector<std::string>, Message> probe (const std::vector<std::string>& ports) override { return session.probe (ports); }
    std::variant<std::vector<std::string>, Message> capture (const std::string& port, const std::string& watched, const Trigger& trigger) override { return session.capture (port, watched, trigger); }
    const TriggeredCapture* captured() override { return session.captured(); }
    void endCapture() override { session.endCapture(); }
    std::vector<NodeCost> costs() override { return running.costs(); }
    std::optional<Message> transport (const Transport&) override { return refused ("osc/transport", "what a play from the command line follows is not stopped or sought", "open the graph in tactus-host"); }
    std::optional<Message> start() override { return refused ("osc/start", "it runs already", "/tactus/stop ends it"); }
    void stop() override { running.stop(); }
    void emergencyStop() override { session.engine().emergencyStop(); }
    void rearm() override { session.engine().rearm(); }
    std::vector<Role> roles() override { return rolesOf (running.status()); }

    Status status() override
    {
        const auto now = running.status();
        return { session.name(), session.rate(), static_cast<double> (now.ticks) / session.rate(), now.force, now.peak, now.ticks, now.misses };
    }

private:
    Session& session;
    Runner& running;
};

}   // namespace tactus::host
