// SPDX-License-Identifier: MIT
#include <host/devices/hid/profile_difference.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <support/temporary_folder.hpp>
#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
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
    auto shipped = loadProfiles (std::filesystem::path (TACTUS_SOURCE_DIR) / "host" / "devices" / "profiles");
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
/// A few values that differ from this one; an empty one means that the value is left out.
std::vector<std::optional<Json>> others (const Json& value)
{
    if (value.is_structured()) return { std::nullopt };
    if (value.is_number()) return { std::nullopt, Json (value.get<double>() + 1.0), Json (0.5 * value.get<double>()) };
    if (value.is_boolean()) return { std::nullopt, Json (! value.get<bool>()) };
    if (! value.is_string()) return { std::nullopt };
    const auto text = value.get<std::string>();
    return { std::nullopt, Json (text + "0"), Json ("1" + text), Json (text + "x"), Json ("") };
}

bool eraseIn (Json& all, const std::string& path)
{
    const JsonPointer at (path);
    if (at.parts().empty()) return false;
    auto& around = all.at (at.parent());
    if (around.is_object()) return around.erase (at.parts().back()) > 0;
    around.erase (std::stoul (at.parts().back()));
    return true;
}

/// A variable of the environment, for as long as this exists.
class Environment
{
public:
    Environment (const char* name, const char* value) : variable (name)
    {
        if (const char* now = std::getenv (name); now != nullptr) before = now;
        setenv (name, value, 1);
    }
    ~Environment()
    {
        if (before)
            setenv (variable, before->c_str(), 1);
        else
            unsetenv (variable);
    }
    Environment (const Environment&) = delete;
    Environment& operator= (const Environment&) = delete;

private:
    const char* variable;
    std::optional<std::string> before;
};

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

