// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "host/devices/hid_link/fake_board.hpp"
#include "support/temporary_folder.hpp"

#include <host/app/devices_panel/devices_panel.hpp>

#include <thread>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using tactus::test::BoardProfile;
using tactus::test::boardReport;
using tactus::test::eventually;
using tactus::test::FakeBoard;

namespace
{
struct Rig
{
    Rig()
    {
        setup.open (home.path());
        run.use (setup);
        setup.onChange = [this] { run.setupChanged(); };
        panel.bindings().onHint = [this] (const juce::String& text) { hint = text; };
        panel.setSize (1000, 300);
        panel.setVisible (true);
    }

    template <typename F>
    bool until (F&& isSo)
    {
        return eventually ([&] {
            run.poll();
            panel.refresh();
            return isSo();
        });
    }

    Json saved() const { return Json::parse (home.textOf ("session.json")); }
    Json bound() const
    {
        const auto* now = setup.session().session.binding ("stylus");
        return now != nullptr ? *now : Json();
    }

    TemporaryFolder home;
    FakeBoard board;
    hid::LoadedProfiles profiles { .profiles = { BoardProfile { .watchdog = 0.02 }.make() }, .messages = {} };
    DeviceSetup setup { board, profiles };
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun run { rig.document, catalogue() };
    DevicesPanel panel { rig.document, run, setup };
    juce::String hint;
};

std::vector<std::string> labelsOf (const std::vector<BindingChoice>& choices)
{
    std::vector<std::string> all;
    for (const auto& c : choices)
        all.push_back (c.label);
    return all;
}
}   // namespace

TEST_CASE ("binding a role in the window is saved immediately, and does not edit the graph", "[app][sessions]")
{
    Rig r;
    const auto before = r.rig.text();
    REQUIRE (r.until ([&] { return ! r.setup.connected().empty() && r.panel.cards() == 3; }));   // the clock, the stylus, and the sound card
    REQUIRE (r.until ([&] {
        r.panel.bindings().bind ("stylus", "Board");
        return ! r.bound().is_null();
    }));
    CHECK (r.bound() == Json { { "driver", "hid" }, { "profile", "board" } });
    CHECK (r.saved()["roles"]["stylus"] == r.bound());

    r.panel.bindings().setPart ("stylus", "/workspace/scale", "2");
    r.panel.bindings().setPart ("stylus", "/workspace/offset", "[0, 0, \"1 cm\"]");
    r.panel.bindings().setPart ("stylus", "/guard/max_force", "2 N");
    CHECK (r.hint.isEmpty());
    const Json workspace { { "scale", 2 }, { "offset", { 0, 0, "1 cm" } } }, guard { { "max_force", "2 N" } };
    CHECK (r.saved()["roles"]["stylus"] == Json { { "driver", "hid" }, { "profile", "board" }, { "workspace", workspace }, { "guard", guard } });

    const auto [pointer, text] = GENERATE (table<std::string, std::string> ({
        { "/workspace/scale", "0" },
        { "/workspace/scale", "wide" },
        { "/workspace/offset", "[1, 2]" },
        { "/guard/max_force", "2 mm" },
    }));
    const auto good = r.home.textOf ("session.json");
    r.panel.bindings().setPart ("stylus", pointer, text);
    CHECK (r.hint.isNotEmpty());
    CHECK (r.home.textOf ("session.json") == good);

    for (const auto* part : { "/workspace/scale", "/workspace/offset", "/guard/max_force" })
        r.panel.bindings().setPart ("stylus", part, "");
    CHECK (r.bound() == Json { { "driver", "hid" }, { "profile", "board" } });
    r.panel.bindings().bind ("stylus", "gesture tap");
    CHECK (r.bound() == Json { { "driver", "gesture" }, { "path", "tap" } });
    r.panel.bindings().bind ("stylus", "as in the graph");
    CHECK (r.bound().is_null());
    CHECK (r.rig.text() == before);
    CHECK (r.rig.document.history().position() == 7);   // three devices, and the edits of the workspace
    CHECK_FALSE (r.rig.document.isChanged());
}

