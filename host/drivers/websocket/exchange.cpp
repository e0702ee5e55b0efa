// SPDX-License-Identifier: MIT
#include "exchange.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host
{

using namespace std::chrono_literals;

std::optional<ServiceAddress> ServiceAddress::read (std::string_view text, std::string_view otherwise)
{
    std::string whole (text.empty() ? otherwise : text);
    if (whole.find (':') == whole.npos) whole = "localhost:" + whole;
    ServiceAddress address { whole.substr (0, whole.rfind (':')), whole.substr (whole.rfind (':') + 1) };
    if (address.host.empty() || address.port.empty() || address.port.find_first_not_of ("0123456789") != whole.npos) return std::nullopt;
    if (address.port.size() > 5 || std::stoi (address.port) < 1 || std::stoi (address.port) > 65535) return std::nullopt;
    return address;
}

Exchange::Exchange (Partner& p, std::string called, Answer a, const Promises& waits)
    : partner (p), service (std::move (called)), answer (a), promises (waits)
{
}

std::string Exchange::open (const ServiceAddress& address, const std::string& path, std::string* first, const std::string& question)
{
    const auto why = socket.open (address.host, address.port, path, promises.connected, first, question);
    return why.empty() ? why : service + " cannot be reached at " + address.host + ":" + address.port + ": " + why + ". Start it, or correct the address";
}

std::string Exchange::claim (std::string_view part)
{
    auto attempt = PeerLock::take (socket.descriptor(), part);
    claimed = std::move (attempt.lock);
    return attempt.why;
}

void Exchange::begin()
{
    socket.post ([this] {
        socket.listen (
            [this] (const std::string& message) {
                auto why = partner.hear (message);
                if (why.empty() && answer == Answer::message) takeAnswer();
                return why;
            },
            [this] { takeAnswer(); });
        talk();
    });
}

Exchange::Got Exchange::wait (Clock::time_point until, const std::function<bool()>& take)
{
    for (;;)
    {
        {
            const std::lock_guard lock (mutex);
            if (take()) return Got::something;
            if (is_asking && Clock::now() - sent > promises.gone) socket.lose (lateBy (promises.gone));
        }
        if (! socket.trouble().empty()) return Got::gone;
        if (Clock::now() >= until) return Got::nothing;
        socket.run (std::min (until, Clock::now() + 2ms));
    }
}

std::string Exchange::offer (const std::function<void()>& put)
{
    if (auto trouble = socket.trouble(); ! trouble.empty()) return trouble;
    {
        const std::lock_guard lock (mutex);
        put();   // also if the service is late: when it answers, it must not hear what was offered before
        if (is_asking && Clock::now() - sent > promises.late) return lateBy (promises.late);
    }
    socket.post ([this] { talk(); });
    socket.runOne();   // here, so that it need not wait until the reading thread wakes up
    return {};
}

void Exchange::rest()
{
    {
        const std::lock_guard lock (mutex);
        partner.askForRest();
    }
    socket.post ([this] { talk(); });
    const auto end = Clock::now() + promises.rested;
    const auto isAtRest = [&] {
        const std::lock_guard lock (mutex);
        return ! socket.trouble().empty() || (partner.hasAskedForRest() && ! is_asking);
    };
    while (! isAtRest() && Clock::now() < end)
        socket.run (std::min (end, Clock::now() + 1ms));
    if (isAtRest()) return;
    socket.lose (service + " did not answer in time, so the connection was closed");
    socket.runAll();
}

/// Says what is due, if nothing is on its way. [strand]
void Exchange::talk()
{
    Turn turn;
    {
        const std::lock_guard lock (mutex);
        if (isWaiting() || ! socket.trouble().empty()) return;
        const auto now = Clock::now();
        turn = partner.speak (now);
        if (turn.due > now) return socket.later (turn.due, [this] { talk(); });
        is_writing = is_asking = true;
        sent = now;
    }
    socket.notLater();
    if (turn.message.empty()) return ask();
    socket.say (std::move (turn.message), [this] { ask(); });
}

/// The message has gone out. [strand]
void Exchange::ask()
{
    {
        const std::lock_guard lock (mutex);
        is_writing = false;
    }
    if (! socket.trouble().empty()) return;
    if (answer == Answer::pong) return socket.ping();
    talk();   // the answer may have come before
}

/// [strand]
void Exchange::takeAnswer()
{
    {
        const std::lock_guard lock (mutex);
        is_asking = false;
        partner.takeAnswer();
    }
    talk();
}

std::string Exchange::lateBy (Clock::duration time) const
{
    return service + " has not answered for " + std::to_string (std::chrono::duration_cast<std::chrono::milliseconds> (time).count()) + " ms";
}

}   // namespace tactus::host
