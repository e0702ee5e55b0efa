// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace tactus::host
{

/// A fake of the service through which programs drive Haply's Inverse3: WebSocket and JSON on this computer. It sends one full message when a client
/// connects, and then one message for each message of the client. A force lasts for one tick of 1 ms, and both spellings of it are understood. A
/// simulated hand moves the cursor and feels the force, in wall time; its rotation and its buttons 0 to 3 are those of the wireless grip. One client
/// at a time. Runs on a thread of its own. [any thread]
class FakeInverse3
{
public:
    /// A fault of the fake Inverse3.
    enum class Fault
    {
        none,
        push,      ///< sends a message every 2 ms, and answers nothing
        silent,    ///< takes messages and answers nothing
        rename,    ///< its device has another id
        restart,   ///< closes the connection; afterwards it behaves well again
        shy,       ///< says nothing to a new client before it is asked
        deaf,      ///< understands no force, so the arm stays idle
        garbage    ///< answers with something that is not JSON
    };

    struct Counts
    {
        std::uint64_t clients = 0, heard = 0, forces = 0, probes = 0, answered = 0;
        std::uint64_t pushes = 0;     ///< forces that were not 0
        std::uint64_t together = 0;   ///< messages that came before the one before had been answered
        std::uint64_t refused = 0;    ///< messages that are not JSON, or are for another device
        double largest = 0.0;         ///< force so far, in N
    };

    /// A port of 0 becomes a free one. `answer_after_ms` delays each answer. Id: device/wire.
    static Result<std::unique_ptr<FakeInverse3>> make (int port, std::unique_ptr<Device> hand, int answer_after_ms = 0);

    virtual ~FakeInverse3() = default;

    virtual int port() const noexcept = 0;
    virtual void fail (Fault) noexcept = 0;
    virtual Counts counts() const = 0;
    virtual Vec3 force() const = 0;   ///< that acts now: 0 unless a message with a force has come within the last tick
};

}   // namespace tactus::host
