// SPDX-License-Identifier: MIT
#include "hid.hpp"

#include <fuzz/profile_target.hpp>
#include <support/property.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
/// A complete, valid profile with a bit of everything.
const Json& good()
{
    static const Json json = Json::parse (R"({
      "format": "tactus-profile", "version": 1, "id": "thing", "name": "Thing", "sources": ["a test"],
      "match": [{ "vid": "0x1209", "pid": ["0x0001", 2], "bus": "usb", "interface": 1 }],
      "init": [{ "kind": "feature", "bytes": "01 02", "delay": "5 ms" }],
      "inputs": [
        { "id": 1, "length": 12, "verified": true, "timestamp": "when", "sequence": "count",
          "fields": [ { "name": "x", "at": 1, "type": "s16be", "scale": "1 um" }, { "name": "count", "at": 3, "type": "u4" },
                      { "name": "when", "at": 4, "type": "u32le", "scale": "1 us" },
                      { "name": "rx", "at": 8, "type": "f32le", "scale": "1 deg" } ] },
        { "id": 2, "length": 2, "longest": 8, "verified": true, "fields": [{ "buttons": ["a", "", "b"], "at": 1, "type": "u3" }] } ],
      "tables": { "curve": { "x": [0, 1], "y": [0, 200] } },
      "outputs": [
        { "name": "push", "id": 3, "body": "03 01 00*8", "neutral": "03 00*9", "verified": true,
          "sequences": [{ "byte": 1, "shift": 4 }], "crc32": { "prefix": "a2", "at": 6 },
          "fields": [ { "name": "fx", "at": 2, "type": "s16le", "scale": "1 mN", "min": -2, "max": 2 },
                      { "name": "hum", "at": 4, "type": "u8", "table": "curve" },
                      { "name": "pitch", "at": 5, "type": "u8", "log2": { "steps": 12, "reference": 20 } } ] } ],
      "position": ["x", null, null], "rotation": ["rx", null, null], "force": ["fx", null, null],
      "limits": { "max_force": "2 N", "max_axis_effort": 3 },
      "samples": [{ "input": ["01 00 05 00*9"], "gives": { "position.x": "5 um" } }] })");
    return json;
}

/// The valid profile with one value replaced; null removes the entry.
Json with (const std::string& pointer, const Json& value)
{
    Json json = good();
    const JsonPointer at (pointer);
    if (! value.is_null())
        json[at] = value;
    else if (auto& parent = json[at.parent()]; parent.is_array())
        parent.erase (std::stoul (at.parts().back()));
    else
        parent.erase (at.parts().back());
    return json;
}

struct Mistake
{
    std::string pointer;
    Json value;
    std::string id;
};
}   // namespace

TEST_CASE ("a valid profile gives no messages")
{
    const auto loaded = readProfile (good());
    for (const auto& m : loaded.messages)
        FAIL_CHECK (m.where + ": " + m.text);
    REQUIRE (loaded.profile);
    const auto& p = *loaded.profile;
    CHECK (p.match[0].pid == std::vector<std::uint16_t> { 1, 2 });
    CHECK (p.inputs[0].fields[2].unwrap);   // a clock is unwrapped
    CHECK (p.inputs[0].fields[3].unit == "rad");
    CHECK (p.outputs[0].fields[0].unit == "N");
    CHECK (p.init[0].delay == 0.005);
    CHECK (p.limits.guard.max_force == 2.0);
}

