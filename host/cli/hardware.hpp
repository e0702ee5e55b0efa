// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/audio/open_audio.hpp>
#include <host/hid_link/open_device.hpp>
#include <host/sessions/choose_clock.hpp>
#include <host/sessions/device_health.hpp>
#include <host/sessions/run_clock.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tactus::host
{

/// Opens the devices of a run, those that are really there, too.
class Hardware
{
public:
    /// Sound cards are opened by the rig, which outlives this.
    Hardware (bool allow, audio::AudioRig& a) : allowed (allow), rig (a) {}

    /// As hid::openDevice, and audio::openAudio; offline it refuses real devices (device/real).
    MadeDevice open (const Json& description, const std::filesystem::path& folder);

    /// As host::tickRateOf.
    std::optional<double> tickRate (const Json& description, bool may_wait);

    const hid::LoadedProfiles& profiles();

private:
    bool allowed;
    audio::AudioRig& rig;
    std::optional<hid::LoadedProfiles> loaded;
};

/// For the status line: how the devices are doing, and what ticks if it is not what was chosen.
std::string statusOf (std::span<const DeviceHealth>, const RunClock*);

/// At the end: a line or some for each device, of what went in and out.
std::string accountOf (std::span<const RealDevice>, std::span<const DeviceHealth>, const RunClock*);

}   // namespace tactus::host
