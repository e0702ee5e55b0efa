// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid_link/profile_library.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
LoadedProfiles having (const std::string& id, double max_force, const std::string& replaces = {})
{
    Profile profile;
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
