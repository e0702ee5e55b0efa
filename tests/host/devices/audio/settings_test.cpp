// SPDX-License-Identifier: MIT
// Sound cards, routes and calibrations in files, and errors in them.

#include "support/sketch.hpp"

#include <host/devices/audio/open_audio.hpp>
#include <host/devices/sessions/check_audio.hpp>
#include <support/property.hpp>
#include <tactus/run/device/make_device.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus;
using namespace tactus::host::audio;

namespace
{
const Json whole = Json::parse (R"({ "type": "JACK", "output": "system", "input": "system", "rate_hz": 48000, "block": 64, "reserve": "20 ms",
    "routes": [ { "port": "mix.out", "channel": 1, "full_scale": "4 N", "gain": -1, "high_pass": "20 Hz" }, { "port": "mix.level[0]", "channel": 2 } ] })");

bool isCovered (const std::string& text) { return ! text.empty(); }
}   // namespace

TEST_CASE ("the audio settings of a session are read", "[audio]")
{
    Messages messages;
    const auto s = readAudioSettings (whole, "/audio", messages);
    INFO (test::text (messages));
    CHECK (messages.empty());
    CHECK (s.card == CardRequest { "JACK", "system", "system", 48000.0, 64 });
    CHECK (s.reserve_s == 0.02);
    REQUIRE (s.routes.size() == 2);
    CHECK (s.routes[0].port == "mix.out");
    CHECK (s.routes[0].full_scale.value == 4.0);
    CHECK (s.routes[0].gain == -1.0);
    CHECK (s.routes[0].high_pass_hz == 20.0);
    CHECK (unitProblem (s.routes[0].full_scale, "N").empty());
    CHECK (isCovered (unitProblem (s.routes[0].full_scale, "m/s2")));
    CHECK (unitProblem (s.routes[0].full_scale, "").empty());
    CHECK (s.routes[1].channel == 2);
    CHECK (unitProblem (s.routes[1].full_scale, "m/s2").empty());
}

TEST_CASE ("all errors in the audio settings of a session are reported, with their position", "[audio]")
{
    const auto messagesOf = [] (const char* text) {
        Messages messages;
        readAudioSettings (Json::parse (text), "/audio", messages);
        return messages;
    };
    const auto three = messagesOf (R"({ "rate_hz": "48 N", "block": 0.5, "routes": [ { "port": "mix.out", "channel": 0, "full_scale": "4 mm" } ] })");
    REQUIRE (three.size() == 4);
    CHECK (three[0].where == "/audio/rate_hz");
    CHECK (three[1].where == "/audio/block");
    CHECK (three[2].where == "/audio/routes/0/channel");
    CHECK (three[3].where == "/audio/routes/0/full_scale");
    CHECK (three[3].id == "audio/full_scale");

    const auto strange = messagesOf (R"({ "colour": "red" })");
    REQUIRE (strange.size() == 1);
    CHECK (strange[0].severity == Message::Severity::warning);
    CHECK (test::has (messagesOf (R"({ "routes": [ {} ] })"), "device/missing"));
    for (const auto* bad : { "0 N", "-4 N", "nan", "1e400 N", "4 rad/s2", "" })
        CHECK (test::has (messagesOf (Json { { "routes", { { { "port", "a.b" }, { "channel", 1 }, { "full_scale", bad } } } } }.dump().c_str()),
                          "audio/full_scale"));
}

TEST_CASE ("settings with any value replaced by any other are read or refused", "[audio]")
{
    test::property ("one value replaced", [] {
        const Json flat = whole.flatten();
        const auto keys = [&] {
            std::vector<std::string> all { "/routes", "/routes/0", "" };
            for (const auto& [key, value] : flat.items())
                all.push_back (key);
            return all;
        }();
        Json damaged = whole;
        const auto key = *rc::gen::elementOf (keys);
        damaged[JsonPointer (key)] = *rc::gen::elementOf (std::vector<Json> {
            nullptr, true, -1, 0, 1e300, 3, 0.5, "", "4 N", "x", Json::array(), Json::object(), Json::array ({ 1, nullptr }), std::nan ("") });
        Messages messages;
        const auto s = readAudioSettings (damaged, "/audio", messages);
        for (const auto& m : messages)
            RC_ASSERT (m.where.starts_with ("/audio") && isCovered (m.text) && isCovered (m.remedy));
        RC_ASSERT (s.reserve_s > 0.0 && s.card.block >= 0 && s.card.rate_hz >= 0.0);
        for (const auto& route : s.routes)
            RC_ASSERT (route.channel >= 1 && route.channel <= most_channels && route.full_scale.value > 0.0 && std::isfinite (route.full_scale.value)
                       && std::isfinite (route.gain) && isCovered (route.port));
    });
}