// Long because it is one table of cases.
TEST_CASE ("every error in a profile is reported with its position")
{
    const Json null;
    const Mistake mistakes[] = {
        { "/format", "tactus-graph", "profile/format" },
        { "/version", 2, "profile/format" },
        { "/id", "Thing", "profile/name" },
        { "/id", "auto", "profile/name" },   // hid:auto and hid:pid mean any device that fits
        { "/id", "pid", "profile/name" },
        { "/name", null, "profile/missing" },
        { "/sources", null, "profile/missing" },
        { "/colour", "red", "profile/unknown_key" },
        { "/match", null, "profile/missing" },
        { "/match/0/vid", null, "profile/missing" },
        { "/match/0/vid", "1209", "profile/kind" },
        { "/match/0/vid", 70000, "profile/kind" },
        { "/match/0/bus", "serial", "profile/kind" },
        { "/init/0/bytes", "0", "profile/hex" },
        { "/init/0/bytes", "00*9999999999999999999999", "profile/hex" },
        { "/init/0/bytes", "00*1025", "profile/hex" },
        { "/init/0/bytes", null, "profile/missing" },
        { "/init/0/delay", "1 min", "profile/unit" },
        { "/init/0/delay", "1 m", "profile/unit" },
        { "/init/0/kind", "input", "profile/kind" },
        { "/inputs", Json::array(), "profile/unknown_name" },
        { "/inputs/0/length", null, "profile/missing" },
        { "/inputs/0/length", 11, "profile/beyond" },
        { "/inputs/0/longest", 5, "profile/out_of_range" },
        { "/inputs/0/verified", null, "profile/missing" },
        { "/inputs/0/verified", false, "profile/missing" },
        { "/inputs/0/verified", 1, "profile/kind" },
        { "/inputs/0/fields/0/at", null, "profile/missing" },
        { "/inputs/0/fields/0/at", 11, "profile/beyond" },
        { "/inputs/0/fields/0/at", -1, "profile/out_of_range" },
        { "/inputs/0/fields/0/type", "s33", "profile/type" },
        { "/inputs/0/fields/0/type", "u0", "profile/type" },
        { "/inputs/0/fields/0/type", "f64le", "profile/type" },
        { "/inputs/0/fields/0/type", "u12be", "profile/type" },
        { "/inputs/0/fields/0/bit", 3, "profile/type" },
        { "/inputs/0/fields/0/scale", 0, "profile/out_of_range" },
        { "/inputs/0/fields/0/scale", "1e20 m", "profile/out_of_range" },
        { "/inputs/0/fields/0/offset", "1e20 m", "profile/out_of_range" },
        { "/inputs/0/fields/0/scale", "1 furlong", "profile/unit" },
        { "/inputs/0/fields/0/scale", 1e-6, "profile/unit" },
        { "/inputs/0/fields/0/unit", "m", "profile/unit" },
        { "/inputs/0/fields/0/offset", "1 s", "profile/unit" },
        { "/inputs/0/fields/0/name", null, "profile/missing" },
        { "/inputs/0/fields/0/name", "count", "profile/duplicate" },
        { "/inputs/0/fields/3/unwrap", true, "profile/type" },
        { "/inputs/0/fields/2/scale", "1 m", "profile/unit" },
        { "/inputs/0/timestamp", "wen", "profile/unknown_name" },
        { "/inputs/0/sequence", "rx", "profile/unknown_name" },
        { "/inputs/1/id", 1, "profile/duplicate" },
        { "/inputs/1/fields/0", Json ({ { "name", "x" }, { "at", 1 }, { "type", "u8" }, { "scale", "1 s" } }), "profile/unit" },
        { "/inputs/1/id", null, "profile/duplicate" },
        { "/inputs/1/fields/0/buttons/0", "A", "profile/name" },
        { "/inputs/1/fields/0/buttons", Json ({ "a", "b", "c", "d" }), "profile/beyond" },
        { "/inputs/1/fields/0/hat", Json ({ "a", "b" }), "profile/kind" },
        { "/outputs/0/neutral", null, "profile/no_neutral" },
        { "/outputs/0/neutral", "03", "profile/beyond" },
        { "/outputs/0/neutral", "04 00*9", "profile/format" },
        { "/outputs/0/neutral", "03 00 00 01 00*6", "profile/neutral" },
        { "/init", Json::parse (R"([{ "bytes": "03 00 00 01 00*6" }])"), "profile/neutral" },      // 256 mN
        { "/init", Json::parse (R"([{ "bytes": "03 00 00 01" }])"), "profile/neutral" },           // also in a report that ends early
        { "/init", Json::parse (R"([{ "bytes": "00 03 00 00 01 00*6" }])"), "profile/neutral" },   // and after a 0, which the system leaves out
        { "/exit", Json::parse (R"([{ "bytes": "01 02" }, { "bytes": "03 00 00 01 00*6" }])"), "profile/neutral" },
        { "/signals", Json::parse (R"([{ "amplitude": "fx" }])"), "profile/signal_on_force" },
        { "/limits", Json::object(), "profile/no_limit" },
        { "/signals", Json::parse (R"([{ "amplitude": "hum" }])"), "profile/no_limit" },
        { "/outputs/0/body", "04 01 00*8", "profile/format" },
        { "/outputs/0/name", null, "profile/missing" },
        { "/outputs/0/kind", "input", "profile/kind" },
        { "/outputs/0/fields/0/at", 0, "profile/overlap" },
        { "/outputs/0/fields/0/at", 3, "profile/overlap" },
        { "/outputs/0/fields/0/at", 9, "profile/beyond" },
        { "/outputs/0/fields/0/min", 3, "profile/out_of_range" },
        { "/outputs/0/fields/0/source", "input", "profile/kind" },
        { "/outputs/0/fields/0/source", "echo", "profile/unknown_name" },
        { "/outputs/0/fields/1/table", "kurve", "profile/unknown_name" },
        { "/outputs/0/fields/2/table", "curve", "profile/kind" },
        { "/outputs/0/fields/2/log2/steps", 0, "profile/out_of_range" },
        { "/outputs/0/fields/2/log2/reference", 0, "profile/out_of_range" },
        { "/outputs/0/crc32/at", 7, "profile/beyond" },
        { "/outputs/0/crc32/at", 5, "profile/overlap" },
        { "/outputs/0/crc32/at", null, "profile/missing" },
        { "/outputs/0/sequences/0/modulo", 10, "profile/out_of_range" },
        { "/outputs/0/sequences/0/shift", 5, "profile/beyond" },
        { "/outputs/0/sequences/0/byte", 10, "profile/beyond" },
        { "/outputs/0/stream", Json ({ { "at", 2 }, { "frames", 9 }, { "channels", { "l" } }, { "rate", 3000 } }), "profile/beyond" },
        { "/outputs/0/stream", Json ({ { "at", 2 }, { "frames", 1 }, { "channels", Json::array() }, { "rate", 3000 } }), "profile/too_many" },
        { "/tables/curve/x", Json ({ 1, 0 }), "profile/kind" },
        { "/position", Json ({ "y", nullptr, nullptr }), "profile/unknown_name" },
        { "/position", Json ({ "rx", nullptr, nullptr }), "profile/unit" },
        { "/position", Json (std::vector<std::string> { "x" }), "profile/kind" },
        { "/rotation/0", "x", "profile/unit" },
        { "/force/0", "hum", "profile/unit" },
        { "/force/1", "fx", "profile/twice" },
        { "/torque", Json ({ "fx", nullptr, nullptr }), "profile/twice" },
        { "/outputs/0/fields/1", Json::parse (R"({ "name": "lift", "at": 4, "type": "u8", "scale": "1 N", "offset": "-2 N" })"), "profile/neutral" },
        { "/outputs/0/fields/1", Json::parse (R"({ "name": "coil", "at": 4, "type": "u8", "unit": "A", "offset": -2 })"), "profile/neutral" },
        { "/pressure", "x", "profile/unit" },
        { "/valid", "homed", "profile/unknown_name" },
        { "/alarms", Json::parse (R"([{ "field": "fog", "means": "too_hot" }])"), "profile/unknown_name" },
        { "/alarms", Json::parse (R"([{ "field": "a", "means": "too_hot" }])"), "profile/unknown_name" },   // a button
        { "/alarms", Json::parse (R"([{ "field": "count", "means": "smoke" }])"), "profile/kind" },
        { "/alarms", Json::parse (R"([{ "field": "count", "means": "lost" }])"), "profile/kind" },
        { "/alarms", Json::parse (R"([{ "field": "count" }])"), "profile/missing" },
        { "/alarms", Json::parse (R"([{ "means": "too_hot" }])"), "profile/missing" },
        { "/alarms", Json::parse (R"([{ "field": "count", "means": "too_hot", "is": -1 }])"), "profile/kind" },
        { "/alarms", Json::parse (R"([{ "field": "count", "means": "too_hot", "while_driven": "1 m" }])"), "profile/unit" },
        { "/alarms", Json::parse (R"([{ "field": "count", "means": "too_hot", "after": 1 }])"), "profile/unknown_key" },
        { "/limits", Json::parse (R"({ "max_force": "2 N", "max_axis_effort": 3, "max_still": "1 s" })"), "profile/missing" },
        { "/axes", Json ({ "x", "y" }), "profile/axes" },
        { "/axes", Json ({ "x", "y", "-z" }), "profile/axes" },
        { "/axes", Json ({ { 1, 0, 0 }, { 0, 2, 0 }, { 0, 0, 1 } }), "profile/axes" },
        { "/kinematics", Json::object(), "profile/kinematics" },
        { "/kinematics", Json ({ { "linear", { { "matrix", { 1, 2, 3 } } } } }), "profile/kinematics" },
        { "/kinematics", Json ({ { "five_bar", { { "drives", Json::array() }, { "links", { 1, 1, 1, 1 } } } } }), "profile/kinematics" },
        { "/kinematics",
          Json ({ { "five_bar", { { "drives", { { { "counts_per_turn", 0 } }, { { "counts_per_turn", 1 } } } }, { "links", { 1, 1, 1, 1 } } } } }),
          "profile/out_of_range" },
        { "/kinematics",
          Json ({ { "five_bar", { { "drives", { { { "counts_per_turn", 1 } }, { { "counts_per_turn", 1 } } } }, { "links", { 1, 1, 0, 1 } } } } }),
          "profile/kinematics" },
        { "/limits/max_force", "-1 N", "profile/out_of_range" },
        { "/limits/max_forse", "1 N", "profile/unknown_key" },
        { "/samples/0/gives", Json ({ { "position.w", 1 } }), "profile/unknown_name" },
        { "/samples/0/input", Json::array(), "profile/missing" },
        { "/samples/0/output", "pull", "profile/unknown_name" },
    };
    for (const auto& mistake : mistakes)
    {
        INFO (mistake.pointer << " = " << mistake.value.dump());
        const auto loaded = readProfile (with (mistake.pointer, mistake.value));
        CHECK_FALSE (loaded.profile);
        const bool named = std::ranges::any_of (loaded.messages, [&] (const Message& m) { return m.id == mistake.id; });
        if (! named)
            for (const auto& m : loaded.messages)
                UNSCOPED_INFO (m.id << " " << m.where << ": " << m.text);
        CHECK (named);
        for (const auto& m : loaded.messages)
            CHECK ((m.id.starts_with ("profile/") && ! m.text.empty() && ! m.remedy.empty()));
    }
}

