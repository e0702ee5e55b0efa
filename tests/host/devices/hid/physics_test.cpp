// SPDX-License-Identifier: MIT
#include "hid.hpp"

#include <host/devices/hid/physics.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
/// The profile of a device that cannot be opened. It gives every number.
const Json& known()
{
    static const Json json = Json::parse (R"({
      "format": "tactus-profile", "version": 1, "id": "arm", "name": "Arm", "sources": ["a test"],
      "physics": {
        "about": "a test", "mass": "75 g", "damping": { "value": "0.1 N*s/m", "guess": true }, "coulomb": { "value": "40 mN", "source": "a paper" },
        "quantum": "30 um", "force_quantum": "5 mN", "delay": 1, "first_mode": { "value": "30 Hz", "source": "a chapter" },
        "first_mode_damping": 0.05, "end_mass": "30 g", "peak_force": "8.5 N", "rate": "1 kHz",
        "workspace": { "min": ["-1 cm", 0, 0], "max": ["1 cm", "2 cm", 0], "source": "a datasheet" } } })");
    return json;
}

/// The same profile with one entry replaced, or removed if the value is null.
Json with (const std::string& pointer, const Json& value)
{
    Json json = known();
    const JsonPointer at (pointer);
    if (value.is_null())
        json[at.parent()].erase (at.parts().back());
    else
        json[at] = value;
    return json;
}
}   // namespace

TEST_CASE ("physics of a profile: a profile may hold only numbers, each with its source or marked as a guess", "[hid]")
{
    const auto loaded = readProfile (known());
    for (const auto& m : loaded.messages)
        FAIL_CHECK (m.where + ": " + m.text);
    REQUIRE (loaded.profile);
    CHECK (isNumbersOnly (*loaded.profile));

    const auto& n = loaded.profile->physics;
    CHECK (n.mass == DeviceNumber { 0.075, "the sources of the profile" });
    CHECK (n.damping == DeviceNumber { 0.1, "", true });
    CHECK (n.coulomb == DeviceNumber { 0.04, "a paper" });
    CHECK (n.quantum->value == 30e-6);
    CHECK (n.force_quantum->value == 5e-3);
    CHECK (n.delay->value == 1.0);
    CHECK (n.first_mode == DeviceNumber { 30.0, "a chapter" });
    CHECK (n.first_mode_damping->value == 0.05);
    CHECK (n.end_mass->value == 0.03);
    CHECK (n.peak_force->value == 8.5);
    CHECK (n.rate->value == 1000.0);
    REQUIRE (n.workspace);
    CHECK (n.workspace->min == Vec3 (-0.01, 0.0, 0.0));
    CHECK (n.workspace->max == Vec3 (0.01, 0.02, 0.0));
    CHECK (n.workspace->source == "a datasheet");
    CHECK (numbersOf (*loaded.profile) == n);
}

TEST_CASE ("physics of a profile: every mistake is reported with its place", "[hid]")
{
    struct Mistake
    {
        std::string pointer;
        Json value;
        std::string id;
    };
    const Json null;
    const Mistake mistakes[] = {
        { "/physics", Json::object(), "profile/missing" },
        { "/physics", null, "profile/missing" },
        { "/physics", 3, "profile/kind" },
        { "/physics/weight", "75 g", "profile/unknown_key" },
        { "/physics/mass", "75 m", "profile/unit" },
        { "/physics/mass", 0, "profile/out_of_range" },
        { "/physics/mass", Json ({ 1, 2 }), "profile/kind" },
        { "/physics/damping/guess", null, "profile/missing" },
        { "/physics/damping/guess", false, "profile/missing" },
        { "/physics/damping/value", null, "profile/missing" },
        { "/physics/damping/colour", "red", "profile/unknown_key" },
        { "/physics/damping/value", "-1 N*s/m", "profile/out_of_range" },
        { "/physics/coulomb/source", "", "profile/kind" },
        { "/physics/delay", 1.5, "profile/kind" },
        { "/physics/delay", -1, "profile/out_of_range" },
        { "/physics/first_mode_damping", 2, "profile/out_of_range" },
        { "/physics/end_mass", "80 g", "profile/out_of_range" },
        { "/physics/workspace/min", null, "profile/missing" },
        { "/physics/workspace/min", Json ({ 1, 0, 0 }), "profile/out_of_range" },
        { "/physics/workspace/source", null, "profile/missing" },
        { "/match", Json::parse (R"([{ "vid": "0x1209" }])"), "profile/missing" },   // a profile with `match` needs reports
    };
    for (const auto& mistake : mistakes)
    {
        INFO (mistake.pointer << " = " << mistake.value.dump());
        const auto loaded = readProfile (with (mistake.pointer, mistake.value));
        CHECK_FALSE (loaded.profile);
        for (const auto& m : loaded.messages)
            UNSCOPED_INFO (m.id << " " << m.where << ": " << m.text);
        CHECK (std::ranges::any_of (loaded.messages, [&] (const Message& m) { return m.id == mistake.id && ! m.remedy.empty(); }));
    }
}

TEST_CASE ("physics of a profile: limits and rate fill in what is missing", "[hid]")
{
    auto profile = *readProfile (with ("/physics/quantum", {})).profile;
    profile.physics.peak_force.reset();
    profile.physics.rate.reset();
    profile.limits.position_quantum = 54e-6;
    profile.limits.first_mode = 99.0;   // ignored, because physics has this number
    profile.limits.guard.max_force = 5.0;
    profile.rate = 500.0;

    const auto n = numbersOf (profile);
    CHECK (n.quantum->value == 54e-6);
    CHECK (n.quantum->source.find ("position_quantum") != std::string::npos);
    CHECK (n.first_mode->value == 30.0);
    CHECK (n.peak_force->value == 5.0);
    CHECK (n.rate->value == 500.0);
}

TEST_CASE ("physics of a profile: in the profiles that come with Tactus, each number has its source or is marked as a guess", "[hid]")
{
    for (const auto& profile : test::profiles())
    {
        INFO (profile->id);
        for (const auto& row : deviceNumberRows())
            if (const auto& number = profile->physics.*row.member)
            {
                INFO (row.id);
                CHECK (number->source.find ("the sources of the profile") == std::string::npos);
            }
    }
}
