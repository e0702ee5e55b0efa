// SPDX-License-Identifier: MIT
#include "hid.hpp"

#include "host/devices/hid_link/wire_bench.hpp"

#include <host/devices/hid/match.hpp>
#include <host/devices/sessions/workspace.hpp>
#include <support/temporary_folder.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace tactus;
using namespace tactus::host::hid;
using test::profiles;

namespace
{
/// The component that the name refers to ("position.x"); empty if it refers to none.
std::optional<double> componentOf (const std::string& name, std::string_view of, const Vec3& v)
{
    if (name.size() != of.size() + 2 || ! name.starts_with (of) || name[of.size()] != '.') return {};
    return v[name.back() - 'x'];
}

double told (const HidModel& model, std::uint64_t lost, const std::string& name)
{
    const auto& s = model.sample();
    if (const auto v = componentOf (name, "position", s.position)) return *v;
    if (const auto v = componentOf (name, "rotation", s.rotation)) return *v;
    const auto& axes = model.axisNames();
    if (const auto it = std::ranges::find (axes, name); name != "time" && it != axes.end())
        return name == "pressure" ? s.pressure : s.axes[static_cast<std::size_t> (it - axes.begin())];
    if (name == "time") return s.time;
    if (name == "lost") return static_cast<double> (lost);
    FAIL ("no value is called " << name);
    return 0.0;
}

HidEffort asked (const HidModel& model, const GoldenSample& sample)
{
    HidEffort effort;
    effort.efforts = model.restEfforts();
    for (const auto& [name, value] : sample.values)
    {
        if (name.starts_with ("force."))
            effort.force[name.back() - 'x'] = value;
        else if (name.starts_with ("torque."))
            effort.torque[name.back() - 'x'] = value;
        else
        {
            const auto& names = model.effortNames();
            effort.efforts[static_cast<std::size_t> (std::ranges::find (names, name) - names.begin())] = value;
        }
    }
    return effort;
}

/// The example profile in a page of docs.
std::string exampleOfTheManual (const char* page = "devices.md")
{
    std::ostringstream manual;
    manual << std::ifstream (std::filesystem::path (TACTUS_SOURCE_DIR) / "docs" / page).rdbuf();
    const auto text = manual.str();
    const std::string_view begin = "```json\n";
    const auto at = text.find (begin);
    REQUIRE (at != text.npos);
    return text.substr (at + begin.size(), text.find ("```", at + begin.size()) - at - begin.size());
}

/// The report without the 0 that hidapi requires before a report without an id.
std::string reportIn (std::span<const std::uint8_t> wire, const OutputReport& report) { return hexOf (report.id ? wire : wire.subspan (1)); }

int decodeSamples (const std::shared_ptr<const Profile>& profile)
{
    int decoded = 0;
    for (const auto& sample : profile->samples)
    {
        if (! sample.output.empty()) continue;
        INFO (profile->id << ": " << sample.about);
        HidModel model (profile);
        std::uint64_t lost = 0;
        for (const auto& report : sample.input)
        {
            REQUIRE (describe (model.decode (report).refusal) == "none");
            lost += model.sample().lost;
        }

        for (const auto& [name, value] : sample.values)
        {
            INFO (name);
            CHECK (told (model, lost, name) == Approx (value).epsilon (1e-12).margin (1e-15));
        }
        std::vector<std::string> pressed;
        for (std::size_t i = 0; i < model.buttonNames().size(); ++i)
            if ((model.sample().buttons >> i & 1u) != 0) pressed.push_back (model.buttonNames()[i]);
        auto expected = sample.pressed;
        std::ranges::sort (expected);
        std::ranges::sort (pressed);
        CHECK (pressed == expected);
        ++decoded;
    }
    return decoded;
}

int encodeSamples (const std::shared_ptr<const Profile>& profile)
{
    int encoded = 0;
    for (const auto& sample : profile->samples)
    {
        if (sample.output.empty()) continue;
        INFO (profile->id << ": " << sample.about);
        HidModel model (profile);
        for (const auto& report : sample.input)
            model.decode (report);
        const auto at = static_cast<std::size_t> (std::ranges::find (profile->outputs, sample.output, &OutputReport::name) - profile->outputs.begin());
        CHECK (reportIn (model.encode (at, asked (model, sample), sample.samples), profile->outputs[at]) == hexOf (sample.expected));
        ++encoded;
    }
    return encoded;
}
}   // namespace

