// SPDX-License-Identifier: MIT
#include "event_device.hpp"

#include <libevdev/libevdev.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

namespace tactus::host::evdev
{

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t most_buttons = 32;
const char* const sys_folder = "/sys/class/input";

struct NamedAxis
{
    std::uint16_t code;
    const char* name;
};
constexpr NamedAxis named_axes[] {
    { ABS_X, "x" },
    { ABS_Y, "y" },
    { ABS_Z, "z" },
    { ABS_RX, "rx" },
    { ABS_RY, "ry" },
    { ABS_RZ, "rz" },
    { ABS_THROTTLE, "throttle" },
    { ABS_RUDDER, "rudder" },
    { ABS_WHEEL, "steering" },
    { ABS_GAS, "accelerator" },
    { ABS_BRAKE, "brake" },
    { ABS_HAT0X, "hat0x" },
    { ABS_HAT0Y, "hat0y" },
    { ABS_HAT1X, "hat1x" },
    { ABS_HAT1Y, "hat1y" },
    { ABS_HAT2X, "hat2x" },
    { ABS_HAT2Y, "hat2y" },
    { ABS_HAT3X, "hat3x" },
    { ABS_HAT3Y, "hat3y" },
};

/// "BTN_TOP2" becomes "top2", and "BTN_0" "button_0", because a name begins with a letter.
std::string buttonName (std::uint16_t code)
{
    const char* given = libevdev_event_code_get_name (EV_KEY, code);
    std::string name = given != nullptr ? given : "BTN_" + std::to_string (code);
    if (name.starts_with ("BTN_")) name.erase (0, 4);
    std::ranges::transform (name, name.begin(), [] (char c) { return static_cast<char> (std::tolower (static_cast<unsigned char> (c))); });
    return name.empty() || std::isalpha (static_cast<unsigned char> (name[0])) == 0 ? "button_" + name : name;
}

std::string textIn (const fs::path& file)
{
    std::ifstream in (file);
    std::string line;
    std::getline (in, line);
    return line;
}

std::uint16_t hexIn (const fs::path& file)
{
    const auto line = textIn (file);
    std::uint16_t number = 0;
    std::from_chars (line.data(), line.data() + line.size(), number, 16);
    return number;
}

/// The gain or the centring spring of a wheel, in a file that some drivers in the kernel, such as hid-logitech-new, put into the folder of the HID device.
std::optional<int> levelIn (const fs::path& file)
{
    const auto line = textIn (file);
    int level = 0;
    const auto [end, wrong] = std::from_chars (line.data(), line.data() + line.size(), level);
    const bool is_level = wrong == std::errc() && end == line.data() + line.size() && level >= 0 && level <= 0xffff;
    return is_level ? std::optional (level) : std::nullopt;
}

/// A bit in a map of sysfs: words of the size of a long in hexadecimal, the highest first.
bool bitIn (const std::string& map, unsigned bit)
{
    constexpr unsigned word_bits = 8 * sizeof (long);
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < map.size();)
    {
        const auto end = std::min (map.find (' ', at), map.size());
        if (end > at) words.push_back (std::string_view (map).substr (at, end - at));
        at = end + 1;
    }
    const auto index = bit / word_bits;
    if (index >= words.size()) return false;
    const auto word = words[words.size() - 1 - index];
    unsigned long value = 0;
    std::from_chars (word.data(), word.data() + word.size(), value, 16);
    return (value >> bit % word_bits & 1u) != 0;
}

/// The time in s from one report to the next that the USB port of a device takes, by the interval of its interrupt OUT endpoint: 0.004 for "4ms". 0:
/// it has none, or is not USB.
double updateInterval (const fs::path& input_device)
{
    std::error_code failed;
    auto place = fs::canonical (input_device, failed);
    for (int up = 0; ! failed && up < 6 && place.has_relative_path(); ++up, place = place.parent_path())
        for (fs::directory_iterator at (place, failed), end; ! failed && at != end; at.increment (failed))
        {
            const auto endpoint = at->path();
            if (! endpoint.filename().string().starts_with ("ep_")) continue;
            if (textIn (endpoint / "direction") != "out" || textIn (endpoint / "type") != "Interrupt") continue;
            const auto text = textIn (endpoint / "interval");
            double number = 0.0;
            const auto read = std::from_chars (text.data(), text.data() + text.size(), number);
            const std::string_view unit (read.ptr, text.data() + text.size());
            if (read.ec == std::errc() && unit == "ms") return 1e-3 * number;
            if (read.ec == std::errc() && unit == "us") return 1e-6 * number;
        }
    return 0.0;
}

/// The name of the node in sysfs, even if the path is a link to it: "event5".
std::string nodeOf (const std::string& path)
{
    std::error_code failed;
    const auto real = fs::canonical (path, failed);
    return failed ? fs::path (path).filename().string() : real.filename().string();
}

