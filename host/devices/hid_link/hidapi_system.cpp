// SPDX-License-Identifier: MIT
#include "transport.hpp"

#include <host/base/platform/device_file.hpp>
#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/private_folder.hpp>
#include <host/devices/failsafe/failsafe.hpp>

#include <hidapi.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

namespace tactus::host::hid
{
namespace
{
struct Close
{
    void operator() (hid_device* device) const noexcept { hid_close (device); }
};
using Handle = std::unique_ptr<hid_device, Close>;

/// hidapi keeps one global error string for all of its calls without a device.
std::mutex& oneAtATime()
{
    static std::mutex mutex;
    return mutex;
}

std::string narrow (const wchar_t* wide)
{
    std::string text;
    for (; wide != nullptr && *wide != 0; ++wide)
    {
        const auto c = static_cast<std::uint32_t> (*wide);
        if (c < 0x80)
            text += static_cast<char> (c);
        else if (c < 0x800)
            (text += static_cast<char> (0xc0 | c >> 6)) += static_cast<char> (0x80 | (c & 0x3f));
        else if (c < 0x10000)
            ((text += static_cast<char> (0xe0 | c >> 12)) += static_cast<char> (0x80 | (c >> 6 & 0x3f))) += static_cast<char> (0x80 | (c & 0x3f));
        else
            text += '?';
    }
    return text;
}

std::string errorOf (hid_device* device)
{
    const auto text = narrow (hid_error (device));
    return text.empty() ? "the system gave no reason" : text;
}

Bus busOf (hid_bus_type type)
{
    if (type == HID_API_BUS_USB) return Bus::usb;
    if (type == HID_API_BUS_BLUETOOTH) return Bus::bluetooth;
    return Bus::unknown;
}

/// Opens the device twice, once for reading and once for writing: hidapi stores the last error string in the handle without
/// a lock, so two threads must not share a handle. Where the device is a file, it is read directly: hidapi waits in steps of 1 ms,
/// and allocates when it fails.
class HidapiTransport final : public Transport
{
public:
    HidapiTransport (std::string where, std::optional<FileLock> l, std::optional<ReportFile> f, Handle in, Handle out)
        : path (std::move (where)), lock (std::move (l)), file (std::move (f)), reading (std::move (in)), writing (std::move (out))
    {
    }

    bool canReadUntil() const noexcept override { return file.has_value(); }

    ReportFile::Outcome readUntil (std::span<std::uint8_t> into, ReportFile::Clock::time_point until) noexcept override
    {
        return file ? file->read (into, until) : Transport::readUntil (into, until);
    }

    Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override
    {
        if (file)
        {
            const auto got = file->read (into, ReportFile::Clock::now() + timeout);
            if (got.what == ReportFile::Outcome::Kind::failure) return transferError (std::generic_category().message (got.error));
            return got.size;
        }
        const int got = hid_read_timeout (reading.get(), into.data(), into.size(), static_cast<int> (timeout.count()));
        if (got < 0) return transferError (errorOf (reading.get()));
        return static_cast<std::size_t> (got);
    }

    Result<std::size_t> getInput (std::span<std::uint8_t> report) override
    {
        std::size_t size = 0;
        if (file)
        {
            const auto got = file->ask (report);
            if (got.what != ReportFile::Outcome::Kind::report) return transferError (std::generic_category().message (got.error));
            size = got.size;
        }
        else
        {
            const int got = hid_get_input_report (reading.get(), report.data(), report.size());
            if (got < 0) return transferError (errorOf (reading.get()));
            size = static_cast<std::size_t> (got);
        }
        if (size == 0 || report[0] != 0) return size;
        std::shift_left (report.begin(), report.begin() + static_cast<std::ptrdiff_t> (size), 1);   // without ids, it begins with a 0 here
        return size - 1;
    }

    Result<> write (std::span<const std::uint8_t> report) override
    {
        return outcome (hid_write (writing.get(), report.data(), report.size()));
    }

    Result<> sendFeature (std::span<const std::uint8_t> report) override
    {
        return outcome (hid_send_feature_report (writing.get(), report.data(), report.size()));
    }

