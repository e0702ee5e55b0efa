// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "osc_port.hpp"

#include <framework/json.hpp>
#include <framework/message.hpp>
#include <host/runtime/node_costs.hpp>
#include <host/runtime/run_status.hpp>
#include <host/runtime/triggered_capture.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace tactus::host
{

/// What runs, as others may see it and act on it. [main thread]
class Controlled
{
public:
    struct Status
    {
        std::string name;
        double rate_hz = 0.0, time_s = 0.0, force = 0.0, peak = 0.0;   ///< Hz, s, N
        std::uint64_t ticks = 0, misses = 0;
    };

    /// What a guard lets through, and why it last did not.
    struct Role
    {
        std::string name;
        bool withholds = false;
        double force = 0.0, torque = 0.0;   ///< N, N m
        std::string last_stop;              ///< in words, with the values that caused it; "" if there was none
    };

    /// How a gesture or a recording that the hand follows goes on; what is not said stays as it is.
    struct Transport
    {
        std::optional<bool> plays {};
        std::optional<double> seek {};    ///< s
        std::optional<double> speed {};   ///< times as fast as recorded
    };

    virtual ~Controlled() = default;

    virtual std::optional<Message> setParam (const std::string& name, const Json& value) = 0;
    virtual std::optional<Message> turnControl (const std::string& id, double value) = 0;

    /// One hit on an input for hits, in m/s.
    virtual std::optional<Message> strike (const std::string& input, double speed) = 0;

    /// From now on these ports are looked at, and no others. Returns the names of their components, each once, or why
    /// not; then all is as it was.
    virtual std::variant<std::vector<std::string>, Message> probe (const std::vector<std::string>& ports) = 0;

    /// One window of a port around an edge of another port, in place of what was asked for before. Returns as probe() does.
    virtual std::variant<std::vector<std::string>, Message> capture (const std::string& port, const std::string& watched, const Trigger&) = 0;
    virtual const TriggeredCapture* captured() = 0;   ///< null until there was the edge, and what comes after it
    virtual void endCapture() = 0;

    virtual Status status() = 0;

    /// What the nodes cost, the costliest first; of those that were measured.
    virtual std::vector<NodeCost> costs() = 0;

    virtual std::vector<Role> roles() = 0;
    virtual std::optional<Message> transport (const Transport&) = 0;
    virtual std::optional<Message> start() = 0;
    virtual void stop() = 0;
    virtual void emergencyStop() = 0;
    virtual void rearm() = 0;
};

/// As a run tells of its roles.
std::vector<Controlled::Role> rolesOf (const RunStatus&);

/// Carries out what comes in at an OSC port, as docs/osc.md has it, and answers. [main thread]
class RemoteControl
{
public:
    using Clock = std::chrono::steady_clock;

    RemoteControl (OscPort& p, Controlled& c) : port (p), controlled (c) {}

    /// Carries out what has come in, and ends probes whose time is over. To be called many times a second.
    void attend (Clock::time_point now = Clock::now());

    /// Values of the components that are probed, in the order of their names.
    void values (std::uint64_t tick, std::span<const double>);

    /// The graph is another one: probes go on as far as their ports are still there.
    void graphChanged();

    bool isProbing() const noexcept { return ! probes.empty(); }

private:
    struct Probe
    {
        std::string name;
        OscReturn to;
        double rate;   // Hz
        Clock::time_point end;
        double due = 0.0;   // tick
        std::vector<std::size_t> components {};
    };

    /// A window that is waited for, or on its way to who asked for it.
    struct Capture
    {
        std::string name, watched;
        OscReturn to;
        Trigger trigger;
        Clock::time_point end;
        std::vector<std::string> components {};
        std::size_t sent = 0;   // ticks
    };

    void carryOut (const juce::OSCMessage&, const std::string& host, Clock::time_point);
    void sendCosts (const OscReturn& to, std::size_t most);
    void sendRoles (const OscReturn& to);
    std::optional<Message> start();
    std::optional<Message> rearm();
    std::optional<Message> transport (const std::string& what, const juce::OSCMessage&);
    std::optional<Message> subscribe (const juce::OSCMessage&, const std::string& host, Clock::time_point);
    std::optional<Message> subscribeCapture (const juce::OSCMessage&, const std::string& host, Clock::time_point);
    std::optional<Message> arm (Capture);
    void confirmCapture();
    void sendCapture();
    std::optional<Message> look (const std::vector<Probe>&);
    void answer (const OscReturn& to, const std::string& address, const std::string& subject, const std::optional<Message>&);

    OscPort& port;
    Controlled& controlled;
    std::vector<Probe> probes;
    std::optional<Capture> capture;
    std::vector<std::string> components;
    double rate_hz = 0.0;
};

}   // namespace tactus::host
