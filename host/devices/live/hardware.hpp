// SPDX-License-Identifier: MIT
#pragma once

#include "run_sound.hpp"

#include <host/devices/hid_link/open_device.hpp>

#include <filesystem>
#include <functional>
#include <optional>

namespace tactus::host
{

/// The real devices of this computer, as far as a run may open them. [main thread]
class Hardware
{
public:
    using Profiles = std::function<const hid::LoadedProfiles&()>;   ///< called when profiles are needed for the first time

    /// No hardware, for a run that does not play in real time.
    Hardware() = default;

    /// The sound may be null. All must outlive this object.
    Hardware (hid::HidSystem& s, Profiles p, RunSound* a) : hid_system (&s), read_profiles (std::move (p)), run_sound (a) {}

    /// Opens the device of a role. Ids: those of makeDevice, hid::openDevice, openPluginDevice and RunSound::open; device/real without hardware;
    /// audio/none without sound.
    MadeDevice open (const Json& description, const std::filesystem::path& folder, const std::string& role, const Plan&);

    /// The rate in Hz at which the device could tick the run: see host::tickRateOf.
    std::optional<double> tickRate (const Json& description, bool may_wait) const;

    bool isThere() const noexcept { return hid_system != nullptr; }
    hid::HidSystem& system() const noexcept { return *hid_system; }           ///< only if it is there
    const hid::LoadedProfiles& profiles() const { return read_profiles(); }   ///< only if it is there
    RunSound* sound() const noexcept { return run_sound; }

private:
    hid::HidSystem* hid_system = nullptr;
    Profiles read_profiles;
    RunSound* run_sound = nullptr;
};

}   // namespace tactus::host