TEST_CASE ("a profile that drives signals, by samples or by their amplitude, says how strongly")
{
    auto json = good();
    json["signals"] = Json::parse (R"([{ "amplitude": "hum" }])");
    json["limits"]["max_signal"] = 1;
    CHECK (readProfile (json).messages.empty());

    json = good();
    json["outputs"].push_back (
        Json::parse (R"({ "name": "samples", "id": 4, "neutral": "04 00*4", "verified": true,
                          "stream": { "at": 1, "frames": 4, "channels": ["l"], "rate": 3000 } })"));
    const auto unlimited = readProfile (json);
    REQUIRE (unlimited.messages.size() == 1);
    CHECK (unlimited.messages[0].id == "profile/no_limit");
    json["limits"]["max_signal"] = 1;
    CHECK (readProfile (json).messages.empty());
}

TEST_CASE ("a profile with a slew limit whose effort has no maximum is refused, because a stop could take forever")
{
    const auto loaded = readProfile (with ("/limits/max_torque_slew", "1 N*m/s"));
    CHECK_FALSE (loaded.profile);
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "device/slow_stop");
}

TEST_CASE ("the steps of init may enable the motors, those of exit may not", "[safety]")
{
    auto json = good();
    json["outputs"][0]["fields"].push_back (Json::parse (R"({ "source": "enable", "at": 1, "type": "u4" })"));
    CHECK (readProfile (json).messages.empty());
    const auto enabled = Json::parse (R"([{ "bytes": "03 01 00*8" }])");
    json["init"] = enabled;
    CHECK (readProfile (json).messages.empty());
    json["exit"] = enabled;
    const auto loaded = readProfile (json);
    CHECK_FALSE (loaded.profile);
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "profile/neutral");
    CHECK (loaded.messages[0].where == "/exit");
    json["exit"] = Json::parse (R"([{ "bytes": "02 ff*9" }])");   // no report that the profile describes
    CHECK (readProfile (json).messages.empty());
}

