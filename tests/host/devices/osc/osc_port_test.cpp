// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/devices/osc/osc_port.hpp>
#include <host/devices/osc/read_packet.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace tactus::host;
using namespace std::chrono_literals;
using juce::OSCMessage;

namespace
{
constexpr auto patience = 20s;

std::unique_ptr<OscPort> anyPort()
{
    auto port = OscPort::open (0);
    REQUIRE (port);
    return std::move (*port);
}

std::string addressOf (const std::optional<OSCMessage>& m) { return m ? m->getAddressPattern().toString().toStdString() : ""; }

/// Sends raw bytes to a port.
struct Attacker
{
    explicit Attacker (int port) : to (port) { socket.bindToPort (0, "127.0.0.1"); }

    void operator() (const std::string& bytes) { socket.write ("127.0.0.1", to, bytes.data(), static_cast<int> (bytes.size())); }

    juce::DatagramSocket socket;
    int to;
};

std::string word (std::uint32_t n)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char> ((n >> static_cast<unsigned> (shift)) & 0xffu);
    return bytes;
}

std::string padded (std::string s)
{
    s += '\0';
    while (s.size() % 4 != 0)
        s += '\0';
    return s;
}

/// Nested bundles, as many as fit into `size` bytes.
std::string nested (std::size_t size)
{
    const auto head = padded ("#bundle") + std::string (8, '\0');
    std::string inner = head;
    while (inner.size() + head.size() + 4 <= size)
        inner = head + word (static_cast<std::uint32_t> (inner.size())) + inner;
    return inner;
}
}   // namespace

TEST_CASE ("a message arrives with all its arguments", "[osc]")
{
    const auto a = anyPort(), b = anyPort();
    a->send (b->number(), OSCMessage ("/tactus/param", juce::String ("drag.mu"), 0.25f, 7));
    const auto m = b->next (patience);
    REQUIRE (addressOf (m) == "/tactus/param");
    REQUIRE (m->size() == 3);
    CHECK ((*m)[0].getString() == "drag.mu");
    CHECK ((*m)[1].getFloat32() == 0.25f);
    CHECK ((*m)[2].getInt32() == 7);
    CHECK_FALSE (b->next());
}

TEST_CASE ("a port in use is refused, and reported as taken", "[osc]")
{
    auto first = anyPort();
    const auto number = first->number();
    CHECK (OscPort::isTaken (number));
    const auto second = OscPort::open (number);
    REQUIRE_FALSE (second);
    CHECK (second.error().id == "osc/port_taken");
    first.reset();
    CHECK_FALSE (OscPort::isTaken (number));
    CHECK (OscPort::open (number));
}

TEST_CASE ("a bundle is unpacked in order", "[osc]")
{
    const auto port = anyPort();
    const auto message = [] (const std::string& address) { return padded (address) + padded (","); };
    const auto element = [] (const std::string& bytes) { return word (static_cast<std::uint32_t> (bytes.size())) + bytes; };
    const auto head = padded ("#bundle") + std::string (8, '\0');
    Attacker send { port->number() };
    send (head + element (message ("/a")) + element (head + element (message ("/b"))) + element (message ("/c")));
    for (const auto* address : { "/a", "/b", "/c" })
        CHECK (addressOf (port->next (patience)) == address);
}

TEST_CASE ("an emergency stop is found whatever its arguments and the rest of its bundle are, and nothing else is made of broken messages", "[osc]")
{
    const auto stop = padded ("/tactus/emergency");
    const auto element = [] (const std::string& bytes) { return word (static_cast<std::uint32_t> (bytes.size())) + bytes; };
    const auto head = padded ("#bundle") + std::string (8, '\0');
    const auto unreadable = padded ("/x") + padded (",d") + std::string (4, '\0');
    const std::vector<std::string> packets {
        stop + padded (","),
        stop + padded (",T"),
        stop + padded (",N"),
        stop + padded (",[i]") + word (1),
        stop + padded (",d") + std::string (8, '\0'),
        stop + padded (",i"),
        stop + padded ("," + std::string (100, 'i')),
        stop + padded (",f") + word (0x3f800000) + "more",
        stop,
        "/tactus/emergency",
        head + element (unreadable) + element (stop + padded (",T")),
        head + element (head + element (unreadable)) + element (stop + padded (",")),
    };
    for (const auto& bytes : packets)
    {
        CAPTURE (bytes);
        const auto packet = readPacket (bytes);
        REQUIRE (packet.messages.size() == 1);
        CHECK (packet.messages.front().getAddressPattern().toString() == "/tactus/emergency");
    }
    for (const auto* address : { "/tactus/start", "/tactus/rearm", "/tactus/emergency2", "/tactus/param", "/x/tactus/emergency" })
        CHECK (readPacket (padded (address) + padded (",[i]") + word (1)).messages.empty());
    for (const auto* address : { "/tactus/start", "/tactus/rearm" })
        for (const auto* type : { ",T", ",F", ",N", ",I" })
            CHECK (readPacket (padded (address) + padded (type)).messages.empty());   // the release of a button starts nothing
    CHECK_FALSE (readPacket (stop + padded (",[i]") + word (1)).right);
}