    Result<> getFeature (std::span<std::uint8_t> report) override
    {
        return outcome (hid_get_feature_report (writing.get(), report.data(), report.size()));
    }

    Result<> armFailsafe (const std::vector<OutgoingReport>& reports) override
    {
        std::vector<Failsafe::Report> last;
        for (const auto& r : reports)
            last.push_back ({ r.bytes, r.is_feature });
        failsafe.reset();
        auto armed = Failsafe::arm (path, last);
        if (! armed) return std::move (armed).error();
        failsafe.emplace (std::move (*armed));
        return {};
    }

    bool beat (bool driven) noexcept override { return ! failsafe || failsafe->beat (driven); }

private:
    Result<> outcome (int result)
    {
        if (result >= 0) return {};
        return transferError (errorOf (writing.get()));
    }

    std::string path;
    std::optional<FileLock> lock;     // ensures that only one driver uses the device, on systems where devices are files
    std::optional<ReportFile> file;   // empty if the device is not a file; then `reading` reads
    Handle reading, writing;
    std::optional<Failsafe> failsafe;
};

class Hidapi final : public HidSystem
{
public:
    std::vector<ConnectedDevice> connected() override
    {
        const std::lock_guard lock (oneAtATime());
        auto* const list = hid_enumerate (0, 0);
        std::vector<ConnectedDevice> found;
        for (const auto* d = list; d != nullptr; d = d->next)
        {
            ConnectedDevice device;
            device.vid = d->vendor_id;
            device.pid = d->product_id;
            device.usage_page = d->usage_page;
            device.usage = d->usage;
            device.interface_number = d->interface_number;
            device.bus = busOf (d->bus_type);
            device.product = narrow (d->product_string);
            device.path = d->path != nullptr ? d->path : "";
            device.serial = narrow (d->serial_number);
            device.manufacturer = narrow (d->manufacturer_string);
            found.push_back (std::move (device));
        }
        hid_free_enumeration (list);
        std::ranges::stable_sort (found, {}, &ConnectedDevice::path);
        return found;
    }

    Result<std::unique_ptr<Transport>> open (const ConnectedDevice& device) override
    {
        const std::lock_guard lock (oneAtATime());
        auto alone = lockDevice (device.path);
        if (! alone) return std::move (alone).error();
        Handle out (hid_open_path (device.path.c_str()));
        auto file = out && isReportFile (device.path) ? ReportFile::open (device.path) : std::nullopt;
        Handle in (out && ! file ? hid_open_path (device.path.c_str()) : nullptr);
        if (! out || (! file && ! in))
            return Message::error (isForbidden (device.path) ? "hid/not_permitted" : "hid/not_opened", device.path, errorOf (nullptr));
        return std::make_unique<HidapiTransport> (device.path, std::move (*alone), std::move (file), std::move (in), std::move (out));
    }

    Bytes reportDescriptor (const ConnectedDevice& device) override   // not through hidapi, which provides it only since 0.14
    {
        const auto text = reportDescriptorOf (device.path);
        return { text.begin(), text.end() };
    }

    bool mayOpen (const ConnectedDevice& device) override { return ! isForbidden (device.path); }
};
}   // namespace

Result<std::optional<FileLock>> lockDevice (const std::string& path)
{
    if constexpr (FileLock::open_is_locked)   // a lock would keep the device itself from being opened, so a file stands for it
    {
        const auto folder = runFolder();
        if (folder.empty() || ! needOwnFolder (folder)) return std::optional<FileLock> {};
        auto lock = FileLock::take (folder / ("device " + std::to_string (std::hash<std::string> {}(path)) + ".lock"));
        if (! lock) return inUse (path);
        return lock;
    }
    auto alone = FileLock::takeExisting (path);
    std::error_code unseen;
    const bool is_used = ! alone && std::filesystem::exists (path, unseen) && ! std::filesystem::is_directory (path, unseen) && ! isForbidden (path);
    if (is_used) return inUse (path);
    return alone;
}

HidSystem& thisComputer()
{
    static Hidapi system;
    return system;
}

}   // namespace tactus::host::hid
