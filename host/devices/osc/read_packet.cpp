// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_packet.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

namespace tactus::host
{

namespace
{
using juce::OSCMessage;

constexpr std::size_t deepest = 8;   // levels of nested bundles
constexpr std::size_t most_arguments = 64;

/// The bytes that have not been read yet. Never reads past the end.
struct Bytes
{
    std::string_view left;

    std::optional<std::string_view> take (std::size_t n)
    {
        if (n > left.size()) return std::nullopt;
        const auto taken = left.substr (0, n);
        left.remove_prefix (n);
        return taken;
    }

    std::optional<std::uint32_t> word()
    {
        const auto bytes = take (4);
        if (! bytes) return std::nullopt;
        std::uint32_t n = 0;
        for (const char c : *bytes)
            n = (n << 8u) | static_cast<unsigned char> (c);
        return n;
    }

    /// Reads UTF-8 up to a zero, padded with zeros to a multiple of four bytes.
    std::optional<std::string_view> text()
    {
        const auto length = left.find ('\0');
        if (length == left.npos) return std::nullopt;
        const auto all = take (length / 4 * 4 + 4);
        if (! all || all->find_first_not_of ('\0', length) != all->npos) return std::nullopt;
        if (! juce::CharPointer_UTF8::isValidString (all->data(), static_cast<int> (length))) return std::nullopt;
        return all->substr (0, length);
    }

    std::optional<std::uint64_t> longWord()
    {
        const auto high = word(), low = word();
        if (! high || ! low) return std::nullopt;
        return std::uint64_t { *high } << 32u | *low;
    }

    bool blob()
    {
        const auto size = word();
        return size && *size <= left.size() && take ((std::size_t { *size } + 3) / 4 * 4);
    }
};

juce::String toText (std::string_view s) { return juce::String::fromUTF8 (s.data(), static_cast<int> (s.size())); }

bool addArgument (OSCMessage& message, char type, Bytes& from)
{
    if (type == 'b') return from.blob();
    if (type == 's')
    {
        const auto text = from.text();
        if (text) message.addString (toText (*text));
        return text.has_value();
    }
    // Types that OSC 1.0 does not require, but that programs send. A double or a long integer is rounded to the type of a param.
    if (type == 'T' || type == 'F' || type == 'I')
    {
        message.addInt32 (type == 'F' ? 0 : 1);
        return true;
    }
    if (type == 'N') return true;   // nothing
    if (type == 'd' || type == 'h')
    {
        const auto bits = from.longWord();
        if (! bits) return false;
        const auto whole = std::bit_cast<std::int64_t> (*bits);
        if (type == 'd')
            message.addFloat32 (static_cast<float> (std::bit_cast<double> (*bits)));
        else if (whole >= std::numeric_limits<std::int32_t>::min() && whole <= std::numeric_limits<std::int32_t>::max())
            message.addInt32 (static_cast<std::int32_t> (whole));
        else
            message.addFloat32 (static_cast<float> (whole));
        return true;
    }
    const auto word = type == 'i' || type == 'f' ? from.word() : std::nullopt;
    if (! word) return false;
    if (type == 'i')
        message.addInt32 (std::bit_cast<std::int32_t> (*word));
    else
        message.addFloat32 (std::bit_cast<float> (*word));
    return true;
}

/// The message, without arguments, if its address asks for a stop. Programs send buttons in many ways: with types that OSC 1.0 does not
/// require (T, N, d), or without types. None of them may lose a stop.
std::optional<OSCMessage> stopIn (std::string_view message)
{
    const auto address = message.substr (0, message.find ('\0'));
    for (const char* stop : { "/tactus/emergency", "/tactus/stop" })
        if (address == stop) return OSCMessage (juce::OSCAddressPattern (stop));
    return std::nullopt;
}

/// True for a message that starts a run or ends a stop, and has the value of a button. The release of a button (F) must not start anything. Programs differ
/// in what they send on a press, so no such value starts anything.
bool isButtonThatStarts (std::string_view address, std::string_view types)
{
    return (address == "/tactus/start" || address == "/tactus/rearm") && types.find_first_of ("TFNIdh") != types.npos;
}

std::optional<OSCMessage> readMessage (Bytes from)
{
    const auto address = from.text(), types = from.text();
    if (! address || ! types || ! types->starts_with (',') || types->size() > most_arguments + 1) return std::nullopt;
    if (isButtonThatStarts (*address, *types)) return std::nullopt;
    try
    {
        OSCMessage message (juce::OSCAddressPattern (toText (*address)));
        for (const char type : types->substr (1))
            if (! addArgument (message, type, from)) return std::nullopt;
        if (from.left.empty()) return message;
    }
    catch (const juce::OSCFormatError&)
    {
    }
    return std::nullopt;
}

Packet damaged (Packet packet)
{
    packet.right = false;
    return packet;
}
}   // namespace

Packet readPacket (std::string_view bytes)
{
    Packet packet { .messages = {}, .right = true };
    std::vector<Bytes> open { { bytes } };   // the rest of each enclosing bundle, innermost last
    bool element = true;                     // true while the innermost entry is an element that has not been read yet
    while (! open.empty())
    {
        auto& inner = open.back();
        if (element && ! inner.left.starts_with ('#'))
        {
            auto message = readMessage (inner);
            packet.right = packet.right && message.has_value();
            if (! message) message = stopIn (inner.left);
            if (message) packet.messages.push_back (std::move (*message));
            open.pop_back();
            element = false;
        }
        else if (element)
        {
            if (open.size() > deepest || inner.text() != "#bundle" || ! inner.take (8)) return damaged (std::move (packet));
            element = false;
        }
        else if (inner.left.empty())
            open.pop_back();
        else
        {
            const auto size = inner.word();
            const auto content = size ? inner.take (*size) : std::nullopt;
            if (! content || content->empty()) return damaged (std::move (packet));
            open.push_back ({ *content });
            element = true;
        }
    }
    return packet;
}

}   // namespace tactus::host
