// SPDX-License-Identifier: MIT
#include <support/temporary_folder.hpp>
#include <tactus/run/device/gestures.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/device/sim.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>

using namespace tactus;

namespace
{
using Described = std::vector<std::pair<std::string, Json>>;

MadeDevice made (const std::string& json, const std::filesystem::path& folder = {}) { return makeDevice (Json::parse (json), folder); }

const Simulation& simulationOf (const MadeDevice& m)
{
    const auto* sim = dynamic_cast<const SimulatedDevice*> (m.device.get());
    REQUIRE (sim != nullptr);
    return sim->simulation();
}

/// "id where" of every message, in order.
std::vector<std::string> found (const MadeDevice& m)
{
    std::vector<std::string> out;
    for (const auto& message : m.messages)
        out.push_back (message.id + " " + message.where);
    return out;
}

DeviceOption optionOf (std::string_view text, const Described& described = {})
{
    auto option = parseDeviceOption (text, described, "graphs");
    if (! option) FAIL (option.error().text);
    return *option;
}

Message refused (std::string_view text)
{
    const auto option = parseDeviceOption (text, {}, {});
    REQUIRE_FALSE (option);
    return option.error();
}
}   // namespace

TEST_CASE ("device description: units are read and converted", "[host][devices]")
{
    const auto m = made (R"({"driver": "sim", "mass": "50 g", "damping": 2.0, "quantum": "10 um", "force_quantum": "1 mN", "delay": 2,
        "coulomb": "40 mN", "first_mode": "0.4 kHz", "first_mode_damping": 0.1, "end_mass": "20 g",
        "position": [0, "2 mm", 0.01], "velocity": ["0.1 m/s", 0, 0], "rotation": [0, 0, "180 deg"],
        "hand_force": [0, 0, "-0.5 N"], "hand": {"stiffness": "0.1 N/mm", "damping": 2.0, "path": "stroke"},
        "guard": {"max_force": "3.3 N", "max_torque": "20 N*mm", "max_slew": "0.5 kN/s", "ramp": "0.2 s", "watchdog": "20 ms"}})");
    REQUIRE (m.messages.empty());

    const auto& sim = simulationOf (m);
    CHECK (sim.mass == Approx (0.05));
    CHECK (sim.damping == 2.0);
    CHECK (sim.quantum == Approx (1e-5));
    CHECK (sim.force_quantum == Approx (1e-3));
    CHECK (sim.delay == 2);
    CHECK (sim.coulomb == Approx (0.04));
    CHECK (sim.first_mode == Approx (400.0));
    CHECK (sim.first_mode_damping == 0.1);
    CHECK (sim.end_mass == Approx (0.02));
    CHECK ((sim.position - Vec3 (0, 0.002, 0.01)).norm() < 1e-15);
    CHECK (sim.velocity.x() == Approx (0.1));
    CHECK (sim.rotation.z() == Approx (3.14159265358979));
    CHECK (sim.hand_force.z() == Approx (-0.5));
    CHECK (sim.hand.stiffness == Approx (100.0));
    CHECK (m.device->duration() == findGesture ("stroke")->duration_s);

    CHECK (m.limits.max_force == Approx (3.3));
    CHECK (m.limits.max_torque == Approx (0.02));
    CHECK (m.limits.max_slew == Approx (500.0));
    CHECK (m.limits.ramp == Approx (0.2));
    CHECK (m.limits.watchdog == Approx (0.02));
    CHECK (m.about == "A simulated tool of 0.05 kg with a damping of 2 N*s/m, in a hand that follows stroke.");
}

TEST_CASE ("device description: a simulated device needs only its driver, and has no guard limits", "[host][devices]")
{
    const auto m = made (R"({"driver": "sim"})");
    REQUIRE (m.messages.empty());
    CHECK (simulationOf (m).mass == 0.1);
    CHECK (simulationOf (m).damping == 1.0);
    CHECK (m.limits == GuardLimits {});
    CHECK (m.device->duration() == 0.0);
    CHECK (m.about.ends_with ("without a hand."));
}

TEST_CASE ("device description: the tool starts in the hand, unless it has its own position", "[host][devices]")
{
    const Vec3 start = findGesture ("circle")->position (0.0);
    CHECK (simulationOf (made (R"({"driver": "sim", "hand": {"path": "circle"}})")).position == start);
    const auto moved = made (R"({"driver": "sim", "hand": {"path": "circle", "offset": [0, 0, 1], "scale": 2}})");
    CHECK (simulationOf (moved).position == Vec3 (Vec3 (0, 0, 1) + 2 * start));
    CHECK (simulationOf (made (R"({"driver": "sim", "position": [0, 0, 0], "hand": {"path": "circle"}})")).position == Vec3 (0, 0, 0));
}

