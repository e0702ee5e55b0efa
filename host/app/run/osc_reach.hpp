// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "performance.hpp"

#include <host/osc/remote_control.hpp>

#include <map>

namespace tactus::host
{

/// Lets other programs of this machine turn, see, start and stop what is open in a window, as docs/osc.md has it. What
/// they turn is felt at once, and is an edit of the document besides, which can be undone: all that comes without a
/// pause is one step. [main thread]
class OscReach final : private Controlled
{
public:
    /// What starts and stops as the strip's button does; the others outlive this.
    struct Switches
    {
        std::function<void()> start {}, stop {}, emergency {};
    };

    OscReach (std::unique_ptr<OscPort>, Performance&, Document&, Switches);

    int port() const noexcept { return osc->number(); }

    /// To be called many times a second.
    void attend (RemoteControl::Clock::time_point now = RemoteControl::Clock::now());

private:
    std::optional<Message> setParam (const std::string& name, const Json& value) override;
    std::optional<Message> turnControl (const std::string& id, double value) override;
    std::optional<Message> strike (const std::string& input, double speed) override { return performance.strike (input, speed); }
    std::variant<std::vector<std::string>, Message> probe (const std::vector<std::string>& ports) override;
    std::variant<std::vector<std::string>, Message> capture (const std::string& port, const std::string& watched, const Trigger&) override;
    const TriggeredCapture* captured() override { return performance.captured(); }
    void endCapture() override;
    Status status() override;
    std::vector<NodeCost> costs() override { return performance.costs(); }
    std::vector<Role> roles() override;
    std::optional<Message> transport (const Transport&) override;
    std::optional<Message> start() override;
    void stop() override { switches.stop(); }
    void emergencyStop() override { switches.emergency(); }
    void rearm() override { performance.rearm(); }

    void lookAgain();
    void sendValues();
    void keep (RemoteControl::Clock::time_point now);

    std::unique_ptr<OscPort> osc;
    Performance& performance;
    Document& document;
    const Switches switches;
    Traces::Client looked_at { performance.traces() };
    std::vector<std::string> components;   // of what is probed
    std::uint64_t sent = 0;                // ticks before this one
    bool captures = false;
    std::map<std::string, Json> turned;    // and not yet edited
    std::map<std::string, double> moved;   // controls
    RemoteControl::Clock::time_point kept_at {};
    std::size_t kept_as = 0;                 // position in the history
    RemoteControl control { *osc, *this };   // last: it is told of this
};

}   // namespace tactus::host