TEST_CASE ("a route on the command line is a port, a channel and optionally a full scale", "[audio]")
{
    const auto route = parseRoute ("drag.force.x=3@4 N").value();
    CHECK (route.port == "drag.force.x");
    CHECK (route.channel == 3);
    CHECK (route.full_scale.value == 4.0);
    CHECK (parseRoute ("mix.level[0]=12").value().channel == 12);
    for (const auto* bad : { "", "=", "mix.out", "mix.out=", "=3", "mix.out=0", "mix.out=65", "mix.out=1.5", "mix.out=1@", "mix.out=1@4 mm", "mix.out=1@-4",
                             "mix.out=99999999999" })
    {
        const auto wrong = parseRoute (bad);
        REQUIRE_FALSE (wrong);
        CHECK (wrong.error().id == "audio/route");
    }
    test::property ("any text", [] (const std::string& text) { static_cast<void> (parseRoute (text)); });

    const std::vector<std::string> types { "JACK", "ALSA" };
    CHECK (parseCard ("jack", types) == CardRequest { .type = "JACK", .output = "", .input = "" });
    CHECK (parseCard ("ALSA:DualSense, USB", types) == CardRequest { .type = "ALSA", .output = "DualSense, USB", .input = "" });
    CHECK (parseCard ("DualSense", types) == CardRequest { .type = "", .output = "DualSense", .input = "" });
    CHECK (parseCard ("hw:2", types) == CardRequest { .type = "", .output = "hw:2", .input = "" });
}

TEST_CASE ("a role uses the channels in its description, or else the channels of its nodes", "[audio]")
{
    Messages messages;
    const auto role = readAudioRole (
        Json::parse (R"({ "driver": "audio", "outputs": [ { "channel": 3, "full_scale": "4 N" } ], "inputs": [ { "channel": 1, "full_scale": "20 m/s2" } ] })"),
        messages);
    CHECK (messages.empty());
    REQUIRE (role.outputs.size() == 1);
    CHECK (role.outputs[0].channel == 3);
    CHECK (role.inputs[0].full_scale.value == 20.0);

    CHECK (checkAudio ({ { "driver", "audio" } }).empty());   // it gets the channels that its graph uses
    CHECK (test::has (checkAudio ({ { "driver", "audio" }, { "outputs", 3 } }), "device/kind"));
    CHECK (test::has (checkAudio ({ { "driver", "audio" }, { "outputs", Json::array() }, { "guard", { { "max_signal", "x" } } } }), "device/unit"));
    CHECK (test::has (makeDevice ({ { "driver", "audio" } }, {}).messages, "device/real"));

    const auto guarded = [] (const char* limit) {
        return checkAudio (Json::parse (R"({ "driver": "audio", "outputs": [ { "channel": 1, "full_scale": "4 N" } ], "guard": { "max_signal": )"
                                        + std::string (limit) + " } }"));
    };
    CHECK (guarded ("3").empty());
    CHECK (guarded (R"("300 mN")").empty());
    CHECK (test::has (guarded (R"("3 m/s2")"), "device/unit"));
    CHECK (guarded (R"(3, "max_signal_slew": 5000)").empty());
    CHECK (guarded (R"(3, "max_signal_slew": "5 kN/s")").empty());
    CHECK (test::has (guarded (R"(3, "max_signal_slew": "5 kN")"), "device/unit"));
    CHECK (test::has (guarded (R"(3, "max_signal_slew": "5 N/s")"), "device/slow_stop"));

    const auto plan = test::Sketch {}.node ("a", "device.signal_out", Json::object(), { { "channel", 3 } }).node ("b", "device.signal_in").compile().plan;
    REQUIRE (plan);
    const auto full = withChannels ({ { "driver", "audio" } }, *plan, "stylus");
    CHECK (full["outputs"].size() == 3);
    CHECK (full["outputs"][2]["channel"] == 3);
    CHECK (full["inputs"].size() == 1);
    CHECK (withChannels ({ { "driver", "audio" }, { "outputs", Json::array() } }, *plan, "stylus")["outputs"].empty());
}

TEST_CASE ("an option binds a role to the sound card, or to a named card, without the calibration of the graph", "[audio]")
{
    const std::vector<std::pair<std::string, Json>> described { { "shaker", { { "driver", "audio" }, { "outputs", { { { "channel", 3 } } } } } } };
    const auto of = [&] (const char* text) { return parseDeviceOption (text, described, {}).value().description; };
    CHECK (of ("shaker=audio") == Json { { "driver", "audio" } });
    CHECK (of ("shaker=audio:JACK:system") == Json { { "driver", "audio" }, { "card", "JACK:system" } });
    CHECK (of ("stylus=audio") == Json { { "driver", "audio" } });
    CHECK (of ("shaker=sim")["signal_outputs"] == 1);
}