TEST_CASE ("device description: of thousands of problems, the first are listed", "[host][devices]")
{
    auto description = Json::object();
    description["driver"] = "sim";
    for (int i = 0; i < 300; ++i)
        description["k" + std::to_string (i)] = 1;
    const auto many = makeDevice (description, {});
    CHECK (many.device == nullptr);
    REQUIRE (many.messages.size() == 101);
    CHECK (many.messages.back().id == "device/unknown_key");
    CHECK (many.messages.back().text == "200 more keys here are not known");

    auto axes = Json::object();
    for (int i = 0; i < 3000; ++i)
        axes["Bad" + std::to_string (i)] = Json::object();
    const auto full = makeDevice (Json { { "driver", "sim" }, { "axes", axes } }, {});
    CHECK (full.device == nullptr);
    REQUIRE (full.messages.size() == 1001);
    CHECK (full.messages.back().id == "device/more");
}

TEST_CASE ("device description: all problems are reported together, each with its own place", "[host][devices]")
{
    const auto m = made (R"({"driver": "sim", "mass": 0, "damping": "-1 N*s/m", "quantum": "1 N", "delay": 1.5, "first_mode": [1], "dampign": 1,
        "position": [0, 0], "velocity": [0, "1 m", "fast"], "hand_force": "1 N", "hand": {"stifness": 5, "path": "strok"},
        "guard": {"max_force": -1, "watchdog": 0, "ramp": "1 m", "max_sped": 3}})");

    CHECK (m.device == nullptr);
    CHECK (found (m) == std::vector<std::string> {
               "device/out_of_range /mass",
               "device/out_of_range /damping",
               "device/unit /quantum",
               "device/kind /delay",
               "device/kind /first_mode",
               "device/unknown_gesture /hand/path",
               "device/unknown_key /hand/stifness",
               "device/kind /position",
               "device/unit /velocity/1",
               "device/unit /velocity/2",
               "device/kind /hand_force",
               "device/out_of_range /guard/max_force",
               "device/unit /guard/ramp",
               "device/out_of_range /guard/watchdog",
               "device/unknown_key /guard/max_sped",
               "device/unknown_key /dampign",
           });

    const auto remedy = [&] (std::string_view where) { return std::ranges::find (m.messages, where, &Message::where)->remedy; };
    CHECK (remedy ("/mass") == "it must be more than 0 kg");
    CHECK (remedy ("/quantum") == "write a number in m, or a string such as \"1 m\"");
    CHECK (remedy ("/dampign") == "did you mean 'damping'?");
    CHECK (remedy ("/hand/stifness") == "did you mean 'stiffness'?");
    CHECK (remedy ("/hand/path") == "did you mean 'stroke'?");
    CHECK (remedy ("/guard/max_sped").find ("max_speed") != std::string::npos);
}

TEST_CASE ("device description: every limit of the guard is read, with its unit", "[host][devices]")
{
    const auto m = made (R"({"driver": "sim", "guard": {"max_axis_effort": "200 N*mm", "max_axis_slew": "3 N*m/s", "max_signal": 0.5, "max_speed": "150 cm/s",
        "max_impulse": "4 N*s", "impulse_window": "2 s", "max_energy": "50 mJ", "energy_window": "500 ms", "dead_man_button": 3,
            "dead_man_pressure": "0.2 N"}})");
    REQUIRE (m.messages.empty());
    CHECK (m.limits == GuardLimits {
               .max_axis_effort = 0.2,
               .max_axis_slew = 3.0,
               .max_signal = 0.5,
               .max_speed = 1.5,
               .max_impulse = 4.0,
               .impulse_window = 2.0,
               .max_energy = 0.05,
               .energy_window = 0.5,
               .dead_man_pressure = 0.2,
               .dead_man_buttons = 8,
           });
    CHECK (made (R"({"driver": "sim", "guard": {"max_axis_effort": "2 N"}})").limits.max_axis_effort == 2.0);
}

