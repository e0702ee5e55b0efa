// SPDX-License-Identifier: GPL-3.0-or-later
#include "setting_fields.hpp"
#include "axes_text.hpp"
#include "binding_choice.hpp"
#include "sound_text.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/devices/hid_link/force_feedback.hpp>

namespace tactus::host
{

namespace
{
constexpr const char* axes_part = "/workspace/axes";

constexpr SettingField parts_of_tool[] {
    { "/workspace/scale", NEEDS_TRANS ("scale"),
      NEEDS_TRANS ("Size of the device's workspace in the graph: at 2 the hand moves half as far, and walls feel twice as stiff") },
    { "/workspace/offset", NEEDS_TRANS ("offset"),
      NEEDS_TRANS ("Position of the device's origin in the graph, such as [0, 0, \"1 cm\"]. The arrows in the 3D scene change it, too") },
    { axes_part, NEEDS_TRANS ("axes"),
      NEEDS_TRANS ("Which axes of the device are x, y and z of the graph, such as y -x z, which turns it, or -x y z, which mirrors it. For any other "
                   "angle: three rows of numbers, such as [[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]]") },
    { "/workspace/clutch", NEEDS_TRANS ("clutch"),
      NEEDS_TRANS ("Button of the device that moves the workspace with the hand while it is held, by its name or number. The key S does it, too") },
    { "/guard/max_force", NEEDS_TRANS ("max force"), NEEDS_TRANS ("Force limit, such as 3 N. Cannot exceed the limit in the device's profile") },
    { "/guard/max_speed", NEEDS_TRANS ("max speed"),
      NEEDS_TRANS ("Speed limit of the tool in the hand, such as 1 m/s. If the tool exceeds it, the guard withholds the force until you rearm") },
    { "/guard/ramp", NEEDS_TRANS ("ramp"), NEEDS_TRANS ("Time from no force to full force, such as 0.5 s") },
};

constexpr SettingField parts_of_calibration[] {
    { "/calibration/full_force", NEEDS_TRANS ("full force"),
      NEEDS_TRANS ("What the device exerts at its largest magnitude, such as 4 N, or 2.5 N*m for a wheel. Measure it. Without it, a tenth is used") },
    { "/calibration/travel", NEEDS_TRANS ("travel"),
      NEEDS_TRANS ("How far each axis moves from end to end, such as {\"x\": \"12 cm\"}, or {\"steering\": \"900 deg\"} for a wheel") },
    { "/calibration/reversed", NEEDS_TRANS ("reversed"), NEEDS_TRANS ("true if a force to the right pushes to the left") },
};

constexpr SettingField parts_of_events[] {
    { "/max_rate", NEEDS_TRANS ("max rate"),
      NEEDS_TRANS ("How many new forces per second the device gets at most, such as 250 Hz. Default: as many as its USB port takes, or 250") },
};

constexpr SettingField parts_of_sound[] {
    { "/outputs", NEEDS_TRANS ("outputs"),
      NEEDS_TRANS ("Card channels for the signal outputs 1, 2 ... of the role, and the value at full scale, such as 3@4 N, 4@4 N. "
                   "Default: the outputs that the graph uses") },
    { "/inputs", NEEDS_TRANS ("inputs"), NEEDS_TRANS ("The same for the signal inputs, such as 1@20 m/s2") },
    { "/guard/max_signal", NEEDS_TRANS ("max signal"), NEEDS_TRANS ("Limit of each output, in that output's unit") },
    { "/guard/ramp", NEEDS_TRANS ("ramp"), NEEDS_TRANS ("Time from silence to full signal, such as 0.5 s") },
};
constexpr SettingField lists_of_card[] {
    { "/type", NEEDS_TRANS ("audio system"), NEEDS_TRANS ("The audio system, such as JACK (PipeWire, too) or ALSA") },
    { "/output", NEEDS_TRANS ("output"), NEEDS_TRANS ("The card for the outputs") },
    { "/input", NEEDS_TRANS ("input"), NEEDS_TRANS ("The card for the inputs") },
};
constexpr SettingField parts_of_card[] {
    { "/rate_hz", NEEDS_TRANS ("sample rate"), NEEDS_TRANS ("Sample rate in Hz. Default: the card's own rate") },
    { "/block", NEEDS_TRANS ("block size"), NEEDS_TRANS ("Block size in frames. Small blocks risk gaps; large ones add delay") },
    { "/reserve", NEEDS_TRANS ("reserve"), NEEDS_TRANS ("How late a tick or block may be without causing a gap, such as 10 ms. Adds to the delay") },
};

bool isListOfChannels (const std::string& pointer) { return pointer == "/outputs" || pointer == "/inputs"; }
}   // namespace

std::vector<SettingField> fieldsOf (const std::string& driver)
{
    std::vector<SettingField> parts;
    const auto add = [&] (std::span<const SettingField> more) { parts.insert (parts.end(), more.begin(), more.end()); };
    if (driver == hid::pid_profile || driver == event_driver) add (parts_of_calibration);
    if (driver == event_driver) add (parts_of_events);
    add (driver == "audio" ? std::span<const SettingField> (parts_of_sound) : parts_of_tool);
    return parts;
}

std::span<const SettingField> listsOfCard() { return lists_of_card; }
std::span<const SettingField> fieldsOfCard() { return parts_of_card; }

std::string driverOf (const Json& binding)
{
    const bool is_pid = hid::isHid (binding) && binding.value ("profile", Json()) == Json (hid::pid_profile);
    return is_pid ? std::string (hid::pid_profile) : binding.value ("driver", std::string());
}

juce::String writtenValue (const Json& v) { return fromUtf8 (v.is_string() ? v.get<std::string>() : v.dump()); }

Json readValue (const juce::String& t)
{
    const auto text = t.trim().toStdString();
    return Json::tryParse (text).value_or (Json (text));
}

juce::String typedSetting (const std::string& pointer, const Json& value)
{
    if (pointer == axes_part) return fromUtf8 (textOfAxes (value));
    return isListOfChannels (pointer) ? fromUtf8 (textOfChannels (value)) : writtenValue (value);
}

Json readTypedSetting (const std::string& pointer, const juce::String& text, const Json& before)
{
    if (pointer == axes_part) return readAxesText (text.trim().toStdString());
    if (pointer == "/workspace/clutch") return text.trim().toStdString();   // a number, too, is written as a text
    return isListOfChannels (pointer) ? readChannelsText (text.toStdString(), before) : readValue (text);
}

void removeSetting (Json& binding, const std::string& pointer)
{
    const JsonPointer at (pointer);
    if (! binding.contains (at)) return;
    auto& around = binding.at (at.parent());
    around.erase (at.parts().back());
    if (around.empty() && ! at.parent().parts().empty()) binding.erase (at.parent().parts().back());
}

}   // namespace tactus::host
