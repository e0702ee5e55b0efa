// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "osc_address.hpp"

#include <host/io/error.hpp>

#include <juce_osc/juce_osc.h>
#include <tl/expected.hpp>

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>

namespace tactus::host
{

/// Whom an answer goes to.
struct OscReturn
{
    std::string host;
    int port = 0;   ///< 0: nobody

    bool operator== (const OscReturn&) const = default;
};

/// Where the programs of this machine, and unless asked for nobody else, send OSC messages to. They wait in a queue of bounded
/// length; what does not fit, and what is no OSC, is dropped and counted. Bundles are taken apart, their times are not heeded.
///
/// Answers go to this machine, and to the one other that is named, but nowhere else: who sends under a false address makes us
/// send nothing to a third. [main thread]
class OscPort
{
public:
    static constexpr int usual = 7770;   ///< where `tactus play` listens

    struct Received
    {
        juce::OSCMessage message;
        std::string host;   ///< where answers to its sender go; "": it gets none
    };

    /// Port 0 is any free one. Ids: osc/port_taken, osc/no_address.
    static tl::expected<std::unique_ptr<OscPort>, Error> open (const OscListen&);
    static tl::expected<std::unique_ptr<OscPort>, Error> open (int number) { return open (OscListen { .port = number }); }

    int number() const noexcept { return bound; }
    const OscListen& listensTo() const noexcept { return where; }

    /// The oldest message that waits, if there is one or comes one in that time.
    std::optional<Received> receive (std::chrono::milliseconds patience = {});
    std::optional<juce::OSCMessage> next (std::chrono::milliseconds patience = {});

    /// To a port of this machine; to whoever wants an answer.
    void send (int to, const juce::OSCMessage&);
    void send (const OscReturn&, const juce::OSCMessage&);

    std::size_t dropped() const;

    /// True if a program on this machine listens there.
    static bool isTaken (int number);

private:
    OscPort() = default;

    static bool bind (juce::DatagramSocket&, const OscListen&);
    void listen (const std::stop_token&);
    void take (std::string_view packet, const std::string& answers_to);
    std::string answersTo (const std::string& sender) const;

    static constexpr std::size_t most_waiting = 4096;

    juce::DatagramSocket socket;
    juce::OSCSender sender;
    OscListen where;
    int bound = 0;
    mutable std::mutex guard;   // of what follows
    std::condition_variable arrived;
    std::deque<Received> waiting;
    std::size_t lost = 0;
    std::jthread listening;   // last: it uses the others
};

}   // namespace tactus::host
