// SPDX-License-Identifier: GPL-3.0-or-later
// Sound cards on the command line, with a card that does not exist. ./test.sh --sound uses one that exists.

#include "program.hpp"

#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using test::runTactus;
using test::Scratch;

namespace
{
const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

bool holds (const std::string& text, const std::string& part) { return text.find (part) != std::string::npos; }

std::string errorOf (std::vector<std::string> more)
{
    std::vector<std::string> all { "play", wood, "--osc", "off", "--duration", "0.1" };
    all.insert (all.end(), more.begin(), more.end());
    const auto ran = runTactus (all);
    CHECK (ran.status == 1);
    return ran.err;
}
}   // namespace

TEST_CASE ("an audio option that cannot work is refused with a remedy", "[cli][audio]")
{
    const auto absent = errorOf ({ "--route", "drag.force.x=1@4 N", "--audio", "no such card" });
    CHECK (holds (absent, "audio/no_card"));
    CHECK (holds (absent, "'no such card'"));
    CHECK (holds (errorOf ({ "--clock", "audio", "--audio", "no such card" }), "audio/no_card"));
    CHECK (holds (errorOf ({ "--device", "stylus=audio:no such card" }), "audio/no_card"));
    CHECK (holds (errorOf ({ "--route", "drag.force.x" }), "audio/route"));
    CHECK (holds (errorOf ({ "--route", "drag.force.x=1@4 mm" }), "audio/route"));
    CHECK (holds (errorOf ({ "--route", "drag.force.x=1@\"4 N\"" }), "audio/route"));
    CHECK (holds (errorOf ({ "--route", "drag.forse.x=1" }), "did you mean 'force'?"));
    CHECK (holds (errorOf ({ "--route", "drag.force.x=1@20 m/s2" }), "audio/unit"));
    CHECK (holds (errorOf ({ "--device", "stylus=audio:one", "--audio", "another" }), "audio/two_cards"));
}

TEST_CASE ("a card on which nothing plays is not opened, and a warning says what is missing", "[cli][audio]")
{
    const std::vector<std::string> play { "play", wood, "--session", "off", "--osc", "off", "--duration", "0.1", "--device", "stylus=sim" };
    auto with_card = play;
    with_card.insert (with_card.end(), { "--audio", "no such card" });
    const auto unused = runTactus (with_card);
    CHECK (unused.status == 0);
    CHECK (holds (unused.err, "--audio no such card: warning: nothing in this run plays on a sound card"));
    CHECK (holds (unused.err, "--route PORT=CHANNEL"));
    CHECK (holds (unused.err, "audio/unused"));
    const auto none = runTactus (play);
    CHECK_FALSE (holds (none.err, "audio/unused"));
}

TEST_CASE ("a render uses no sound card, and a graph that names one is valid on any machine", "[cli][audio]")
{
    const auto refused = runTactus ({ "render", wood, "--duration", "1", "--device", "stylus=audio" });
    CHECK (refused.status == 1);
    CHECK (holds (refused.err, "device/real"));

    Scratch scratch;
    const auto graphWith = [&] (const std::string& outputs) {
        return scratch.write ("graph.json", R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
            "devices": { "shaker": { "driver": "audio", "outputs": )"
                                                + outputs + R"( } },
            "nodes": { "wave": { "type": "signal.lfo" }, "out": { "type": "device.signal_out", "role": "shaker" } }, "wires": ["wave.out -> out.in"] })");
    };
    CHECK (runTactus ({ "validate", graphWith (R"([ { "channel": 3, "full_scale": "4 N" } ])") }).status == 0);
    const auto unused = runTactus ({ "play", graphWith (R"([ { "channel": 0, "full_scale": "4 mm" } ])"), "--osc", "off", "--duration", "0.1" });
    CHECK (unused.status == 0);
    CHECK (holds (unused.err, "--device shaker=audio "));
    CHECK (holds (unused.err, "device/not_by_graph"));
}