TEST_CASE ("device description: an impossible limit is an error, and an unknown dead-man button lets no force through", "[host][devices]")
{
    const auto m = made (R"({"driver": "sim", "guard": {"max_axis_effort": "2 m", "max_speed": 0, "max_impulse": 1, "max_energy": "1 N",
        "energy_window": "0 s", "dead_man_button": "grip"}})");
    CHECK (found (m) == std::vector<std::string> {
               "device/unit /guard/max_axis_effort",
               "device/out_of_range /guard/max_speed",
               "device/missing /guard",
               "device/unit /guard/max_energy",
               "device/out_of_range /guard/energy_window",
               "device/unknown_button /guard/dead_man_button",
           });
    CHECK (m.messages.back().text == "the device has no button 'grip'; it has no buttons at all");
    CHECK (m.limits.dead_man_buttons == ~std::uint64_t { 0 });
    const auto foundFor = [] (const std::string& button) { return found (made (R"({"driver": "sim", "guard": {"dead_man_button": )" + button + "}}")); };
    CHECK (foundFor ("32") == std::vector<std::string> { "device/out_of_range /guard/dead_man_button" });
    CHECK (foundFor ("true") == std::vector<std::string> { "device/kind /guard/dead_man_button" });
}

TEST_CASE ("device description: a simulated device may have axes in addition to the tool, and signals", "[host][devices]")
{
    const auto m = made (R"({"driver": "sim", "axes": {"trigger": {"mass": "20 g", "damping": 0.5, "stiffness": "0.2 N/mm", "position": "1 mm",
        "hand_force": "1 N"}, "wheel": {}}, "signal_outputs": 2})");
    REQUIRE (m.messages.empty());
    const DeviceLayout parts { .axes = { "trigger", "wheel" }, .efforts = { "trigger", "wheel" }, .signal_outputs = 2, .mechanics = { 0.1, 1.0 } };
    CHECK (m.device->layout() == parts);
    const auto& trigger = simulationOf (m).axes.at (0);
    CHECK (trigger.mass == Approx (0.02));
    CHECK (trigger.stiffness == Approx (200.0));
    const auto wrong = made (R"({"driver": "sim", "axes": {"Left": {}, "a": {"mass": 0, "spring": 1}, "b": 3}, "signal_outputs": -1})");
    CHECK (found (wrong) == std::vector<std::string> {
               "device/name /axes/Left",
               "device/out_of_range /axes/a/mass",
               "device/unknown_key /axes/a/spring",
               "device/kind /axes/b",
               "device/out_of_range /signal_outputs",
           });
    CHECK (found (made (R"({"driver": "sim", "axes": []})")) == std::vector<std::string> { "device/kind /axes" });
}

TEST_CASE ("device description: for an unknown gesture, the message lists the gestures", "[host][devices]")
{
    const auto m = made (R"({"driver": "gesture", "path": "handshake"})");
    REQUIRE (found (m) == std::vector<std::string> { "device/unknown_gesture /path" });
    for (const auto& gesture : gestures())
        CHECK (m.messages[0].remedy.find (gesture.id) != std::string::npos);
}

TEST_CASE ("device description: any JSON is either accepted or refused", "[host][devices]")
{
    CHECK (found (made ("[]")) == std::vector<std::string> { "device/kind " });
    CHECK (found (made ("null")) == std::vector<std::string> { "device/kind " });
    CHECK (found (made ("{}")) == std::vector<std::string> { "device/missing " });
    CHECK (found (made (R"({"driver": 3})")) == std::vector<std::string> { "device/kind /driver" });
    CHECK (found (made (R"({"driver": "sym"})")) == std::vector<std::string> { "device/unknown_driver /driver" });
    CHECK (found (made (R"({"driver": "trace"})")) == std::vector<std::string> { "device/missing " });
    CHECK (found (made (R"({"driver": "gesture", "path": ""})")) == std::vector<std::string> { "device/kind /path" });
    CHECK (found (made (R"({"driver": "sim", "hand": 5})")) == std::vector<std::string> { "device/kind /hand", "device/missing /hand" });
    CHECK (found (made (R"({"driver": "sim", "hand": {"path": 5}})")) == std::vector<std::string> { "device/kind /hand/path" });
    CHECK (found (made (R"({"driver": "sim", "delay": -1, "a/b~c": 0, "guard": []})")) == std::vector<std::string> {
               "device/out_of_range /delay",
               "device/kind /guard",
               "device/unknown_key /a~1b~0c",
           });
    CHECK (found (made (R"({"driver": "sim", "ui": {"x": 1}, "about": "mine"})")).empty());

    Json infinite { { "driver", "sim" }, { "mass", std::numeric_limits<double>::infinity() }, { "damping", std::numeric_limits<double>::quiet_NaN() } };
    CHECK (found (makeDevice (infinite, {})) == std::vector<std::string> { "device/out_of_range /mass", "device/out_of_range /damping" });
}

