// SPDX-License-Identifier: MIT
#pragma once

#include "driver_about.hpp"
#include "driver_report.hpp"

#include <tactus/plugin/shared_object.hpp>
#include <tactus/tactus_device.h>
#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

class OpenedDevice;

/// True for the drivers that are part of Tactus, such as "hid". No plugin may have such a name.
bool isBuiltInDriver (std::string_view name) noexcept;

/// A device that a driver has found, and what opens it.
struct FoundByDriver
{
    std::string name;         ///< for people
    Json description;         ///< {"driver": …, "port": …}, or without a port if the driver needs none
    bool is_in_use = false;   ///< by another role or another program
    bool is_seen = true;      ///< false: it is known by its name only
};

/// A driver in a plugin (tactus_device.h). Its devices keep it loaded. Functions that call the driver wait for each other: the interface promises
/// drivers that such calls never overlap. If the driver does not return to one of them, the others give up after `patience`.
class DeviceDriver : public std::enable_shared_from_this<DeviceDriver>
{
public:
    static constexpr const char* suffix = ".tactus-device";
    static constexpr std::chrono::seconds patience { 10 };

    /// Runs code of the plugin: its static initialisers. Refuses a file that is not a driver, one for another version of the interface, and one that
    /// another user could have written. A file that is loaded already is not loaded again. Errors: plugin/foreign, plugin/cannot_load,
    /// plugin/no_entry, plugin/wrong_abi, plugin/wrong_size, plugin/bad_driver. [main thread]
    static Result<std::shared_ptr<const DeviceDriver>> load (const std::filesystem::path&);

    /// A driver that is part of this program. It must outlive its devices. Errors as for load(). [main thread]
    static Result<std::shared_ptr<const DeviceDriver>> within (const tactus_device_driver&);

    ~DeviceDriver();
    DeviceDriver (const DeviceDriver&) = delete;
    DeviceDriver& operator= (const DeviceDriver&) = delete;

    const std::string& name() const noexcept { return called; }
    const std::string& version() const noexcept { return of_version; }
    const std::string& about() const noexcept { return sentence; }
    const std::vector<std::string>& keys() const noexcept { return known_keys; }
    const tactus_device_driver& functions() const noexcept { return entry; }

    /// Checks a description, as far as that is possible without the device. The keys "guard" and "workspace" are the caller's. Ids: those of
    /// ObjectReader, device/refused, device/driver_busy. [any thread]
    Messages check (const Json& description) const;

    /// Opens a device, and brings it to rest. Ids: those of check() and readAbout(), device/not_opened. `where` is relative to the description.
    /// [any thread]
    std::unique_ptr<OpenedDevice> open (const Json& description, Messages&) const;

    bool canFind() const noexcept { return entry.find != nullptr; }

    /// Asks the driver for its devices; at most 1000. Ids: device/cannot_find, device/driver_busy. [any thread]
    Result<std::vector<FoundByDriver>> find() const;

private:
    friend class OpenedDevice;

    explicit DeviceDriver (std::unique_ptr<SharedObject>);
    Result<> take (const tactus_device_driver*, const std::filesystem::path& from);

    std::unique_ptr<SharedObject> object;   // null for a driver of this program
    tactus_device_driver entry {};
    std::string called, of_version, sentence;
    std::vector<std::string> known_keys;

    /// Held during check, open and close. (Not a std::timed_mutex, which thread sanitizers do not understand.)
    class CallLock
    {
    public:
        explicit CallLock (const DeviceDriver&);
        ~CallLock() { end(); }
        CallLock (const CallLock&) = delete;
        CallLock& operator= (const CallLock&) = delete;

        explicit operator bool() const noexcept { return is_mine; }   ///< false if another call did not return in time
        void end() noexcept;

    private:
        const DeviceDriver& of;
        bool is_mine;
    };

    mutable std::mutex turning;
    mutable std::condition_variable free;
    mutable bool is_taken = false;
};

/// A device that a driver has opened. Closes it at the end.
class OpenedDevice
{
public:
    ~OpenedDevice();   ///< no other call may be running
    OpenedDevice (const OpenedDevice&) = delete;
    OpenedDevice& operator= (const OpenedDevice&) = delete;

    const DriverAbout& about() const noexcept { return described; }
    const DeviceDriver& driver() const noexcept { return *of; }
    const Json& description() const noexcept { return asked; }

    /// The functions of the driver. Each returns TACTUS_DEVICE_OK, …; an answer that no driver may give counts as TACTUS_DEVICE_FAILED. Without
    /// efforts, there is nothing to write or to bring to rest.
    int read (std::chrono::milliseconds timeout, tactus_reading&, tactus_device_stamp&, DriverReport&) noexcept;   ///< [reading thread]
    int write (const Effort&, bool is_withheld, double max_signal, DriverReport&) noexcept;                        ///< [writing thread]
    int rest (DriverReport&) noexcept;                                                                             ///< [writing thread]

private:
    friend class DeviceDriver;

    OpenedDevice (std::shared_ptr<const DeviceDriver> d, Json j, void* h, DriverAbout a)
        : of (std::move (d)), asked (std::move (j)), handle (h), described (std::move (a))
    {
    }

    std::shared_ptr<const DeviceDriver> of;
    Json asked;
    void* handle;
    DriverAbout described;
};

}   // namespace tactus::host
