// SPDX-License-Identifier: MIT
// The process between the driver and a Falcon without a serial port. It opens the adapter by libftdi and carries bytes between that and a pseudo-terminal,
// whose speed it sets at the adapter. If the driver ends, is killed or falls silent, it takes the force off. Its arguments are the number of the Falcon, and
// the files of the pseudo-terminal and of a pipe, into which it writes why it cannot begin, or an empty line. The functions are those of the public C
// interface of libftdi 1. No Falcon has been tried. See docs/known_devices.md.
#include "packets.hpp"

#include <asm/termbits.h>
#include <dlfcn.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <string>
#include <type_traits>

namespace
{
using namespace tactus::host::falcon;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto silent = 150ms, stays = 500ms;   // a driver with a force on the Falcon that sends nothing, if no guardian acts; after the driver, for it
constexpr int between_looks_ms = 2;
volatile std::sig_atomic_t is_ending = 0;

/// The adapter of a Falcon, by libftdi.
class Adapter
{
public:
    Adapter() = default;
    Adapter (const Adapter&) = delete;
    Adapter& operator= (const Adapter&) = delete;
    ~Adapter()
    {
        if (context != nullptr) close (context);
    }

    /// The reason if it cannot be opened.
    std::string open (unsigned number)
    {
        void* library = ::dlopen ("libftdi1.so.2", RTLD_NOW);
        if (library == nullptr) return std::string (::dlerror()) + " (on Debian: sudo apt install libftdi1-2)";
        std::string lacks;
        const auto find = [&] (auto& to, const char* name) {
            to = reinterpret_cast<std::remove_reference_t<decltype (to)>> (::dlsym (library, name));   // NOLINT: a function is found as data
            if (to == nullptr && lacks.empty()) lacks = std::string ("libftdi lacks ") + name;
        };
        find (make, "ftdi_new");
        find (close, "ftdi_free");
        find (open_index, "ftdi_usb_open_desc_index");
        find (error_of, "ftdi_get_error_string");
        find (set_baud, "ftdi_set_baudrate");
        find (set_line, "ftdi_set_line_property");
        find (set_flow, "ftdi_setflowctrl");
        find (set_latency, "ftdi_set_latency_timer");
        find (set_lines, "ftdi_setdtr_rts");
        find (read_some, "ftdi_read_data");
        find (write_all, "ftdi_write_data");
        if (! lacks.empty()) return lacks;
        find (flush, "ftdi_tcioflush");   // since 1.5
        if (flush == nullptr) find (flush, "ftdi_usb_purge_buffers");
        context = make();
        if (context == nullptr) return "libftdi has no memory";
        const int failed = open_index (context, 0x0403, 0xcb48, nullptr, nullptr, number);
        if (failed == 0) return {};
        const char* remedy = failed == -4   ? ": you may not open it; docs/known_devices.md has a udev rule"
                             : failed == -5 ? ": another role or another program is using it"
                                            : "";
        return "libftdi says: " + std::string (error_of (context)) + remedy;
    }

    /// As the driver has set up its end. Before firmware is loaded, the speed also says what the lines are.
    void set (unsigned baud)
    {
        constexpr int eight_bits = 8, one_stop_bit = 0, no_parity = 0, no_flow = 0;
        set_line (context, eight_bits, one_stop_bit, no_parity);
        set_flow (context, no_flow);
        set_latency (context, baud == normal_baud ? 1 : 16);
        set_baud (context, static_cast<int> (baud));
        if (flush != nullptr) flush (context);
        if (baud != normal_baud) set_lines (context, 0, 0);
        if (baud == hello_baud) set_lines (context, 1, 0);
    }

    bool put (const std::uint8_t* bytes, std::size_t count) { return write_all (context, bytes, static_cast<int> (count)) == static_cast<int> (count); }

    /// Waits until bytes come, as long as the adapter keeps them: 1 ms, while it is used. Empty: it is gone.
    std::optional<std::size_t> get (std::array<std::uint8_t, 512>& to)
    {
        const int got = read_some (context, to.data(), static_cast<int> (to.size()));
        return got >= 0 ? std::optional (static_cast<std::size_t> (got)) : std::nullopt;
    }

private:
    void* context = nullptr;
    void* (*make)() = nullptr;
    void (*close) (void*) = nullptr;
    int (*open_index) (void*, int vendor, int product, const char* description, const char* serial, unsigned index) = nullptr;
    const char* (*error_of) (void*) = nullptr;
    int (*set_baud) (void*, int) = nullptr;
    int (*set_line) (void*, int bits, int stop, int parity) = nullptr;
    int (*set_flow) (void*, int) = nullptr;
    int (*set_latency) (void*, unsigned char ms) = nullptr;
    int (*set_lines) (void*, int dtr, int rts) = nullptr;
    int (*read_some) (void*, unsigned char*, int) = nullptr;
    int (*write_all) (void*, const unsigned char*, int) = nullptr;
    int (*flush) (void*) = nullptr;
};

/// Carries bytes both ways until the driver or the Falcon is gone.
void carry (Adapter& adapter, int line)
{
    std::array<std::uint8_t, 512> bytes {};
    unsigned baud = 0;
    std::size_t unanswered = 0;   // bytes that the Falcon has not answered
    bool pushes = false;
    auto heard = Clock::now();   // the driver
    for (bool is_there = true; is_there && is_ending == 0;)
    {
        pollfd wait { line, POLLIN, 0 };
        static_cast<void> (::poll (&wait, 1, unanswered > 0 ? 0 : between_looks_ms));
        const auto count = (wait.revents & POLLIN) != 0 ? ::read (line, bytes.data(), bytes.size()) : 0;
        const bool has_left = count <= 0 && (wait.revents & POLLHUP) != 0;
        termios2 how {};
        const bool is_known = ::ioctl (line, TCGETS2, &how) == 0 && (how.c_ospeed == normal_baud || how.c_ospeed == hello_baud || how.c_ospeed == loading_baud);
        if (is_known && how.c_ospeed != baud) adapter.set (baud = how.c_ospeed);
        const auto now = Clock::now();
        if (count > 0)
        {
            is_there = adapter.put (bytes.data(), static_cast<std::size_t> (count));
            unanswered += static_cast<std::size_t> (count);
            const std::uint8_t *end = bytes.data() + count, *last = end - std::min<std::ptrdiff_t> (count, std::ssize (at_rest));
            pushes = baud == normal_baud && ! std::equal (last, end, at_rest.begin());   // to be on the safe side, any other packet
            heard = now;
        }
        if (pushes && (has_left || now - heard > silent))
        {
            is_there = adapter.put (at_rest.data(), at_rest.size());
            pushes = false;
        }
        if (has_left && now - heard > stays) return;
        const auto got = adapter.get (bytes);
        is_there = is_there && got;
        unanswered -= std::min (unanswered, got.value_or (0));
        if (got && *got > 0 && ::write (line, bytes.data(), *got) < 0 && errno != EAGAIN && errno != EIO) return;
    }
    static_cast<void> (adapter.put (at_rest.data(), at_rest.size()));
}
}   // namespace

int main (int count, char** arguments)
{
    if (count < 4) return 2;
    const int line = std::atoi (arguments[2]), pipe = std::atoi (arguments[3]);
    std::signal (SIGTERM, [] (int) { is_ending = 1; });
    Adapter adapter;
    const auto why = adapter.open (static_cast<unsigned> (std::atoi (arguments[1])));
    const auto told = why + "\n";
    if (::write (pipe, told.data(), told.size()) < 0 || ! why.empty()) return 1;
    ::close (pipe);
    carry (adapter, line);
    return 0;
}
