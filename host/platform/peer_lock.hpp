// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <string_view>
#include <utility>

namespace tactus::host
{

/// The far end of a connected socket, which only one holder may drive, in this process or in another one of this computer, whoever has started it. The system
/// releases it when the process ends, for whatever reason. All addresses of this computer count as one. Two addresses of another computer count as two,
/// because nothing here tells that they lead to the same device. Works only on Linux; elsewhere, each call gets a lock. [any thread]
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
