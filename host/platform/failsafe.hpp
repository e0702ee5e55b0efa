// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/text/result.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tactus::host
{

/// Reports that are written to a device file if this process dies, for whatever reason, while the object exists:
///  - after a fault (SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL) immediately, by a signal handler that only writes; then the
///    previous signal handler runs;
///  - after anything else (kill -9, out of memory) by a guardian: a small process that also has the device file open, and
///    notices the death because a socket closes.
///
/// Good to know
///  - After a fault both the handler and the guardian write, so the device must tolerate receiving the reports twice.
///  - After a stack overflow the handler has no stack, so only the guardian writes.
///  - The guardian is forked when the first failsafe is armed, and ends with this process. It ignores Ctrl-C.
class Failsafe
{
public:
    struct Report
    {
        std::vector<std::uint8_t> bytes;   ///< in the form that write(2) expects
        bool is_feature = false;           ///< sent as a feature report of a hidraw device
    };

    static constexpr std::size_t most_devices = 16, most_reports = 16, most_bytes = 4096;

    /// Arms the failsafe. Writes nothing now. Id: device/failsafe. [main thread, or one that opens devices]
    static Result<Failsafe> arm (const std::string& device_file, const std::vector<Report>&);

    Failsafe (Failsafe&&) noexcept;
    Failsafe& operator= (Failsafe&&) noexcept;
    ~Failsafe();   ///< disarms the failsafe

private:
    explicit Failsafe (int s) noexcept : slot (s) {}

    static constexpr int none = -1;
    int slot = none;
};

}   // namespace tactus::host