/// The properties of a device that are known without opening it.
EventDeviceInfo look (const std::string& path)
{
    const auto at = fs::path (sys_folder) / nodeOf (path) / "device";
    EventDeviceInfo info;
    info.path = path;
    info.name = textIn (at / "name");
    info.serial = textIn (at / "uniq");
    info.place = textIn (at / "phys");
    info.gain = levelIn (at / "device/gain");
    info.autocenter = levelIn (at / "device/autocenter");
    info.bus = hexIn (at / "id/bustype");
    info.vid = hexIn (at / "id/vendor");
    info.pid = hexIn (at / "id/product");
    const auto effects = textIn (at / "capabilities/ff");
    info.has_constant = bitIn (effects, FF_CONSTANT);
    info.has_rumble = bitIn (effects, FF_RUMBLE);
    info.has_gain = bitIn (effects, FF_GAIN);
    info.has_autocenter = bitIn (effects, FF_AUTOCENTER);
    info.update_interval_s = updateInterval (at);
    info.may_open = ::access (path.c_str(), R_OK | W_OK) == 0;
    return info;
}

Message cannotOpen (const std::string& path, std::string why, std::string remedy)
{
    return Message::error ("device/not_opened", path, std::move (why), std::move (remedy));
}

double nowS()
{
    timespec t {};
    ::clock_gettime (CLOCK_MONOTONIC, &t);
    return static_cast<double> (t.tv_sec) + 1e-9 * static_cast<double> (t.tv_nsec);
}

//==============================================================================
class LinuxEventDevice final : public EventDevice
{
public:
    LinuxEventDevice (int f, libevdev* d, EventDeviceInfo i) : file (f), device (d), about (std::move (i))
    {
        // The kernel would ignore changes that are smaller than the fuzz of an axis, which is 1/256 of the travel of many joysticks.
        for (const auto& axis : about.axes)
            if (const auto* had = libevdev_get_abs_info (device, axis.code); had != nullptr && had->fuzz != 0)
            {
                auto without = *had;
                without.fuzz = 0;
                fuzzy.push_back ({ axis.code, *had });
                static_cast<void> (libevdev_kernel_set_abs_info (device, axis.code, &without));   // if this fails, the axis is coarser
            }
    }

    ~LinuxEventDevice() override
    {
        for (auto& [code, had] : fuzzy)
            if (const auto* now = libevdev_get_abs_info (device, code); now != nullptr)
            {
                had.value = now->value;
                static_cast<void> (libevdev_kernel_set_abs_info (device, code, &had));   // the device may be gone
            }
        libevdev_free (device);
        ::close (file);
    }

    LinuxEventDevice (const LinuxEventDevice&) = delete;
    LinuxEventDevice& operator= (const LinuxEventDevice&) = delete;

    const EventDeviceInfo& info() const noexcept override { return about; }

    Got next (Event& to, int timeout_ms) override
    {
        for (int looks = 0;; ++looks)
        {
            input_event event {};
            const auto how = is_syncing ? LIBEVDEV_READ_FLAG_SYNC : LIBEVDEV_READ_FLAG_NORMAL;
            const int got = libevdev_next_event (device, static_cast<unsigned> (how), &event);
            if (got == LIBEVDEV_READ_STATUS_SYNC && ! std::exchange (is_syncing, true)) continue;   // the event itself is SYN_DROPPED
            if (got == -EAGAIN && std::exchange (is_syncing, false)) continue;
            if (got == LIBEVDEV_READ_STATUS_SUCCESS || got == LIBEVDEV_READ_STATUS_SYNC)
            {
                to = { .type = event.type, .code = event.code, .value = event.value };
                const double at = static_cast<double> (event.input_event_sec) + 1e-6 * static_cast<double> (event.input_event_usec);
                to.age_s = std::max (0.0, nowS() - at);
                return Got::event;
            }
            if (got != -EAGAIN && got != -EINTR) return Got::gone;
            if (looks > 0) return Got::nothing;
            pollfd wait { .fd = file, .events = POLLIN, .revents = 0 };
            if (const int ready = ::poll (&wait, 1, timeout_ms); ready == 0) return Got::nothing;
            if ((wait.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) return Got::gone;
        }
    }

    int upload (ff_effect& effect) override { return ::ioctl (file, EVIOCSFF, &effect) < 0 ? errno : 0; }

    int tell (std::uint16_t code, int value) override
    {
        input_event event {};
        event.type = EV_FF;
        event.code = code;
        event.value = value;
        const auto written = ::write (file, &event, sizeof event);
        if (written == static_cast<ssize_t> (sizeof event)) return 0;
        return written < 0 ? errno : EIO;
    }

private:
    const int file;
    libevdev* const device;
    const EventDeviceInfo about;
    std::vector<std::pair<std::uint16_t, input_absinfo>> fuzzy;   // axes as they were
    bool is_syncing = false;                                      // [reading thread]
};

class LinuxEventSystem final : public EventSystem
{
public:
    std::vector<EventDeviceInfo> list() override
    {
        std::vector<std::pair<int, EventDeviceInfo>> found;
        std::error_code failed;
        for (fs::directory_iterator at (sys_folder, failed), end; ! failed && at != end; at.increment (failed))
        {
            const auto node = at->path().filename().string();
            int number = 0;
            if (! node.starts_with ("event") || std::from_chars (node.data() + 5, node.data() + node.size(), number).ec != std::errc()) continue;
            auto info = look ("/dev/input/" + node);
            if (! info.hasForceFeedback()) continue;
            if (info.may_open)
                if (const int file = ::open (info.path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC); file >= 0)
                {
                    libevdev* device = nullptr;
                    if (libevdev_new_from_fd (file, &device) == 0)
                    {
                        readParts (device, info);
                        libevdev_free (device);
                    }
                    ::close (file);
                }
            found.emplace_back (number, std::move (info));
        }
        std::ranges::sort (found, {}, [] (const auto& f) { return f.first; });
        std::vector<EventDeviceInfo> all;
        for (auto& f : found)
            all.push_back (std::move (f.second));
        return all;
    }

