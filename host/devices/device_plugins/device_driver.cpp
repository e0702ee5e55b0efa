// SPDX-License-Identifier: MIT
#include "device_driver.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/caught.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <map>
#include <system_error>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr const char* symbol = "tactus_device_entry";
constexpr std::size_t most_keys = 64;

// The keys of a description that Tactus itself reads.
constexpr const char* own_keys[] { "driver", "guard", "about", "ui", "workspace" };

constexpr std::string_view built_in[] { "sim", "trace", "gesture", "hid", "serial", "udp", "audio" };

/// The size of the first version of the struct.
constexpr std::size_t first_size = offsetof (tactus_device_driver, close) + sizeof (void (*)());

std::string textOf (const char* text) { return text != nullptr ? printableName (text) : std::string(); }

Message badDriver (const fs::path& file, std::string why)
{
    return Message::error ("plugin/bad_driver", file.string(), "the driver " + std::move (why), "ask its author to correct it, or remove it");
}

/// The keys that the driver reads itself.
Json keysOf (const Json& description)
{
    Json::Object own;
    for (const auto& member : description.items())
        if (std::ranges::find (own_keys, member.first) == std::end (own_keys)) own.push_back (member);
    return own;
}

/// A description as the driver gets it. It refers to this object.
struct DescriptionText
{
    explicit DescriptionText (const Json& description)
    {
        const auto own = keysOf (description);
        if (const auto at = own.find ("port"); at != own.end() && at->is_string()) port = at->get<std::string>();
        json = own.dump();
    }

    tactus_device_description given() const noexcept { return { sizeof (tactus_device_description), port.c_str(), json.c_str() }; }

    std::string port, json;
};
}   // namespace

bool isBuiltInDriver (std::string_view name) noexcept { return std::ranges::find (built_in, name) != std::end (built_in); }

//==============================================================================
DeviceDriver::DeviceDriver (std::unique_ptr<SharedObject> o) : object (std::move (o)) {}
DeviceDriver::~DeviceDriver() = default;

Result<std::shared_ptr<const DeviceDriver>> DeviceDriver::load (const fs::path& file)
{
    static std::mutex changing;
    static std::map<fs::path, std::weak_ptr<const DeviceDriver>> loaded;
    const std::lock_guard lock (changing);
    std::error_code unseen;
    const auto whole = fs::weakly_canonical (file, unseen);
    if (const auto before = loaded.find (whole); before != loaded.end())
        if (auto still = before->second.lock()) return still;

    auto opened = SharedObject::load (file);
    if (! opened) return std::move (opened).error();
    const std::shared_ptr<DeviceDriver> made (new DeviceDriver (std::move (*opened)));
    const auto* given = static_cast<const tactus_device_driver*> (made->object->find (symbol));
    if (auto taken = made->take (given, file); ! taken) return std::move (taken).error();
    loaded[whole] = made;
    return std::shared_ptr<const DeviceDriver> (made);
}

Result<std::shared_ptr<const DeviceDriver>> DeviceDriver::within (const tactus_device_driver& given)
{
    const std::shared_ptr<DeviceDriver> made (new DeviceDriver (nullptr));
    if (auto taken = made->take (&given, {}); ! taken) return std::move (taken).error();
    return std::shared_ptr<const DeviceDriver> (made);
}

Result<> DeviceDriver::take (const tactus_device_driver* given, const fs::path& from)
{
    const auto refuse = [&] (const char* id, std::string why) {
        return Message::error (id, from.string(), std::move (why), "build the driver again, with the <tactus/tactus_device.h> of this version");
    };
    if (given == nullptr) return refuse ("plugin/no_entry", std::string ("the file is not a device driver: it does not export `") + symbol + "`");
    if (given->size < offsetof (tactus_device_driver, abi) + sizeof given->abi)
        return refuse ("plugin/wrong_size", std::string ("`") + symbol + "` has the wrong size");
    if (given->abi != TACTUS_DEVICE_ABI)
        return refuse ("plugin/wrong_abi", "the driver is for version " + std::to_string (given->abi) + " of the driver interface, and this Tactus has version "
                                               + std::to_string (TACTUS_DEVICE_ABI));
    if (given->size < first_size) return refuse ("plugin/wrong_size", std::string ("`") + symbol + "` is too small for its version");
    std::memcpy (&entry, given, std::min<std::size_t> (given->size, sizeof entry));
    entry.size = sizeof entry;

    called = entry.name != nullptr ? std::string (entry.name) : std::string();
    of_version = textOf (entry.version);
    sentence = textOf (entry.about);
    if (! graph::isId (called)) return badDriver (from, "is called " + quote (called) + ": a name consists of a to z, digits and _, and begins with a letter");
    if (isBuiltInDriver (called)) return badDriver (from, "is called " + quote (called) + ", like a driver of Tactus");
    if (! from.empty() && from.filename() != called + suffix)
        return badDriver (from, "is called " + quote (called) + ", so its file must be " + called + suffix);
    if (entry.open == nullptr || entry.read == nullptr || entry.close == nullptr) return badDriver (from, "lacks open, read or close");
    if ((entry.write == nullptr) != (entry.rest == nullptr)) return badDriver (from, "has only one of write and rest");
    if (entry.key_count > most_keys || (entry.key_count > 0 && entry.keys == nullptr))
        return badDriver (from, "gives " + std::to_string (entry.key_count) + " keys, or no names for them");
    for (std::size_t i = 0; i < entry.key_count; ++i)
    {
        const std::string key = entry.keys[i] != nullptr ? entry.keys[i] : "";
        if (! graph::isId (key) || std::ranges::find (own_keys, key) != std::end (own_keys) || std::ranges::count (known_keys, key) > 0)
            return badDriver (from, "cannot have a key " + quote (key));
        known_keys.push_back (key);
    }
    return {};
}