TEST_CASE ("user's profiles: one that differs from the shipped profile in anything but names and limits is refused", "[hid]")
{
    struct Case
    {
        std::string differs;
        Change make;
    };
    const Case cases[] = {
        { "\"force\", \"torque\", \"signals\"",   // signals of 1e6 in place of 2 N
          [] (Profile& p) {
              p.force = p.torque = {};
              p.signals = { { "fx", {} }, { "fy", {} }, { "fz", {} } };
              p.limits.guard.max_signal = 1e6;
          } },
        { "\"force\"", [] (Profile& p) { p.force = {}; } },
        { "\"force\"", [] (Profile& p) { std::swap (p.force[0], p.force[1]); } },
        { "\"torque\"", [] (Profile& p) { p.torque[2].clear(); } },
        { "\"outputs\"", [] (Profile& p) { fieldOf (p, "effort1").name = "effort9"; } },   // the guard would not count its energy
        { "\"outputs\"", [] (Profile& p) { fieldOf (p, "fx").encoding.scale = 1e-9; } },
        { "\"outputs\"", [] (Profile& p) { fieldOf (p, "fx").encoding.offset = 1.0; } },
        { "\"outputs\"", [] (Profile& p) { fieldOf (p, "effort1").unit = "A"; } },
        { "\"outputs\"",
          [] (Profile& p) {
              auto& e = fieldOf (p, "fx").encoding;
              e.law = Encoding::Law::table;
              e.x = { 0.0, 1.0 };
              e.y = { 0.0, 1000.0 };
          } },
        { "\"outputs\"", [] (Profile& p) { fieldOf (p, "fx").bits.big_endian = true; } },
        { "\"outputs\"", [] (Profile& p) { p.outputs[0].fields[0].bits.at = 8 * 11; } },   // the enable bit within a force
        { "\"outputs\"", [] (Profile& p) { p.outputs[0].body[8] = 1; } },
        { "\"outputs\"", [] (Profile& p) { p.outputs[0].id = 0x54; } },
        { "\"outputs\"", [] (Profile& p) { p.outputs[0].stream = Stream { .at = 48, .frames = 4, .rate = 1000.0, .channels = { "l" } }; } },
        { "\"outputs\"", [] (Profile& p) { p.outputs[0].max_rate = 0.2; } },   // the last force would stay for 5 s
        { "\"outputs\"", [] (Profile& p) { p.outputs[0].keepalive = 5.0; } },
        // A force that is clamped, or has no motor, does not brake, but the guard would count that it did.
        { "\"outputs\"", [] (Profile& p) { fieldOf (p, "fx").max = 1.0; } },
        { "\"outputs\"", [] (Profile& p) { p.outputs[0].fields.pop_back(); } },
        { "\"exit\"",   // it has no outputs, but still sends something
          [] (Profile& p) {
              p.outputs.clear();
              p.force = p.torque = {};
              p.kinematics = LinearMap {};
              p.exit = { { .kind = Step::Kind::output, .bytes = Bytes (64) } };
          } },
        { "\"kinematics\"", [] (Profile& p) { p.kinematics = LinearMap { .matrix = 10.0 * Mat3::Identity() }; } },
        { "\"axes\"", [] (Profile& p) { p.axes.col (0) = -p.axes.col (0); } },
        // The limits depend on the readings, so a change of the readings is refused too.
        { "\"inputs\"", [] (Profile& p) { inputOf (p, "y").scale *= 1e-3; } },
        { "\"position\"", [] (Profile& p) { p.position[0] = "axis1"; } },
        { "\"position\"", [] (Profile& p) { p.position[2].clear(); } },
        { "\"inputs\"", [] (Profile& p) { inputOf (p, "rx").bits.at += 32; } },
        { "\"inputs\"", [] (Profile& p) { inputOf (p, "magic").expect.reset(); } },
        { "\"inputs\"", [] (Profile& p) { p.inputs[0].length = 8; } },
        { "\"inputs\"",   // the dead-man's switch would be another button
          [] (Profile& p) {
              const auto buttons = std::ranges::find_if (p.inputs[0].fields, [] (const InputField& f) { return ! f.buttons.empty(); });
              REQUIRE (buttons != p.inputs[0].fields.end());
              std::swap (buttons->buttons[0], buttons->buttons[1]);
          } },
        { "\"pressure\"", [] (Profile& p) { p.pressure = "axis1"; } },
        { "\"valid\"", [] (Profile& p) { p.valid.clear(); } },
        { "\"alarms\"", [] (Profile& p) { p.alarms.pop_back(); } },
        { "\"alarms\"", [] (Profile& p) { p.alarms.back().while_driven = 1e9; } },
        { "\"alarms\"", [] (Profile& p) { p.alarms.back().means = ReadingFault::failed; } },
        { "\"inputs\"", [] (Profile& p) { p.inputs[0].sequence.clear(); } },
        { "\"inputs\"", [] (Profile& p) { p.inputs[0].fields.pop_back(); } },
        { "\"init\"", [] (Profile& p) { p.init.push_back ({ .kind = Step::Kind::output, .bytes = Bytes (64) }); } },
        { "\"rate\"", [] (Profile& p) { p.rate = 10.0; } },                           // at 10 Hz, 20 m/s would pass
        { "\"quirks\"", [] (Profile& p) { p.quirks.push_back ("only_changes"); } },   // silence would be no fault
        { "\"physics\"", [] (Profile& p) { p.physics.mass = DeviceNumber { .value = 10.0 }; } },
        { "\"limits\"", [] (Profile& p) { p.limits.device_damping = 100.0; } },
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

TEST_CASE ("user's profiles: every key of a profile that comes with Tactus counts, except a few", "[hid]")
{
    const std::vector<std::string> may_differ { "/$schema", "/id", "/name", "/about", "/match", "/wires", "/replaces", "/sources", "/samples", "/limits" };
    const auto folder = std::filesystem::path (TACTUS_SOURCE_DIR) / "host" / "devices" / "profiles";
    int changed = 0;
    for (const auto* id : { "tactus_board", "woodenhaptics_usb", "dualsense_bluetooth_samples", "switch_controllers", "steam_triton" })
    {
        const auto json = Json::parse (*readTextFile (folder / (std::string (id) + ".json")));
        const auto original = readProfile (json).profile;
        REQUIRE (original);
        const std::function<void (const Json&, const std::string&)> change = [&] (const Json& value, const std::string& path) {
            if (std::ranges::count (may_differ, path) > 0 || path.ends_with ("/verified") || path.ends_with ("/why_not")) return;
            if (value.is_object())
                for (const auto& [key, inner] : value.items())
                    change (inner, path + "/" + key);
            if (value.is_array())
                for (std::size_t i = 0; i < value.size(); ++i)
                    change (value[i], path + "/" + std::to_string (i));
            for (const auto& other : others (value))
            {
                auto copy = json;
                if (other)
                    copy[JsonPointer (path)] = *other;
                else if (! eraseIn (copy, path))
                    continue;
                const auto read = readProfile (copy).profile;
                if (! read || *read == *original) continue;   // it is broken, or only a text
                ++changed;
                INFO (id << path << (other ? " as " + other->dump() : " left out"));
                CHECK_FALSE (differenceOf (*read, *original).empty());
            }
        };
        change (json, "");
    }
    CHECK (changed > 500);
}

TEST_CASE ("user's profiles: one that is the same as the shipped profile but for names and limits, or sends nothing, is used", "[hid]")
{
    const Change fine[] = {
        [] (Profile&) {},
        [] (Profile& p) { p.limits.guard.max_force = 50.0; },
        [] (Profile& p) {
            p.name = p.about = "mine";
            p.sources = { "measured" };
            p.samples.clear();
            p.outputs[0].verified = true;
            p.inputs[0].why_not.clear();
        },
        [] (Profile& p) {   // tighter limits
            p.limits.guard.max_speed = 0.1;
            p.limits.max_motor = 0.1;
            p.limits.still_travel = 0.001;
        },
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
    const auto weaker = profileNamed (withCopyOf ("tactus_board", fine[3]), "mine")->limits;
    CHECK (weaker.guard.max_speed == 0.1);
    CHECK (weaker.max_motor == 0.1);
    CHECK (weaker.still_travel == 0.001);

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

TEST_CASE ("user's profiles: where several shipped profiles fit a device, one that is the same as one of them is used", "[hid]")
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

TEST_CASE ("user's profiles: one that leaves out an init or exit step of the shipped profile is refused, unless it sends nothing", "[hid]")
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
    CHECK_FALSE (isUsed ([] (Profile& p) { p.init.erase (p.init.begin() + 1); }));   // some devices change their mode when they are read
    CHECK_FALSE (isUsed ([] (Profile& p) { p.init[0].delay = 10.0; }));
    CHECK_FALSE (isUsed ([] (Profile& p) { p.outputs.clear(); }));
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

TEST_CASE ("user's profiles: a relative path in the environment names no folder, because it would be next to a graph", "[hid]")
{
    const Environment none ("TACTUS_PROFILES", ""), config ("XDG_CONFIG_HOME", "here"), home ("HOME", "/home/somebody");
    CHECK (ownProfileFolder() == "/home/somebody/.config/tactus/profiles");
    const Environment nowhere ("HOME", "there");
    CHECK (ownProfileFolder().empty());
    const Environment absolute ("XDG_CONFIG_HOME", "/config");
    CHECK (ownProfileFolder() == "/config/tactus/profiles");
}

TEST_CASE ("profiles that another user can change are not used", "[hid]")
{
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    fs::copy_file (fs::path (TACTUS_SOURCE_DIR) / "host/devices/profiles/tactus_board.json", folder / "board.json");
    CHECK (loadOwnProfiles (folder.path()).profiles.size() == 1);
    fs::permissions (folder / "board.json", fs::perms::all);
    CHECK (loadOwnProfiles (folder.path()).profiles.empty());
    fs::permissions (folder / "board.json", fs::perms::owner_all);
    CHECK (loadOwnProfiles (folder.path()).profiles.size() == 1);
    fs::permissions (folder.path(), fs::perms::all);
    const auto loaded = loadOwnProfiles (folder.path());
    CHECK (loaded.profiles.empty());
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "profile/foreign");
}