TEST_CASE ("a linear map drives no current, because it knows no torque constant")
{
    auto json = good();
    json["kinematics"] = Json::parse (R"({ "linear": { "matrix": [[0.05, 0, 0], [0, 1, 0], [0, 0, 1]] } })");
    CHECK (readProfile (json).messages.empty());
    json["outputs"][0]["fields"][0] = Json::parse (R"({ "name": "fx", "at": 2, "type": "s16le", "scale": 0.001, "unit": "A" })");
    const auto loaded = readProfile (json);
    CHECK_FALSE (loaded.profile);
    CHECK (std::ranges::any_of (loaded.messages, [] (const Message& m) { return m.id == "profile/unit" && m.where == "/force"; }));
    json["outputs"][0]["fields"][0]["unit"] = "mA";
    CHECK_FALSE (readProfile (json).profile);
}

TEST_CASE ("a force with a table is refused unless its neutral report holds the raw value of no force")
{
    auto json = good();
    json["tables"]["push"] = Json::parse (R"({ "x": [-2, 2], "y": [0, 200] })");
    json["outputs"][0]["fields"][0] = Json::parse (R"({ "name": "fx", "at": 2, "type": "u16le", "table": "push", "unit": "N" })");
    for (const auto& [neutral, is_fine] : { std::pair { "03 00 64 00*7", true }, { "03 00 63 00*7", false }, { "03 00*9", false } })
    {
        INFO (neutral);
        json["outputs"][0]["neutral"] = neutral;
        const auto loaded = readProfile (json);
        CHECK ((loaded.profile != nullptr) == is_fine);
        if (! is_fine) CHECK (loaded.messages.at (0).id == "profile/neutral");
    }
}