TEST_CASE ("every profile decodes its reports to the manually computed values")
{
    int decoded = 0;
    for (const auto& profile : profiles())
        decoded += decodeSamples (profile);
    CHECK (decoded >= 12);
}

TEST_CASE ("every profile encodes efforts to the manually computed bytes")
{
    int encoded = 0;
    for (const auto& profile : profiles())
        encoded += encodeSamples (profile);
    CHECK (encoded >= 10);
}

TEST_CASE ("every profile has a sample of each report, names its sources, and gives a reason for each report that is not verified")
{
    for (const auto& profile : profiles())
    {
        INFO (profile->id);
        CHECK (std::filesystem::path (profile->file).stem() == profile->id);
        CHECK_FALSE (profile->sources.empty());
        for (const auto& report : profile->outputs)
            CHECK (std::ranges::any_of (profile->samples, [&] (const auto& s) { return s.output == report.name; }));

        for (const auto& report : profile->inputs)
        {
            const auto of_this = [&] (const Bytes& b) { return ! report.id || b.front() == *report.id; };
            const auto decodes = [&] (const GoldenSample& s) { return s.output.empty() && std::ranges::any_of (s.input, of_this); };
            // A second report with the same layout needs no sample.
            const auto same_layout = [&] (const InputReport& other) {
                if (&other == &report) return false;
                return other.fields.size() >= report.fields.size() && other.length == report.length;
            };
            INFO ("report " << int (report.id.value_or (0)));
            CHECK ((std::ranges::any_of (profile->samples, decodes) || std::ranges::any_of (profile->inputs, same_layout)));
            if (report.verified)
                CHECK (std::ranges::any_of (profile->samples, [&] (const auto& s) { return s.captured && decodes (s); }));
        }
    }
}

TEST_CASE ("every profile limits how strongly, how fast, how long and with how much energy its device drives the hand")
{
    const auto names = [] (const auto& all) { return std::ranges::any_of (all, [] (const auto& name) { return ! name.empty(); }); };
    constexpr double none = GuardLimits::none;
    int forces = 0, with_signals = 0;
    for (const auto& profile : profiles())
    {
        INFO (profile->id);
        const auto& guard = profile->limits.guard;
        if (names (profile->force))
        {
            ++forces;
            for (const double limit : { guard.max_force, guard.max_slew, guard.max_speed, guard.max_impulse, guard.max_energy })
                CHECK (limit != none);
        }
        if (names (profile->torque))
            for (const double limit : { guard.max_torque, guard.max_torque_slew, guard.max_angular_speed, guard.max_angular_impulse, guard.max_energy })
                CHECK (limit != none);
        const bool streams = std::ranges::any_of (profile->outputs, [] (const auto& report) { return report.stream.has_value(); });
        if (streams || ! profile->signals.empty())
        {
            ++with_signals;
            CHECK (guard.max_signal == 1.0);   // full scale
            CHECK (guard.max_signal_slew != none);
        }
    }
    CHECK (forces >= 2);
    CHECK (with_signals >= 4);
}

TEST_CASE ("every profile with efforts has a neutral report, and rest efforts encode to it")
{
    for (const auto& profile : profiles())
    {
        HidModel model (profile), other (profile);
        HidEffort rest;
        rest.efforts = model.restEfforts();
        for (std::size_t i = 0; i < model.outputs(); ++i)
        {
            INFO (profile->id << " " << profile->outputs[i].name);
            const auto& neutral = profile->outputs[i].neutral;
            const auto sent = model.neutral (i);
            CHECK (sent.size() == neutral.size() + (profile->outputs[i].id ? 0 : 1));

            // At rest, all effort fields have the values of the neutral report.
            const auto at_rest = other.encode (i, rest);
            for (const auto& field : profile->outputs[i].fields)
                if (field.source == OutputField::Source::effort)
                    for (auto bit = field.bits.at; bit < field.bits.end(); ++bit)
                    {
                        const auto byte = bit / 8 + (profile->outputs[i].id ? 0 : 1);
                        CHECK ((at_rest[byte] >> bit % 8 & 1) == (neutral[bit / 8] >> bit % 8 & 1));
                    }
        }
    }
}

