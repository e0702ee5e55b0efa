// SPDX-License-Identifier: GPL-3.0-or-later
// Random OSC packets as programs send them. The test knows the messages, so the reader must give those that are whole, in order, and say whether all were.
#include <host/devices/osc/read_packet.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <variant>
#include <vector>

using namespace tactus::host;

namespace
{
constexpr int packets = 300;

struct Random
{
    std::mt19937 engine { 7770 };

    int below (int n) { return static_cast<int> (engine() % static_cast<unsigned> (n)); }
    bool once_in (int n) { return below (n) == 0; }
};

void append (std::string& bytes, std::uint64_t v, int size)
{
    for (int i = size; i-- > 0;)
        bytes += static_cast<char> (static_cast<unsigned char> (v >> 8 * i));
}

std::string text (const std::string& s) { return s + std::string (4 - s.size() % 4, '\0'); }

using Value = std::variant<int, float, std::string>;

struct Sent
{
    std::string address {};
    std::vector<Value> values {};
};

/// A message, or one with a mistake, which is then not among the messages that must be read.
std::string message (Random& random, std::vector<Sent>& sent, bool& is_whole)
{
    static const std::vector<std::string> addresses { "/tactus/param", "/tactus/control", "/a", "/ab/c1", "/tactus/probe" };
    Sent made { addresses[static_cast<std::size_t> (random.below (5))] };
    std::string types = ",", content;
    for (int n = random.below (6); n > 0; --n)
    {
        const char type = "ifsdhTFNIb"[random.below (10)];
        types += type;
        const auto number = static_cast<std::int32_t> (random.engine());
        if (type == 'i')
        {
            append (content, static_cast<std::uint32_t> (number), 4);
            made.values.emplace_back (number);
        }
        else if (type == 'f' || type == 'd')
        {
            const float v = static_cast<float> (number) / 1024.0f;
            if (type == 'f')
                append (content, std::bit_cast<std::uint32_t> (v), 4);
            else
                append (content, std::bit_cast<std::uint64_t> (double { v }), 8);
            made.values.emplace_back (v);
        }
        else if (type == 'h')
        {
            const std::int64_t v = random.once_in (2) ? std::int64_t { number } : std::int64_t { number } * 4096 + 8'796'093'022'208;
            append (content, static_cast<std::uint64_t> (v), 8);
            if (v == static_cast<std::int32_t> (v))
                made.values.emplace_back (static_cast<int> (v));
            else
                made.values.emplace_back (static_cast<float> (v));
        }
        else if (type == 's')
        {
            const std::string s (static_cast<std::size_t> (random.below (9)), static_cast<char> ('a' + random.below (26)));
            content += text (s);
            made.values.emplace_back (s);
        }
        else if (type == 'b')
        {
            const auto size = static_cast<std::size_t> (random.below (10));
            append (content, size, 4);
            content += std::string ((size + 3) / 4 * 4, '\x7f');
        }
        else if (type != 'N')
            made.values.emplace_back (type == 'F' ? 0 : 1);
    }
    auto address = text (made.address);
    bool is_right = true;
    switch (random.below (24))   // mistakes
    {
    case 0:
        types += "rmct[S"[random.below (6)], is_right = false;   // types that are not read
        content += std::string (8, '\0');
        break;
    case 1:
        content += std::string (4, '\0'), is_right = false;   // more than the types say
        break;
    case 2:
        types += 'i', is_right = false;   // less than they say
        break;
    case 3:
        types.erase (0, 1), types.insert (0, "x"), is_right = false;   // no comma
        break;
    case 4:
        address.replace (0, 1, "t"), is_right = false;   // no slash
        break;
    default:
        break;
    }
    if (is_right)
        sent.push_back (std::move (made));
    else
        is_whole = false;
    return address + text (types) + content;
}

std::string packet (Random& random, std::vector<Sent>& sent, bool& is_whole, int depth)
{
    if (depth == 7 || random.below (3) > 0) return message (random, sent, is_whole);
    std::string bytes = text ("#bundle");
    append (bytes, random.once_in (2) ? 1 : std::uint64_t { random.engine() } << 32u, 8);   // a time, which is ignored
    for (int n = random.below (4); n > 0; --n)
    {
        const auto element = packet (random, sent, is_whole, depth + 1);
        append (bytes, element.size(), 4);
        bytes += element;
    }
    return bytes;
}
}   // namespace

TEST_CASE ("of 300 random packets, each whole message is read, in order, and a packet is whole if all of its messages are", "[osc]")
{
    Random random;
    int damaged = 0, messages = 0;
    for (int n = 0; n < packets; ++n)
    {
        std::vector<Sent> sent;
        bool is_whole = true;
        const auto bytes = packet (random, sent, is_whole, 0);
        INFO ("packet " << n);
        const auto read = readPacket (bytes);
        CHECK (read.right == is_whole);
        damaged += ! is_whole;
        REQUIRE (read.messages.size() == sent.size());
        for (std::size_t i = 0; i < sent.size(); ++i, ++messages)
        {
            const auto& got = read.messages[i];
            CHECK (got.getAddressPattern().toString().toStdString() == sent[i].address);
            REQUIRE (static_cast<std::size_t> (got.size()) == sent[i].values.size());
            for (int k = 0; k < got.size(); ++k)
            {
                const auto& wanted = sent[i].values[static_cast<std::size_t> (k)];
                if (const auto* whole = std::get_if<int> (&wanted))
                    CHECK ((got[k].isInt32() && got[k].getInt32() == *whole));
                else if (const auto* real = std::get_if<float> (&wanted))
                    CHECK ((got[k].isFloat32() && got[k].getFloat32() == *real));
                else
                    CHECK ((got[k].isString() && got[k].getString().toStdString() == std::get<std::string> (wanted)));
            }
        }
        // Cut anywhere, it is never whole.
        if (bytes.size() <= 4) continue;
        const auto cut = std::string_view (bytes).substr (0, static_cast<std::size_t> (1 + random.below (static_cast<int> (bytes.size()) - 1)));
        CHECK ((! readPacket (cut).right || bytes.starts_with ("#bundle")));
    }
    CHECK (damaged > 20);
    CHECK (messages > packets);
}
