// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tactus::host
{

/// Reports that are written to a device file if this process dies while one of these lives, however it dies:
///  - after a fault (SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL) at once, by a signal handler that does nothing but write;
///    what handled the signal before handles it then;
///  - after anything else (kill -9, no memory left) by a guardian, a small process that holds the device file, too, and
///    learns of the death by the end of a socket.
///
/// Good to know
///  - After a fault both write; the reports have to bear being written twice.
///  - A stack that has overflown leaves the handler no room, and the guardian does it alone.
///  - The guardian is forked when the first will is left and ends with this process. It heeds no Ctrl-C.
class LastWill
{
public:
    struct Report
    {
        std::vector<std::uint8_t> bytes;   ///< as write(2) takes them
        bool is_feature = false;           ///< sent as a feature report of a hidraw device
    };

    static constexpr std::size_t most_wills = 16, most_reports = 16, most_bytes = 4096;

    /// Nothing is written by this. Or why not. [main thread, or one that opens devices]
    static tl::expected<LastWill, std::string> leave (const std::string& device_file, const std::vector<Report>&);

    LastWill (LastWill&&) noexcept;
    LastWill& operator= (LastWill&&) noexcept;
    ~LastWill();   ///< takes it back

private:
    explicit LastWill (int s) noexcept : slot (s) {}

    static constexpr int none = -1;
    int slot = none;
};

}   // namespace tactus::host
