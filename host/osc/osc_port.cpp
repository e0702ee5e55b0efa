// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_port.hpp"
#include "read_packet.hpp"

#include <vector>

namespace tactus::host
{

namespace
{
constexpr const char* loopback = "127.0.0.1";
constexpr std::size_t largest_packet = 65536;
}   // namespace

bool OscPort::bind (juce::DatagramSocket& s, int number)
{
    s.setEnablePortReuse (false);   // else two programs share a port, and one of them hears nothing
    return s.bindToPort (number, loopback);
}

bool OscPort::isTaken (int number)
{
    juce::DatagramSocket s;
    return ! bind (s, number);
}

tl::expected<std::unique_ptr<OscPort>, Error> OscPort::open (int number)
{
    std::unique_ptr<OscPort> port { new OscPort };
    if (! bind (port->socket, number) || ! port->sender.connect (loopback, number == 0 ? usual : number))
        return tl::unexpected (Error { "osc/port_taken", std::string (loopback) + ":" + std::to_string (number), "another program listens on this UDP port already", "give another one, as in --osc " + std::to_string (number == usual ? usual + 1 : usual) + ", or --osc 0 for any that is free" });
    port->bound = port->socket.getBoundPort();
    port->listening = std::jthread ([raw = port.get()] (const std::stop_token& stop)
                                    { raw->listen (stop); });
    return port;
}

std::optional<juce::OSCMessage> OscPort::next (std::chrono::milliseconds patience)
{
    std::unique_lock lock (guard);
    if (patience.count() > 0) arrived.wait_for (lock, patience, [this]
                                                { return ! waiting.empty(); });
    if (waiting.empty()) return std::nullopt;
    auto message = std::move (waiting.front());
    waiting.pop_front();
    return message;
}

void OscPort::send (int to, const juce::OSCMessage& message) { sender.sendToIPAddress (loopback, to, message); }

std::size_t OscPort::dropped() const
{
    const std::lock_guard lock (guard);
    return lost;
}

void OscPort::listen (const std::stop_token& stop)
{
    std::vector<char> buffer (largest_packet);
    while (! stop.stop_requested())
    {
        if (socket.waitUntilReady (true, 20) != 1) continue;
        const int size = socket.read (buffer.data(), static_cast<int> (buffer.size()), false);
        if (size > 0) take ({ buffer.data(), static_cast<std::size_t> (size) });
    }
}

void OscPort::take (std::string_view bytes)
{
    auto packet = readPacket (bytes);
    const std::lock_guard lock (guard);
    lost += ! packet.right;
    for (auto& message : packet.messages)
        if (waiting.size() < most_waiting)
            waiting.push_back (std::move (message));
        else
            ++lost;
    arrived.notify_one();
}

}   // namespace tactus::host
