// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/json.hpp>

#include <juce_core/juce_core.h>

#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// A setting of a binding or of the sound card, in a field of the devices panel: its JSON pointer, and its label and tooltip in English.
struct SettingField
{
    const char *pointer, *label, *about;
};

/// The fields of a binding with this driver, see driverOf().
std::vector<SettingField> fieldsOf (const std::string& driver);

/// The fields of the sound card: those that choose from a list, and those that are typed.
std::span<const SettingField> listsOfCard();
std::span<const SettingField> fieldsOfCard();

/// The name that decides which settings a binding has: its driver, or "pid" for a HID device that must be calibrated.
std::string driverOf (const Json& binding);

/// A setting as it is typed, and the value that a typed text stands for. Keys that cannot be typed are taken from `before`.
juce::String typedSetting (const std::string& pointer, const Json& value);
Json readTypedSetting (const std::string& pointer, const juce::String& text, const Json& before);

/// A value as JSON text, or a string without quotes; and back.
juce::String writtenValue (const Json&);
Json readValue (const juce::String&);

/// Removes a setting, and the object around it if that becomes empty.
void removeSetting (Json& binding, const std::string& pointer);

}   // namespace tactus::host
