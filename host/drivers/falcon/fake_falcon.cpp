// SPDX-License-Identifier: MIT
#include "fake_falcon.hpp"

#include <tactus/text/caught.hpp>

#include <asm/termbits.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>   // NOLINT: posix_openpt
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

namespace tactus::host
{

namespace falcon_legs
{
Place anglesAt (const Place& p)
{
    const double a = 0.060, b = 0.1025, c = 0.01443, d = 0.01125, e = 0.01125, f = -0.025, r = 0.0400, s = -0.02309;
    const double directions[] { 105.0, -15.0, -135.0 };
    Place angles {};
    for (std::size_t i = 0; i < 3; ++i)
    {
        const double phi = directions[i] * std::numbers::pi / 180.0;
        const double u = p[0] * std::cos (phi) + p[1] * std::sin (phi) - r, v = -p[0] * std::sin (phi) + p[1] * std::cos (phi) - s, w = p[2];
        const double l = d + e + b * std::sin (std::acos ((v + f) / b));
        const double k = u * u + w * w + c * c + a * a + 2.0 * c * u - l * l;
        const double l0 = k - 2.0 * a * (u + c), l1 = -4.0 * a * w, l2 = k + 2.0 * a * (u + c);
        angles[i] = 2.0 * std::atan ((-l1 - std::sqrt (l1 * l1 - 4.0 * l0 * l2)) / (2.0 * l2));
    }
    return angles;
}

std::array<int, 3> countsAt (const Place& p)
{
    constexpr double degrees_per_count = 0.01425 / 1280.0 * 360.0 / 0.110;
    std::array<int, 3> counts {};
    const auto angles = anglesAt (p);
    for (std::size_t i = 0; i < 3; ++i)
        counts[i] = static_cast<int> (std::lround ((angles[i] * 180.0 / std::numbers::pi - 35.0) / degrees_per_count));
    return counts;
}

Place forceOf (const Place& torques, const Place& at)
{
    constexpr double step = 1e-7;   // in m
    Place force {};
    for (std::size_t i = 0; i < 3; ++i)
    {
        auto more = at, less = at;
        more[i] += step;
        less[i] -= step;
        const auto above = anglesAt (more), below = anglesAt (less);
        for (std::size_t leg = 0; leg < 3; ++leg)
            force[i] += torques[leg] * (above[leg] - below[leg]) / (2.0 * step);
    }
    return force;
}
}   // namespace falcon_legs

namespace
{
using namespace std::chrono_literals;
constexpr unsigned normal_baud = 1'500'000, hello_baud = 9600, loading_baud = 142'857;
constexpr std::size_t packet_size = 16;
constexpr unsigned homing = 0x11;   // the code of libnifalcon names one bit, and its comment the other: either will do
constexpr int changed_bit = 4;      // of a digit of a count
}   // namespace

FakeFalcon::FakeFalcon (Hand h, bool has_firmware, std::size_t size) : hand (std::move (h)), image_size (size), runs_firmware (has_firmware)
{
    line = ::posix_openpt (O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    ::grantpt (line);
    ::unlockpt (line);
    char text[128] {};
    static_cast<void> (::ptsname_r (line, text, sizeof text));
    name = text;
    kept_open = ::open (text, O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios2 how {};   // without a program, nothing is echoed
    how.c_cflag = BOTHER | CS8 | CLOCAL | CREAD;
    how.c_ispeed = how.c_ospeed = hello_baud;
    static_cast<void> (::ioctl (kept_open, TCSETS2, &how));
    running = std::thread ([this] {
        const auto lived = caught ("the fake Falcon", [this] {
            while (! is_over)
                attend();
        });
        if (! lived) unplug();
    });
}

FakeFalcon::~FakeFalcon()
{
    is_over = true;
    running.join();
    unplug();
}

void FakeFalcon::unplug()
{
    const std::lock_guard lock (mutex);
    if (line >= 0) ::close (std::exchange (line, -1));
    if (kept_open >= 0) ::close (std::exchange (kept_open, -1));
}

void FakeFalcon::hold (const Place& at, unsigned pressed)
{
    const std::lock_guard lock (mutex);
    grip = at;
    buttons = pressed;
    is_held = true;
    got.clear();
}

bool FakeFalcon::hasGot (const std::array<int, 3>& values) const
{
    const std::lock_guard lock (mutex);
    return std::ranges::count (got, values) > 0;
}

FakeFalcon::Place FakeFalcon::place() const
{
    const std::lock_guard lock (mutex);
    return grip;
}

std::vector<std::uint8_t> FakeFalcon::image() const
{
    const std::lock_guard lock (mutex);
    return stored;
}

//==============================================================================
/// True if bytes are waiting.
bool FakeFalcon::hears (int within_ms) const
{
    pollfd wait { -1, POLLIN, 0 };
    {
        const std::lock_guard lock (mutex);
        wait.fd = line;
    }
    return ::poll (&wait, 1, within_ms) > 0 && (wait.revents & POLLIN) != 0;   // unplugged, it only waits
}

void FakeFalcon::attend()
{
    if (! hears (2)) return;
    {
        const std::lock_guard lock (mutex);
        std::uint8_t some[512];
        const auto count = line >= 0 ? ::read (line, some, sizeof some) : -1;
        if (count <= 0) return;
        in.insert (in.end(), some, some + count);
    }
    runs_firmware ? answerPackets() : load();
}

unsigned FakeFalcon::speed() const
{
    termios2 how {};
    const std::lock_guard lock (mutex);
    return line >= 0 && ::ioctl (line, TCGETS2, &how) == 0 ? how.c_ospeed : 0;
}

void FakeFalcon::put (const std::vector<std::uint8_t>& bytes)
{
    const std::lock_guard lock (mutex);
    if (line >= 0 && ::write (line, bytes.data(), bytes.size()) < 0) return;   // no reader
}

//==============================================================================
void FakeFalcon::load()
{
    if (! is_loading)
    {
        const std::vector<std::uint8_t> hello { 0x0a, 0x43, 0x0d };
        if (speed() != hello_baud) return in.clear();
        if (std::search (in.begin(), in.end(), hello.begin(), hello.end()) == in.end()) return;
        in.clear();
        if (first_tries_that_fail-- > 0) return;
        is_loading = true;
        return put ({ 0x00, 0x0a, 0x44, 0x2c, 0x0d });
    }
    if (speed() != loading_baud) return in.clear();
    const auto bytes = std::exchange (in, {});
    {
        const std::lock_guard lock (mutex);
        for (const auto byte : bytes)
            if (! is_ready)
                is_ready = byte == 0x41;
            else
                stored.push_back (byte);
        loaded = stored.size();
        if (is_ready && stored.size() >= image_size) runs_firmware = true;
    }
    put (bytes);
}

//==============================================================================
void FakeFalcon::answerPackets()
{
    if (speed() != normal_baud) return in.clear();
    while (in.size() >= packet_size)
    {
        const auto* p = in.data();
        const bool is_whole = p[0] == '<' && p[packet_size - 1] == '>' && std::all_of (p + 1, p + packet_size - 1, [] (int b) { return b >= 'A' && b <= 'P'; });
        if (! is_whole)
        {
            ++malformed;
            in.erase (in.begin());
            continue;
        }
        take (p);
        in.erase (in.begin(), in.begin() + packet_size);
        const bool waits = in.empty() && ! hears (looks_ms);
        together += waits ? 0 : 1;
        alone = waits ? alone + 1 : 0;
        const bool is_third = packets % 3 == 0;
        const auto now = fault.load();
        if (now == Fault::silent) continue;
        if (now == Fault::late) std::this_thread::sleep_for (30ms);
        auto bytes = answer();
        if (now == Fault::shorter && is_third) bytes.erase (bytes.begin() + 5, bytes.begin() + 7);
        if (now == Fault::shifted && is_third) bytes.erase (bytes.begin());
        if ((now == Fault::changed && is_third) || now == Fault::impossible)
        {
            auto& digit = bytes[now == Fault::changed ? 3 : 4];   // 1024 counts, or 16384
            digit = static_cast<std::uint8_t> ('A' + ((digit - 'A') ^ changed_bit));
        }
        if (now == Fault::noisy) bytes.insert (bytes.begin(), { '>', '<', 'A', 0xff, '<' });
        put (bytes);
    }
}

void FakeFalcon::take (const std::uint8_t* p)
{
    std::array<int, 3> values {};
    Place torques {};
    const bool was_at_rest = isAtRest();
    for (std::size_t i = 0; i < 3; ++i)
    {
        unsigned raw = 0;
        for (std::size_t nibble = 0; nibble < 4; ++nibble)
            raw |= static_cast<unsigned> (p[1 + 4 * i + nibble] - 'A') << 4 * nibble;
        values[i] = static_cast<std::int16_t> (raw);
        torques[i] = -values[i] / 10'000.0;
        motors[i] = values[i];
        largest_motor = std::max (largest_motor.load(), std::abs (values[i]));
    }
    bits = static_cast<unsigned> (p[13] - 'A');
    const bool is_without = (bits & homing) == 0;
    without_homing += is_without ? 1 : 0;
    if (is_without || fault == Fault::forgetful) homed = 0;
    pushes += isAtRest() ? 0 : 1;
    if (isAtRest() && ! was_at_rest) zero_at = std::chrono::nanoseconds (std::chrono::steady_clock::now().time_since_epoch()).count();
    ++packets;

    const std::lock_guard lock (mutex);
    if (is_held) got.push_back (values);
    const auto force = falcon_legs::forceOf (torques, grip);
    largest_force = std::max (largest_force.load(), std::hypot (force[0], force[1], force[2]));
    if (is_held) return;
    auto next = grip;
    if (hand)
        next = hand (grip, force);
    else
        for (std::size_t i = 0; i < 3; ++i)
            next[i] += 0.2 * (target[i] + force[i] / stiffness + tremor * std::sin (0.3 * static_cast<double> (packets)) - grip[i]);
    const auto angles = falcon_legs::anglesAt (next);
    if (std::isfinite (angles[0] + angles[1] + angles[2])) grip = next;   // beyond the reach of the legs, the grip stops
}

std::vector<std::uint8_t> FakeFalcon::answer() const
{
    std::vector<std::uint8_t> bytes { '<' };
    const std::lock_guard lock (mutex);
    for (const int count : falcon_legs::countsAt (grip))
        for (int nibble = 0; nibble < 4; ++nibble)
            bytes.push_back (static_cast<std::uint8_t> ('A' + ((static_cast<unsigned> (count) >> 4 * nibble) & 0xfu)));
    bytes.push_back (static_cast<std::uint8_t> ('A' + (buttons & 0xfu) + (homed << 4)));
    bytes.insert (bytes.end(), { 'A', '>' });
    return bytes;
}

}   // namespace tactus::host
