// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "playback.hpp"

#include <host/devices/osc/remote_control.hpp>
#include <host/devices/osc/token_file.hpp>

#include <functional>
#include <map>

namespace tactus::host
{

/// Lets other programs control and watch the run of a window over OSC, see docs/osc.md. A value that they set is felt immediately,
/// and also becomes an edit of the document that can be undone; edits that follow each other within a second are one undo step.
/// [main thread]
class OscServer final : private RemoteTarget
{
public:
    /// The playback and the document must outlive the server. While `is_asking`, the window waits for an answer, and nothing starts.
    OscServer (std::unique_ptr<OscPort>, Playback&, Document&, std::function<bool()> is_asking = {});

    int port() const noexcept { return osc->number(); }
    std::string losses() const { return osc->losses(); }

    /// Call many times a second, at least after onMessage.
    void poll (RemoteControl::Clock::time_point now = RemoteControl::Clock::now());

    std::function<void()> onMessage;   ///< called soon after a message has arrived

private:
    Result<> setParam (const std::string& name, const Json& value) override;
    Result<> turnControl (const std::string& id, double value) override;
    Result<> strike (const std::string& input, double speed) override { return live_run.strike (input, speed); }
    Result<std::vector<std::string>> probe (const std::vector<std::string>& ports) override;
    Result<std::vector<std::string>> capture (const std::string& port, const std::string& watched, const Trigger&) override;
    const TriggeredCapture* captured() override { return live_run.captured(); }
    void endCapture() override;
    Status status() override;
    std::vector<NodeCost> costs() override { return live_run.costs(); }
    std::vector<Role> roles() override;
    Result<> transport (const Transport&) override;
    Result<> start() override;
    void stop() override { playback.stop (By::program); }
    void emergencyStop() override { playback.emergencyStop (By::program); }
    void emergencyNow() noexcept override { playback.stopSwitch().emergencyStop (By::program); }
    bool drivesDevice() override { return live_run.meansDevice(); }
    void messageArrived() override { arrival.triggerAsyncUpdate(); }
    Result<> rearm (std::chrono::steady_clock::time_point asked) override;

    /// Brings the news of a message to the main thread.
    struct Arrival final : juce::AsyncUpdater
    {
        explicit Arrival (OscServer& s) : server (s) {}
        ~Arrival() override { cancelPendingUpdate(); }
        void handleAsyncUpdate() override
        {
            if (server.onMessage) server.onMessage();
        }
        OscServer& server;
    };

    void checkProbes();
    void sendValues();
    void performEdits (RemoteControl::Clock::time_point now);

    std::unique_ptr<OscPort> osc;
    Playback& playback;
    LiveRun& live_run { playback.run() };
    Document& document;
    std::function<bool()> is_asking;
    Traces::Client probed { live_run.traces() };
    std::vector<std::string> components;   // all components of the probed ports
    std::uint64_t sent = 0;                // all ticks before this one are sent
    bool captures = false;
    std::map<std::string, Json> new_params;       // params that are set, but not yet stored by an edit of the document
    std::map<std::string, double> new_controls;   // controls likewise
    RemoteControl::Clock::time_point edited_at {};
    std::size_t edited_position = 0;   // position in the history after this server's last edit
    Arrival arrival { *this };
    const std::string token = randomToken();
    const TokenFile token_file { osc->number(), token };
    RemoteControl control { *osc, *this, token };   // declared last: it calls the functions of this object
};

}   // namespace tactus::host
