// SPDX-License-Identifier: MIT
// The process between the driver and a Falcon without a serial port. It opens the adapter by libftdi and carries bytes between that and a pseudo-terminal,
// whose speed it sets at the adapter. If the driver ends, is killed or falls silent, it takes the force off. Its arguments are the number of the Falcon, and
// the files of the pseudo-terminal and of the pipes of a HelperProcess; its first line says why it cannot begin, or nothing. The functions are those of the
// public C interface of libftdi 1. No Falcon has been tried. See docs/known_devices.md.
#include "packets.hpp"

#include <host/drivers/makers_library.hpp>

#include <asm/termbits.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <string>

namespace
{
using namespace tactus::host::falcon;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto silent = 150ms, stays = 500ms;   // a driver with a force on the Falcon that sends nothing, if no guardian acts; after the driver, for that
constexpr int between_looks_ms = 2;

// clang-format off
#define FTDI_FUNCTIONS(X) \
    X (void*, ftdi_new, ()) X (void, ftdi_free, (void*)) X (const char*, ftdi_get_error_string, (void*)) X (int, ftdi_set_baudrate, (void*, int)) \
    X (int, ftdi_usb_open_desc_index, (void*, int vendor, int product, const char* description, const char* serial, unsigned index)) \
    X (int, ftdi_set_line_property, (void*, int bits, int stop, int parity)) X (int, ftdi_setflowctrl, (void*, int)) \
    X (int, ftdi_set_latency_timer, (void*, unsigned char ms)) X (int, ftdi_setdtr_rts, (void*, int dtr, int rts)) \
    X (int, ftdi_read_data, (void*, unsigned char*, int)) X (int, ftdi_write_data, (void*, const unsigned char*, int))
// clang-format on

/// The adapter of a Falcon, by libftdi.
struct Adapter
{
    FTDI_FUNCTIONS (TACTUS_FUNCTION_OF_LIBRARY)
    int (*flush) (void*) = nullptr;
    void* context = nullptr;

    /// The reason if it cannot be opened.
    std::string open (unsigned number)
    {
        tactus::host::MakersLibrary library { "libftdi1.so.2" };
        FTDI_FUNCTIONS (TACTUS_NEED_IN_LIBRARY)
        if (! library.why().empty()) return "libftdi " + library.why() + " (on Debian: sudo apt install libftdi1-2)";
        if (! library.find ("ftdi_tcioflush", flush)) library.find ("ftdi_usb_purge_buffers", flush);   // its name until 1.4
        context = ftdi_new();
        if (context == nullptr) return "libftdi has no memory";
        const int failed = ftdi_usb_open_desc_index (context, 0x0403, 0xcb48, nullptr, nullptr, number);
        if (failed == 0) return {};
        const char* remedy = failed == -4   ? ": you may not open it; docs/known_devices.md has a udev rule"
                             : failed == -5 ? ": another role or another program is using it"
                                            : "";
        return "libftdi says: " + std::string (ftdi_get_error_string (context)) + remedy;
    }

    /// As the driver has set up its end. Before firmware is loaded, the speed also says what the lines are.
    void set (unsigned baud) const
    {
        ftdi_set_line_property (context, 8, 0, 0);   // bits, one stop bit, no parity
        ftdi_setflowctrl (context, 0);
        ftdi_set_latency_timer (context, baud == normal_baud ? 1 : 16);
        ftdi_set_baudrate (context, static_cast<int> (baud));
        if (flush != nullptr) flush (context);
        if (baud != normal_baud) ftdi_setdtr_rts (context, 0, 0);
        if (baud == hello_baud) ftdi_setdtr_rts (context, 1, 0);
    }

    bool put (const std::uint8_t* bytes, int count) const { return ftdi_write_data (context, bytes, count) == count; }
    bool rest() const { return put (at_rest.data(), static_cast<int> (at_rest.size())); }

    /// Waits until bytes come, as long as the adapter keeps them: 1 ms, while it is used. Below 0: it is gone.
    int get (std::array<std::uint8_t, 512>& to) const { return ftdi_read_data (context, to.data(), static_cast<int> (to.size())); }
};

/// Carries bytes both ways until the driver or the Falcon is gone. `driver`: the pipe that ends with it.
void carry (const Adapter& adapter, int line, int driver)
{
    std::array<std::uint8_t, 512> bytes {};
    unsigned baud = 0;
    int unanswered = 0;   // bytes that the Falcon has not answered
    bool pushes = false, is_there = true, has_left = false;
    auto heard = Clock::now();   // the driver
    while (is_there)
    {
        std::array wait { pollfd { line, POLLIN, 0 }, pollfd { driver, 0, 0 } };
        static_cast<void> (::poll (wait.data(), wait.size(), unanswered > 0 ? 0 : between_looks_ms));
        const int count = (wait[0].revents & POLLIN) != 0 ? static_cast<int> (::read (line, bytes.data(), bytes.size())) : 0;
        has_left = has_left || wait[1].revents != 0;
        if (termios2 how {}; ::ioctl (line, TCGETS2, &how) == 0 && how.c_ospeed != baud) adapter.set (baud = how.c_ospeed);
        const auto now = Clock::now();
        if (count > 0)
        {
            is_there = adapter.put (bytes.data(), count);
            unanswered += count;
            const auto* const end = bytes.data() + count;
            pushes = baud == normal_baud && ! std::equal (end - std::min (count, int { at_rest.size() }), end, at_rest.begin(), at_rest.end());   // or may push
            heard = now;
        }
        if (pushes && (has_left || now - heard > silent))
        {
            is_there = adapter.rest();
            pushes = false;
        }
        const bool is_closed = count <= 0 && (wait[0].revents & POLLHUP) != 0;   // by the guardian, too
        if (has_left && (is_closed || now - heard > stays)) break;
        const int got = adapter.get (bytes);
        is_there = is_there && got >= 0;
        unanswered -= std::min (unanswered, std::max (got, 0));
        if (got > 0 && ::write (line, bytes.data(), static_cast<std::size_t> (got)) < 0 && errno != EAGAIN && errno != EIO) break;
    }
    static_cast<void> (adapter.rest());
}
}   // namespace

int main (int count, char** arguments)
{
    if (count < 5) return 2;
    Adapter adapter;
    const auto told = adapter.open (static_cast<unsigned> (std::atoi (arguments[1]))) + "\n";
    if (::write (std::atoi (arguments[4]), told.data(), told.size()) < 0 || told.size() > 1) return 1;
    carry (adapter, std::atoi (arguments[2]), std::atoi (arguments[3]));
    adapter.ftdi_free (adapter.context);
    return 0;
}
