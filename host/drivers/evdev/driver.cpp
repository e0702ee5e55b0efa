// SPDX-License-Identifier: MIT
#include "driver.hpp"
#include "force_device.hpp"

#include <host/devices/device_plugins/driver_answer.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>

namespace tactus::host::evdev
{

namespace
{
EventSystem* in_use = nullptr;

EventSystem& system() { return in_use != nullptr ? *in_use : thisComputer(); }

//==============================================================================
/// The description of a device, as read.
struct Wanted
{
    std::string port;
    std::optional<hid::PidCalibration> calibration;
    double most_hz = 0.0;
};

std::string read (const tactus_device_description& given, Wanted& wanted)
{
    Messages messages;
    const auto json = readJson (given.json != nullptr && given.json[0] != 0 ? given.json : "{}").root;
    ObjectReader in (json, "", messages);
    in.ignore ("port");
    in.ignore ("calibration");
    wanted.port = given.port != nullptr ? given.port : "";
    wanted.calibration = hid::readCalibration (json, messages, false);
    wanted.most_hz = in.number ("max_rate", unit::hertz, { .min = 1.0, .max = 1000.0 }, 0.0);
    in.finish();
    const auto wrong = std::ranges::find (messages, Message::Severity::error, &Message::severity);
    if (wrong != messages.end()) return wrong->where + ": " + wrong->text + "; " + wrong->remedy;
    return wanted.port.empty() ? "name the device: evdev:/dev/input/event5, or evdev:NAME as `tactus devices` prints it" : std::string();
}

//==============================================================================
/// The devices that went away while they were open, by the port with which they were opened: another device may get the same number, and must not
/// get the calibration.
class GoneDevices
{
public:
    void add (const std::string& port, const EventDeviceInfo& info)
    {
        const std::lock_guard lock (mutex);
        all.insert_or_assign (port, info);
    }

    void found (const std::string& port)
    {
        const std::lock_guard lock (mutex);
        all.erase (port);
    }

    std::optional<EventDeviceInfo> at (const std::string& port) const
    {
        const std::lock_guard lock (mutex);
        const auto known = all.find (port);
        return known != all.end() ? std::optional (known->second) : std::nullopt;
    }

    /// True if the device is at the place of a device that went away from another port.
    bool hasElsewhere (const std::string& port, const EventDeviceInfo& info) const
    {
        const std::lock_guard lock (mutex);
        const auto isElsewhere = [&] (const auto& one) { return one.first != port && one.second.isSameAs (info) && one.second.place == info.place; };
        return ! info.place.empty() && std::ranges::any_of (all, isElsewhere);
    }

private:
    mutable std::mutex mutex;
    std::map<std::string, EventDeviceInfo> all;
};

GoneDevices& gone()
{
    static GoneDevices devices;
    return devices;
}

/// The files of the devices that are open in this program. A link, such as those in /dev/input/by-id, counts as the file that it leads to.
class OpenPaths
{
public:
    static std::string fileOf (const std::string& path)
    {
        std::error_code failed;
        const auto real = std::filesystem::canonical (path, failed);
        return failed ? path : real.string();
    }

    void add (const std::string& file)
    {
        const std::lock_guard lock (mutex);
        all.insert (file);
    }

    void remove (const std::string& file)
    {
        const std::lock_guard lock (mutex);
        if (const auto at = all.find (file); at != all.end()) all.erase (at);
    }

