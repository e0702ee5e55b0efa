// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <tactus/text/json.hpp>

#include <tactus/text/json_writer.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// A ribbed wall at 1 kHz.
std::string graphWith (const std::string& stiffness, const std::string& device = R"({ "driver": "gesture", "path": "stroke" })")
{
    return R"({ "format": "tactus-graph", "version": 1, "name": "wall", "rate_hz": 1000, "devices": { "tip": )" + device + R"( }, "nodes": {
        "hand": { "type": "device.position", "role": "tip" }, "motor": { "type": "device.force", "role": "tip" },
        "wall": { "type": "deform.plane", "params": { "stiffness": ")"
           + stiffness + R"(" } },
        "ribs": { "type": "texture.grating", "params": { "spatial_frequency": "100 1/m" } } },
        "wires": ["hand.position -> wall.position", "wall.force -> motor.force", "hand.position -> ribs.position", "ribs.force -> motor.force"] })";
}

const char* profile = R"({ "format": "tactus-profile", "version": 1, "id": "numbers", "name": "Numbers", "sources": ["made up"],
    "physics": { "mass": "75 g", "damping": { "value": "1 N*s/m", "guess": true }, "coulomb": "50 mN", "quantum": "10 um", "first_mode": "30 Hz",
                 "peak_force": "8.5 N" } })";

Json conditionOf (const Json& report, std::string_view id)
{
    for (const auto& c : report.at ("conditions").asArray())
        if (c.at ("id") == Json (id)) return c;
    return {};
}
}   // namespace

TEST_CASE ("`tactus check` says which condition a wall breaks, by how much, and what would help", "[check][cli]")
{
    Scratch scratch;
    const auto file = scratch.write ("wall.json", graphWith ("100 N/mm")), device = scratch.write ("numbers.json", profile);
    const auto ran = runTactus ({ "check", file, "--device", "tip=" + device });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.out.find ("tip on numbers: M 0.075 kg, B 1 N*s/m (guess)") != std::string::npos);
    CHECK (ran.out.find ("unstable    stiffness") != std::string::npos);
    CHECK (ran.out.find ("whatever the hand does: along the force of 'wall' a stiffness of at most 2000 N/m, a rate of at least 50000 Hz")
           != std::string::npos);
    CHECK (ran.out.find ("unknown     force_resolution") != std::string::npos);
}

TEST_CASE ("`tactus check` takes the name of a preset, and lists a texture that the hand does not reach", "[check][cli]")
{
    const auto preset = runTactus ({ "check", "granite_wall" });
    INFO (preset.out << preset.err);
    CHECK (preset.out.find ("granite_wall.json at ") != std::string::npos);
    CHECK (runTactus ({ "check", "granite_wal" }).err.find ("granite_wall") != std::string::npos);

    Scratch scratch;
    const auto still = R"({ "driver": "sim", "mass": "50 g", "damping": "1 N*s/m" })";
    const auto ran = runTactus ({ "check", scratch.write ("wall.json", graphWith ("100 N/m", still)) });
    INFO (ran.out << ran.err);
    CHECK (ran.out.find ("not reached reach             ribs") != std::string::npos);
    CHECK (ran.out.find ("would help: another motion of the hand: --sweep") != std::string::npos);
}

TEST_CASE ("`tactus check` judges an axis like a tool, and says first what it does not judge", "[check][cli]")
{
    Scratch scratch;
    const auto knob = [&] (const std::string& wires, const std::string& nodes = "") {
        return scratch.write ("knob.json", R"json({ "format": "tactus-graph", "version": 2, "name": "detents", "rate_hz": 1000,
            "devices": { "knob": { "driver": "sim", "mass": "50 g", "axes": { "slide": { "mass": "50 g", "damping": "1 N*s/m", "position": "0.2 mm" } } } },
            "nodes": { "p": { "type": "device.axis", "role": "knob", "settings": { "axis": "slide" } },
                       "law": { "type": "signal.expression", "settings": { "inputs": 1, "text": "-2*sin(2000*in0)" } },
                       "m": { "type": "device.effort", "role": "knob", "settings": { "axis": "slide" } })json"
                                               + nodes + R"json( },
            "wires": ["p.axis -> law.in[0]", )json"
                                               + wires + " ] }");
    };
    const auto stiff = runTactus ({ "check", knob (R"("law.out -> m.effort")"), "--json" });
    INFO (stiff.out << stiff.err);
    CHECK (stiff.status == 1);
    CHECK (conditionOf (Json::parse (stiff.out), "stiffness").at ("verdict") == Json ("unstable"));
    CHECK (conditionOf (Json::parse (stiff.out), "stiffness").at ("axis") == Json ("slide"));
    const auto soft = runTactus ({ "check", knob (R"({ "wire": "law.out -> m.effort", "gain": 0.2 })"), "--json" });
    INFO (soft.out << soft.err);
    CHECK (soft.status == 0);
    CHECK (conditionOf (Json::parse (soft.out), "stiffness").at ("verdict") == Json ("passive_here"));

    const auto both = knob (R"("law.out -> m.effort", "law.out -> turn.x", "turn.out -> wrist.torque")",
                            R"(, "turn": { "type": "vector.join" }, "wrist": { "type": "device.force", "role": "knob" })");
    const auto text = runTactus ({ "check", both }).out;
    INFO (text);
    CHECK (text.find ("not judged: of knob, torque of 'wrist'") < text.find ("stiffness"));
}

