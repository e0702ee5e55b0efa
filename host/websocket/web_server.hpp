// SPDX-License-Identifier: MIT
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace tactus::host
{

/// The service's end of a WebSocket on this computer, with text messages: for fakes. One client at a time. [one thread]
class WebServer
{
    using Tcp = boost::asio::ip::tcp;

public:
    /// A client that has shaken hands. Its functions throw std::runtime_error if it is gone.
    class Client
    {
    public:
        Client (boost::asio::io_context& context, Tcp::socket socket) : io (context), stream (std::move (socket))
        {
            namespace http = boost::beast::http;
            stream.next_layer().set_option (Tcp::no_delay (true));
            http::request<http::string_body> request;
            http::read (stream.next_layer(), buffer, request);
            path = { request.target().data(), request.target().size() };
            stream.accept (request);
            buffer.clear();
            listen();
        }

        ~Client()
        {
            boost::system::error_code ignored;
            stream.next_layer().close (ignored);
            io.restart();
            io.poll();   // what was under way ends with an error
        }

        Client (const Client&) = delete;
        Client& operator= (const Client&) = delete;

        const std::string& target() const noexcept { return path; }   ///< what it has asked for, as "/v2/feedbacks?app_id=x"

        /// True if a message has come, or comes within this time. Pings are answered meanwhile.
        bool says (int ms)
        {
            const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds (ms);
            io.restart();
            io.poll();
            while (messages.empty() && ! why && std::chrono::steady_clock::now() < end)
            {
                io.restart();
                io.run_one_until (end);
            }
            if (messages.empty() && why) throw std::runtime_error (*why);
            return ! messages.empty();
        }

        /// The next message, after says().
        std::string hear()
        {
            auto message = std::move (messages.front());
            messages.pop_front();
            return message;
        }

        void say (const std::string& message)
        {
            bool is_sent = false;
            stream.async_write (boost::asio::buffer (message), [&] (boost::system::error_code failed, std::size_t) {
                is_sent = true;
                if (failed) why = failed.message();
            });
            while (! is_sent)
            {
                io.restart();
                io.run_one();
            }
            if (why) throw std::runtime_error (*why);
        }

    private:
        void listen()
        {
            stream.async_read (buffer, [this] (boost::system::error_code failed, std::size_t) {
                if (failed)
                {
                    why = failed.message();
                    return;
                }
                messages.push_back (boost::beast::buffers_to_string (buffer.data()));
                buffer.clear();
                listen();
            });
        }

        boost::asio::io_context& io;
        boost::beast::websocket::stream<Tcp::socket> stream;
        boost::beast::flat_buffer buffer;
        std::string path;
        std::deque<std::string> messages;
        std::optional<std::string> why;   // it is gone
    };

    /// Listens on this computer. A port of 0 becomes a free one. Throws if it is taken.
    explicit WebServer (int p) : acceptor (io, { boost::asio::ip::address_v4::loopback(), static_cast<std::uint16_t> (p) }) { accept(); }

    int port() const noexcept
    {
        boost::system::error_code failed;
        return acceptor.local_endpoint (failed).port();
    }

    /// The next client; none if none comes within this time. The last one must be gone.
    std::unique_ptr<Client> next (int ms)
    {
        io.restart();
        io.run_for (std::chrono::milliseconds (ms));
        if (! accepted) return nullptr;
        auto socket = std::move (*accepted);
        accepted.reset();
        accept();
        return std::make_unique<Client> (io, std::move (socket));
    }

private:
    void accept()
    {
        acceptor.async_accept ([this] (boost::system::error_code failed, Tcp::socket socket) {
            if (! failed)
                accepted.emplace (std::move (socket));
            else if (acceptor.is_open() && failed != boost::asio::error::operation_aborted)
                accept();
        });
    }

    boost::asio::io_context io;
    Tcp::acceptor acceptor;
    std::optional<Tcp::socket> accepted;
};

}   // namespace tactus::host
