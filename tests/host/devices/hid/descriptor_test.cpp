// SPDX-License-Identifier: MIT
#include "hid.hpp"
#include "pid_wheel.hpp"

#include <support/property.hpp>

#include <fuzz/descriptor_target.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

using namespace tactus;
using namespace tactus::host::hid;
using Kind = DescribedField::Kind;

namespace
{
const std::filesystem::path data = TACTUS_SHARED_DATA;

Bytes fileOf (const std::filesystem::path& path)
{
    std::ifstream file (path, std::ios::binary);
    return { std::istreambuf_iterator<char> (file), {} };
}

ReportDescriptor good (const Bytes& bytes)
{
    const auto read = readDescriptor (bytes);
    for (const auto& m : read.messages)
        FAIL_CHECK (m.where + ": " + m.text);
    return read.descriptor;
}

const DescribedField* fieldOf (const ReportDescriptor& d, Kind kind, Usage usage)
{
    const auto it = std::ranges::find_if (d.fields, [&] (const auto& f) { return f.kind == kind && f.placeOf (usage); });
    return it == d.fields.end() ? nullptr : &*it;
}

/// The numbers of a "cap" in Windows' preparsed data, in the format of hidapi's tests: "pp_data->cap[3]->BitSize = 8".
using Cap = std::map<std::string, long>;

std::vector<Cap> capsOf (const std::string& text, std::array<long, 3>& lengths, std::array<std::size_t, 3>& firsts)
{
    std::vector<Cap> caps;
    std::istringstream lines (text);
    for (std::string line; std::getline (lines, line);)
    {
        const auto equals = line.find (" = ");
        const auto arrow = line.find ("]->");
        if (equals == line.npos || arrow == line.npos) continue;
        auto key = line.substr (arrow + 3, equals - arrow - 3);
        key.erase (key.find_last_not_of (' ') + 1);
        const auto index = std::stoul (line.substr (line.find ('[') + 1));
        const auto value = std::strtol (line.c_str() + equals + 3, nullptr, 0);
        if (line.starts_with ("pp_data->caps_info") && index < 3)
        {
            if (key == "ReportByteLength") lengths[index] = value;
            if (key == "FirstCap") firsts[index] = static_cast<std::size_t> (value);
        }
        if (! line.starts_with ("pp_data->cap[")) continue;
        caps.resize (std::max<std::size_t> (caps.size(), index + 1));
        caps[index].emplace (key, value);
    }
    return caps;
}
}   // namespace

TEST_CASE ("a descriptor gives the place of each number in a report")
{
    const auto d = good (test::wheel());
    CHECK (d.has_ids);
    CHECK (d.length (Kind::input, 1) == 3);
    CHECK (d.length (Kind::output, 2) == 8);
    CHECK (d.length (Kind::output, 3) == 3);
    CHECK (d.length (Kind::feature, 7) == 2);
    CHECK (d.length (Kind::input, 9) == 0);

    const auto* x = fieldOf (d, Kind::input, usageOf (1, 0x30));
    REQUIRE (x != nullptr);
    CHECK (x->logical_min == -32767);
    CHECK (x->logical_max == 32767);
    CHECK (x->size == 16);
    const auto* buttons = fieldOf (d, Kind::input, usageOf (9, 5));
    REQUIRE (buttons != nullptr);
    CHECK (buttons->bit == 16);
    CHECK (buttons->placeOf (usageOf (9, 5)) == 4);
    CHECK (buttons->usage (7) == usageOf (9, 8));
    const auto* time = fieldOf (d, Kind::output, usageOf (0x0f, 0x50));
    REQUIRE (time != nullptr);
    CHECK (time->unit_exponent == -3);
    CHECK (time->physical_max == 10000);
    CHECK (d.lies (time->collection, usageOf (0x0f, 0x21)));
    CHECK (d.lies (time->collection, usageOf (1, 4)));
    CHECK_FALSE (d.lies (time->collection, usageOf (0x0f, 0x73)));
}

