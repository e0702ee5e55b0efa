// SPDX-License-Identifier: MIT
#pragma once

#include "web_socket.hpp"

#include <host/base/platform/peer_lock.hpp>

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace tactus::host
{

/// The address of a service.
struct ServiceAddress
{
    std::string host, port;

    /// Reads HOST:PORT, or PORT on this computer; `otherwise` if that is empty. None if it is neither.
    static std::optional<ServiceAddress> read (std::string_view text, std::string_view otherwise);
};

/// Talks with a service in turns. Nothing is said before the last message has been answered, so at most one message is on its way, and it is the
/// newest. One thread reads and another one writes, as in the interface of drivers; neither waits for the other.
class Exchange
{
public:
    using Clock = WebSocket::Clock;

    /// The times that it waits for an answer.
    struct Promises
    {
        Clock::duration late {};                                   ///< then offers fail
        Clock::duration gone {};                                   ///< then the service is not there any more
        Clock::duration rested = std::chrono::milliseconds (15);   ///< then rest() closes the connection; it may take 20 ms
        Clock::duration connected = std::chrono::seconds (2);

        /// The same for a computer that is so many times slower: for tests.
        Promises operator* (int times) const { return { times * late, times * gone, times * rested, times * connected }; }
    };

    /// The kind of message that counts as an answer.
    enum class Answer
    {
        message,   ///< any message
        pong       ///< a ping follows each message. When it is answered, the message has been taken
    };

    struct Turn
    {
        Clock::time_point due {};   ///< nothing is said before, unless something new is offered
        std::string message {};     ///< empty: only a ping
    };

    /// The part of an exchange that depends on the service: it decides what is said, and takes what is heard.
    class Partner
    {
    public:
        /// The next message to say, if it is due now. [strand, with `mutex` held]
        virtual Turn speak (Clock::time_point now) = 0;

        /// Takes a message. Returns why the connection cannot be used any more; empty if it can. [strand]
        virtual std::string hear (const std::string& message) = 0;

        /// The last message has been answered. [strand, with `mutex` held]
        virtual void takeAnswer() {}

        /// From now on, until something else is offered, speak() asks for rest. [writing thread, with `mutex` held]
        virtual void askForRest() = 0;

        /// True once speak() has asked for rest. [writing thread, with `mutex` held]
        virtual bool hasAskedForRest() const = 0;

    protected:
        ~Partner() = default;
    };

    /// `service` is what messages call it: "the service". The partner must outlive this.
    Exchange (Partner&, std::string service, Answer, const Promises&);

    /// Connects, and waits for a message if `first` is not null. If none has come after a second, sends `question`, if it is not empty: some services
    /// only answer. Returns why it cannot; empty if it can.
    std::string open (const ServiceAddress&, const std::string& path, std::string* first, const std::string& question = {});

    /// Makes sure that no other role or program drives this part of the open service. Returns why it cannot; empty if it can.
    std::string claim (std::string_view part);

    /// Begins to talk. [the thread that has opened it]
    void begin();

    enum class Got
    {
        something,
        nothing,   ///< in this time
        gone       ///< trouble() says why
    };

    /// Waits until `take` has found something, which is called with `mutex` held. [reading thread]
    Got wait (Clock::time_point until, const std::function<bool()>& take);

    /// Says something new as soon as the last message has been answered. `put` says what, and is called with `mutex` held. Returns why that is not
    /// possible, or that the answer is late: then it is still what is said next. Empty otherwise. [writing thread]
    std::string offer (const std::function<void()>& put);

    /// Asks for rest, and waits for the answer. If this takes too long, closes the connection. [writing thread]
    void rest();

    std::string trouble() const { return socket.trouble(); }   ///< [any thread]

    std::mutex mutex;   ///< protects what the threads share; never held while waiting

private:
    void talk();
    void ask();
    void takeAnswer();
    bool isWaiting() const { return is_writing || is_asking; }
    std::string lateBy (Clock::duration) const;

    Partner& partner;
    const std::string service;
    const Answer answer;
    const Promises promises;
    bool is_writing = false, is_asking = false;   // a message is on its way out; it waits for its answer
    Clock::time_point sent;
    std::optional<PeerLock> claimed;
    WebSocket socket;   // last: what it calls uses the other members
};

}   // namespace tactus::host
