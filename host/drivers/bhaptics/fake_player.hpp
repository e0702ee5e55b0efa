// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// A fake of bHaptics Player (version 2), the program that drives vests: WebSocket and JSON on this computer, at /v2/feedbacks. It says which devices it has
/// when a client connects, and again when that changes. A frame drives its motors until it has lasted as long as it says, another frame with its key comes,
/// or its key is turned off. One client at a time. Runs on a thread of its own. [any thread]
class FakePlayer
{
public:
    /// A fault of the fake Player.
    enum class Fault
    {
        none,
        silent,    ///< takes nothing and answers nothing
        garbage,   ///< sends something that is not JSON
        restart,   ///< closes the connection; afterwards it behaves well again
        unworn     ///< has no vest any more
    };

    struct Counts
    {
        std::uint64_t clients = 0, heard = 0, frames = 0, turned_off = 0;
        std::uint64_t refused = 0;   ///< messages that are not what the description says, and clients that ask for something else
        int largest = 0;             ///< intensity so far
    };

    /// A port of 0 becomes a free one. Id: device/wire.
    static Result<std::unique_ptr<FakePlayer>> make (int port);

    virtual ~FakePlayer() = default;

    virtual int port() const noexcept = 0;
    virtual void fail (Fault) noexcept = 0;
    virtual Counts counts() const = 0;
    virtual std::vector<std::string> heard() const = 0;                         ///< all messages so far
    virtual int intensity (const std::string& position, int motor) const = 0;   ///< 0 to 100, now
    virtual bool isSilent() const = 0;                                          ///< no motor is driven now
};

}   // namespace tactus::host