    Result<std::unique_ptr<EventDevice>> open (const std::string& path) override
    {
        auto info = look (path);
        const int file = ::open (path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        if (file < 0 && errno == EACCES) return cannotOpen (path, "this user may not open it: " + howToPermit (info), "");
        if (file < 0) return cannotOpen (path, std::strerror (errno), "check that it is plugged in; `tactus devices` lists the available devices");
        const auto refuse = [&] (std::string why) {
            ::close (file);
            return cannotOpen (path, std::move (why), "`tactus devices` lists the available devices");
        };
        if (::flock (file, LOCK_EX | LOCK_NB) != 0) return refuse ("another role or another instance of Tactus is using it");
        libevdev* device = nullptr;
        if (libevdev_new_from_fd (file, &device) != 0) return refuse ("it is not an event device");
        libevdev_set_clock_id (device, CLOCK_MONOTONIC);
        readParts (device, info);
        return std::unique_ptr<EventDevice> (std::make_unique<LinuxEventDevice> (file, device, std::move (info)));
    }

private:
    static void readParts (const libevdev* device, EventDeviceInfo& info)
    {
        info.name = libevdev_get_name (device) != nullptr ? libevdev_get_name (device) : "";
        info.serial = libevdev_get_uniq (device) != nullptr ? libevdev_get_uniq (device) : "";
        info.has_constant = libevdev_has_event_code (device, EV_FF, FF_CONSTANT) != 0;
        info.has_rumble = libevdev_has_event_code (device, EV_FF, FF_RUMBLE) != 0;
        info.has_gain = libevdev_has_event_code (device, EV_FF, FF_GAIN) != 0;
        info.has_autocenter = libevdev_has_event_code (device, EV_FF, FF_AUTOCENTER) != 0;
        for (const auto& named : named_axes)
            if (const auto* range = libevdev_get_abs_info (device, named.code); range != nullptr && range->maximum > range->minimum)
                info.axes.push_back (
                    { .code = named.code, .name = named.name, .minimum = range->minimum, .maximum = range->maximum, .value = range->value });
        for (unsigned code = 0; code <= KEY_MAX && info.buttons.size() < most_buttons; ++code)
            if (libevdev_has_event_code (device, EV_KEY, code) != 0)
                info.buttons.push_back ({ .code = static_cast<std::uint16_t> (code),
                                          .name = buttonName (static_cast<std::uint16_t> (code)),
                                          .is_down = libevdev_get_event_value (device, EV_KEY, code) != 0 });
    }
};
}   // namespace

bool EventDeviceInfo::isSameAs (const EventDeviceInfo& other) const
{
    return name == other.name && serial == other.serial && bus == other.bus && vid == other.vid && pid == other.pid;
}

EventSystem& thisComputer()
{
    static LinuxEventSystem system;
    return system;
}

std::string howToPermit (const EventDeviceInfo& d)
{
    std::array<char, 160> rule {};
    std::snprintf (rule.data(), rule.size(), R"(KERNEL=="event*", ATTRS{id/vendor}=="%04x", ATTRS{id/product}=="%04x", TAG+="uaccess")", d.vid, d.pid);
    return "add the udev rule " + std::string (rule.data()) + ", or join the group input";
}

}   // namespace tactus::host::evdev
