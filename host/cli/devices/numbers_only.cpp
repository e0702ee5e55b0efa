// SPDX-License-Identifier: GPL-3.0-or-later
#include "numbers_only.hpp"

#include <host/devices/hid/physics.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::host
{

std::vector<std::shared_ptr<const hid::Profile>> knownByNumbers (const hid::LoadedProfiles& all)
{
    std::vector<std::shared_ptr<const hid::Profile>> known;
    std::ranges::copy_if (all.profiles, std::back_inserter (known), [] (const auto& p) { return hid::isNumbersOnly (*p); });
    return known;
}

Json numbersJsonOf (const hid::Profile& profile)
{
    Json physics = Json::object();
    const auto origin = [] (Json json, const auto& number) {
        if (! number.source.empty()) json["source"] = number.source;
        json["guess"] = number.guess;
        return json;
    };
    const auto numbers = hid::numbersOf (profile);
    for (const auto& row : deviceNumberRows())
        if (const auto& number = numbers.*row.member) physics[std::string (row.id)] = origin ({ { "value", number->value } }, *number);
    const auto corner = [] (const Vec3& v) { return Json { v.x(), v.y(), v.z() }; };
    if (const auto& box = numbers.workspace) physics["workspace"] = origin ({ { "min", corner (box->min) }, { "max", corner (box->max) } }, *box);
    return { { "profile", profile.id }, { "name", profile.name }, { "numbers_only", true }, { "physics", std::move (physics) } };
}

std::string numbersTextOf (const hid::Profile& profile)
{
    return printableName (profile.id) + "   " + printableName (profile.name) + "\n    numbers only, no open driver; simulate it: --device ROLE="
           + printableName (profile.id) + "\n";
}

}   // namespace tactus::host
