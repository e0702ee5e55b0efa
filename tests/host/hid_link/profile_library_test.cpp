// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid_link/profile_library.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <limits>
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

using Change = std::function<void (Profile&)>;

/// A changed copy of a shipped profile, as a user's own one, joined with all shipped ones.
LoadedProfiles withCopyOf (const std::string& id, const Change& change)
{
    auto shipped = loadProfiles (std::filesystem::path (TACTUS_SOURCE_DIR) / "host" / "profiles");
    const auto original = profileNamed (shipped, id);
    REQUIRE (original);
    auto copy = *original;
    copy.id = "mine";
    change (copy);
    return joined ({ { std::make_shared<const Profile> (std::move (copy)) }, {} }, std::move (shipped));
}

/// The texts of the errors; empty if the copy is used.
std::string refusal (const std::string& id, const Change& change)
{
    const auto all = withCopyOf (id, change);
    std::string texts;
    for (const auto& m : all.messages)
        if (m.severity == Message::Severity::error)
        {
            CHECK (m.id == "profile/competes");
            CHECK (m.remedy.find ("\"replaces\": \"") != std::string::npos);
            texts += m.text + '\n';
        }
    CHECK ((profileNamed (all, "mine") == nullptr) == ! texts.empty());
    CHECK (profileNamed (all, id));
    return texts;
}

OutputField& fieldOf (Profile& profile, const std::string& name)
{
    const auto at = std::ranges::find (profile.outputs[0].fields, name, &OutputField::name);
    REQUIRE (at != profile.outputs[0].fields.end());
    return *at;
}
InputField& inputOf (Profile& profile, const std::string& name)
{
    const auto at = std::ranges::find (profile.inputs[0].fields, name, &InputField::name);
    REQUIRE (at != profile.inputs[0].fields.end());
    return *at;
}
}   // namespace

TEST_CASE ("user's profiles: one with the id of a shipped profile is refused, unless it says that it replaces it", "[hid]")
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

TEST_CASE ("user's profiles: one that fits the device of a shipped profile says so, and keeps to the limits of both", "[hid]")
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

TEST_CASE ("user's profiles: one that replaces a shipped profile keeps to the limits of the others that fit its device", "[hid]")
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

TEST_CASE ("user's profiles: one that drives the device of a shipped profile differently is refused", "[hid]")
{
    struct Case
    {
        std::string differs;
        Change make;
    };
    const Case cases[] = {
        { "instead of force x",   // signals of 1e6 in place of 2 N
          [] (Profile& p) {
              p.force = p.torque = {};
              p.signals = { { "fx", {} }, { "fy", {} }, { "fz", {} } };
              p.limits.guard.max_signal = 1e6;
          } },
        { "instead of force x", [] (Profile& p) { p.force = {}; } },
        { "instead of force x", [] (Profile& p) { std::swap (p.force[0], p.force[1]); } },
        { "instead of torque z", [] (Profile& p) { p.torque[2].clear(); } },
        { "instead of the effort 'effort1'", [] (Profile& p) { fieldOf (p, "effort1").name = "effort9"; } },   // the guard would not count its energy
        { "a different scale", [] (Profile& p) { fieldOf (p, "fx").encoding.scale = 1e-9; } },
        { "a different scale", [] (Profile& p) { fieldOf (p, "fx").encoding.offset = 1.0; } },
        { "a different scale", [] (Profile& p) { fieldOf (p, "effort1").unit = "A"; } },
        { "a different scale",
          [] (Profile& p) {
              auto& e = fieldOf (p, "fx").encoding;
              e.law = Encoding::Law::table;
              e.x = { 0.0, 1.0 };
              e.y = { 0.0, 1000.0 };
          } },
        { "different bits", [] (Profile& p) { fieldOf (p, "fx").bits.big_endian = true; } },
        { "different bits", [] (Profile& p) { p.outputs[0].fields[0].bits.at = 8 * 11; } },   // the enable bit within a force
        { "constants", [] (Profile& p) { p.outputs[0].body[8] = 1; } },
        { "constants", [] (Profile& p) { p.outputs[0].id = 0x54; } },
        { "stream", [] (Profile& p) { p.outputs[0].stream = Stream { .at = 48, .frames = 4, .rate = 1000.0, .channels = { "l" } }; } },
        { "kinematics", [] (Profile& p) { p.kinematics = LinearMap { .matrix = 10.0 * Mat3::Identity() }; } },
        { "axes", [] (Profile& p) { p.axes.col (0) = -p.axes.col (0); } },
        // The limits depend on the readings, so a change of the readings is refused too.
        { "position y", [] (Profile& p) { inputOf (p, "y").scale *= 1e-3; } },
        { "position x", [] (Profile& p) { p.position[0] = "axis1"; } },
        { "position z", [] (Profile& p) { p.position[2].clear(); } },
        { "rotation x", [] (Profile& p) { inputOf (p, "rx").bits.at += 32; } },
        { "valid", [] (Profile& p) { p.valid.clear(); } },
        { "alarm", [] (Profile& p) { p.alarms.pop_back(); } },
        { "alarm", [] (Profile& p) { p.alarms.back().while_driven = 1e9; } },
        { "the sequence number or the timestamp", [] (Profile& p) { p.inputs[0].sequence.clear(); } },
        { "axis 'axis4'", [] (Profile& p) { p.inputs[0].fields.pop_back(); } },
        { "init", [] (Profile& p) { p.init.push_back ({ .kind = Step::Kind::output, .bytes = Bytes (64) }); } },
    };
    for (const auto& [differs, make] : cases)
    {
        const auto text = refusal ("tactus_board", make);
        INFO (differs << ": " << text);
        CHECK (text.find (differs) != std::string::npos);
        CHECK (text.find ("'tactus_board'") != std::string::npos);
    }

    const auto arm = [] (const Change& make) { return refusal ("woodenhaptics_usb", make); };
    CHECK_FALSE (arm ([] (Profile& p) { fieldOf (p, "motor_a").max = 6.0; }).empty());
    CHECK_FALSE (arm ([] (Profile& p) { fieldOf (p, "motor_a").min = -std::numeric_limits<double>::infinity(); }).empty());
    CHECK_FALSE (arm ([] (Profile& p) { std::get<SerialArm> (p.kinematics).drives[1].torque_constant = 0.001; }).empty());
}

