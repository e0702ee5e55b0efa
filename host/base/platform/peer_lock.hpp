// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <string_view>
#include <utility>

namespace tactus::host
{

/// A lock on the device at the far end of a connected socket. Only one role of one process on this computer can hold it, whichever user runs the process. The
/// system releases it when the process ends, even after a crash. All addresses of this computer count as one. Two addresses of another computer count as
/// two, because nothing shows that they lead to the same device. Works only on Linux; elsewhere, every call succeeds. [any thread]
class PeerLock
{
public:
    /// `part` names one of several devices behind the same port. Empty if another holder has the lock.
    static std::optional<PeerLock> take (int connected_socket, std::string_view part = {});

    PeerLock (PeerLock&& other) noexcept : slot (std::exchange (other.slot, nullptr)) {}
    PeerLock& operator= (PeerLock&& other) noexcept
    {
        std::swap (slot, other.slot);
        return *this;
    }
    ~PeerLock();

private:
    explicit PeerLock (std::atomic<int>* s) noexcept : slot (s) {}

    std::atomic<int>* slot;   // of the table of all locks of this process
};

}   // namespace tactus::host
