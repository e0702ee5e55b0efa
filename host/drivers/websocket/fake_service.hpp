// SPDX-License-Identifier: MIT
#pragma once

#include "web_server.hpp"

#include <tactus/text/caught.hpp>
#include <tactus/text/result.hpp>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace tactus::host
{

/// The common part of fake services: a thread that serves one client after the other, a fault, and counts. `Fake` is the interface: it names a Fault
/// (none, restart, …) and Counts (clients, …), and has virtual functions port(), fail() and counts().
template <typename Fake>
class FakeService : public Fake
{
public:
    using Fault = typename Fake::Fault;
    using Counts = typename Fake::Counts;

    int port() const noexcept final { return server.port(); }
    void fail (Fault f) noexcept final { wrong = f; }

    Counts counts() const final
    {
        const std::lock_guard lock (mutex);
        return tally;
    }

protected:
    static constexpr int look_ms = 2;   ///< how often a service looks whether it must end

    explicit FakeService (int p) : server (p) {}

    /// Starts the thread. For the end of the constructor of the service.
    void begin (std::string name)
    {
        runs = std::jthread ([this, called = std::move (name)] (const std::stop_token& stop) {
            while (! stop.stop_requested())
                static_cast<void> (caught (called, [&] { serveNext (stop); }));   // a client may do anything
        });
    }

    /// For its destructor.
    void end() { runs = {}; }

    /// Serves a client until it must end. Throws if the client is gone. [service thread]
    virtual void serve (WebServer::Client&, const std::stop_token&) = 0;

    Fault fault() const noexcept { return wrong; }
    bool mustEnd (const std::stop_token& stop) const noexcept { return stop.stop_requested() || wrong == Fault::restart; }

    template <typename F>
    void count (F&& f)
    {
        const std::lock_guard lock (mutex);
        f (tally);
    }

    mutable std::mutex mutex;   ///< also for what the service keeps
    Counts tally;

private:
    void serveNext (const std::stop_token& stop)
    {
        const auto client = server.next (look_ms);
        if (client == nullptr) return;
        count ([] (Counts& n) { ++n.clients; });
        serve (*client, stop);
        auto restarting = Fault::restart;
        wrong.compare_exchange_strong (restarting, Fault::none);
    }

    WebServer server;
    std::atomic<Fault> wrong = Fault::none;
    std::jthread runs;
};

/// Makes a service, whose constructor throws if its port is taken. Id: device/wire.
template <typename Fake, typename Make>
Result<std::unique_ptr<Fake>> madeService (int port, Make&& make)
{
    std::unique_ptr<Fake> made;
    if (auto done = caught ("the fake service", [&] { made = make(); }); ! done)
        return Message::error ("device/wire", "port " + std::to_string (port), done.error().text, "choose another port");
    return made;
}

}   // namespace tactus::host