TEST_CASE ("`tactus check` says that a damper on a coarse sensor strikes the tool", "[check][cli]")
{
    Scratch scratch;
    const auto wall = [&] (const char* window) {
        return scratch.write ("wall.json", std::string (R"({ "format": "tactus-graph", "version": 2, "name": "wall", "rate_hz": 1000,
            "devices": { "h": { "driver": "sim", "mass": "100 g", "damping": "1 N*s/m", "quantum": "50 um", "coulomb": "0.03 N",
                "position": ["0 mm", "0 mm", "3 mm"],
                "hand": { "stiffness": "300 N/m", "damping": "3 N*s/m", "path": "press", "scale": 0.2, "offset": ["0 mm", "0 mm", "-4 mm"] } } },
            "nodes": { "p": { "type": "device.position", "role": "h" }, "m": { "type": "device.force", "role": "h" },
                "w": { "type": "deform.plane", "params": { "stiffness": "1 N/mm", "damping": "10 N*s/m" }, "settings": { "window": ")")
                                               + window + R"(" } } },
            "wires": ["p.position -> w.position", "w.force -> m.force"] })");
    };
    const auto report = Json::parse (runTactus ({ "check", wall ("0 s"), "--json" }).out);
    const auto blow = conditionOf (report, "blow");
    INFO (writeJson (report));
    CHECK (blow.at ("verdict") == Json ("broken"));
    CHECK (blow.at ("value").get<double>() == Approx (0.5).epsilon (1e-3));
    CHECK (blow.at ("text").asString().find ("b delta/T") != std::string::npos);
    CHECK (blow.at ("remedy").asString().find ("window") != std::string::npos);
    const auto smooth = conditionOf (Json::parse (runTactus ({ "check", wall ("20 ms"), "--json" }).out), "blow");
    CHECK (smooth.at ("value").get<double>() == Approx (0.025).epsilon (0.05));
    CHECK (smooth.at ("verdict") != Json ("broken"));
}

TEST_CASE ("`tactus check` calls the braked wall stable: its brake counts", "[check][cli]")
{
    const auto ran = runTactus ({ "check", "braked_wall", "--json" });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    CHECK (conditionOf (Json::parse (ran.out), "stiffness").at ("verdict") != Json ("unstable"));
}

TEST_CASE ("`tactus nodes` says which nodes claim to be passive", "[cli]")
{
    CHECK (runTactus ({ "nodes", "friction.elasto_plastic" }).out.find ("\nPassive: ") != std::string::npos);
    CHECK (runTactus ({ "nodes", "signal.lfo" }).out.find ("Passive") == std::string::npos);
}

TEST_CASE ("`tactus check --json` reports every condition, with the numbers of the device and their sources", "[check][cli]")
{
    Scratch scratch;
    const auto file = scratch.write ("wall.json", graphWith ("1 N/mm")), device = scratch.write ("numbers.json", profile);
    const auto ran = runTactus ({ "check", file, "--device", "tip=" + device, "--json", "--speed", "0.2" });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    const auto report = Json::parse (ran.out);
    CHECK (report.at ("broken") == Json (0));
    CHECK (report.at ("speed") == Json (0.2));
    const auto& role = report.at ("roles").at (0);
    CHECK (role.at ("device") == Json ("numbers"));
    CHECK (role.at ("stiffness").get<double>() == Approx (1000.0).epsilon (1e-3));
    CHECK (role.at ("numbers").at ("damping").at ("guess") == Json (true));
    CHECK (role.at ("numbers").at ("mass").at ("source").asString().size() > 3);
    CHECK (conditionOf (report, "stiffness").at ("value").get<double>() == Approx (0.5).epsilon (1e-3));
    CHECK (conditionOf (report, "stiffness").at ("margin").get<double>() == Approx (2.0).epsilon (1e-3));
    CHECK (conditionOf (report, "structural").at ("value").get<double>() == Approx (20.0));
    CHECK (conditionOf (report, "structural").at ("node") == Json ("ribs"));
    CHECK (conditionOf (report, "force_resolution").at ("limit").is_null());
    CHECK (runTactus ({ "check", file, "--device", "tip=" + device, "--speed", "0.31" }).status == 1);
}

