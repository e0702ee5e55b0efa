// SPDX-License-Identifier: MIT
#include "serial_port.hpp"

#include <host/drivers/helper_program.hpp>
#include <tactus/file/text_file.hpp>

#include <asm/termbits.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <poll.h>
#include <stdlib.h>   // NOLINT: posix_openpt
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>
#include <thread>

extern char** environ;

namespace tactus::host::falcon
{

namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
constexpr std::uint8_t hello[] { 0x0a, 0x43, 0x0d }, hello_answer[] { 0x0a, 0x44, 0x2c, 0x0d }, ready[] { 0x41 };
constexpr std::size_t block_size = 62, most_firmware = 65'536;

std::string textOf (int error) { return std::generic_category().message (error); }
}   // namespace

SerialPort::~SerialPort()
{
    if (file >= 0) ::close (file);
    if (bridge <= 0) return;
    ::kill (bridge, SIGTERM);   // it takes the force off, and ends
    bool has_ended = false;
    for (const auto end = Clock::now() + 1s; ! has_ended && Clock::now() < end; std::this_thread::sleep_for (1ms))
        has_ended = ::waitpid (bridge, nullptr, WNOHANG) != 0;
    if (has_ended) return;
    ::kill (bridge, SIGKILL);
    ::waitpid (bridge, nullptr, 0);
}

std::string SerialPort::ofFalcon (const std::filesystem::path& adapters)
{
    const auto word = [] (const std::filesystem::path& in) {
        std::string text;
        std::ifstream (in) >> text;
        return text;
    };
    std::error_code failed;
    for (std::filesystem::directory_iterator at (adapters, failed), end; ! failed && at != end; at.increment (failed))
        if (const auto usb = at->path() / "../.."; word (usb / "idVendor") == "0403" && word (usb / "idProduct") == "cb48")
            return "/dev/" + at->path().filename().string();
    return {};
}