TEST_CASE ("a run uses the bound device, is ticked by it, and restarts when the binding changes", "[app][sessions]")
{
    Rig r;
    REQUIRE (r.setup.edit ([] (DeviceSession& s) {
        const Json workspace { { "scale", 2 }, { "offset", { 0, 0, "1 cm" } } };
        s.bind ("stylus", { { "driver", "hid" }, { "profile", "board" }, { "workspace", workspace } });
    }));
    std::atomic<bool> sends = true;
    std::jthread reports { [&] (const std::stop_token& over) {
        for (std::uint16_t n = 0; ! over.stop_requested(); tactus::test::letPass (std::chrono::milliseconds (1)))
            if (sends) r.board.send (boardReport (++n, 1'000'000, 0, -10'000'000));
    } };
    r.run.start ({});
    REQUIRE (r.run.isRunning());
    CHECK (r.run.clockRole() == "stylus");
    CHECK (r.run.rate() == 1000.0);
    CHECK (r.run.mostForce() == 3.0);
    CHECK (r.until ([&] { return r.run.tool() && (r.run.tool()->position - Vec3 (0.002, 0.0, -0.01)).norm() < 1e-12 && r.run.tool()->force.norm() > 0.1; }));
    CHECK (r.until ([&] { return ! r.run.health().empty() && r.run.health().front().rate_hz && r.run.health().front().ticks; }));

    // An edit of the graph keeps the device open.
    const auto openings = r.board.openings();
    r.rig.document.perform (graph::SetParam { "", "drag", "mu", 0.3 });
    CHECK (r.run.rate() == 1000.0);
    CHECK (r.board.openings() == openings);

    sends = false;
    CHECK (r.until ([&] { return r.run.status()->clock_replaced && r.run.status()->force == 0.0; }));
    sends = true;
    CHECK (r.until ([&] { return ! r.run.status()->clock_replaced && r.run.status()->force > 0.1; }));

    REQUIRE (r.setup.edit ([] (DeviceSession& s) { s.bind ("stylus", { { "driver", "gesture" }, { "path", "tap" } }); }));
    CHECK (r.until ([&] { return r.run.isRunning() && r.run.rate() == 4000.0 && r.run.clockRole().empty(); }));
    r.run.letGo();
    CHECK (r.run.health().empty());
}

TEST_CASE ("a run in the window waits for a missing device, and the mouse can take the role meanwhile", "[app][sessions]")
{
    Rig r;
    r.board.plug (false);
    REQUIRE (r.setup.edit ([] (DeviceSession& s) {
        s.bind ("stylus", { { "driver", "hid" }, { "profile", "board" } });
        s.setClock ("stylus");
    }));
    r.run.start ({});
    REQUIRE (r.run.isRunning());
    CHECK (r.until ([&] { return r.run.status()->clock_replaced && ! r.run.health().empty() && ! r.run.health().front().has_come; }));
    CHECK (r.run.status()->peak == 0.0);

    r.run.start (LiveRun::Hand::pointer());
    CHECK (r.until ([&] { return r.run.isRunning() && r.run.clockRole().empty() && r.run.rate() == 4000.0; }));
    CHECK (r.run.health().empty());
    r.run.letGo();
}

TEST_CASE ("a joystick without a profile is chosen and calibrated in the window, and the session keeps it", "[app][sessions]")
{
    hid::ConnectedDevice stick;
    stick.product = "Stick";
    stick.serial = "J1";
    const Json chosen { { "driver", "hid" }, { "profile", "pid" }, { "serial", "J1" } };
    const std::vector<hid::ConnectedDevice> there { stick };
    const auto choices = bindingChoices (nullptr, there, {}, there);
    CHECK (std::ranges::count_if (choices, [&] (const BindingChoice& c) { return c.description == chosen && c.label.starts_with ("Stick"); }) == 1);

    Rig r;
    const auto before = r.rig.text();
    REQUIRE (r.setup.edit ([&] (DeviceSession& s) { s.bind ("stylus", chosen); }));
    r.panel.bindings().setPart ("stylus", "/calibration/full_force", "4 N");
    r.panel.bindings().setPart ("stylus", "/calibration/travel", "{\"x\": \"12 cm\"}");
    r.panel.bindings().setPart ("stylus", "/calibration/reversed", "true");
    const Json calibration { { "full_force", "4 N" }, { "travel", { { "x", "12 cm" } } }, { "reversed", true } };
    CHECK (r.saved()["roles"]["stylus"]["calibration"] == calibration);
    CHECK (r.hint.isEmpty());
    r.panel.bindings().setPart ("stylus", "/calibration/full_force", "4 mm");
    CHECK (r.hint.isNotEmpty());
    CHECK (r.bound()["calibration"] == calibration);
    CHECK (deviceOfBinding (r.bound()) == chosen);   // so that the panel shows the choice
    CHECK (r.rig.text() == before);
}