TEST_CASE ("pushed states, long usages, alternatives and unsigned maxima follow the standard")
{
    const auto d = good (test::bytes (
        "05 01 15 00 25 7f 75 08 95 01 a4 05 09 75 01 b4 09 30 81 02 "   // push the state, change it, pop it: x is still 8 bits wide
        "0b 05 00 0c 00 81 02 "                                          // a usage with its own page
        "a9 01 09 31 09 32 a9 00 81 02 "                                 // the first of a set of alternatives
        "26 ff ff 75 10 09 33 81 02 fe 02 00 11 22 09 34 91 02"));       // 65535, a long item, an output
    REQUIRE (d.fields.size() == 5);
    CHECK (d.fields[0].usage (0) == usageOf (1, 0x30));
    CHECK (d.fields[0].size == 8);
    CHECK (d.fields[1].usage (0) == usageOf (12, 5));
    CHECK (d.fields[2].usage (0) == usageOf (1, 0x31));
    CHECK_FALSE (d.fields[2].placeOf (usageOf (1, 0x32)));
    CHECK (d.fields[3].logical_max == 65535);
    CHECK (d.fields[3].bit == 24);
    CHECK (d.fields[4].kind == Kind::output);
    CHECK_FALSE (d.has_ids);
}

TEST_CASE ("a broken or oversized descriptor is refused at little cost, and the error has a position")
{
    const auto idOf = [] (const Bytes& bytes) {
        const auto read = readDescriptor (bytes);
        return read.messages.empty() ? std::string() : read.messages.front().id;
    };
    CHECK (idOf ({}) == "");
    CHECK (idOf (test::bytes ("05")) == "descriptor/truncated");
    CHECK (idOf (test::bytes ("27 00 00 00")) == "descriptor/truncated");
    CHECK (idOf (test::bytes ("fe")) == "descriptor/truncated");
    CHECK (idOf (test::bytes ("fe ff 00 00")) == "descriptor/truncated");
    CHECK (idOf (test::bytes ("a1 01")) == "descriptor/unbalanced");
    CHECK (idOf (test::bytes ("c0")) == "descriptor/unbalanced");
    CHECK (idOf (test::bytes ("b4")) == "descriptor/unbalanced");
    CHECK (idOf (test::bytes ("a4*33")) == "descriptor/too_deep");
    CHECK (idOf (test::bytes ("85 00")) == "descriptor/report_id");
    CHECK (idOf (test::bytes ("86 00 01")) == "descriptor/report_id");
    CHECK (idOf (test::bytes ("77 ff ff ff ff")) == "descriptor/too_large");
    CHECK (idOf (test::bytes ("97 ff ff ff ff")) == "descriptor/too_large");
    CHECK (idOf (test::bytes ("75 20 96 00 10 81 02")) == "descriptor/too_large");
    CHECK (idOf (test::bytes ("75 08 95 01 09*600 81 02")) == "descriptor/too_many");
    CHECK (idOf (Bytes (70'000, 0)) == "descriptor/too_long");
    CHECK (readDescriptor (test::bytes ("05 01 c0")).messages.front().where == "byte 2");

    const auto repeated = [] (std::string_view hex, int times) {
        std::string text;
        for (int i = 0; i < times; ++i)
            text += hex;
        return test::bytes (text);
    };
    CHECK (idOf (repeated ("a1 00", 33)) == "descriptor/too_deep");
    CHECK (idOf (repeated ("a1 00 c0", 300)) == "");
    auto many = test::bytes ("75 01 95 01");   // 4500 one-bit fields
    for (int i = 0; i < 10; ++i)
        std::ranges::copy (repeated ("81 02", 450), std::back_inserter (many));
    CHECK (idOf (many) == "descriptor/too_many");
}

TEST_CASE ("any bytes give either a descriptor or errors, and any descriptor with force feedback can be driven")
{
    test::property ("any bytes", [] { fuzz::tryDescriptor (*rc::gen::container<std::string> (rc::gen::arbitrary<char>())); });
    test::property ("a wheel with one byte changed", [] {
        auto bytes = test::wheel();
        bytes[*rc::gen::inRange<std::size_t> (0, bytes.size())] = *rc::gen::arbitrary<std::uint8_t>();
        fuzz::tryDescriptor ({ reinterpret_cast<const char*> (bytes.data()), bytes.size() });
    });
}

TEST_CASE ("a force feedback wheel is driven by one constant force that ends on its own")
{
    Messages messages;
    const auto device = PidDevice::from (good (test::wheel()), messages);
    REQUIRE (device);
    CHECK (messages.empty());
    CHECK (hexOf (device->createEffect()) == "06 01");
    CHECK (hexOf (device->blockLoad()) == "07 00 00");
    const auto blockOf = [&] (const PidDevice& of, const char* answer) { return numberIn (of.answer(), test::bytes (answer)).value(); };
    CHECK (blockOf (*device, "07 05 01") == 5u);
    CHECK (numberIn (device->answer(), test::bytes ("07 05 02")).error().id == "pid/full");
    CHECK (numberIn (device->answer(), test::bytes ("07 05 03")).error().id == "pid/refused");
    for (const auto* no_answer : { "07 00 01", "07 05 00", "07 05", "06 05 01", "07", "" })
        CHECK (numberIn (device->answer(), test::bytes (no_answer)).value() == std::nullopt);

    // Other devices have one bit for each status.
    auto bits = hexOf (test::wheel());
    const std::string array = "09 8e 25 03 b1 00";
    bits.replace (bits.find (array), array.size(), "09 8e 15 00 25 01 75 01 95 03 b1 02 75 05 95 01 b1 03");
    const auto other = PidDevice::from (good (test::bytes (bits)), messages);
    REQUIRE (other);
    CHECK (blockOf (*other, "07 05 01") == 5u);
    CHECK (numberIn (other->answer(), test::bytes ("07 05 06")).error().id == "pid/full");

    HidModel model (std::make_shared<Profile> (device->profile()));
    REQUIRE (model.init().size() == 5);
    CHECK (hexOf (model.init()[0].bytes) == "06 01");                        // create a constant force
    CHECK (hexOf (model.init()[1].bytes) == "07 00 00");                     // request its block
    CHECK (hexOf (model.init()[2].bytes) == "05 01");                        // actuators on
    CHECK (hexOf (model.init()[3].bytes) == "02 01 01 f4 01 ff 01 5a 00");   // block 1, constant, 500 ms, full gain, from 90 of 360
    CHECK (hexOf (model.init()[4].bytes) == "03 01 00 00");
    for (const auto i : { 3u, 4u })
        CHECK (model.init()[i].given->at == 8);
    CHECK (hexOf (model.exit().back().bytes) == "05 03");   // stop all

    CHECK (model.effortNames() == std::vector<std::string> { "force" });
    const auto sent = [&] (double share) {
        HidEffort effort;
        effort.efforts[0] = share;
        return hexOf (model.encode (0, effort));
    };
    CHECK (sent (-0.5) == "03 01 88 13");   // a force from the right pushes left
    CHECK (sent (1.0) == "03 01 f0 d8");
    CHECK (sent (-7.0) == "03 01 10 27");
    CHECK (sent (std::numeric_limits<double>::quiet_NaN()) == "03 01 00 00");
    CHECK (hexOf (model.neutral (0)) == "03 01 00 00");
    CHECK (hexOf (model.encode (1, {})) == "04 01 01 01");   // started once
    CHECK (hexOf (model.neutral (1)) == "04 01 03 00");      // stopped
    CHECK (model.profile().outputs[1].keepalive < model.profile().limits.device_watchdog);

    const auto& s = model.decode (test::bytes ("01 01 80 82"));
    CHECK (s.axes[0] == Approx (-1.0));
    CHECK (s.buttons == 0x82);
    CHECK (model.axisNames() == std::vector<std::string> { "x" });
    CHECK (model.decode (test::bytes ("01 00 40 00")).axes[0] == Approx (16384.0 / 32767.0));
}

TEST_CASE ("a joystick without force feedback gives errors that name what is missing")
{
    Messages messages;
    CHECK_FALSE (PidDevice::from (good (test::bytes ("05 01 09 04 a1 01 09 30 15 00 26 ff 00 75 08 95 01 81 02 c0")), messages));
    CHECK (messages.size() >= 5);
    for (const auto& m : messages)
        CHECK (m.id == "pid/missing");

    // A constant force with its block in one report and its magnitude in another.
    auto spread = hexOf (test::wheel());
    const std::string force = "09 70 16 f0 d8";
    spread.insert (spread.find (force), "85 08 ");
    messages.clear();
    CHECK_FALSE (PidDevice::from (good (test::bytes (spread)), messages));
    REQUIRE (messages.size() == 1);
    CHECK (messages[0].text == "the device has no Set Constant Force with a magnitude");
}

TEST_CASE ("the board descriptor in docs/devices.md matches the profile")
{
    const auto d = good (test::bytes ("06 ab ff 0a 00 02 a1 01 75 08 15 00 26 ff 00 95 40 09 01 81 02 95 40 09 02 91 02 c0"));
    const auto profile = test::profileOf ("tactus_board");
    CHECK_FALSE (d.has_ids);
    CHECK (d.length (Kind::input, 0) == profile->inputs[0].length);
    CHECK (d.length (Kind::output, 0) == profile->outputs[0].neutral.size());
    CHECK (d.collections[0].usage == usageOf (*profile->match[0].usage_page, *profile->match[0].usage));
}

TEST_CASE ("OpenFFBoard's descriptor gives its reports, and the same force as standard drivers")
{
    const auto bytes = fileOf (data / "hid_ffb" / "openffboard_1axis.bin");
    if (bytes.empty())
    {
        WARN ("skipped: " << data / "hid_ffb"
                          << " does not exist");
        return;
    }
    const auto d = good (bytes);
    CHECK (d.length (Kind::input, 1) == 24);
    CHECK (d.length (Kind::input, 2) == 1);
    const std::map<std::uint8_t, std::size_t> outputs { { 1, 17 }, { 2, 13 }, { 3, 14 }, { 4, 11 }, { 5, 3 }, { 6, 5 } };
    for (const auto& [id, length] : outputs)
        CHECK (d.length (Kind::output, id) == length);
    for (const auto id : Bytes { 10, 11, 12, 13 })
        CHECK (d.length (Kind::output, id) > 0);
    for (const auto id : Bytes { 17, 18, 19 })
        CHECK (d.length (Kind::feature, id) > 0);

    Messages messages;
    const auto device = PidDevice::from (d, messages);
    REQUIRE (device);
    CHECK (hexOf (device->createEffect()).starts_with ("11 01"));
    CHECK (hexOf (device->blockLoad()).starts_with ("12 00"));
    CHECK (numberIn (device->answer(), test::bytes ("12 03 01 00 10")).value() == 3u);
    CHECK (numberIn (device->answer(), test::bytes ("12 00 02 00 00")).error().id == "pid/full");

    HidModel model (std::make_shared<Profile> (device->profile ({ .full_force = 4.0, .travel = { { "x", 0.2 }, { "y", 0.1 } } })));
    const auto sent = [&] (double newton) { return hexOf (model.encode (0, { { newton, 0.0, 0.0 }, Vec3::Zero(), {} })); };
    Bytes resting (25);
    resting[0] = 1;
    REQUIRE (model.decode (resting).refusal == Refusal::none);
    resting[10] = 0x40;   // x, which follows 64 buttons
    resting[12] = 0x80;   // y, which a stick counts positive towards the user
    CHECK (model.decode (resting).position.x() == Approx (0.05).epsilon (1e-4));
    CHECK (model.reading().position.y() == Approx (0.05).epsilon (1e-4));
    CHECK (sent (-4.0) == "05 01 ff 7f");
    CHECK (sent (2.0) == "05 01 01 c0");                // -16383, half of -32767 towards 0
    CHECK (hexOf (model.init()[0].bytes) == "0c 08");   // Device Control is a bit field here: reset is the fourth bit,
    CHECK (hexOf (model.exit()[1].bytes) == "0c 04");   // "stop all" the third
    CHECK (hexOf (model.exit()[2].bytes) == "0b 01");   // and the block is freed
    CHECK (model.axisNames().size() == 8);
    CHECK (model.buttonNames().size() == 32);   // the device has 64
    const auto& set = model.init()[5].bytes;
    CHECK (set.size() == 18);
    CHECK (set[1] == 1);
    CHECK (set[2] == 1);
    CHECK ((set[3] | set[4] << 8) == 500);
}

TEST_CASE ("a SpaceNavigator's descriptor and the profile agree on reports and scale")
{
    const auto bytes = fileOf (data / "hid_spacemouse" / "spacenavigator_046d_c626_217.bin");
    if (bytes.empty())
    {
        WARN ("skipped: " << data / "hid_spacemouse"
                          << " does not exist");
        return;
    }
    const auto d = good (bytes);
    const auto profile = test::profileOf ("spacemouse");
    for (const auto& report : profile->inputs)
        CHECK (d.length (Kind::input, *report.id) + 1 == report.length);
    CHECK (d.length (Kind::output, 4) == 1);

    const auto* x = fieldOf (d, Kind::input, usageOf (1, 0x30));
    REQUIRE (x != nullptr);
    CHECK (x->count == 3);
    CHECK (x->relative);       // declared relative, although it is absolute
    CHECK (x->unit == 0x11);   // cm
    const double metre = static_cast<double> (x->physical_max) / static_cast<double> (x->logical_max) * std::pow (10.0, x->unit_exponent) * 1e-2;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const auto& field = profile->inputs[0].fields[i];
        CHECK (field.bits.at == 8 + x->bit + 16 * i);
        CHECK (field.scale == Approx (metre));
    }
}

TEST_CASE ("SpaceMouse profiles read the same bytes as PySpaceMouse, with the same signs")
{
    std::ifstream file (data / "hid_pyspacemouse" / "devices.toml");
    if (! file)
    {
        WARN ("skipped: " << data / "hid_pyspacemouse"
                          << " does not exist");
        return;
    }

    // "mappings.x     = [1, 1, 2, 1]": report, low byte, high byte, sign; pitch, roll, yaw are turns about x, y, z.
    const auto numbersIn = [] (const std::string& line) {
        std::vector<long> numbers;
        const char* at = line.c_str() + line.find ('[') + 1;
        for (char* end = nullptr; *at != '\0' && *at != ']'; at = *end == ',' ? end + 1 : end)
        {
            numbers.push_back (std::strtol (at, &end, 0));
            if (end == at) break;
        }
        return numbers;
    };
    int devices = 0, axes = 0;
    std::shared_ptr<const Profile> profile;
    for (std::string line; std::getline (file, line);)
    {
        if (line.starts_with ("hid_id"))
        {
            const auto id = numbersIn (line);
            profile.reset();
            for (const auto& p : test::profiles())
                for (const auto& rule : p->match)
                    if (std::ranges::find (rule.vid, id[0]) != rule.vid.end() && std::ranges::find (rule.pid, id[1]) != rule.pid.end()) profile = p;
            INFO (line);
            CHECK (profile);
            ++devices;
        }
        if (! line.starts_with ("mappings.") || ! profile) continue;

        const std::map<std::string, std::string> names { { "x", "x" }, { "y", "y" }, { "z", "z" }, { "pitch", "rx" }, { "roll", "ry" }, { "yaw", "rz" } };
        const auto theirs = line.substr (9, line.find_first_of (" =", 9) - 9);
        const auto map = numbersIn (line);
        const auto name = names.at (theirs);
        INFO (profile->id << " " << line);
        const auto report = std::ranges::find_if (profile->inputs, [&] (const auto& r) { return *r.id == map[0]; });
        REQUIRE (report != profile->inputs.end());
        const auto field = std::ranges::find (report->fields, name, &InputField::name);
        REQUIRE (field != report->fields.end());
        CHECK (static_cast<long> (field->bits.at) == 8 * map[1]);
        CHECK (map[2] == map[1] + 1);
        if (theirs.size() == 1) CHECK (profile->axes (theirs[0] - 'x', theirs[0] - 'x') == static_cast<double> (map[3]));
        ++axes;
    }
    CHECK (devices >= 12);
    CHECK (axes == 6 * devices);
}

TEST_CASE ("descriptors of real devices give the same fields as on Windows")
{
    if (! std::filesystem::exists (data / "hid_hidapi"))
    {
        WARN ("skipped: " << data / "hid_hidapi"
                          << " does not exist");
        return;
    }
    int compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator (data / "hid_hidapi"))
    {
        if (entry.path().extension() != ".pp_data") continue;
        const auto name = entry.path().stem().string();
        const auto text = fileOf (entry.path());
        std::array<long, 3> lengths {};
        std::array<std::size_t, 3> firsts {};
        const auto caps = capsOf ({ text.begin(), text.end() }, lengths, firsts);

        for (const auto* which : { "_real.rpt_desc", "_expected.rpt_desc" })
        {
            // A list of bytes in C, with comments; files in any other format are skipped.
            Bytes bytes;
            std::ifstream lines (data / "hid_hidapi" / (name + which));
            for (std::string line; std::getline (lines, line);)
                for (auto at = line.find ("0x"); at < line.find ("//"); at = line.find ("0x", at + 2))
                    bytes.push_back (static_cast<std::uint8_t> (std::strtol (line.c_str() + at, nullptr, 16)));
            if (bytes.empty()) continue;
            INFO (name << which);
            const auto d = good (bytes);

            for (std::size_t i = 0; i < caps.size(); ++i)
            {
                auto cap = caps[i];
                if (cap.empty() || cap["IsPadding"] != 0) continue;
                auto kind = i >= firsts[1] ? Kind::output : Kind::input;
                if (i >= firsts[2]) kind = Kind::feature;
                const auto usage = usageOf (static_cast<unsigned> (cap["UsagePage"]),
                                            static_cast<unsigned> (cap["IsRange"] != 0 ? cap["Range.UsageMin"] : cap["NotRange.Usage"]));
                const auto bit = static_cast<std::size_t> (8 * (cap["BytePosition"] - 1) + cap["BitPosition"]);
                const bool found = std::ranges::any_of (d.fields, [&] (const DescribedField& f) {
                    const auto n = f.placeOf (usage);
                    return n && f.kind == kind && f.report == cap["ReportID"] && f.size == static_cast<std::size_t> (cap["BitSize"])
                           && f.bit + (f.variable ? *n * f.size : 0) == bit;
                });
                INFO ("cap " << i << " usage " << std::hex << usage << " bit " << std::dec << bit);
                CHECK (found);
                ++compared;
            }
            if (name == "046D_C283_0004_0001")
            {
                CHECK (static_cast<long> (d.length (Kind::input, 0)) + 1 == lengths[0]);
                CHECK (static_cast<long> (d.length (Kind::output, 0)) + 1 == lengths[1]);
            }
        }
    }
    CHECK (compared >= 50);
}
