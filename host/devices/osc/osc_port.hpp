// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "osc_address.hpp"

#include <tactus/text/result.hpp>

#include <juce_osc/juce_osc.h>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

namespace tactus::host
{

/// The address and port for an answer.
struct OscReturn
{
    std::string host;
    int port = 0;   ///< 0: no answer

    bool operator== (const OscReturn&) const = default;
};

/// A port that receives OSC messages from programs on this machine and, only on request, from other machines. Messages wait
/// in a queue of limited length; messages that do not fit into it, and packets that are not OSC, are dropped and counted. Bundles are unpacked;
/// their time tags are ignored.
///
/// Answers go only to this machine and to OscListen::answered, so a sender with a forged address cannot make us send to a third
/// machine. [main thread]
class OscPort
{
public:
    static constexpr int usual = 7770;   ///< the default port of `tactus play`

    struct ReceivedMessage
    {
        juce::OSCMessage message;
        std::string host;                           ///< where to send answers; "": the sender gets none
        std::chrono::steady_clock::time_point at;   ///< time of arrival
        std::string from {};                        ///< the socket that has sent it, as 127.0.0.1:40123
        bool must_fit = false;                      ///< it is never dropped
    };

    /// Port 0: any free port. Ids: osc/port_taken, osc/no_address.
    static Result<std::unique_ptr<OscPort>> open (const OscListen&);
    static Result<std::unique_ptr<OscPort>> open (int number) { return open (OscListen { .port = number }); }

    int number() const noexcept { return bound; }
    const OscListen& listensTo() const noexcept { return where; }

    /// Calls `see` with every message as soon as it arrives, before it waits in the queue, and even if it does not fit there. If it returns true, the
    /// message is never dropped: if the queue is full, it takes the place of the newest message that may be dropped, unless the same message waits
    /// after that one. An empty function ends this. `see` must not wait. [main thread; `see` on the thread of the port]
    void onArrival (std::function<bool (const juce::OSCMessage&)> see);

    /// The oldest waiting message, or the first one that arrives within `patience`.
    std::optional<ReceivedMessage> receive (std::chrono::milliseconds patience = {});
    std::optional<juce::OSCMessage> next (std::chrono::milliseconds patience = {});

    /// Sends to a port on this machine, or sends an answer.
    void send (int to, const juce::OSCMessage&);
    void send (const OscReturn&, const juce::OSCMessage&);

    std::size_t dropped() const;
    std::string losses() const;   ///< the numbers of dropped messages with reasons, in words; "" if there are none

    /// True if a program on this machine listens on this port.
    static bool isTaken (int number);

private:
    OscPort() = default;

    static bool bind (juce::DatagramSocket&, const OscListen&);
    void lose();
    void listen (const std::stop_token&);
    void put (ReceivedMessage);
    void take (std::string_view packet, const std::string& sender, int sender_port);
    std::string answersTo (const std::string& sender) const;

    static constexpr std::size_t most_waiting = 4096;

    juce::DatagramSocket socket;
    juce::OSCSender sender;
    OscListen where;
    int bound = 0;
    std::mutex looking;   // protects first_look; the main thread takes it only in onArrival, so no emergency stop waits for another thread
    std::function<bool (const juce::OSCMessage&)> first_look;
    mutable std::mutex guard;   // protects the members below
    std::condition_variable arrived;
    std::deque<ReceivedMessage> waiting;
    std::size_t unread = 0, overflowed = 0;   // packets; messages
    std::jthread listening;                   // declared last: it uses the other members
};

}   // namespace tactus::host