TEST_CASE ("the most specific of the matching profiles comes first")
{
    const auto idsOf = [] (const DeviceInfo& device) {
        std::vector<std::string> ids;
        for (const auto& profile : matching (profiles(), device))
            ids.push_back (profile->id);
        return ids;
    };
    using Ids = std::vector<std::string>;
    CHECK (idsOf ({ .vid = 0x054c, .pid = 0x0ce6, .bus = Bus::usb, .product = {} }) == Ids { "dualsense_usb" });
    CHECK (idsOf ({ .vid = 0x054c, .pid = 0x0ce6, .bus = Bus::bluetooth, .product = {} }) == Ids { "dualsense_bluetooth", "dualsense_bluetooth_samples" });
    CHECK (idsOf ({ .vid = 0x256f, .pid = 0xc62e, .product = {} }) == Ids { "spacemouse_wireless" });
    CHECK (idsOf ({ .vid = 0x16c0, .pid = 0x0486, .usage_page = 0xffab, .usage = 0x0200, .product = {} }) == Ids { "tactus_board" });
    CHECK (idsOf ({ .vid = 0x16c0, .pid = 0x0486, .usage_page = 0xffc9, .usage = 0x0004, .product = {} }).empty());   // the board's emulated serial port
    CHECK (idsOf ({ .vid = 0x16c0, .pid = 0x0486, .product = {} }) == Ids { "tactus_board" });                        // if usages are unknown
    CHECK (idsOf ({ .vid = 0x046d, .pid = 0xffff, .product = {} }).empty());

    // With two profiles for one board, the one that names its product wins.
    Profile any, mine;
    any.id = "a_board";
    any.match = { { .vid = { 0x16c0 }, .pid = { 0x0486 }, .usage_page = {}, .usage = {}, .interface_number = {}, .bus = {}, .product = {} } };
    mine = any;
    mine.id = "my_board";
    mine.match[0].product = "paddle";
    const std::vector<std::shared_ptr<const Profile>> both { std::make_shared<Profile> (any), std::make_shared<Profile> (mine) };
    CHECK (matching (both, { .vid = 0x16c0, .pid = 0x0486, .product = "Haptic Paddle 2" }).front()->id == "my_board");
    CHECK (matching (both, { .vid = 0x16c0, .pid = 0x0486, .product = "Wheel" }).size() == 1);
}

TEST_CASE ("a new device needs only a JSON file")
{
    const TemporaryFolder folder;
    for (const auto& entry : std::filesystem::directory_iterator (test::profile_folder))
        std::filesystem::copy (entry.path(), folder / entry.path().filename().string());
    std::ofstream (folder / "paddle.json") << exampleOfTheManual();
    std::ofstream (folder / "broken.json") << R"({ "format": "tactus-profile", "id": "broken" )";
    std::ofstream (folder / "twice.json") << std::ifstream (folder / "paddle.json").rdbuf();

    const auto loaded = loadProfiles (folder.path());
    CHECK (loaded.profiles.size() == profiles().size() + 1);   // bad profiles do not affect the others
    REQUIRE (loaded.messages.size() == 2);
    CHECK (loaded.messages[0].file == (folder / "broken.json").string());
    CHECK (loaded.messages[0].line == 1);
    CHECK (loaded.messages[1].id == "profile/duplicate");

    const auto found = matching (loaded.profiles, { .vid = 0x2341, .pid = 0x8036, .product = "My Paddle" });
    REQUIRE (found.size() == 1);
    CHECK (decodeSamples (found.front()) == 1);
    CHECK (encodeSamples (found.front()) == 1);
    HidModel model (found.front());
    CHECK (model.limits().max_force == 1.0);
    CHECK (model.limits().watchdog == 0.01);

    const auto& s = model.decode (test::bytes ("fc 18 07 00"));   // -1000 counts: 15 mm away from the user
    CHECK (s.position.isApprox (Vec3 { 0.0, 0.015, 0.0 }));
    CHECK (s.buttons == 0);
    CHECK (model.buttonNames() == std::vector<std::string> { "trigger" });

    // 1 N towards the user on a handle of 75 mm: 75 mN m; 128 is zero.
    HidEffort effort;
    effort.efforts = model.restEfforts();
    effort.force = { 0.0, -1.0, 0.0 };
    CHECK (hexOf (model.encode (0, effort)) == "00 cb 00");
    CHECK (hexOf (model.neutral (0)) == "00 80 00");

    CHECK (loadProfiles (folder / "none").messages.front().id == "profile/unreadable");
}

