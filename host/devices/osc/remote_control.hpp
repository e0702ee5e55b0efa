// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "osc_port.hpp"

#include <tactus/run/clock/node_costs.hpp>
#include <tactus/run/probe/triggered_capture.hpp>
#include <tactus/run/run_status.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// A run that OSC clients may watch and control. [main thread]
class RemoteTarget
{
public:
    struct Status
    {
        std::string name;
        double rate_hz = 0.0, time_s = 0.0, force = 0.0, peak = 0.0;   ///< in Hz, s, N, N
        std::uint64_t ticks = 0, misses = 0;
    };

    /// The state of a guard, and why it last stopped.
    struct Role
    {
        std::string name;
        bool withholds = false;
        double force = 0.0, torque = 0.0;   ///< N, N m
        std::string last_stop;              ///< the reason in words, with the values that caused the stop; "" if there was no stop
    };

    /// Playback of the gesture or recording that the tool follows. Settings whose members are empty stay unchanged.
    struct Transport
    {
        std::optional<bool> plays {};
        std::optional<double> seek {};    ///< s
        std::optional<double> speed {};   ///< 1: as fast as the recording
    };

    virtual ~RemoteTarget() = default;

    virtual Result<> setParam (const std::string& name, const Json& value) = 0;
    virtual Result<> turnControl (const std::string& id, double value) = 0;

    /// Triggers a hit with a speed in m/s on a hit input.
    virtual Result<> strike (const std::string& input, double speed) = 0;

    /// From now on, probes exactly these ports. Returns the names of their components, each listed once. If this fails,
    /// nothing changes.
    virtual Result<std::vector<std::string>> probe (const std::vector<std::string>& ports) = 0;

    /// Captures one window of a port around an edge of another port. Replaces the previous capture. Returns the names of
    /// the captured components.
    virtual Result<std::vector<std::string>> capture (const std::string& port, const std::string& watched, const Trigger&) = 0;
    virtual const TriggeredCapture* captured() = 0;   ///< null until the window is complete
    virtual void endCapture() = 0;

    virtual Status status() = 0;

    /// Costs of the nodes measured so far, highest first.
    virtual std::vector<NodeCost> costs() = 0;

    virtual std::vector<Role> roles() = 0;
    virtual Result<> transport (const Transport&) = 0;

    /// True if a real device is bound, so that messages that can raise a force need the token.
    virtual bool drivesDevice() = 0;
    virtual Result<> start() = 0;
    virtual void stop() = 0;
    virtual void emergencyStop() = 0;

    /// Lets forces rise again. `asked` is the time at which the message arrived, which may be long before it is handled: it must not
    /// undo a stop that came later.
    virtual Result<> rearm (std::chrono::steady_clock::time_point asked) = 0;

    /// Called as soon as the message for an emergency stop arrives, ahead of the waiting messages. emergencyStop() follows on the
    /// main thread. [thread of the port]
    virtual void emergencyNow() noexcept {}

    /// Called as soon as any message arrives; poll() handles it. [thread of the port]
    virtual void messageArrived() {}
};

/// The roles in the status of a run.
std::vector<RemoteTarget::Role> rolesOf (const RunStatus&);

/// Twelve random digits and letters. There is no delay after a wrong token, because other users could use it to lock out the owner of the right one.
std::string randomToken();

/// Handles the messages at an OSC port and answers them: docs/osc.md. [main thread]
class RemoteControl
{
public:
    using Clock = std::chrono::steady_clock;

    /// A rearm needs the token, and so does everything else that can raise the force of a real device. If the token is empty, OSC can do neither.
    RemoteControl (OscPort&, RemoteTarget&, std::string token = {});
    ~RemoteControl();
    RemoteControl (const RemoteControl&) = delete;
    RemoteControl& operator= (const RemoteControl&) = delete;

    /// Handles the waiting messages and ends expired probes. Call this many times a second.
    void poll (Clock::time_point now = Clock::now());

    /// Passes on values of the probed components, in the order in which RemoteTarget::probe returned their names.
    void values (std::uint64_t tick, std::span<const double>);

    /// Call this after the graph has changed: probes continue if their ports still exist.
    void graphChanged();

    bool isProbing() const noexcept { return ! probes.empty(); }

private:
    struct Probe
    {
        std::string name;
        OscReturn to;
        double rate;   // Hz
        Clock::time_point end;
        double due = 0.0;   // tick from which the next value may be sent
        std::vector<std::size_t> components {};
    };

    /// A window that is awaited or being sent.
    struct Capture
    {
        std::string name, watched;
        OscReturn to;
        Trigger trigger;
        Clock::time_point end;
        std::vector<std::string> components {};
        std::size_t sent = 0;   // ticks sent so far
    };

    void carryOut (const OscPort::ReceivedMessage&, Clock::time_point);
    Result<> hello (const std::string& token_given, const std::string& from, Clock::time_point);
    Result<> mayRaise (const std::string& from, Clock::time_point);
    Result<> checkToken (const char* id, const std::string& token_given);
    Result<> turn (const std::string& address, const std::string& name, const juce::OSCMessage&);
    void report (const std::string& address, const std::string& subject, const juce::OSCMessage&, const std::string& host, Clock::time_point);
    void sendCosts (const OscReturn& to, std::size_t most);
    void sendRoles (const OscReturn& to);
    Result<> start();
    Result<> rearm (const std::string& token_given);
    Result<> transport (const std::string& what, const juce::OSCMessage&);
    Result<> subscribe (const juce::OSCMessage&, const std::string& host, Clock::time_point);
    Result<> subscribeCapture (const juce::OSCMessage&, const std::string& host, Clock::time_point);
    Result<> arm (Capture);
    void confirmCapture();
    void sendCapture();
    Result<> listenTo (const std::vector<Probe>&);
    void answer (const OscReturn& to, const std::string& address, const std::string& subject, const Result<>&);

    OscPort& port;
    RemoteTarget& controlled;
    const std::string token;
    std::chrono::steady_clock::time_point arrived_at {};   // of the message that is handled
    std::map<std::string, Clock::time_point> known;        // senders that have given the token, and when they last sent something that needs it
    std::vector<Probe> probes;
    std::optional<Capture> capture;
    std::vector<std::string> components;
    double rate_hz = 0.0;
};

}   // namespace tactus::host