    bool has (const std::string& path) const
    {
        const auto file = fileOf (path);
        const std::lock_guard lock (mutex);
        return all.contains (file);
    }

private:
    mutable std::mutex mutex;
    std::multiset<std::string> all;
};

OpenPaths& openPaths()
{
    static OpenPaths paths;
    return paths;
}

/// The path of the only device that meets a condition. If there is none, `why` gets the reason.
template <typename Fits>
std::string onlyOne (Fits&& fits, const std::string& what, std::string& why)
{
    std::string path;
    int count = 0;
    for (const auto& info : system().list())
        if (fits (info))
        {
            path = info.path;
            ++count;
        }
    why.clear();
    if (count == 1) return path;
    why = count == 0 ? "no device with force feedback is called " + what : std::to_string (count) + " devices are called " + what + ": name one by its path";
    return {};
}

/// The path of the device that `port` means: a path, a name, or a part of a name.
std::string findPath (const std::string& port, std::string& why)
{
    if (const auto before = gone().at (port))
    {
        // An identical device is not this one if it is in use, or at the place of another one that went away. Of the rest, the one at the same place is.
        const auto isFree = [&] (const EventDeviceInfo& info) {
            return info.isSameAs (*before) && ! openPaths().has (info.path) && ! gone().hasElsewhere (port, info);
        };
        const auto isInPlace = [&] (const EventDeviceInfo& info) { return isFree (info) && ! info.place.empty() && info.place == before->place; };
        if (auto path = onlyOne (isInPlace, quote (before->name), why); ! path.empty()) return path;
        if (auto path = onlyOne (isFree, quote (before->name), why); ! path.empty()) return path;
        if (why.find ("devices are called") != why.npos)
        {
            why = "several devices like " + quote (before->name) + " are plugged in: plug the one that was at this port back in where it was";
            return {};
        }
        why = "the device " + quote (before->name) + ", which was at this port, is gone";
        return {};
    }
    if (port[0] == '/') return port;
    if (const auto path = onlyOne ([&] (const EventDeviceInfo& info) { return info.name == port; }, quote (port), why); ! path.empty()) return path;
    return onlyOne ([&] (const EventDeviceInfo& info) { return info.name.find (port) != std::string::npos; }, quote (port), why);
}

/// The device that `open` returns.
struct Opened
{
    std::string port;
    std::string file;   // as openPaths() knows it
    std::unique_ptr<ForceDevice> device;
    std::atomic<bool> is_gone = false;   // whichever function has found that out
};

std::unique_ptr<Opened> open (const Wanted& wanted, std::string& why, std::string& remark)
{
    const auto path = findPath (wanted.port, why);
    if (path.empty()) return nullptr;
    auto events = system().open (path);
    if (! events)
    {
        why = events.error().text + (events.error().remedy.empty() ? "" : "; " + events.error().remedy);
        return nullptr;
    }
    const auto& info = (*events)->info();
    if (! info.hasForceFeedback())
    {
        why = quote (info.name) + " has no force feedback that is known here: neither a constant force nor rumble";
        return nullptr;
    }
    std::vector<std::string> axes;
    for (const auto& axis : info.axes)
        axes.push_back (axis.name);
    hid::PidCalibration calibration = wanted.calibration.value_or (hid::PidCalibration {});
    if (info.has_constant)
    {
        if (wanted.calibration && wanted.calibration->full_force <= 0.0)
        {
            why = R"(the calibration has no "full_force": write the device's largest force: "4 N", or "2.5 N*m" for a wheel)";
            return nullptr;
        }
        Messages messages;
        calibration = hid::calibrationOf (info.name, axes, wanted.calibration, messages);
        for (const auto& m : messages)
            (m.severity == Message::Severity::error ? why : remark) += m.text;
        if (! why.empty()) return nullptr;
    }
    auto opened = std::make_unique<Opened>();
    opened->port = wanted.port;
    opened->file = OpenPaths::fileOf (path);
    opened->device = std::make_unique<ForceDevice> (std::move (*events), calibration, wanted.most_hz);
    why = opened->device->prepare();
    if (! why.empty()) return nullptr;
    if (const auto stays = opened->device->whatStaysChanged(); ! stays.empty()) remark += (remark.empty() ? "" : "; ") + stays;
    gone().found (wanted.port);
    openPaths().add (opened->file);
    return opened;
}

//==============================================================================
int32_t checkPort (const tactus_device_description* given, const tactus_plugin_report* report) noexcept
{
    return answered (report, [&] {
        Wanted wanted;
        const auto wrong = read (*given, wanted);
        return wrong.empty() ? TACTUS_DEVICE_OK : failed (report, wrong);
    });
}

void* openPort (const tactus_device_description* given, tactus_device_about* about, const tactus_plugin_report* report) noexcept
{
    Opened* made = nullptr;
    answered (report, [&] {
        Wanted wanted;
        if (const auto wrong = read (*given, wanted); ! wrong.empty()) return failed (report, wrong);
        std::string why, remark;
        auto opened = open (wanted, why, remark);
        if (! opened) return failed (report, why);
        opened->device->describe (*about);
        if (! remark.empty()) report->put (report->context, remark.data(), remark.size());
        made = opened.release();
        return int32_t { TACTUS_DEVICE_OK };
    });
    return made;
}

int32_t readPort (void* device, int32_t timeout_ms, tactus_reading* to, tactus_device_stamp* stamp, const tactus_plugin_report* report) noexcept
{
    return answered (report, [&] {
        auto& opened = *static_cast<Opened*> (device);
        const auto got = opened.device->read (std::chrono::milliseconds (timeout_ms), *to, *stamp);
        if (got == TACTUS_DEVICE_GONE)
        {
            opened.is_gone = true;
            failed (report, "it was unplugged");
        }
        return got;
    });
}

int32_t answerOf (Opened& opened, int error, const tactus_plugin_report* report)
{
    if (error == 0) return TACTUS_DEVICE_OK;
    failed (report, std::strerror (error));
    if (error == ENODEV) opened.is_gone = true;
    return error == ENODEV ? TACTUS_DEVICE_GONE : TACTUS_DEVICE_FAILED;
}

int32_t writePort (void* device, const tactus_effort* effort, const tactus_plugin_report* report) noexcept
{
    return answered (report, [&] {
        auto& opened = *static_cast<Opened*> (device);
        return answerOf (opened, opened.device->write (*effort, ForceDevice::Clock::now()), report);
    });
}

int32_t restPort (void* device, const tactus_plugin_report* report) noexcept
{
    return answered (report, [&] {
        // A device that is gone is at rest: the kernel has removed its effects.
        auto& opened = *static_cast<Opened*> (device);
        const auto answer = answerOf (opened, opened.device->rest(), report);
        return answer == TACTUS_DEVICE_GONE ? int32_t { TACTUS_DEVICE_OK } : answer;
    });
}

void closePort (void* device) noexcept
{
    const std::unique_ptr<Opened> opened (static_cast<Opened*> (device));
    try
    {
        openPaths().remove (opened->file);
        if (! opened->is_gone) return opened->device->restore();
        gone().add (opened->port, opened->device->device().info());
    }
    catch (const std::exception&)
    {
        // Without memory, the device is found again by its port.
    }
}

constexpr const char* keys[] { "port", "calibration", "max_rate" };
}   // namespace

const tactus_device_driver driver { sizeof (tactus_device_driver),
                                    TACTUS_DEVICE_ABI,
                                    "evdev",
                                    "1.0.0",
                                    "Wheels, joysticks and pads with force feedback, through the event devices of Linux.",
                                    keys,
                                    std::size (keys),
                                    checkPort,
                                    openPort,
                                    readPort,
                                    writePort,
                                    restPort,
                                    closePort,
                                    nullptr };

void setSystem (EventSystem& s) { in_use = &s; }

}   // namespace tactus::host::evdev