TEST_CASE ("doubles, long integers, truth, impulse and nil are read as what a param takes", "[osc]")
{
    const auto number = word (0x3fe00000) + word (0), large = word (1) + word (0), small = word (0xffffffff) + word (0xfffffff9);
    const auto packet = readPacket (padded ("/a") + padded (",dhhTFNI") + number + large + small);
    REQUIRE (packet.right);
    REQUIRE (packet.messages.size() == 1);
    const auto& m = packet.messages.front();
    REQUIRE (m.size() == 6);
    CHECK (m[0].getFloat32() == 0.5f);
    CHECK (m[1].getFloat32() == 4294967296.0f);
    CHECK (m[2].getInt32() == -7);
    CHECK (m[3].getInt32() == 1);
    CHECK (m[4].getInt32() == 0);
    CHECK (m[5].getInt32() == 1);
    CHECK_FALSE (readPacket (padded ("/a") + padded (",d") + word (0)).right);
}

TEST_CASE ("any bytes are either a packet or refused, and nothing beyond their end is read", "[osc]")
{
    const auto right =
        padded ("#bundle") + std::string (8, '\0') + word (36) + padded ("/tactus/param") + padded (",sif") + padded ("ab") + word (7) + word (0x3f000000);
    CHECK (readPacket (right).right);
    tactus::test::property ("any damage", [&] (std::vector<std::pair<std::uint16_t, char>> changes, std::uint16_t cut, std::string more) {
        auto bytes = right;
        for (const auto& [place, c] : changes)
            bytes[place % bytes.size()] = c;
        bytes.resize (bytes.size() - cut % bytes.size());
        bytes += more;
        const std::vector<char> exact (bytes.begin(), bytes.end());   // so that ASan detects reads beyond the end
        const auto packet = readPacket ({ exact.data(), exact.size() });
        RC_ASSERT (packet.messages.size() <= bytes.size() / 8);
    });
    CHECK_FALSE (readPacket (nested (65000)).right);
    CHECK (readPacket (nested (160)).right);
}

// Long because it is one table of malformed packets.
TEST_CASE ("malformed packets are harmless and counted", "[osc]")
{
    const auto port = anyPort(), good = anyPort();
    Attacker attack { port->number() };
    const auto alive = [&]   // repeated until it arrives, since the queue may be full
    {
        for (int i = 0; i < 1000; ++i)
        {
            good->send (port->number(), OSCMessage ("/alive"));
            while (const auto m = port->next (20ms))
                if (addressOf (m) == "/alive") return true;
        }
        return false;
    };

    SECTION ("invalid strings, sizes and types")
    {
        const std::vector<std::string> hostile {
            "",
            "x",
            "/",
            "////",
            std::string (4, '\0'),
            "/a" + std::string (60000, 'b'),
            padded ("/a"),
            padded ("/a") + "x",
            padded ("/a") + ",",
            padded ("/a") + padded (",i"),
            padded ("/a") + padded (",s"),
            padded ("/a") + padded (",s") + "abcd",
            padded ("/a") + padded (",b") + word (0x7fffffff),
            padded ("/a") + padded (",b") + word (0xffffffff) + "abcd",
            padded ("/a") + padded (",b") + word (0x80000000),
            padded ("/a") + padded (",d") + std::string (4, 'x'),
            padded ("/a") + padded (",[[[["),
            padded ("/a") + padded ("," + std::string (60000, 'i')),
            padded ("/ a#*?{}[") + padded (","),
            padded ("/*/{a,b") + padded (","),
            padded ("/\xff\xfe") + padded (","),
            padded ("#bundle"),
            padded ("#bundle") + std::string (8, '\0') + word (0xfffffffc),
            padded ("#bundle") + std::string (8, '\0') + word (0) + word (0),
            padded ("#bundle") + std::string (8, '\0') + word (3) + "abc",
            padded ("#bundle") + std::string (8, '\0') + word (8) + padded ("#bundle"),
            nested (2000),
            nested (65000),
        };
        for (const auto& bytes : hostile)
        {
            INFO (bytes.substr (0, 40));
            attack (bytes);
            CHECK (alive());
        }
        CHECK (port->dropped() > 10);
        CHECK (port->losses().starts_with (std::to_string (port->dropped()) + " that are not OSC 1.0"));
    }
    SECTION ("packets that are almost right")
    {
        const auto right = padded ("/tactus/param") + padded (",sfib") + padded ("drag.mu") + word (0x3f000000) + word (7) + word (4) + "abcd";
        tactus::test::property ("any damage", [&] (std::vector<std::pair<std::uint16_t, char>> changes, std::uint16_t cut) {
            auto bytes = right;
            for (const auto& [place, c] : changes)
                bytes[place % bytes.size()] = c;
            attack (bytes.substr (0, bytes.size() - cut % bytes.size()));
        });
        CHECK (alive());
    }
    SECTION ("more messages than are taken out of the queue")
    {
        for (int i = 0; i < 1'000'000 && port->dropped() == 0; ++i)
            attack (padded ("/flood") + padded (","));
        CHECK (port->dropped() > 0);
        CHECK (port->losses().find (" that came faster than they could be handled") != std::string::npos);
        CHECK (alive());
    }
}

