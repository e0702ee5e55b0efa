// SPDX-License-Identifier: MIT
// A fake of libftdi for FakeFalcon: TACTUS_FAKE_FTDI names the pseudo-terminals of Falcons, one after another, with colons between them; "denied" is one
// that may not be opened. Written from the public functions, apart from the bridge. What a real adapter would not carry does not arrive: at 9600 baud, the
// Falcon listens with DTR and without RTS, at 142857 without both, and always with 8 bits, no parity and no flow control. A read
// waits for the latency timer. The number of the process goes to the file that TACTUS_FAKE_FTDI_PROCESS names.

#include <asm/termbits.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#define EXPORTED extern "C" __attribute__ ((visibility ("default")))

namespace
{
constexpr int no_device = -3, denied = -4, claimed = -5, is_away = -4;

struct Context
{
    int line = -1, baud = 0, latency = 16, dtr = 1, rts = 1;
    bool is_plain = false, has_flow = true;
    const char* error = "";

    int fail (int code, const char* text)
    {
        error = text;
        return code;
    }

    bool carries() const
    {
        const bool has_lines = baud == 9600 ? dtr == 1 && rts == 0 : baud != 142857 || (dtr == 0 && rts == 0);
        return is_plain && ! has_flow && has_lines;
    }
};

template <typename T>
int keep (T& to, T value)
{
    to = value;
    return 0;
}
}   // namespace

EXPORTED Context* ftdi_new()
{
    if (const char* to = std::getenv ("TACTUS_FAKE_FTDI_PROCESS"); to != nullptr) std::ofstream (to) << ::getpid() << std::endl;
    return new Context;
}
EXPORTED void ftdi_free (Context* c)
{
    if (c->line >= 0) ::close (c->line);
    delete c;
}
EXPORTED const char* ftdi_get_error_string (Context* c) { return c->error; }
EXPORTED int ftdi_usb_open_desc_index (Context* c, int vendor, int product, const char*, const char*, unsigned index)
{
    const char* all = std::getenv ("TACTUS_FAKE_FTDI");
    std::istringstream paths (all != nullptr ? all : "");
    std::string path;
    for (unsigned i = 0; i <= index; ++i)
        if (! std::getline (paths, path, ':')) return c->fail (no_device, "device not found");
    if (vendor != 0x0403 || product != 0xcb48) return c->fail (no_device, "device not found");
    if (path == "denied") return c->fail (denied, "unable to open device");
    c->line = ::open (path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (c->line < 0) return c->fail (no_device, "device not found");
    if (::flock (c->line, LOCK_EX | LOCK_NB) != 0) return c->fail (claimed, "unable to claim usb device");
    return 0;
}
EXPORTED int ftdi_set_baudrate (Context* c, int baud)
{
    termios2 how {};
    how.c_cflag = BOTHER | CS8 | CLOCAL | CREAD;
    how.c_cc[VMIN] = 1;
    how.c_ispeed = how.c_ospeed = static_cast<unsigned> (c->baud = baud);
    return ::ioctl (c->line, TCSETS2, &how);
}
EXPORTED int ftdi_set_line_property (Context* c, int bits, int stop, int parity) { return keep (c->is_plain, bits == 8 && stop == 0 && parity == 0); }
EXPORTED int ftdi_setflowctrl (Context* c, int flow) { return keep (c->has_flow, flow != 0); }
#if ! defined(FAKE_LACKS_LATENCY)
EXPORTED int ftdi_set_latency_timer (Context* c, unsigned char ms)
{
    return keep<int> (c->latency, ms);
}
#endif
EXPORTED int ftdi_setdtr_rts (Context* c, int dtr, int rts)
{
    c->dtr = dtr;
    return keep (c->rts, rts);
}
EXPORTED int ftdi_usb_purge_buffers (Context* c) { return ::ioctl (c->line, TCFLSH, TCIOFLUSH); }

EXPORTED int ftdi_read_data (Context* c, unsigned char* to, int size)
{
    pollfd wait { c->line, POLLIN, 0 };
    static_cast<void> (::poll (&wait, 1, c->latency));
    const auto got = ::read (c->line, to, static_cast<std::size_t> (size));
    if (got == 0 || (got < 0 && (wait.revents & (POLLHUP | POLLERR)) != 0)) return c->fail (is_away, "usb bulk read failed");
    return got > 0 ? static_cast<int> (got) : 0;
}
EXPORTED int ftdi_write_data (Context* c, const unsigned char* from, int size)
{
    if (! c->carries()) return size;
    const auto put = ::write (c->line, from, static_cast<std::size_t> (size));
    return put == size ? size : c->fail (is_away, "usb bulk write failed");
}