TEST_CASE ("device description: a trace is read from the graph's folder, then moved and scaled as described", "[host][devices]")
{
    const TemporaryFolder folder;
    folder.write ("pen.csv", "t,x,y,z\n0,1,2,3\n0.5,4,5,6\n");

    auto m = made (R"({"driver": "trace", "path": "pen.csv", "offset": ["1 m", 0, 0], "scale": 2})", folder.path());
    REQUIRE (m.messages.empty());
    m.device->prepare (0.5);
    CHECK (m.device->read().position == Vec3 (3, 4, 6));
    CHECK (m.device->duration() == 1.0);

    m = made (R"({"driver": "sim", "hand": {"path": "pen.csv"}})", folder.path());
    REQUIRE (m.messages.empty());
    CHECK (simulationOf (m).hand.path->at (0.25).position == Vec3 (2.5, 3.5, 4.5));
}

TEST_CASE ("device description: a problem in a trace is reported at the key that names the file", "[host][devices]")
{
    const TemporaryFolder folder;
    folder.write ("backwards.csv", "t,x,y,z\n1,0,0,0\n0,0,0,0\n");
    folder.write ("words.csv", "t,x,y,z\n1,0,here,0\n");

    const auto backwards = made (R"({"driver": "trace", "path": "backwards.csv"})", folder.path());
    CHECK (found (backwards) == std::vector<std::string> { "trace/time_order /path" });
    CHECK (backwards.messages.at (0).text.starts_with ("backwards.csv, row 2: "));

    CHECK (found (made (R"({"driver": "sim", "hand": {"path": "words.csv"}})", folder.path())) == std::vector<std::string> { "csv/not_a_number /hand/path" });
    CHECK (found (made (R"({"driver": "trace", "path": "nowhere.csv"})", folder.path())) == std::vector<std::string> { "csv/unreadable /path" });
}

TEST_CASE ("the option --device: a role is bound to a gesture, a recording, a file or a simulation", "[host][devices]")
{
    CHECK (optionOf ("stylus=gesture:tap").description == Json { { "driver", "gesture" }, { "path", "tap" } });
    CHECK (optionOf ("stylus=trace:runs/a=b.csv").description == Json { { "driver", "trace" }, { "path", "runs/a=b.csv" } });
    CHECK (optionOf ("stylus=trace:a.csv").folder.empty());
    CHECK (optionOf ("finger_2=sim").role == "finger_2");

    const TemporaryFolder folder;
    folder.write ("omni.json", R"({"driver": "sim", "hand": {"path": "pen.csv"}})");
    const auto option = optionOf ("stylus=" + (folder / "omni.json").string());
    CHECK (option.description["hand"]["path"] == "pen.csv");
    CHECK (option.folder == folder.path());
}

TEST_CASE ("the option --device ROLE=sim: uses those parts of the graph's own description that apply to a simulation", "[host][devices]")
{
    const Described described { { "stylus", { { "driver", "hid" }, { "vendor", 1133 }, { "mass", "45 g" }, { "guard", { { "max_force", 3 } } } } } };

    const auto own = optionOf ("stylus=sim", described);
    CHECK (own.description == Json { { "driver", "sim" }, { "mass", "45 g" }, { "guard", { { "max_force", 3 } } } });
    CHECK (own.folder == "graphs");

    const auto other = optionOf ("thumb=sim", described);
    CHECK (other.description == defaultDevice());
    const auto m = makeDevice (other.description, {});
    CHECK (m.messages.empty());
    CHECK (m.device->duration() > 0.0);
}