TEST_CASE ("the listening address is a port, or an address with a port", "[osc]")
{
    CHECK (readListen ("7770")->port == 7770);
    CHECK (readListen ("7770")->isLoopback());
    CHECK (readListen ("0")->port == 0);
    CHECK (readListen ("192.168.1.5:9000")->address == "192.168.1.5");
    CHECK (readListen ("0.0.0.0:9000")->port == 9000);
    CHECK_FALSE (readListen ("0.0.0.0:9000")->isLoopback());
    for (const auto* wrong : { "", ":", "65536", "-1", "+1", "1.2.3.4", "1.2.3:5", "1.2.3.4.5:6", "256.0.0.1:5", "a.b.c.d:5", "1.2.3.4:", "::1:5",
                               "localhost:5", "7770 ", "0x10", "1..2.3:4", "0000.0.0.0:1" })
    {
        INFO (wrong);
        CHECK_FALSE (readListen (wrong));
    }
    CHECK (warningOf (*readListen ("7770")).empty());
    CHECK (warningOf (*readListen ("0.0.0.0:7770")).find ("0.0.0.0") != std::string::npos);
    tactus::test::property ("any text", [] {
        const auto text = *rc::gen::container<std::string> (rc::gen::elementOf (std::string ("0129.:-x")));
        if (const auto listen = readListen (text)) RC_ASSERT (listen->port >= 0 && listen->port <= 65535 && isAddress (listen->address));
    });
}

TEST_CASE ("a port that other machines can reach answers only this machine and the named one", "[osc]")
{
    const auto open = [] (const std::string& answered) {
        const OscListen listen { .address = "0.0.0.0", .port = 0, .answered = answered };
        return std::move (*OscPort::open (listen));
    };
    const auto receive = [] (OscPort& port, const std::string& from) {
        juce::DatagramSocket sender;
        REQUIRE (sender.bindToPort (0, from));
        const auto bytes = padded ("/tactus/stop") + padded (",");
        sender.write ("127.0.0.1", port.number(), bytes.data(), static_cast<int> (bytes.size()));
        const auto received = port.receive (patience);
        REQUIRE (received);
        return received->host;
    };
    const auto alone = open ("");
    CHECK (receive (*alone, "127.0.0.1") == "127.0.0.1");
    CHECK (receive (*alone, "127.0.0.2") == "127.0.0.1");   // 127.0.0.2 is also this machine

    juce::Array<juce::IPAddress> all;
    juce::IPAddress::findAllAddresses (all);
    const auto* card = std::find_if (all.begin(), all.end(), [] (const auto& a) { return ! a.isIPv6 && ! a.toString().startsWith ("127."); });
    if (card == all.end()) return;   // this machine is not on a network
    const auto address = card->toString().toStdString();
    const auto from_card = [&] (OscPort& port) {
        juce::DatagramSocket sender;
        REQUIRE (sender.bindToPort (0, address));
        const auto bytes = padded ("/tactus/stop") + padded (",");
        sender.write (address, port.number(), bytes.data(), static_cast<int> (bytes.size()));
        const auto received = port.receive (patience);
        REQUIRE (received);
        return received->host;
    };
    CHECK (from_card (*alone) == "");
    CHECK (from_card (*open (address)) == address);
    CHECK (from_card (*open ("10.1.2.3")) == "");
    CHECK (OscPort::open (OscListen { .address = "203.0.113.7", .port = 0 }).error().id == "osc/no_address");
}