std::string SerialPort::openUsb (unsigned number)
{
    const int other_end = ::posix_openpt (O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    char path[64] {};
    std::array<int, 2> told { -1, -1 };
    std::string why;
    if (::grantpt (other_end) != 0 || ::unlockpt (other_end) != 0 || ::ptsname_r (other_end, path, sizeof path) != 0 || ::pipe2 (told.data(), O_CLOEXEC) != 0)
        why = textOf (errno);
    else
        why = open (path);
    if (why.empty())
    {
        goNormal();
        const auto program = findHelper (hello, "falcon-bridge", why);
        if (! program.empty()) why = startHelper (program, { std::to_string (number) }, { other_end, told[1] }, environ, bridge);
    }
    ::close (other_end);
    ::close (told[1]);
    std::string said;
    for (char byte = 0; why.empty() && byte != '\n';)
        if (::read (told[0], &byte, 1) != 1)
            why = "the program between the driver and libftdi has died";
        else if (byte != '\n')
            said += byte;
    ::close (told[0]);
    return why.empty() ? said : why;
}

std::string SerialPort::open (const std::string& path)
{
    name = path;
    file = ::open (path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return textOf (errno) + (errno == EACCES ? ": join the group of " + path + " (on Debian: sudo adduser $USER dialout)" : std::string());
    termios2 how {};
    if (::ioctl (file, TCGETS2, &how) != 0) return path + " is not a serial port";
    lock = FileLock::takeExisting (path);   // not TIOCEXCL: the guardian opens it, too
    if (! lock) return "another role or another instance of Tactus is using it";
    return {};
}

/// Sets the time for which an FTDI adapter keeps answers, to 1 ms or 16 ms. A pseudo-terminal has no such setting.
void SerialPort::setLowLatency (bool is_low)
{
    serial_struct serial {};
    if (::ioctl (file, TIOCGSERIAL, &serial) != 0) return;
    serial.flags = (serial.flags & ~static_cast<int> (ASYNC_LOW_LATENCY)) | (is_low ? static_cast<int> (ASYNC_LOW_LATENCY) : 0);
    static_cast<void> (::ioctl (file, TIOCSSERIAL, &serial));
}

void SerialPort::setSpeed (unsigned baud)
{
    termios2 how {};
    how.c_cflag = BOTHER | CS8 | CLOCAL | CREAD;
    how.c_cc[VMIN] = 1;   // a read of 0 bytes then means the end of the line, and not silence
    how.c_ispeed = how.c_ospeed = baud;
    static_cast<void> (::ioctl (file, TCSETS2, &how));
}

void SerialPort::setLines (int rts_and_dtr)
{
    const int off = ~rts_and_dtr & (TIOCM_RTS | TIOCM_DTR);
    static_cast<void> (::ioctl (file, TIOCMBIC, &off));   // a pseudo-terminal has no such lines
    static_cast<void> (::ioctl (file, TIOCMBIS, &rts_and_dtr));
}

void SerialPort::purge()
{
    static_cast<void> (::ioctl (file, TCFLSH, TCIOFLUSH));
    count = used = 0;
    finder = {};
}

void SerialPort::goNormal()
{
    setLowLatency (true);
    setSpeed (normal_baud);
    purge();
}

bool SerialPort::put (std::span<const std::uint8_t> all)
{
    for (const auto end = Clock::now() + 1s; ! all.empty() && Clock::now() < end;)
    {
        const auto done = ::write (file, all.data(), all.size());
        if (done > 0)
            all = all.subspan (static_cast<std::size_t> (done));
        else if (done < 0 && errno != EAGAIN && errno != EINTR)
            return false;
        pollfd wait { file, POLLOUT, 0 };
        if (! all.empty()) static_cast<void> (::poll (&wait, 1, 10));
    }
    return all.empty();
}

/// Some systems put a 0 in front of an answer.
bool SerialPort::expects (std::span<const std::uint8_t> all, std::chrono::milliseconds within)
{
    bool is_first = true;
    for (const auto end = Clock::now() + within; ! all.empty() && Clock::now() < end && ! is_gone;)
    {
        if (used == count) await (5ms);
        for (; used < count && ! all.empty(); is_first = false)
        {
            const auto byte = bytes[used++];
            if (byte == all.front())
                all = all.subspan (1);
            else if (! is_first || byte != 0)
                return false;
        }
    }
    return all.empty();
}

std::string SerialPort::load (const std::string& from)
{
    const auto image = readFile (from);
    if (! image || image->empty() || image->size() > most_firmware)
        return from + ": this is not the firmware of a Falcon: it cannot be read, is empty, or is too long";
    setLowLatency (false);   // users report that loading fails otherwise
    setSpeed (hello_baud);
    purge();
    setLines (0);
    setLines (TIOCM_DTR);
    bool is_there = false;
    for (int tries = 0; tries < 40 && ! is_there && ! is_gone; ++tries, count = used = 0)
        is_there = put (hello) && expects (hello_answer, 50ms);
    if (! is_there) return "neither its firmware nor its loader answers: check its power and its cable";
    purge();   // answers to earlier questions
    setLines (0);
    setSpeed (loading_baud);
    if (! put (ready) || ! expects (ready, 1s)) return "it is not ready for its firmware";
    for (std::span left (reinterpret_cast<const std::uint8_t*> (image->data()), image->size()); ! left.empty();)
    {
        const auto block = left.first (std::min (left.size(), block_size));
        if (! put (block) || ! expects (block, 1s))
            return "its echo of the firmware is wrong after " + std::to_string (image->size() - left.size()) + " bytes";
        left = left.subspan (block.size());
    }
    return {};
}

bool SerialPort::isFree() const
{
    int waiting = 0;
    return ::ioctl (file, TIOCOUTQ, &waiting) != 0 || waiting == 0;
}

std::string SerialPort::send (const Packet& packet)
{
    const auto done = ::write (file, packet.data(), packet.size());
    if (done == static_cast<ssize_t> (packet.size())) return {};
    if (done < 0 && errno != EAGAIN && errno != EINTR) is_gone = true;
    return done < 0 ? textOf (errno) : "only a part of a packet is out";
}

bool SerialPort::receive()
{
    const auto got = ::read (file, bytes.data(), bytes.size());
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) is_gone = true;
    count = got > 0 ? static_cast<std::size_t> (got) : 0;
    used = 0;
    return count > 0;
}

std::optional<Report> SerialPort::next()
{
    do
        while (used < count)
            if (const auto report = finder.take (bytes[used++])) return report;
    while (receive());
    return std::nullopt;
}

void SerialPort::await (Clock::duration time)
{
    pollfd wait { file, POLLIN, 0 };
    const auto us = std::max<std::int64_t> (0, std::chrono::duration_cast<std::chrono::microseconds> (time).count());
    if (::poll (&wait, 1, static_cast<int> ((us + 999) / 1000)) > 0 && used == count) receive();
}

}   // namespace tactus::host::falcon