TEST_CASE ("`tactus check` takes the numbers of a simulated device from the graph, and the rate and the factors from options", "[check][cli]")
{
    Scratch scratch;
    const auto file = scratch.write ("wall.json", graphWith ("3 N/mm", R"({ "driver": "sim", "mass": 0.1, "damping": 1, "hand": { "path": "stroke" } })"));
    CHECK (runTactus ({ "check", file }).status == 1);
    CHECK (runTactus ({ "check", file, "--rate", "2000" }).status == 0);
    CHECK (runTactus ({ "check", file, "--rate", "2000", "--alpha", "1e6", "--speed", "0.1" }).status == 1);
    CHECK (runTactus ({ "check", file, "--set", "wall.stiffness=1500" }).status == 0);
    CHECK (runTactus ({ "check", file, "--sweep" }).status == 1);
    CHECK (runTactus ({ "check", file, "--device", "tip=gesture:touch" }).status == 1);
}

TEST_CASE ("a texture that its graph fades out is judged at another speed as if it were felt there, and is not told to be faded out", "[check][cli]")
{
    const auto said = [] (const char* speed) { return runTactus ({ "check", "machined_steel", "--speed", speed }).out; };
    const auto fast = said ("3"), slow = said ("0.01");
    INFO (fast);
    CHECK (fast.find ("v 3 m/s, alpha 2, as if it were still felt at this speed, whatever 'slow' fades out") != std::string::npos);
    CHECK (fast.find ("or a texture.antialias\n") == std::string::npos);
    CHECK (slow.find ("whatever 'slow' fades out") == std::string::npos);
    const auto weave = runTactus ({ "check", "canvas_weave", "--speed", "2" }).out;   // two textures, each with its own: which is whose is not known
    INFO (weave);
    CHECK (weave.find ("whatever a texture.antialias fades out") != std::string::npos);
    CHECK (weave.find ("_slow' fades out") == std::string::npos);
}

TEST_CASE ("`tactus check` refuses a role, a profile and a file that do not exist", "[check][cli]")
{
    Scratch scratch;
    const auto file = scratch.write ("wall.json", graphWith ("1 N/mm"));
    const auto id = [&] (const std::string& device) {
        const auto ran = runTactus ({ "check", file, "--device", device });
        CHECK (ran.status == 1);
        return ran.err;
    };
    CHECK (id ("top=sim").find ("device/unknown_role") != std::string::npos);
    CHECK (id ("tip=tactus_bored").find ("did you mean 'tactus_board'") != std::string::npos);
    CHECK (id ("tip=missing.json").find ("device/unreadable") != std::string::npos);
}

TEST_CASE ("`tactus check` and `tactus limits` say what is wrong with the description of a device, instead of judging without its numbers", "[check][cli]")
{
    const Scratch scratch;
    const auto command = GENERATE (as<std::string> {}, "check", "limits");
    const auto key = GENERATE (as<std::string> {}, "quantum", "delay", "first_mode", "coulomb", "end_mass", "guard");
    const auto device = R"({ "driver": "sim", "mass": 0.1, "damping": 1, ")" + key + R"(": "5e-5 yd", "hand": { "path": "press" } })";
    const auto ran = runTactus ({ command, scratch.write ("wall.json", graphWith ("1 N/mm", device)) });
    INFO (command << ": " << ran.out << ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("wall.json:1:") != std::string::npos);
    CHECK (ran.err.find ("error: ") != std::string::npos);
    CHECK (ran.out.find ("broken") == std::string::npos);
}

TEST_CASE ("the profiles of PHANTOM and Pantograph limit the speed over a grating as the chapter says", "[check][cli]")
{
    Scratch scratch;
    struct Case
    {
        const char *device, *frequency, *slow, *fast;
    };
    const std::vector<Case> cases {
        { "phantom_1_0", "100 1/m", "0.299", "0.301" },
        { "phantom_1_0", "1000 1/m", "0.0299", "0.0301" },
        { "pantograph_mk2", "100 1/m", "3.99", "4.01" },
        { "pantograph_mk2", "1000 1/m", "0.399", "0.401" },
    };
    const auto file = scratch.write ("wall.json", graphWith ("100 N/m"));
    for (const auto& [device, frequency, slow, fast] : cases)
        for (const auto* speed : { slow, fast })
        {
            const auto ran = runTactus ({ "check", file, "--rate", "10000", "--json", "--speed", speed, "--device", std::string ("tip=") + device, "--set",
                                          std::string ("ribs.spatial_frequency=") + frequency });
            INFO (device << ' ' << frequency << ' ' << speed << ran.err);
            const auto verdict = conditionOf (Json::parse (ran.out), "structural").at ("verdict").asString();
            CHECK (verdict == (speed == slow ? "holds" : "broken"));
        }
}
