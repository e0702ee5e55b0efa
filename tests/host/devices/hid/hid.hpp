// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/hex.hpp>
#include <host/devices/hid/hid_model.hpp>
#include <host/devices/hid/profile_reader.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

namespace tactus::test
{

inline const std::filesystem::path profile_folder = std::filesystem::path (TACTUS_SOURCE_DIR) / "host" / "devices" / "profiles";

/// The profiles that come with Tactus; they have no errors.
inline const std::vector<std::shared_ptr<const host::hid::Profile>>& profiles()
{
    static const auto loaded = host::hid::loadProfiles (profile_folder);
    for (const auto& m : loaded.messages)
        FAIL_CHECK (m.file + " " + m.where + ": " + m.text);
    return loaded.profiles;
}

inline std::shared_ptr<const host::hid::Profile> profileOf (std::string_view id)
{
    for (const auto& profile : profiles())
        if (profile->id == id) return profile;
    FAIL ("no profile " << id);
    return {};
}

inline host::hid::Bytes bytes (std::string_view hex) { return host::hid::bytesOf (hex).value(); }

}   // namespace tactus::test