//==============================================================================
namespace
{
Message busy (const std::string& name)
{
    return Message::error ("device/driver_busy", "", "the driver " + quote (name) + " has not returned from an earlier call",
                           "end the program, and start it again");
}
}   // namespace

Messages DeviceDriver::check (const Json& description) const
{
    Messages messages;
    ObjectReader in (description, "", messages);
    for (const auto* key : own_keys)
        in.ignore (key);
    for (const auto& key : known_keys)
        in.ignore (key);
    if (std::ranges::count (known_keys, "port") > 0) in.text ("port");
    in.finish();
    if (hasErrors (messages) || entry.check == nullptr) return messages;

    const CallLock turn (*this);
    if (! turn) return { busy (called) };
    const DescriptionText asked (description);
    const auto given = asked.given();
    DriverReport why;
    if (entry.check (&given, why.to()) != TACTUS_DEVICE_OK)
        messages.push_back (Message::error ("device/refused", "", "the driver " + quote (called) + " refuses the description: " + why.text(),
                                            sentence.empty() ? "see the documentation of the driver" : "the driver says about itself: " + sentence));
    return messages;
}

std::unique_ptr<OpenedDevice> DeviceDriver::open (const Json& description, Messages& messages) const
{
    auto wrong = check (description);
    const bool is_wrong = hasErrors (wrong);
    std::ranges::move (wrong, std::back_inserter (messages));
    if (is_wrong) return nullptr;

    const auto refuse = [&] (const std::string& why) {
        messages.push_back (Message::error ("device/not_opened", "", "the driver " + quote (called) + " cannot open its device: " + why,
                                            "check that it is connected, that you may open it, and that no other program uses it"));
        return nullptr;
    };
    CallLock turn (*this);
    if (! turn)
    {
        messages.push_back (busy (called));
        return nullptr;
    }
    const DescriptionText asked (description);
    const auto given = asked.given();
    tactus_device_about about {};
    about.size = sizeof about;
    DriverReport why;
    void* const handle = entry.open (&given, &about, why.to());
    if (handle == nullptr) return refuse (why.text());

    Messages found;
    auto described = readAbout (about, entry.write != nullptr, found);
    if (const auto remark = why.text (""); ! remark.empty())
        found.push_back (Message::warning ("device/remark", "", remark, "see the documentation of the driver " + quote (called)));
    std::unique_ptr<OpenedDevice> opened (new OpenedDevice (shared_from_this(), description, handle, std::move (described)));
    why.clear();
    const bool rests = opened->rest (why) == TACTUS_DEVICE_OK;   // whatever the driver has said: the device may hold an effort of its last user
    turn.end();                                                  // closing needs it
    const bool is_faulty = hasErrors (found);
    std::ranges::move (found, std::back_inserter (messages));
    if (is_faulty) return nullptr;
    if (! rests) return refuse ("it does not come to rest: " + why.text());
    return opened;
}

