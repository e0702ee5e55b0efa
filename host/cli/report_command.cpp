// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"

#include <host/base/platform/system_facts.hpp>
#include <host/devices/audio/card.hpp>
#include <host/devices/failsafe/last_failsafe.hpp>
#include <host/devices/hid/match.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/realtime.hpp>
#include <tactus/tactus.h>
#include <tactus/text/caught.hpp>
#include <tactus/text/quote.hpp>

#include <Eigen/Core>
#include <hidapi.h>
#include <juce_core/juce_core.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <thread>

namespace tactus::host
{

namespace
{
void print (const std::string& name, const std::string& text) { std::cout << name << ": " << text << '\n'; }

void printVersions()
{
    print ("Tactus", std::string (tactus_version()) + " (C API " + std::to_string (TACTUS_API_VERSION) + ")");
    print ("compiler", __VERSION__);
    constexpr auto juce_version = JUCE_STRINGIFY (JUCE_MAJOR_VERSION) "." JUCE_STRINGIFY (JUCE_MINOR_VERSION) "." JUCE_STRINGIFY (JUCE_BUILDNUMBER);
    constexpr auto eigen_version =
        JUCE_STRINGIFY (EIGEN_WORLD_VERSION) "." JUCE_STRINGIFY (EIGEN_MAJOR_VERSION) "." JUCE_STRINGIFY (EIGEN_MINOR_VERSION);
    print ("libraries", std::string ("JUCE ") + juce_version + ", Eigen " + eigen_version + ", hidapi " + hid_version_str());
    std::size_t types = 0, of_plugins = 0;
    for (const auto& type : catalogue())
    {
        ++types;
        of_plugins += type.origin.empty() ? 0 : 1;
    }
    print ("node types", std::to_string (types) + ", " + std::to_string (of_plugins) + " of them from plugins");
}

/// Requests what a live run requests, and says what it got.
void printRights()
{
    std::vector<std::string> refused;
    if (auto why = lockMemory()) refused.push_back (std::move (*why));
    std::jthread ([&] {
        static_cast<void> (caught ("the thread that asks for real time", [&] {
            std::ranges::move (becomeRealTime (std::nullopt), std::back_inserter (refused));
        }));
    }).join();
    if (refused.empty()) print ("real time", "the tick thread has real-time priority, and its memory is locked");
    for (const auto& why : refused)
        print ("real time", why);
}

/// Devices by what they are, without paths, serial numbers and names, which a user may have chosen.
void printDevices()
{
    const auto profiles = hid::loadProfileLibrary();
    const auto devices = eachOnce (hid::thisComputer().connected(), profiles);
    for (const auto& d : devices)
    {
        char numbers[16];
        std::snprintf (numbers, sizeof numbers, "%04x:%04x", d.vid, d.pid);
        const auto fitting = matching (profiles.profiles, d);
        print ("HID device", std::string (numbers) + ", " + (fitting.empty() ? "no profile" : "profile " + printableName (fitting.front()->id))
                                 + (hid::thisComputer().mayOpen (d) ? "" : ", may not be opened by this user"));
    }
    if (devices.empty()) print ("HID devices", "none");
    for (const auto& card : audio::soundCards().list())
        print ("sound card", printableName (card.type) + ", " + std::to_string (card.outputs.size()) + " outputs, " + std::to_string (card.inputs.size())
                                 + " inputs");
}

void run()
{
    printVersions();
    for (const auto& [name, text] : systemFacts())
        print (name, text);
    printRights();
    printDevices();
    const auto last = lastFailsafe();
    print ("last failsafe", last.empty() ? "none" : last);
}
}   // namespace

void addReport (const Command& app)
{
    const auto command = app.add ("report", "Print the details for a problem report: versions, devices, limits and permissions of this computer");
    command.footer ("The report contains no names of users, computers, files or devices, and no serial numbers.\n\n"
                    "Examples:\n"
                    "  tactus report\n"
                    "  tactus report > report.txt");
    command.callback ([] { run(); });
}

}   // namespace tactus::host