TEST_CASE ("the driver of a plugin keeps its keys, and only the channels and the calibration of other devices are no part of a choice", "[app][sessions]")
{
    const Json device { { "driver", "serial_arm" }, { "port", "a" }, { "calibration", "b" }, { "outputs", 2 } };
    auto binding = device;
    binding["guard"] = { { "max_force", "1 N" } };
    CHECK (deviceOfBinding (binding) == device);
    CHECK (deviceOfBinding ({ { "driver", "audio" }, { "outputs", Json::array() } }) == Json { { "driver", "audio" } });
}

TEST_CASE ("the choices for a role include connected devices, with serial numbers if two are alike", "[app][sessions]")
{
    FakeBoard board;
    const hid::LoadedProfiles profiles { .profiles = { BoardProfile { .watchdog = 0.02 }.make() }, .messages = {} };
    auto there = board.connected();
    auto labels = labelsOf (bindingChoices (nullptr, there, profiles));
    CHECK (labels.front() == "as in the graph");
    CHECK (std::ranges::count (labels, "Board") == 1);

    there.push_back (there.front());
    there.back().path = "fake/1";
    there.back().serial = "S2";
    labels = labelsOf (bindingChoices (nullptr, there, profiles));
    CHECK (std::ranges::count (labels, "Board, serial S1") == 1);
    CHECK (std::ranges::count (labels, "Board, serial S2") == 1);

    const Json away { { "driver", "hid" }, { "profile", "board" }, { "serial", "S9" }, { "guard", { { "max_force", 1 } } } };
    CHECK (labelsOf (bindingChoices (&away, there, profiles)).back() == "hid board, serial S9");
    const Json here { { "driver", "hid" }, { "profile", "board" }, { "serial", "S2" }, { "workspace", { { "scale", 2 } } } };
    CHECK (bindingChoices (&here, there, profiles).size() == labels.size());
}

TEST_CASE ("a device that is known only by its numbers can be simulated, keeps the limits of the binding, and is named as simulated", "[app][sessions]")
{
    const auto labels = labelsOf (bindingChoices (nullptr, {}, deviceProfiles()));
    CHECK (std::ranges::count (labels, "simulated PHANTOM 1.0") == 1);
    CHECK (std::ranges::count (labels, "simulated Pantograph Mk-II") == 1);
    CHECK (std::ranges::count (labels, "PHANTOM 1.0") == 0);

    Rig r;
    r.profiles.profiles.push_back (hid::profileNamed (deviceProfiles(), "phantom_1_0"));
    r.panel.visibilityChanged();
    r.panel.bindings().bind ("stylus", "simulated tool");
    r.panel.bindings().setPart ("stylus", "/guard/max_force", "1 N");
    r.panel.bindings().setPart ("stylus", "/guard/max_speed", "1 m/s");
    r.panel.bindings().bind ("stylus", "simulated PHANTOM 1.0");
    CHECK (r.bound()["driver"] == "sim");
    CHECK (r.bound()["mass"].get<double>() == Approx (0.075));
    CHECK (r.bound()["guard"] == Json { { "max_force", "1 N" }, { "max_speed", "1 m/s" } });   // stricter than the device's own 8.5 N
    CHECK (r.hint == "The limit of before, 1.00 N, stays: PHANTOM 1.0 could give 8.50 N. \"max force\" changes it");
    r.hint.clear();

    r.panel.bindings().setPart ("stylus", "/guard/max_force", "");
    r.panel.bindings().bind ("stylus", "simulated tool");
    r.panel.bindings().bind ("stylus", "simulated PHANTOM 1.0");
    CHECK (r.bound()["guard"]["max_force"].get<double>() == Approx (8.5));
    CHECK (r.hint.isEmpty());
    CHECK (bindingChoices (r.setup.session().session.binding ("stylus"), {}, r.profiles).size() == bindingChoices (nullptr, {}, r.profiles).size());
    r.run.start ({});
    CHECK (r.until ([&] { return r.run.isRunning() && r.run.mostForce() == 6.0; }));   // the graph allows no more
    r.run.letGo();
}
