// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid_link/profile_library.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <optional>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
using Ids = std::vector<std::uint16_t>;

LoadedProfiles having (const std::string& id, double max_force, const std::string& replaces = {}, const std::optional<Ids>& products = {})
{
    Profile profile;
    if (products)
    {
        profile.match.emplace_back();
        profile.match[0].vid = { 1 };
        profile.match[0].pid = *products;
    }
    profile.id = id;
    profile.replaces = replaces;
    profile.file = "own/" + id + ".json";
    profile.limits.guard.max_force = max_force;
    return { { std::make_shared<const Profile> (std::move (profile)) }, {} };
}
}   // namespace

TEST_CASE ("own profiles: one with the id of a shipped profile is refused, unless it says that it replaces it", "[hid]")
{
    const auto both = joined (having ("paddle", 50.0), having ("arm", 5.0));
    CHECK (both.profiles.size() == 2);
    CHECK (both.messages.empty());

    for (const auto* other : { "", "something_else" })
    {
        const auto refused = joined (having ("arm", 50.0, other), having ("arm", 5.0));
        REQUIRE (refused.profiles.size() == 1);
        CHECK (refused.profiles[0]->limits.guard.max_force == 5.0);
        REQUIRE (refused.messages.size() == 1);
        CHECK (refused.messages[0].id == "profile/shadows");
        CHECK (refused.messages[0].file == "own/arm.json");
    }

    const auto replaced = joined (having ("arm", 50.0, "arm"), having ("arm", 5.0));
    REQUIRE (replaced.profiles.size() == 1);
    CHECK (replaced.profiles[0]->limits.guard.max_force == 50.0);
    REQUIRE (replaced.messages.size() == 1);
    CHECK (replaced.messages[0].id == "profile/replaces");
    CHECK (replaced.messages[0].severity == Message::Severity::warning);
}

TEST_CASE ("own profiles: one that fits the device of a shipped profile says so, and keeps to the limits of both", "[hid]")
{
    auto arm = *having ("arm", 5.0, {}, Ids { 2, 3 }).profiles[0];
    arm.limits.guard.max_speed = 2.0;
    const LoadedProfiles shipped { { std::make_shared<const Profile> (arm) }, {} };

    for (const auto& products : { Ids { 3 }, Ids { 4, 2 }, Ids {} })   // without a product id, a rule fits all devices of the vendor
        for (const double max_force : { 50.0, 1.0 })
        {
            const auto both = joined (having ("mine", max_force, "another", products), shipped);
            REQUIRE (both.profiles.size() == 2);
            const auto mine = profileNamed (both, "mine");
            REQUIRE (mine);
            CHECK (mine->limits.guard.max_force == std::min (max_force, 5.0));
            CHECK (mine->limits.guard.max_speed == 2.0);
            CHECK (profileNamed (both, "arm")->limits.guard.max_force == 5.0);
            REQUIRE (both.messages.size() == 1);
            CHECK (both.messages[0].id == "profile/competes");
            CHECK (both.messages[0].severity == Message::Severity::warning);
            CHECK (both.messages[0].file == "own/mine.json");
            CHECK (both.messages[0].text.find ("'arm'") != std::string::npos);
        }

    const auto other = joined (having ("mine", 50.0, {}, Ids { 4 }), shipped);
    CHECK (profileNamed (other, "mine")->limits.guard.max_force == 50.0);
    CHECK (other.messages.empty());

    const auto replaced = joined (having ("mine", 50.0, "arm", Ids { 3 }), shipped);
    REQUIRE (replaced.profiles.size() == 1);
    CHECK (replaced.profiles[0]->limits.guard.max_force == 50.0);
    CHECK (replaced.profiles[0]->limits.guard.max_speed == GuardLimits::none);
    REQUIRE (replaced.messages.size() == 1);
    CHECK (replaced.messages[0].id == "profile/replaces");
}

TEST_CASE ("own profiles: one that replaces a shipped profile keeps to the limits of the others that fit its device", "[hid]")
{
    auto shipped = having ("arm", 5.0, {}, Ids { 2 });
    shipped.profiles.push_back (having ("leg", 7.0, {}, Ids { 3 }).profiles[0]);
    auto own = having ("mine", 50.0, "arm", Ids { 2, 3 });
    own.profiles.push_back (having ("arm", 60.0, {}, Ids { 2 }).profiles[0]);   // arm is replaced, but its id is still that of a shipped one

    const auto all = joined (std::move (own), std::move (shipped));
    REQUIRE (all.profiles.size() == 2);
    CHECK (profileNamed (all, "mine")->limits.guard.max_force == 7.0);
    CHECK (profileNamed (all, "leg"));
    REQUIRE (all.messages.size() == 3);
    CHECK (all.messages[0].id == "profile/replaces");
    CHECK (all.messages[1].id == "profile/competes");
    CHECK (all.messages[2].id == "profile/shadows");
}
