// SPDX-License-Identifier: MIT
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace tactus::host
{

/// The client's end of a WebSocket with text messages, for drivers. Whatever touches the stream happens on its strand, on whichever thread calls run():
/// the reading thread, and that of `rest`. Nothing else waits.
class WebSocket
{
public:
    using Clock = std::chrono::steady_clock;

    WebSocket() = default;
    WebSocket (const WebSocket&) = delete;
    WebSocket& operator= (const WebSocket&) = delete;

    ~WebSocket() { close(); }

    /// What was under way ends with an error. For the destructor of whoever is called, when no other thread uses this any more.
    void close()
    {
        lose ("it was closed");
        io.restart();
        io.poll();
    }

    /// Connects, and waits for a message if `first` is not null. Returns why it cannot; empty if it can.
    std::string open (const std::string& host, const std::string& port, const std::string& target, Clock::duration longest, std::string* first)
    {
        namespace asio = boost::asio;
        using boost::system::error_code;
        asio::ip::tcp::resolver resolver (io);
        error_code failed;
        const auto found = resolver.resolve (host, port, failed);
        if (failed) return failed.message();
        auto& tcp = boost::beast::get_lowest_layer (stream);
        std::string why = "the service does not answer";
        bool is_done = false;
        tcp.expires_after (longest);
        tcp.async_connect (found, [&] (error_code e, const auto&) {
            if (e) return void (why = e.message());
            tcp.socket().set_option (asio::ip::tcp::no_delay (true));
            stream.async_handshake (host, target, [&] (error_code refused) {
                if (refused) return void (why = refused.message());
                why.clear();
                is_done = first == nullptr;
                if (is_done) return;
                stream.async_read (buffer, [&] (error_code lost, std::size_t) {
                    why = lost ? lost.message() : std::string();
                    is_done = true;
                });
            });
        });
        io.run_for (longest + std::chrono::milliseconds (500));
        if (! is_done || ! why.empty()) return why.empty() ? "the service does not answer" : why;
        tcp.expires_never();
        if (first != nullptr) *first = boost::beast::buffers_to_string (buffer.data());
        buffer.clear();
        io.restart();
        return {};
    }

    /// For timers that act on the strand.
    auto executor() { return stream.get_executor(); }

    /// Acts on the strand. [any thread]
    template <typename F>
    void post (F&& act)
    {
        boost::asio::post (stream.get_executor(), std::forward<F> (act));
    }

    /// Does one thing that is due on the strand, or waits for it until then.
    void run (Clock::time_point until)
    {
        io.run_one_until (until);
        if (io.stopped()) io.restart();
    }

    /// Does all that is due, without waiting.
    void runAll() { io.poll(); }

    /// From now on, calls `take` with each message, on the strand. What it returns is why the connection cannot be used any more; empty if it can.
    /// `answered` is called for each answer to ping(). [strand]
    void listen (std::function<std::string (const std::string&)> take, std::function<void()> answered = {})
    {
        heard = std::move (take);
        stream.control_callback ([act = std::move (answered)] (boost::beast::websocket::frame_type kind, boost::beast::string_view) {
            if (kind == boost::beast::websocket::frame_type::pong && act) act();
        });
        hear();
    }

    /// Sends a message, and then calls `then`. One at a time. [strand]
    template <typename F>
    void say (std::string message, F&& then)
    {
        outgoing = std::move (message);
        stream.async_write (boost::asio::buffer (outgoing), [this, then = std::forward<F> (then)] (boost::system::error_code failed, std::size_t) {
            if (failed) lose (failed.message());
            then();
        });
    }

    /// Asks whether the service is there. When it answers, it has taken all messages before. One at a time. [strand]
    void ping()
    {
        stream.async_ping ({}, [this] (boost::system::error_code failed) {
            if (failed) lose (failed.message());
        });
    }

    /// The connection cannot be used any more. [any thread]
    void lose (const std::string& why)
    {
        {
            const std::lock_guard lock (telling);
            if (! lost_because.empty()) return;
            lost_because = why;
        }
        post ([this] {
            boost::system::error_code ignored;
            boost::beast::get_lowest_layer (stream).socket().close (ignored);
        });
    }

    /// Why it cannot be used any more; empty while it can. [any thread]
    std::string trouble() const
    {
        const std::lock_guard lock (telling);
        return lost_because;
    }

private:
    void hear()
    {
        stream.async_read (buffer, [this] (boost::system::error_code failed, std::size_t) {
            if (failed) return lose (failed.message());
            const auto message = boost::beast::buffers_to_string (buffer.data());
            buffer.clear();
            if (const auto why = heard (message); ! why.empty()) lose (why);
            if (trouble().empty()) hear();
        });
    }

    boost::asio::io_context io;
    boost::beast::websocket::stream<boost::beast::tcp_stream> stream { boost::asio::make_strand (io) };
    boost::beast::flat_buffer buffer;
    std::function<std::string (const std::string&)> heard;
    std::string outgoing;   // the message on its way

    mutable std::mutex telling;
    std::string lost_because;
};

}   // namespace tactus::host
