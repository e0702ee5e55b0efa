// SPDX-License-Identifier: MIT
#include "physics.hpp"

#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <cmath>

namespace tactus::host::hid
{
namespace
{
/// Reads "source" and "guess" of a number or of the workspace. At least one of the two must be given.
template <typename Number>
void readOrigin (ProfileFields& in, Number& number)
{
    number.source = in.text ("source");
    number.guess = in.flag ("guess");
    if (! in.has ("source") && ! number.guess)
        in.require ("source", "write where the number comes from, or \"guess\": true");
}

double readValue (ProfileFields& in, std::string_view key, const DeviceNumberRow& row)
{
    if (row.is_whole) return in.whole (key, static_cast<int> (row.bounds.min), static_cast<int> (row.bounds.max), 0);
    return in.number (key, row.unit, row.bounds, row.bounds.without_min ? 1.0 : row.bounds.min);
}

DeviceNumber readNumber (ProfileFields& physics, const DeviceNumberRow& row)
{
    if (! physics.object (row.id).is_object()) return { .value = readValue (physics, row.id, row), .source = "the sources of the profile" };
    DeviceNumber number;
    physics.within (row.id, [&] (ProfileFields& in) {
        in.require ("value", "write \"value\": the number, with its unit");
        number.value = readValue (in, "value", row);
        readOrigin (in, number);
    });
    return number;
}

DeviceReach readReach (ProfileFields& in)
{
    DeviceReach reach;
    for (const auto* key : { "min", "max" })
        in.require (key, "write [x, y, z]: a corner of the box that the tool can reach");
    reach.min = in.vector ("min", unit::metre, reach.min);
    reach.max = in.vector ("max", unit::metre, reach.max);
    if (! (reach.min.array() <= reach.max.array()).all())
        in.error ("max", "profile/out_of_range", "max is less than min on at least one axis",
                  "on each axis, write the smaller coordinate in min and the larger one in max");
    readOrigin (in, reach);
    return reach;
}
}   // namespace

DeviceNumbers readPhysics (ProfileFields& profile)
{
    DeviceNumbers numbers;
    profile.within ("physics", [&] (ProfileFields& in) {
        in.ignore ("about");
        for (const auto& row : deviceNumberRows())
            if (in.has (row.id)) numbers.*row.member = readNumber (in, row);
        in.within ("workspace", [&] (ProfileFields& box) { numbers.workspace = readReach (box); });
        if (numbers.end_mass && numbers.mass && ! (numbers.end_mass->value < numbers.mass->value))
            in.error ("end_mass", "profile/out_of_range", "end_mass is not less than mass",
                      "end_mass is the part of the mass at the tool: write less than " + numberText (numbers.mass->value) + " kg");
        if (isEmpty (numbers) && in.json().is_object())
            in.error ("mass", "profile/missing", "\"physics\" holds no number", "add a number, such as \"mass\": \"75 g\", or remove \"physics\"");
    });
    return numbers;
}

DeviceNumbers numbersOf (const Profile& profile)
{
    auto numbers = profile.physics;
    const auto fill = [] (DeviceNumbers::Number& number, double value, const char* source) {
        if (! number && value > 0.0 && std::isfinite (value)) number = DeviceNumber { .value = value, .source = source };
    };
    const auto& limits = profile.limits;
    fill (numbers.damping, limits.device_damping, "device_damping in the limits of the profile");
    fill (numbers.first_mode, limits.first_mode, "first_mode in the limits of the profile");
    fill (numbers.quantum, limits.position_quantum, "position_quantum in the limits of the profile");
    fill (numbers.force_quantum, limits.force_quantum, "force_quantum in the limits of the profile");
    fill (numbers.peak_force, limits.guard.max_force, "max_force in the limits of the profile");
    fill (numbers.rate, profile.rate, "the rate of the profile");
    return numbers;
}

}   // namespace tactus::host::hid
