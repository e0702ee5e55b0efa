// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_port.hpp"
#include "read_packet.hpp"

#include <tactus/run/realtime.hpp>
#include <tactus/text/caught.hpp>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace tactus::host
{

namespace
{
constexpr std::size_t largest_packet = 65536;
constexpr int longest_wait_ms = 1000;   // only if the packet that ends it is lost
}   // namespace

bool OscPort::bind (juce::DatagramSocket& s, const OscListen& where)
{
    s.setEnablePortReuse (false);   // otherwise two programs could share a port, and one of them would receive nothing
    return s.bindToPort (where.port, where.address);
}

bool OscPort::isTaken (int number)
{
    juce::DatagramSocket s;
    return ! bind (s, { .port = number });
}

Result<std::unique_ptr<OscPort>> OscPort::open (const OscListen& where)
{
    std::unique_ptr<OscPort> port { new OscPort };
    if (! bind (port->socket, where) || ! port->sender.connect (OscListen::loopback, where.port == 0 ? usual : where.port))
    {
        const auto place = where.address + ":" + std::to_string (where.port);
        juce::DatagramSocket any;
        if (! where.isLoopback() && ! bind (any, { .address = where.address, .port = 0 }))
            return Message::error ("osc/no_address", place, "this machine has no such address, or does not allow listening on it",
                                   "give the address of a network interface of this machine, 0.0.0.0 for all of them, "
                                   "or only a port to listen on this machine alone");
        return Message::error ("osc/port_taken", place, "another program is already listening on this UDP port",
                               "give another port, as in --osc " + std::to_string (where.port == usual ? usual + 1 : usual) + ", or --osc 0 for any free port");
    }
    port->where = where;
    port->bound = port->socket.getBoundPort();
    port->listening = std::jthread ([raw = port.get()] (const std::stop_token& stop) {
        const std::stop_callback wake (stop, [raw] { raw->socket.write (raw->where.address, raw->bound, "", 1); });
        while (! stop.stop_requested())
            if (! caught ("OSC", [&] { raw->listen (stop); })) raw->lose();
    });
    return port;
}

void OscPort::onArrival (std::function<bool (const juce::OSCMessage&)> see)
{
    const std::lock_guard lock (looking);
    first_look = std::move (see);
}

std::optional<OscPort::ReceivedMessage> OscPort::receive (std::chrono::milliseconds patience)
{
    std::unique_lock lock (guard);
    if (patience.count() > 0) arrived.wait_for (lock, patience, [this] { return ! waiting.empty(); });
    if (waiting.empty()) return std::nullopt;
    auto message = std::move (waiting.front());
    waiting.pop_front();
    return message;
}

std::optional<juce::OSCMessage> OscPort::next (std::chrono::milliseconds patience)
{
    auto received = receive (patience);
    if (! received) return std::nullopt;
    return std::move (received->message);
}

void OscPort::send (int to, const juce::OSCMessage& message) { sender.sendToIPAddress (OscListen::loopback, to, message); }

void OscPort::send (const OscReturn& to, const juce::OSCMessage& message)
{
    if (to.port != 0 && ! to.host.empty()) sender.sendToIPAddress (to.host, to.port, message);
}

/// The address for answers to this sender; "" if it gets none. All loopback addresses become OscListen::loopback.
std::string OscPort::answersTo (const std::string& from) const
{
    if (from.starts_with ("127.")) return OscListen::loopback;
    return from == where.answered ? from : std::string();
}

std::size_t OscPort::dropped() const
{
    const std::lock_guard lock (guard);
    return unread + overflowed;
}

std::string OscPort::losses() const
{
    const std::lock_guard lock (guard);
    std::string text;
    const auto add = [&] (std::size_t count, const char* why) {
        if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string (count) + why;
    };
    add (unread, " that are not OSC 1.0, whose arguments have types that are not read, or that start a run with a button's value");
    add (overflowed, " that came faster than they could be handled");
    return text;
}

/// Counts a message that could not be taken.
void OscPort::lose()
{
    const std::lock_guard lock (guard);
    ++unread;
}

void OscPort::listen (const std::stop_token& stop)
{
    static_cast<void> (raisePriority (priority::messages));   // so that emergency stops do not wait; if the priority is refused, the run reports that
    std::vector<char> buffer (largest_packet);
    while (! stop.stop_requested())
    {
        if (socket.waitUntilReady (true, longest_wait_ms) != 1) continue;
        juce::String from;
        int from_port = 0;
        const int size = socket.read (buffer.data(), static_cast<int> (buffer.size()), false, from, from_port);
        if (size > 0 && ! stop.stop_requested()) take ({ buffer.data(), static_cast<std::size_t> (size) }, from.toStdString(), from_port);
    }
}

/// [with `guard` held]
void OscPort::put (ReceivedMessage message)
{
    if (waiting.size() >= most_waiting)
    {
        ++overflowed;
        const auto same = [&] (const ReceivedMessage& m) { return m.message.getAddressPattern() == message.message.getAddressPattern(); };
        const auto place = std::find_if (waiting.rbegin(), waiting.rend(), [&] (const auto& m) { return ! m.must_fit || same (m); });
        if (! message.must_fit || place == waiting.rend() || place->must_fit) return;
        waiting.erase (std::next (place).base());
    }
    waiting.push_back (std::move (message));
}

void OscPort::take (std::string_view bytes, const std::string& sender_address, int sender_port)
{
    const auto answers_to = answersTo (sender_address), from = sender_address + ":" + std::to_string (sender_port);
    const auto now = std::chrono::steady_clock::now();
    auto packet = readPacket (bytes);
    std::vector<bool> must_fit;
    {
        const std::lock_guard lock (looking);
        for (const auto& message : packet.messages)
            must_fit.push_back (first_look && first_look (message));
    }
    const std::lock_guard lock (guard);
    unread += ! packet.right;
    for (std::size_t i = 0; i < packet.messages.size(); ++i)
        put ({ std::move (packet.messages[i]), answers_to, now, from, must_fit[i] });
    arrived.notify_one();
}

}   // namespace tactus::host
