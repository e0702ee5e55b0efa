// SPDX-License-Identifier: MIT
#include "service_relay.hpp"
#include "web_server.hpp"

#include <tactus/text/caught.hpp>

#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace tactus::host
{

namespace
{
using namespace std::chrono_literals;

constexpr int look_ms = 2;   // how often it looks whether it must end
constexpr auto until_connected = 2s;

class Relay final : public ServiceRelay
{
public:
    Relay (ServiceAddress a, See s) : address (std::move (a)), see (std::move (s)), server (0)
    {
        runs = std::jthread ([this] (const std::stop_token& stop) {
            while (! stop.stop_requested())
                static_cast<void> (caught ("the relay", [&] { passOn (stop); }));   // either end may go away
        });
    }

    int port() const noexcept override { return server.port(); }

    std::string trouble() const override
    {
        const std::lock_guard lock (mutex);
        return why;
    }

private:
    void passOn (const std::stop_token& stop)
    {
        const auto driver = server.next (look_ms);
        if (driver == nullptr) return;
        std::deque<std::string> to_service, to_driver;
        bool is_saying = false;
        WebSocket service;   // last: it uses what is above
        auto failed = service.open (address.host, address.port, driver->target(), until_connected, nullptr);
        {
            const std::lock_guard lock (mutex);
            why = failed;
        }
        if (! failed.empty()) return;
        service.post ([&] {
            service.listen ([&] (const std::string& message) {
                to_driver.push_back (message);
                return std::string();
            });
        });
        while (! stop.stop_requested() && service.trouble().empty())
        {
            service.run (WebSocket::Clock::now() + 1ms);
            for (; ! to_driver.empty(); to_driver.pop_front())
            {
                see (true, to_driver.front());
                driver->say (to_driver.front());
            }
            while (driver->says (0))
            {
                to_service.push_back (driver->hear());
                see (false, to_service.back());
            }
            if (is_saying || to_service.empty()) continue;
            is_saying = true;
            service.post ([&] {
                service.say (std::move (to_service.front()), [&] { is_saying = false; });
                to_service.pop_front();
            });
        }
    }

    const ServiceAddress address;
    const See see;
    WebServer server;
    mutable std::mutex mutex;
    std::string why;
    std::jthread runs;   // last: it uses the other members
};
}   // namespace

Result<std::unique_ptr<ServiceRelay>> ServiceRelay::make (const ServiceAddress& address, See see)
{
    std::unique_ptr<ServiceRelay> made;
    if (auto done = caught ("the relay", [&] { made = std::make_unique<Relay> (address, std::move (see)); }); ! done)
        return Message::error ("device/wire", "localhost", done.error().text, "free a port of this computer");
    return made;
}

}   // namespace tactus::host