TEST_CASE ("an effort in N that is not a force may rest within half a count of zero")
{
    const auto accepts = [] (const char* lift) { return readProfile (with ("/outputs/0/fields/1", Json::parse (lift))).profile != nullptr; };
    CHECK_FALSE (accepts (R"({ "name": "lift", "at": 4, "type": "u8", "scale": "5 N", "offset": "-5 N" })"));
    CHECK (accepts (R"({ "name": "lift", "at": 4, "type": "u8", "scale": "1 N", "offset": "-0.5 N" })"));
}

TEST_CASE ("the limits of a motor accept every way to write its unit")
{
    const auto limited = [] (const Json& most, const Json& slew) {
        auto json = with ("/limits/max_motor", most);
        json["limits"]["max_motor_slew"] = slew;
        return readProfile (json);
    };
    for (const auto* slew : { "200 N/s", "0.2 N/ms", "200 kg*m/s3", "2e5 mN/s" })
    {
        INFO (slew);
        const auto loaded = limited ("2 N", slew);
        CHECK (loaded.messages.empty());
        REQUIRE (loaded.profile);
        CHECK (loaded.profile->limits.max_motor_slew == Approx (200.0));
    }
    for (const auto* slew : { "200 N", "200 N*m/s", "200 1/s", "200 rad/s" })
    {
        INFO (slew);
        const auto loaded = limited ("2 N", slew);
        REQUIRE (loaded.messages.size() == 1);
        CHECK (loaded.messages[0].id == "profile/unit");
    }
}

