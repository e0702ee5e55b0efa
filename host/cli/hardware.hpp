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

/// Opens the devices of a run, including real ones.
class Hardware
{
public:
    /// Real devices are opened only if `allow` is true. Sound cards are opened by the rig, which must outlive this.
    Hardware (bool allow, audio::AudioRig& a) : allowed (allow), rig (a) {}

    /// Like hid::openDevice and audio::openAudio. Refuses real devices in an offline run (device/real).
    MadeDevice open (const Json& description, const std::filesystem::path& folder);

    /// See host::tickRateOf.
    std::optional<double> tickRate (const Json& description, bool may_wait);

    const hid::LoadedProfiles& profiles();

private:
    bool allowed;
    audio::AudioRig& rig;
    std::optional<hid::LoadedProfiles> loaded;
};

/// Text for the status line: the state of the devices, and which clock ticks the run if it is not the chosen one.
std::string statusOf (std::span<const DeviceHealth>, const RunClock*);

/// Text for the end of a run: a few lines for each device about its traffic.
std::string accountOf (std::span<const RealDevice>, std::span<const DeviceHealth>, const RunClock*);

}   // namespace tactus::host