TEST_CASE ("the smallest profile of the manual is one for a slider on a serial line, and each key that it calls required is")
{
    const auto text = exampleOfTheManual ("profiles.md");
    const auto loaded = readProfileText (text);
    INFO (test::text (loaded.messages));
    CHECK (loaded.messages.empty());
    REQUIRE (loaded.profile);
    REQUIRE (loaded.profile->wires.serial);
    HidModel model { loaded.profile };
    CHECK (model.decode (bytesOf ("40 42 0f 00").value()).refusal == Refusal::none);
    CHECK (model.reading().position.x() == Approx (1e-3));
    HidEffort effort { {}, {}, model.restEfforts() };
    effort.force.x() = 0.25;
    CHECK (hexOf (model.encode (0, effort)) == "00 90 d0 03 00");

    for (const auto* key : { "format", "id", "name", "sources", "wires", "inputs/0/length", "inputs/0/fields", "inputs/0/verified", "inputs/0/why_not",
                             "outputs/0/name", "outputs/0/neutral", "outputs/0/verified", "outputs/0/why_not", "limits/max_force" })
    {
        auto json = readJson (text).root;
        const std::string path = key;
        const auto slash = path.rfind ('/');
        auto& object = slash == path.npos ? json : json.at (JsonPointer ("/" + path.substr (0, slash)));
        object.erase (path.substr (slash == path.npos ? 0 : slash + 1));
        INFO (key);
        CHECK (hasErrors (readProfile (json).messages));
    }
}

TEST_CASE ("soft pad presses the paddle of the manual once the session turns its workspace")
{
    const auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/soft_pad.json").graph;
    const auto compiled = compile (graph, catalogue(), { .rate_hz = 1000.0 });
    REQUIRE (compiled.plan);
    const auto paddle = readProfileText (exampleOfTheManual()).profile;
    REQUIRE (paddle);
    std::vector<Bytes> reports;   // 7.5 mm towards the person
    for (int count = 0; count <= 500; ++count)
        reports.push_back ({ static_cast<std::uint8_t> (count >> 8), static_cast<std::uint8_t> (count), static_cast<std::uint8_t> (count), 0 });
    const bool is_turned = GENERATE (false, true);
    Messages messages;
    const auto workspace = is_turned ? host::readWorkspace ({ { "axes", { "x", "-z", "y" } } }, "", messages) : host::Workspace {};
    CHECK (messages.empty());
    auto made = std::make_unique<test::wires::OffTheWire> (paddle, reports);
    const auto& answers = made->answers;
    const auto limits = limitsOf (*paddle, {});
    host::WorkspaceDevice device { std::move (made), workspace, limits };
    Engine engine { compiled.plan };
    engine.attach ("finger", device, limits);
    for (std::size_t k = 0; k < reports.size(); ++k)
        engine.tick();
    const auto pushes = std::ranges::count_if (answers, [] (const Bytes& report) { return report.front() < 0x80; });   // a torque that moves it away
    CHECK (std::ranges::count_if (answers, [] (const Bytes& report) { return report.front() > 0x80; }) == 0);
    CHECK ((pushes > 100) == is_turned);
}
