// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tactus::host
{

/// A lock on the device at the far end of a connected socket. Only one role of one process on this computer can hold it. The system releases it when the
/// process ends, even after a crash. All addresses of this computer count as one. Two addresses of another computer count as two, because nothing shows
/// that they lead to the same device. Works only on Linux; elsewhere, every call succeeds. [any thread]
///
/// Programs of the same user exclude each other by a lock in a file that no other user can open (runFolder()). Between users, it is a name of the system.
/// Any user of the computer can take such a name, so whose lock counts is a decision:
///
///  - The lock of another process of this user counts.
///  - The lock of another user, root included, counts only if that user also has a connection to the device, by the tables of the kernel. Such a user can
///    push the device, or keep it busy, with or without a lock; a lock without a connection would only take the device from its owner. It is passed over:
///    the lock gets a second name, a third, up to `most_names`, and everybody looks at them in the same order. If all are passed over, the lock in the
///    file is enough. Without such a file, the device is refused.
///  - The lock of an unknown user (its queue is full) counts if anybody else has a connection to the device.
class PeerLock
{
public:
    static constexpr int most_names = 8;

    struct Attempt;

    /// `part` names one of several devices behind the same port.
    static Attempt take (int connected_socket, std::string_view part = {});

    PeerLock (PeerLock&& other) noexcept : slots (std::exchange (other.slots, {})) {}
    PeerLock& operator= (PeerLock&& other) noexcept
    {
        std::swap (slots, other.slots);
        return *this;
    }
    ~PeerLock();

private:
    PeerLock() = default;

    std::array<std::atomic<int>*, 2> slots {};   // the file and the name, in the table of all locks of this process; null: there is none
};

/// The lock, or who has it.
struct PeerLock::Attempt
{
    std::optional<PeerLock> lock {};
    std::string why {};   ///< if there is none: "the user ada is using it (process 1234, tactus)"

    explicit operator bool() const noexcept { return lock.has_value(); }
};

}   // namespace tactus::host
