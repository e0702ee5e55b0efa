// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace tactus::host
{

/// The client's end of a WebSocket with text messages, for drivers. Whatever touches the connection happens on its strand: one thing at a time, on
/// whichever thread calls run(): the reading thread, and that of `rest`. Nothing else waits.
class WebSocket
{
public:
    using Clock = std::chrono::steady_clock;

    WebSocket();
    ~WebSocket();   ///< closes
    WebSocket (const WebSocket&) = delete;
    WebSocket& operator= (const WebSocket&) = delete;

    /// Ends what is under way with an error. Call it in the destructor of the object that is called, when no other thread uses this any more.
    void close();

    /// Connects, and waits for a message if `first` is not null. If none has come after a second, sends `question`, if it is not empty. Returns why it
    /// cannot; empty if it can.
    std::string open (const std::string& host, const std::string& port, const std::string& target, Clock::duration longest, std::string* first,
                      const std::string& question = {});

    int descriptor();   ///< of the connection

    /// Acts on the strand. [any thread]
    void post (std::function<void()> act);

    /// Acts on the strand at that time, instead of what the last call has asked for. [strand]
    void later (Clock::time_point due, std::function<void()> act);

    /// Forgets what later() was asked for. [strand]
    void notLater();

    /// Does one thing that is due on the strand, or waits for it until then.
    void run (Clock::time_point until);

    /// Does one thing that is due, without waiting.
    void runOne();

    /// Does all that is due, without waiting.
    void runAll();

    /// From now on, calls `take` with each message, on the strand. What it returns is why the connection cannot be used any more; empty if it can.
    /// `answered` is called for each answer to ping(). [strand]
    void listen (std::function<std::string (const std::string&)> take, std::function<void()> answered = {});

    /// Sends a message, and then calls `then`, also if that has failed. One at a time. [strand]
    void say (std::string message, std::function<void()> then);

    /// Asks whether the service is there. When it answers, it has taken all messages before. One at a time. [strand]
    void ping();

    void lose (const std::string& why);   ///< the connection cannot be used any more   [any thread]
    std::string trouble() const;          ///< why it cannot be used any more; empty while it can   [any thread]

private:
    struct Inside;
    const std::unique_ptr<Inside> inside;
};

}   // namespace tactus::host
