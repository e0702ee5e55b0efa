// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
#include <string_view>
#include <thread>

namespace tactus::host
{

/// Where the programs of this machine, and nobody else, send OSC messages to. They wait in a queue of bounded length;
/// what does not fit, and what is no OSC, is dropped and counted. Bundles are taken apart, their times are not heeded.
/// [main thread]
class OscPort
{
public:
    static constexpr int usual = 7770;   ///< where `tactus play` listens

    /// Number 0 is any free one. Ids: osc/port_taken.
    static tl::expected<std::unique_ptr<OscPort>, Error> open (int number);

    int number() const noexcept { return bound; }

    /// The oldest message that waits, if there is one or comes one in that time.
    std::optional<juce::OSCMessage> next (std::chrono::milliseconds patience = {});

    void send (int to, const juce::OSCMessage&);

    std::size_t dropped() const;

    /// True if a program on this machine listens there.
    static bool isTaken (int number);

private:
    OscPort() = default;

    static bool bind (juce::DatagramSocket&, int number);
    void listen (const std::stop_token&);
    void take (std::string_view packet);

    static constexpr std::size_t most_waiting = 4096;

    juce::DatagramSocket socket;
    juce::OSCSender sender;
    int bound = 0;
    mutable std::mutex guard;   // of what follows
    std::condition_variable arrived;
    std::deque<juce::OSCMessage> waiting;
    std::size_t lost = 0;
    std::jthread listening;   // last: it uses the others
};

}   // namespace tactus::host
