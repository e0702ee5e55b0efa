// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/cli/command_run.hpp>
#include <host/devices/osc/remote_control.hpp>
#include <tactus/run/runner.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/message.hpp>

namespace tactus::host
{

/// A run that OSC controls. [main thread]
class Remote final : public RemoteTarget
{
public:
    Remote (CommandRun& r, StopSwitch& s) : command (r), stops (s) {}

    Result<> setParam (const std::string& name, const Json& value) override { return turnParam (command.engine(), name, value); }
    Result<> turnControl (const std::string& id, double value) override { return tactus::turnControl (command.engine(), command.graph(), id, value); }
    Result<> strike (const std::string& input, double speed) override { return tactus::strike (command.engine(), input, speed); }
    Result<std::vector<std::string>> probe (const std::vector<std::string>& ports) override { return command.probe (ports); }
    Result<std::vector<std::string>> capture (const std::string& port, const std::string& watched, const Trigger& trigger) override
    {
        return command.capture (port, watched, trigger);
    }
    const TriggeredCapture* captured() override { return command.run().captured(); }
    void endCapture() override { command.run().endCapture(); }
    std::vector<NodeCost> costs() override { return command.run().live().costs(); }
    Result<> transport (const Transport&) override
    {
        return Message::error ("osc/transport", {}, "the input of a run from the command line cannot be paused or moved",
                               "open the graph in tactus-host");
    }
    Result<> start() override { return Message::error ("osc/start", {}, "the run has already started", "/tactus/stop ends it"); }
    void stop() override { command.session().stop(); }
    void emergencyStop() override { stops.emergencyStop (By::program); }
    void emergencyNow() noexcept override { stops.emergencyStop (By::program); }
    Result<> rearm (std::chrono::steady_clock::time_point asked) override { return command.session().rearm (asked, By::program); }
    bool drivesDevice() override { return command.session().drivesDevice(); }
    std::vector<Role> roles() override { return rolesOf (command.run().live().status()); }

    Status status() override
    {
        const auto now = command.run().live().status();
        return { command.name(), command.rate(), static_cast<double> (now.ticks) / command.rate(), now.force, now.peak, now.ticks, now.misses };
    }

private:
    CommandRun& command;
    StopSwitch& stops;
};

}   // namespace tactus::host