namespace
{
/// Takes what a driver finds. Without memory, it takes no more.
void addFound (void* context, const tactus_device_found* found) noexcept
{
    constexpr std::size_t most_found = 1000;
    auto& of = *static_cast<std::pair<std::string, std::vector<FoundByDriver>>*> (context);
    auto& driver = of.first;
    auto& all = of.second;
    if (found == nullptr || found->size < sizeof *found || all.size() >= most_found) return;
    static_cast<void> (caught ({}, [&] {
        Json description { { "driver", driver } };
        if (found->port != nullptr && found->port[0] != 0) description["port"] = found->port;
        const bool is_known = std::ranges::count (all, description, &FoundByDriver::description) > 0;
        const bool is_in_use = (found->state & TACTUS_DEVICE_IN_USE) != 0, is_seen = (found->state & TACTUS_DEVICE_UNSEEN) == 0;
        if (! is_known) all.push_back ({ textOf (found->name), std::move (description), is_in_use, is_seen });
    }));
}
}   // namespace

Result<std::vector<FoundByDriver>> DeviceDriver::find() const
{
    const auto refuse = [&] (const std::string& why) {
        return Message::error ("device/cannot_find", "", "the driver " + quote (called) + " cannot look for devices: " + why,
                               "name the device yourself: --device ROLE=" + called + ":PORT");
    };
    if (! canFind()) return refuse ("it has no list of them");
    const CallLock turn (*this);
    if (! turn) return busy (called);
    std::pair<std::string, std::vector<FoundByDriver>> found { called, {} };
    const tactus_device_finder finder { sizeof finder, &found, addFound };
    DriverReport why;
    if (entry.find (&finder, why.to()) != TACTUS_DEVICE_OK) return refuse (why.text());
    return std::move (found.second);
}

//==============================================================================
DeviceDriver::CallLock::CallLock (const DeviceDriver& d) : of (d)
{
    std::unique_lock lock (of.turning);
    is_mine = of.free.wait_for (lock, patience, [this] { return ! of.is_taken; });
    if (is_mine) of.is_taken = true;
}

void DeviceDriver::CallLock::end() noexcept
{
    if (! std::exchange (is_mine, false)) return;
    {
        const std::lock_guard lock (of.turning);
        of.is_taken = false;
    }
    of.free.notify_one();
}

//==============================================================================
OpenedDevice::~OpenedDevice()
{
    if (const DeviceDriver::CallLock turn (*of); turn)
    {
        of->entry.close (handle);
        return;
    }
    static std::mutex changing;
    // NOLINTNEXTLINE(bugprone-unhandled-exception-at-new): a program without memory for this ends
    static auto& kept = *new std::vector<std::shared_ptr<const DeviceDriver>>;   // the device stays open, so its driver must stay loaded
    const std::lock_guard lock (changing);
    kept.push_back (of);
}

namespace
{
int known (int answer) noexcept { return answer >= TACTUS_DEVICE_OK && answer <= TACTUS_DEVICE_GONE ? answer : int { TACTUS_DEVICE_FAILED }; }
}   // namespace

int OpenedDevice::read (std::chrono::milliseconds timeout, tactus_reading& to, tactus_device_stamp& stamp, DriverReport& why) noexcept
{
    to = {};
    to.size = sizeof to;
    stamp = {};
    stamp.size = sizeof stamp;
    return known (of->entry.read (handle, static_cast<std::int32_t> (timeout.count()), &to, &stamp, why.to()));
}

int OpenedDevice::write (const Effort& effort, bool is_withheld, double max_signal, DriverReport& why) noexcept
{
    if (of->entry.write == nullptr) return TACTUS_DEVICE_OK;
    tactus_effort given {};
    given.size = sizeof given;
    given.is_withheld = is_withheld ? 1 : 0;
    given.max_signal = std::min (max_signal, described.limits.max_signal);
    Vec3::Map (given.force) = described.renderedForce (effort.force);
    Vec3::Map (given.torque) = described.renderedTorque (effort.torque);
    // The driver gets what it has named, whatever the graph wires: nothing else has a limit.
    given.axis_count = static_cast<std::uint32_t> (described.layout.efforts.size());
    given.signal_count = static_cast<std::uint32_t> (described.layout.signal_outputs);
    for (int i = 0; i < static_cast<int> (given.axis_count); ++i)
        given.axes[i] = effort.axes[i];
    for (int i = 0; i < static_cast<int> (given.signal_count); ++i)
        given.signals[i] = effort.signals[i];
    const int answer = known (of->entry.write (handle, &given, why.to()));
    return answer == TACTUS_DEVICE_NONE ? int { TACTUS_DEVICE_FAILED } : answer;
}

int OpenedDevice::rest (DriverReport& why) noexcept
{
    if (of->entry.rest == nullptr) return TACTUS_DEVICE_OK;
    const int answer = known (of->entry.rest (handle, why.to()));
    return answer == TACTUS_DEVICE_NONE ? int { TACTUS_DEVICE_FAILED } : answer;
}

}   // namespace tactus::host
