// SPDX-License-Identifier: MIT
// The only file that includes Boost.Beast: both ends share one kind of stream, so that its templates are compiled once.
#include "web_server.hpp"
#include "web_socket.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tactus::host
{

namespace
{
namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;
using Tcp = asio::ip::tcp;
using Clock = WebSocket::Clock;
using namespace std::chrono_literals;

constexpr std::size_t longest_request = 8192;   // in bytes, as many servers have it
constexpr auto longest_greeting = 2s;
constexpr auto until_question = 1s;   // a service that speaks first has done so by then

/// One end of a connection, and its messages.
class End
{
public:
    explicit End (asio::io_context& io) : stream (asio::make_strand (io)), pause (stream.get_executor()) {}

    auto& tcp() { return beast::get_lowest_layer (stream); }

    /// Answers a client that has connected. `done` is told what it has asked for, or why it is refused.
    void accept (std::function<void (error_code, std::string target)> done)
    {
        greeted = std::move (done);
        tcp().socket().set_option (Tcp::no_delay (true));
        tcp().expires_after (longest_greeting);
        asio::async_read_until (tcp(), asio::dynamic_buffer (request, longest_request), "\r\n\r\n", [this] (error_code failed, std::size_t) {
            beast::http::request_parser<beast::http::empty_body> parser;
            if (! failed) parser.put (asio::buffer (request), failed);
            if (! failed && parser.get().count (beast::http::field::origin) > 0) failed = asio::error::access_denied;   // a web page: no driver says that
            if (failed) return greeted (failed, {});
            const auto asked = parser.get().target();
            stream.async_accept (parser.get(), [this, target = std::string (asked.data(), asked.size())] (error_code refused) {
                tcp().expires_never();
                greeted (refused, target);
            });
        });
    }

    /// Connects and shakes hands; reads the first message, too, if `reads`.
    void connect (const Tcp::resolver::results_type& where, const std::string& host, const std::string& target, Clock::duration longest, bool reads,
                  const std::string& question, std::function<void (error_code)> done)
    {
        opened = std::move (done);
        tcp().expires_after (longest);
        tcp().async_connect (where, [this, host, target, reads, question] (error_code failed, const auto&) {
            if (failed) return opened (failed);
            tcp().socket().set_option (Tcp::no_delay (true));
            stream.async_handshake (host, target, [this, reads, question] (error_code refused) {
                if (refused || ! reads) return opened (refused);
                heard = [this] (const std::string& message) {
                    notLater();
                    first = message;
                    return std::string();
                };
                hear (false);
                if (question.empty()) return;
                later (Clock::now() + until_question, [this, question] {
                    if (first.empty()) say (question, [] {});
                });
            });
        });
    }

    /// Passes the next message on, or all that come.
    void hear (bool goes_on)
    {
        stream.async_read (buffer, [this, goes_on] (error_code failed, std::size_t) {
            std::string why = failed ? failed.message() : std::string();
            if (! failed)
            {
                const auto message = beast::buffers_to_string (buffer.data());
                buffer.clear();
                why = heard (message);
            }
            if (! goes_on) return opened (failed);
            if (! why.empty()) lose (why);
            if (trouble().empty()) hear (true);
        });
    }

    void listen (std::function<std::string (const std::string&)> take, std::function<void()> answered)
    {
        heard = std::move (take);
        stream.control_callback ([act = std::move (answered)] (beast::websocket::frame_type kind, beast::string_view) {
            if (kind == beast::websocket::frame_type::pong && act) act();
        });
        hear (true);
    }

    void say (std::string message, std::function<void()> then)
    {
        outgoing = std::move (message);
        said = std::move (then);
        stream.async_write (asio::buffer (outgoing), [this] (error_code failed, std::size_t) {
            if (failed) lose (failed.message());
            std::exchange (said, {})();
        });
    }

    void ping()
    {
        stream.async_ping ({}, [this] (error_code failed) {
            if (failed) lose (failed.message());
        });
    }

    void later (Clock::time_point due, std::function<void()> act)
    {
        pause.expires_at (due);
        pause.async_wait ([then = std::move (act)] (error_code cancelled) {
            if (! cancelled) then();
        });
    }

    void notLater() { pause.cancel(); }

    void lose (const std::string& why)
    {
        {
            const std::lock_guard lock (telling);
            if (! lost_because.empty()) return;
            lost_because = why.empty() ? "it was lost" : why;
        }
        asio::post (stream.get_executor(), [this] {
            error_code ignored;
            pause.cancel();
            tcp().socket().close (ignored);
        });
    }

    std::string trouble() const
    {
        const std::lock_guard lock (telling);
        return lost_because;
    }

    auto executor() { return stream.get_executor(); }

    std::string first;   // the message that connect() has read

private:
    beast::websocket::stream<beast::tcp_stream, false> stream;   // false: without compression, which no service has
    asio::steady_timer pause;
    beast::flat_buffer buffer;
    std::string request;
    std::function<void (error_code, std::string)> greeted;
    std::function<void (error_code)> opened;
    std::function<std::string (const std::string&)> heard;
    std::string outgoing;   // the message on its way
    std::function<void()> said;

    mutable std::mutex telling;
    std::string lost_because;
};

/// Does what is due until something holds, or the time is over.
template <typename F>
void runUntil (asio::io_context& io, Clock::time_point end, F&& so)
{
    io.poll();
    while (! so() && Clock::now() < end)
        io.run_one_until (end);
}

/// An executor of things to do. It waits for more when it has nothing to do.
struct Doing
{
    asio::io_context io;
    asio::executor_work_guard<asio::io_context::executor_type> goes_on { io.get_executor() };
};
}   // namespace

//==============================================================================
struct WebSocket::Inside : Doing
{
    End end { io };
};

WebSocket::WebSocket() : inside (std::make_unique<Inside>()) {}
WebSocket::~WebSocket() { close(); }

void WebSocket::close()
{
    lose ("it was closed");
    runAll();
}

std::string WebSocket::open (const std::string& host, const std::string& port, const std::string& target, Clock::duration longest, std::string* first,
                             const std::string& question)
{
    Tcp::resolver resolver (inside->io);
    error_code failed;
    const auto found = resolver.resolve (host, port, failed);
    if (failed) return failed.message();
    std::optional<error_code> answer;
    inside->end.connect (found, host, target, longest, first != nullptr, question, [&] (error_code e) { answer = e; });
    runUntil (inside->io, Clock::now() + longest + 500ms, [&] { return answer.has_value(); });
    if (! answer || *answer == beast::error::timeout)
    {
        close();   // nothing is left that would answer
        return "the service does not answer";
    }
    if (*answer) return answer->message();
    inside->end.tcp().expires_never();
    if (first != nullptr) *first = std::move (inside->end.first);
    return {};
}

int WebSocket::descriptor() { return inside->end.tcp().socket().native_handle(); }
void WebSocket::post (std::function<void()> act) { asio::post (inside->end.executor(), std::move (act)); }
void WebSocket::later (Clock::time_point due, std::function<void()> act) { inside->end.later (due, std::move (act)); }
void WebSocket::notLater() { inside->end.notLater(); }
void WebSocket::run (Clock::time_point until) { inside->io.run_one_until (until); }
void WebSocket::runOne() { inside->io.poll_one(); }
void WebSocket::runAll() { inside->io.poll(); }
void WebSocket::ping() { inside->end.ping(); }
void WebSocket::lose (const std::string& why) { inside->end.lose (why); }
std::string WebSocket::trouble() const { return inside->end.trouble(); }

void WebSocket::listen (std::function<std::string (const std::string&)> take, std::function<void()> answered)
{
    inside->end.listen (std::move (take), std::move (answered));
}

void WebSocket::say (std::string message, std::function<void()> then) { inside->end.say (std::move (message), std::move (then)); }

//==============================================================================
struct WebServer::Inside : Doing
{
    explicit Inside (int port) : acceptor (io, { asio::ip::address_v4::loopback(), static_cast<std::uint16_t> (port) }) { accept(); }

    void accept()
    {
        acceptor.async_accept ([this] (error_code failed, Tcp::socket socket) {
            if (! failed)
                accepted.emplace (std::move (socket));
            else if (acceptor.is_open() && failed != asio::error::operation_aborted)
                accept();
        });
    }

    Tcp::acceptor acceptor;
    std::optional<Tcp::socket> accepted;
};

struct WebServer::Client::Inside
{
    explicit Inside (asio::io_context& i) : io (i), end (i) {}

    ~Inside()
    {
        end.lose ("it was closed");
        io.poll();   // what was under way ends with an error
    }

    /// Throws if it is gone.
    void demand() const
    {
        if (const auto why = end.trouble(); ! why.empty()) throw std::runtime_error (why);
    }

    asio::io_context& io;
    std::string path;
    std::deque<std::string> messages;
    End end;
};

WebServer::WebServer (int port) : inside (std::make_unique<Inside> (port)) {}
WebServer::~WebServer() = default;

int WebServer::port() const noexcept
{
    error_code failed;
    return inside->acceptor.local_endpoint (failed).port();
}

std::unique_ptr<WebServer::Client> WebServer::next (int ms)
{
    auto& own = *inside;
    runUntil (own.io, Clock::now() + std::chrono::milliseconds (ms), [&] { return own.accepted.has_value(); });
    if (! own.accepted) return nullptr;
    std::optional<error_code> answer;   // outlives the client, whose end tells it
    auto client = std::make_unique<Client::Inside> (own.io);
    client->end.tcp().socket() = std::move (*own.accepted);
    own.accepted.reset();
    own.accept();

    client->end.accept ([&answer, to = client.get()] (error_code e, std::string target) {
        answer = e;
        to->path = std::move (target);
    });
    runUntil (own.io, Clock::now() + 2 * longest_greeting, [&] { return answer.has_value(); });
    if (! answer || *answer) return nullptr;
    client->end.listen (
        [&all = client->messages] (const std::string& message) {
            all.push_back (message);
            return std::string();
        },
        {});
    return std::unique_ptr<Client> (new Client (std::move (client)));
}

WebServer::Client::Client (std::unique_ptr<Inside> i) : inside (std::move (i)) {}
WebServer::Client::~Client() = default;

const std::string& WebServer::Client::target() const noexcept { return inside->path; }

bool WebServer::Client::says (int ms)
{
    auto& own = *inside;
    runUntil (own.io, Clock::now() + std::chrono::milliseconds (ms), [&] { return ! own.messages.empty() || ! own.end.trouble().empty(); });
    if (own.messages.empty()) own.demand();
    return ! own.messages.empty();
}

std::string WebServer::Client::hear()
{
    auto message = std::move (inside->messages.front());
    inside->messages.pop_front();
    return message;
}

void WebServer::Client::say (const std::string& message)
{
    auto& own = *inside;
    bool is_said = false;
    own.end.say (message, [&] { is_said = true; });
    while (! is_said)
        own.io.run_one();
    own.demand();
}

}   // namespace tactus::host
