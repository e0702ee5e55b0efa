// SPDX-License-Identifier: MIT
// Turns with a service that answers late, and requests of web pages to the end that waits for drivers.

#include "support/waiting.hpp"

#include <host/drivers/websocket/exchange.hpp>
#include <host/drivers/websocket/service_relay.hpp>
#include <host/drivers/websocket/web_server.hpp>

#include <tactus/text/caught.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace tactus;
using namespace std::chrono_literals;
using host::Exchange;
using host::WebServer;
using test::eventually;

namespace
{
/// Says the newest number.
struct Number final : Exchange::Partner
{
    std::string hear (const std::string&) override { return {}; }

    Exchange::Turn speak (Exchange::Clock::time_point now) override
    {
        if (! std::exchange (is_new, false)) return { now + 1h };
        return { now, std::to_string (newest) };
    }

    void askForRest() override { put (0); }
    bool hasAskedForRest() const override { return ! is_new; }

    void put (int n)
    {
        newest = n;
        is_new = true;
    }

    int newest = 0;
    bool is_new = false;
};

/// A service that answers when it is told to.
struct LateService
{
    LateService()
    {
        thread = std::jthread ([this] (const std::stop_token& stop) {
            std::unique_ptr<WebServer::Client> client;
            while (! stop.stop_requested())
                if (client == nullptr)
                    client = server.next (2);
                else if (! caught ("the service", [&] { serve (*client, stop); }))
                    client.reset();   // it is gone
        });
    }

    void serve (WebServer::Client& client, const std::stop_token& stop)
    {
        if (! client.says (2)) return;
        {
            const std::lock_guard lock (mutex);
            heard.push_back (client.hear());
        }
        while (! answers && ! stop.stop_requested())
            test::letPass (1ms);
        client.say ("{}");
    }

    std::vector<std::string> all() const
    {
        const std::lock_guard lock (mutex);
        return heard;
    }

    WebServer server { 0 };
    std::atomic<bool> answers = false;
    mutable std::mutex mutex;
    std::vector<std::string> heard;
    std::jthread thread;   // last: it uses the other members
};

/// What a server answers to a request for a WebSocket with this line in it: its first line, or nothing if it closes the connection.
std::string answerTo (int port, const std::string& line)
{
    const int end = ::socket (AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    REQUIRE (end >= 0);
    sockaddr_in where {};
    where.sin_family = AF_INET;
    where.sin_port = htons (static_cast<std::uint16_t> (port));
    where.sin_addr.s_addr = htonl (INADDR_LOOPBACK);
    REQUIRE (::connect (end, reinterpret_cast<const sockaddr*> (&where), sizeof where) == 0);
    const auto request = "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                         + line + "\r\n";
    REQUIRE (::send (end, request.data(), request.size(), MSG_NOSIGNAL) == static_cast<ssize_t> (request.size()));
    std::string answer;
    char byte = 0;
    while (answer.find ('\n') == answer.npos && ::recv (end, &byte, 1, 0) == 1)
        answer += byte;
    ::close (end);
    return answer;
}
}   // namespace

TEST_CASE ("what is offered while a service is late is refused, and is still what it hears next, not what was offered before", "[haply][wires][safety]")
{
    LateService service;
    Number number;
    Exchange exchange { number, "the service", Exchange::Answer::message, { 20ms, 60s, 60s, 60s } };
    REQUIRE (exchange.open ({ "localhost", std::to_string (service.server.port()) }, "/", nullptr).empty());
    exchange.begin();
    const auto listens = [&] { exchange.wait (test::fromNow (1ms), [] { return false; }); };
    const auto offers = [&] (int n) { return exchange.offer ([&] { number.put (n); }); };
    CHECK (offers (1).empty());
    REQUIRE (eventually ([&] {
        listens();
        return service.all().size() == 1;
    }));
    std::string why;
    int last = 1;
    REQUIRE (eventually ([&] {
        listens();
        why = offers (++last);
        return ! why.empty();
    }));
    CHECK (why == "the service has not answered for 20 ms");
    service.answers = true;
    REQUIRE (eventually ([&] {
        listens();
        return service.all().size() >= 2;
    }));
    CHECK (service.all()[1] == std::to_string (last));
}

TEST_CASE ("a web page cannot reach a service through the relay of a capture", "[haply][wires][safety]")
{
    LateService service;
    const auto relay = host::ServiceRelay::make ({ "localhost", std::to_string (service.server.port()) }, [] (bool, const std::string&) {});
    REQUIRE (relay);
    CHECK (answerTo ((*relay)->port(), "Origin: http://example.org\r\n").find ("101") == std::string::npos);
    CHECK (answerTo ((*relay)->port(), "origin: null\r\n").find ("101") == std::string::npos);
    CHECK (answerTo ((*relay)->port(), "").find ("101 Switching Protocols") != std::string::npos);
}
