// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

namespace tactus::host
{

/// The service's end of a WebSocket on this computer, with text messages: for fakes and for the relay of a
/// capture. Web pages are refused: a browser says where a page comes from (Origin). One client at a time. [one thread]
class WebServer
{
    struct Inside;

public:
    /// A client that has shaken hands. Its functions throw std::runtime_error if it is gone.
    class Client
    {
    public:
        ~Client();
        Client (const Client&) = delete;
        Client& operator= (const Client&) = delete;

        const std::string& target() const noexcept;   ///< what it has asked for, as "/v2/feedbacks?app_id=x"

        /// True if a message has come, or comes within this time. Pings are answered meanwhile.
        bool says (int ms);

        /// The next message, after says().
        std::string hear();

        void say (const std::string& message);

    private:
        friend class WebServer;
        struct Inside;
        explicit Client (std::unique_ptr<Inside>);
        const std::unique_ptr<Inside> inside;
    };

    /// Listens on this computer. A port of 0 becomes a free one. Throws if it is taken.
    explicit WebServer (int port);
    ~WebServer();
    WebServer (const WebServer&) = delete;
    WebServer& operator= (const WebServer&) = delete;

    int port() const noexcept;

    /// The next client; none if none comes within this time, or if it does not shake hands. The last one must be gone.
    std::unique_ptr<Client> next (int ms);

private:
    const std::unique_ptr<Inside> inside;
};

}   // namespace tactus::host
