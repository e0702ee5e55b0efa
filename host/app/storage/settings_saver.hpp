// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "settings.hpp"

#include <filesystem>
#include <utility>

namespace tactus::host
{

/// The saving of settings, half a second after a change, so that a drag writes them only once. What is left is saved at the end. [main thread]
class SettingsSaver
{
public:
    explicit SettingsSaver (const Settings& s) : settings (s) {}

    ~SettingsSaver()
    {
        if (calls_left > 0) static_cast<void> (saveSettings (settings, folder));
    }

    SettingsSaver (const SettingsSaver&) = delete;
    SettingsSaver& operator= (const SettingsSaver&) = delete;

    void begin (std::filesystem::path home) { folder = std::move (home); }   ///< before that, nothing is saved
    const std::filesystem::path& home() const noexcept { return folder; }

    void saveSoon() noexcept
    {
        if (! folder.empty()) calls_left = calls_before_saving;
    }
    bool isWaiting() const noexcept { return calls_left > 0; }

    Result<> poll()   ///< call 30 times a second; the error of a save
    {
        if (calls_left == 0 || --calls_left > 0) return {};
        return saveSettings (settings, folder);
    }

private:
    static constexpr int calls_before_saving = 15;

    const Settings& settings;
    std::filesystem::path folder;
    int calls_left = 0;
};

}   // namespace tactus::host