TEST_CASE ("user's profiles: one that drives the same device exactly as the shipped profile does, or drives less of it, is used", "[hid]")
{
    const Change fine[] = {
        [] (Profile&) {},
        [] (Profile& p) { p.limits.guard.max_force = 50.0; },
        [] (Profile& p) { fieldOf (p, "fx").max = 1.0; },
        [] (Profile& p) { p.outputs[0].fields.pop_back(); },
        [] (Profile& p) {   // without the fourth axis
            p.inputs[0].fields.pop_back();
            p.outputs[0].fields.pop_back();
        },
        [] (Profile& p) { p.alarms.push_back ({ .field = "magic", .is = {} }); },
        [] (Profile& p) { inputOf (p, "x").name = p.position[0] = "across"; },
        [] (Profile& p) { fieldOf (p, "fx").name = p.force[0] = "push"; },
        [] (Profile& p) {   // readings only
            p.outputs.clear();
            p.force = p.torque = {};
            p.kinematics = LinearMap {};
        },
    };
    for (const auto& change : fine)
        CHECK (refusal ("tactus_board", change) == "");

    const auto stronger = withCopyOf ("tactus_board", fine[1]);
    CHECK (profileNamed (stronger, "mine")->limits.guard.max_force == 2.0);

    const Change scaled = [] (Profile& p) { fieldOf (p, "fx").encoding.scale = 1e-9; };
    const auto replacing = withCopyOf ("tactus_board", [&] (Profile& p) {
        scaled (p);
        p.replaces = "tactus_board";
    });
    CHECK (profileNamed (replacing, "mine"));
    CHECK_FALSE (profileNamed (replacing, "tactus_board"));
    CHECK_FALSE (refusal ("tactus_board", [&] (Profile& p) {   // a shipped profile of another device
                     scaled (p);
                     p.replaces = "woodenhaptics_usb";
                 })
                     .empty());
}

TEST_CASE ("user's profiles: where several shipped profiles fit a device, the same drive as one of them is enough", "[hid]")
{
    const Change scaled = [] (Profile& p) { p.outputs[0].fields[0].encoding.scale *= 0.1; };
    for (const auto* id : { "dualsense_usb", "dualsense_bluetooth", "dualsense_bluetooth_samples" })
    {
        INFO (id);
        CHECK (refusal (id, [] (Profile&) {}) == "");
        CHECK_FALSE (refusal (id, scaled).empty());
        const auto replacing = withCopyOf (id, [&] (Profile& p) {
            scaled (p);
            p.replaces = id;
        });
        CHECK (profileNamed (replacing, "mine"));
        CHECK_FALSE (profileNamed (replacing, id));
    }
}

TEST_CASE ("user's profiles: one that leaves out an init or exit report of the shipped profile is refused, unless it drives nothing", "[hid]")
{
    auto shipped = having ("arm", 5.0, {}, Ids { 2 });
    auto arm = *shipped.profiles[0];
    arm.outputs.emplace_back();
    using Kind = Step::Kind;
    arm.init = { { .kind = Kind::feature, .bytes = { 1, 2 } }, { .kind = Kind::get_feature, .bytes = { 3 } }, { .kind = Kind::feature, .bytes = { 4, 5 } } };
    arm.exit = { { .kind = Step::Kind::output, .bytes = { 6 } } };
    shipped.profiles = { std::make_shared<const Profile> (arm) };
    const auto isUsed = [&] (const Change& change) {
        auto own = arm;
        own.id = "mine";
        change (own);
        return profileNamed (joined ({ { std::make_shared<const Profile> (std::move (own)) }, {} }, shipped), "mine") != nullptr;
    };
    CHECK (isUsed ([] (Profile&) {}));
    CHECK (isUsed ([] (Profile& p) { p.init.erase (p.init.begin() + 1); }));   // this step only reads
    CHECK_FALSE (isUsed ([] (Profile& p) { p.init.pop_back(); }));
    CHECK_FALSE (isUsed ([] (Profile& p) { std::swap (p.init.front(), p.init.back()); }));
    CHECK_FALSE (isUsed ([] (Profile& p) { p.exit.clear(); }));
    CHECK_FALSE (isUsed ([] (Profile& p) { p.init.front().given = Bits { .at = 8 }; }));
    CHECK (isUsed ([] (Profile& p) {
        p.outputs.clear();
        p.init.clear();
        p.exit.clear();
    }));
}