TEST_CASE ("too many items of any kind are refused")
{
    Json many = Json::array();
    for (int i = 0; i < 33; ++i)
        many.push_back ({ { "name", "value" + std::to_string (i) }, { "at", 1 }, { "type", "u8" } });
    auto json = with ("/inputs/1/fields", many);
    CHECK (readProfile (json).messages.front().id == "profile/too_many");

    for (int i = 0; i < 1000; ++i)
        many.push_back (many[0]);
    json = with ("/inputs/1/fields", many);
    const auto loaded = readProfile (json);
    CHECK (loaded.messages.front().id == "profile/too_many");
    CHECK (loaded.messages.size() < 300);
}

TEST_CASE ("all errors in a profile are reported together, with line and column")
{
    const auto loaded = readProfileText (
        "{\n  \"format\": \"tactus-profile\", \"version\": 1, \"id\": \"a\", \"name\": \"A\",\n"
        "  \"match\": [{ \"vid\": -1 }],\n  \"sources\": [\"a test\"], \"rate\": \"1 m\",\n"
        "  \"inputs\": [{ \"length\": 0, \"verified\": true }] }");
    CHECK_FALSE (loaded.profile);
    const auto lineOf = [&] (const std::string& where) {
        const auto it = std::ranges::find (loaded.messages, where, &Message::where);
        return it == loaded.messages.end() ? 0 : it->line;
    };
    CHECK (lineOf ("/match/0/vid") == 3);
    CHECK (lineOf ("/rate") == 4);
    CHECK (lineOf ("/inputs/0/length") == 5);
}

TEST_CASE ("hexadecimal bytes read back as written")
{
    test::property ("any bytes", [] (const Bytes& bytes) {
        RC_PRE (bytes.size() <= longest_report);
        RC_ASSERT (bytesOf (hexOf (bytes)) == bytes);
    });
    CHECK (bytesOf ("00*3 FF")->size() == 4);
    for (const auto bad : { "0", "0x00", "00*", "00*0", "00*-1", "gg", "00,00", "+1" })
        CHECK_FALSE (bytesOf (bad));
}

TEST_CASE ("profiles with any value anywhere are read or refused, and those that are read decode any report")
{
    std::vector<std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator (test::profile_folder))
    {
        std::ostringstream text;
        text << std::ifstream (entry.path()).rdbuf();
        texts.push_back (text.str());
    }
    const auto flat = good().flatten();
    std::vector<std::string> pointers;
    for (const auto& [pointer, value] : flat.items())
        pointers.push_back (pointer);
    const std::vector<Json> values { nullptr, true, -1, 0, 1, 1e300, 4294967296.0,   // values that are not strings
                                     "",
                                     "x",
                                     "fx",
                                     "0xff",
                                     "00",
                                     "u32le",
                                     "1 m",
                                     Json::array(),
                                     Json::object(),
                                     { 1, 2, 3 },
                                     { "x", "x", "x" } };

    test::property ("one value replaced by another", [&] {
        const auto json = with (*rc::gen::elementOf (pointers), *rc::gen::elementOf (values));
        fuzz::tryProfile (json.dump());
    });
    test::property ("a piece of the text removed", [&] {
        auto text = *rc::gen::elementOf (texts);
        const auto at = *rc::gen::inRange<std::size_t> (0, text.size());
        text.erase (at, *rc::gen::inRange<std::size_t> (1, 40));
        fuzz::tryProfile (text);
    });
}