TEST_CASE ("a graph never chooses a real device: its role gets a tool at rest, and the message has the option to use", "[host][devices]")
{
    const auto of = [] (const Json& description, Messages& messages) { return describedByGraph (&description, "stylus", messages); };
    const auto optionIn = [&] (const Json& description) {
        Messages messages;
        const auto used = of (description, messages);
        CHECK (isSimulated (used));
        CHECK_FALSE (isSimulated (description));
        CHECK_FALSE (used.contains ("calibration"));
        CHECK_FALSE (used.contains ("guard"));   // the run applies it
        const auto made = makeDevice (used, {});
        CHECK (made.messages.empty());
        CHECK (made.device->duration() == 0.0);
        REQUIRE (messages.size() == 1);
        CHECK (messages[0].id == "device/not_by_graph");
        CHECK (messages[0].severity == Message::Severity::warning);
        CHECK (messages[0].where == "/devices/stylus/driver");
        const auto at = messages[0].remedy.find ("--device ");
        REQUIRE (at != std::string::npos);
        return messages[0].remedy.substr (at, messages[0].remedy.find (" to `") - at);
    };
    const auto hid = [] (const Json& profile) { return Json { { "driver", "hid" }, { "profile", profile }, { "calibration", { { "full_force", "1 mN" } } } }; };
    CHECK (optionIn (hid ("pid")) == "--device stylus=hid:pid");
    CHECK (optionIn (hid ("tactus_board")) == "--device stylus=hid:tactus_board");
    CHECK (optionIn ({ { "driver", "hid" } }) == "--device stylus=hid:auto");
    CHECK (optionIn (hid ("x; rm -rf ~")) == "--device stylus=hid:auto");   // people copy the line
    CHECK (optionIn (hid (3)) == "--device stylus=hid:auto");
    CHECK (optionIn ({ { "driver", "audio" }, { "card", "$(reboot)" }, { "outputs", Json::array ({ Json::object() }) } }) == "--device stylus=audio");

    Messages none;
    for (const auto& simulated : { Json { { "driver", "sim" }, { "mass", 1.0 } }, Json { { "driver", "gesture" }, { "path", "tap" } },
                                   Json { { "driver", "trace" }, { "path", "a.csv" } } })
    {
        CHECK (isSimulated (simulated));
        CHECK (of (simulated, none) == simulated);
    }
    CHECK (describedByGraph (nullptr, "stylus", none) == Json { { "driver", "sim" } });
    CHECK (none.empty());

    // Whatever is not in the list of simulated drivers is refused, also what may become the driver of a real device later.
    const Json unknown[] { "websocket", "HID", "hid ", "tcp://10.0.0.1", "bridge", "pid", "", 1, Json() };
    for (const auto& driver : unknown)
    {
        const Json description { { "driver", driver }, { "path", "/dev/ttyACM0" } };
        CAPTURE (description);
        CHECK_FALSE (isSimulated (description));
        Messages messages;
        CHECK_FALSE (makeDevice (of (description, messages), {}).device);
    }
}

TEST_CASE ("the option --device: a real device takes nothing from the graph", "[host][devices]")
{
    const Described described { { "stylus", { { "driver", "hid" }, { "profile", "pid" }, { "calibration", { { "full_force", "1 mN" } } }, { "serial", "7" } } },
                                { "shaker", { { "driver", "audio" }, { "outputs", { { { "channel", 3 }, { "full_scale", "1 mN" }, { "gain", 1000 } } } } } } };
    CHECK (optionOf ("stylus=hid:auto", described).description == Json { { "driver", "hid" }, { "profile", "auto" } });
    CHECK (optionOf ("stylus=hid:pid", described).description == Json { { "driver", "hid" }, { "profile", "pid" } });
    CHECK (optionOf ("shaker=audio", described).description == Json { { "driver", "audio" } });
    CHECK (optionOf ("shaker=audio:JACK:system", described).description == Json { { "driver", "audio" }, { "card", "JACK:system" } });
}

TEST_CASE ("the option --device: unreadable text is refused with a list of the valid forms", "[host][devices]")
{
    for (const char* text : { "", "stylus", "=sim", "Stylus=sim", "a.b=sim", "stylus=", "stylus=simulation", "stylus=trace",
                              "stylus=trace:", "stylus=gesture:" })
    {
        CAPTURE (text);
        const auto message = refused (text);
        CHECK (message.id == "device/option");
        CHECK (message.remedy.find ("ROLE=gesture:NAME") != std::string::npos);
    }

    const TemporaryFolder folder;
    folder.write ("broken.json", "{\"driver\": }");
    CHECK (refused ("stylus=" + (folder / "broken.json").string()).id == "device/syntax");
    CHECK (refused ("stylus=" + (folder / "none.json").string()).id == "device/unreadable");
}

TEST_CASE ("device description: the end must be lighter than the whole device, and the keys of the first mode need a first mode", "[host][devices]")
{
    CHECK (found (made (R"({"driver": "sim", "mass": "50 g", "first_mode": 30, "end_mass": "50 g"})"))
           == std::vector<std::string> { "device/out_of_range /end_mass" });
    CHECK (found (made (R"({"driver": "sim", "first_mode": 30, "first_mode_damping": 1.5})"))
           == std::vector<std::string> { "device/out_of_range /first_mode_damping" });
    CHECK (found (made (R"({"driver": "sim", "end_mass": "20 g"})")) == std::vector<std::string> { "device/missing /end_mass" });
    CHECK (found (made (R"({"driver": "sim", "first_mode_damping": 0.1})")) == std::vector<std::string> { "device/missing /first_mode_damping" });
    CHECK (found (made (R"({"driver": "sim", "coulomb": "-1 N"})")) == std::vector<std::string> { "device/out_of_range /coulomb" });
}
