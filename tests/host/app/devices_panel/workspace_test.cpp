// SPDX-License-Identifier: GPL-3.0-or-later
// Where the hand is: a role's workspace in the Devices panel, and the box that its device can reach in the scene. The force steps nowhere.

#include "host/app/support/board_bench.hpp"
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/film_steps.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/devices_panel/axes_text.hpp>
#include <host/app/devices_panel/devices_panel.hpp>
#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::BoardBench;
using tactus::host::test::DeskRig;
using tactus::host::test::DeskStage;
using tactus::host::test::latestStep;
using tactus::host::test::OnStage;
using tactus::host::test::stepsChecked;

namespace
{
struct Bench final : BoardBench<DeskStage>
{
    explicit Bench (const char* preset = "dry_wood.json", std::string of = "stylus") : BoardBench (preset, std::move (of))
    {
        show<DevicesPanel> (devicesPanel);
        showHand();
        bind();
    }

    LiveRun& run() override { return playback.run(); }
    DevicesPanel& panel() override { return dynamic_cast<DevicesPanel&> (*DeskRig::panel->component); }
    SceneView& scene() { return hand->scene(); }

    void start()
    {
        playback.start ({});
        REQUIRE (isPushing());
    }

    /// A capture that never triggers ends with the run.
    void watchRun (const char* port)
    {
        const auto names = run().capture (port, port, { .level = 1e9 });
        REQUIRE (names);
    }
    bool isSameRun() { return run().isCapturing(); }

    bool says (const juce::String& text)
    {
        stage->wheel (stage->getLocalPoint (&panel(), juce::Point<float> (40.0f, 60.0f)), 100.0f, true);   // to its top
        settle();
        juce::StringArray words;
        for (const auto& seen : host::test::readTexts (panel()))
            words.addTokens (seen.text, false);
        return words.joinIntoString (" ").replace ("  ", " ").contains (text);
    }

    void type (const juce::String& label, const juce::String& text)
    {
        INFO (label);
        stage->click (middleOf (field (label)));
        settle();
        stage->type (text);
        key ("return");
        settle();
    }
};
}   // namespace

TEST_CASE ("axes are typed as three letters, or as rows of numbers", "[app][sessions]")
{
    CHECK (readAxesText ("y -x z") == Json { "y", "-x", "z" });
    CHECK (readAxesText ("+y, -x,z") == Json { "y", "-x", "z" });
    CHECK (readAxesText ("[\"y\", \"-x\", \"z\"]") == Json { "y", "-x", "z" });
    CHECK (readAxesText ("y -x") == Json ("y -x"));
    CHECK (textOfAxes (Json { "y", "-x", "z" }) == "y -x z");
    const auto rows = Json::parse ("[[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]]");
    CHECK (readAxesText (textOfAxes (rows)) == rows);
}

TEST_CASE ("a role's workspace is typed in the Devices panel, saved with the session, and each edit is one undo", "[app][sessions][undo]")
{
    Bench w;
    auto& document = w.document;
    const auto graph = writeGraph (w.graph());
    const auto before = document.history().position();
    w.type ("scale", "2");
    w.type ("offset", "[0, 0, \"1 cm\"]");
    w.type ("axes", "-x y z");
    w.type ("clutch", "grip");
    const Json mirrored { { "scale", 2 }, { "offset", { 0, 0, "1 cm" } }, { "axes", { "-x", "y", "z" } }, { "clutch", "grip" } };
    CHECK (w.workspace() == mirrored);
    CHECK (document.history().position() == before + 4);
    CHECK (latestStep (document) == "clutch of stylus");
    CHECK (w.field ("axes").getText() == "-x y z");
    CHECK (w.says ("no button"));   // the device has none, and its card says so

    // A mistake changes nothing, and is no step.
    w.type ("axes", "x x z");
    CHECK (w.workspace() == mirrored);
    CHECK (w.status.text().contains ("axes"));
    CHECK (document.history().position() == before + 4);

    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + z");
    CHECK_FALSE (w.workspace().contains ("clutch"));
    w.key ("ctrl + z");
    CHECK_FALSE (w.workspace().contains ("axes"));
    CHECK (w.field ("axes").getText().isEmpty());
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + y");
    CHECK (w.workspace()["axes"] == Json { "-x", "y", "z" });
    w.type ("max force", "1 N");   // a limit is not taken back
    w.canvas.grabKeyboardFocus();
    for (int i = 0; i < 3; ++i)
        w.key ("ctrl + z");
    CHECK (w.workspace().is_null());
    CHECK (w.binding()["guard"]["max_force"] == Json ("1 N"));
    CHECK (document.history().position() == before);
    CHECK (writeGraph (w.graph()) == graph);
    CHECK_FALSE (document.isChanged());
}

TEST_CASE ("the choice of a device is one undo, which leaves the edits before it and every limit alone", "[app][sessions][undo]")
{
    Bench w;
    auto& document = w.document;
    auto* device = dynamic_cast<juce::ComboBox*> (OnStage::titledIn (w.panel(), "device"));
    REQUIRE (device != nullptr);
    // An edit of the graph, by the keyboard: friction is bypassed.
    w.canvas.select ({ w.graph().root.find ("drag")->id });
    w.canvas.grabKeyboardFocus();
    w.key ("b");
    REQUIRE (w.graph().root.find ("drag")->bypass);
    const auto edited = writeGraph (w.graph());
    const auto before = document.history().position();

    const auto bound = w.binding();
    const auto chosen = device->getText();
    const auto target = device->getItemText (1);   // the simulated tool
    REQUIRE (target != chosen);
    w.choose (w.middleOf (*device), 2, juce::ModifierKeys::leftButtonModifier);
    const auto now = w.binding();
    REQUIRE (now != bound);
    CHECK (now["guard"] == bound["guard"]);
    CHECK (document.history().position() == before + 1);
    CHECK (latestStep (document) == "device of stylus");

    w.type ("max force", "1 N");
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + z");
    CHECK (document.history().position() == before);
    auto with_limit = bound;
    with_limit["guard"]["max_force"] = "1 N";
    CHECK (w.binding() == with_limit);
    CHECK (writeGraph (w.graph()) == edited);   // friction is still bypassed
    w.key ("ctrl + y");
    with_limit = now;
    with_limit["guard"]["max_force"] = "1 N";
    CHECK (w.binding() == with_limit);

    // Back to the device of the graph, which has its own limits; undo brings back the device with the limit that it had.
    w.panel().bindings().bind ("stylus", "as in the graph");
    CHECK_FALSE (w.saved()["roles"].contains ("stylus"));
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + z");
    CHECK (w.binding() == with_limit);
    w.key ("ctrl + y");
    CHECK_FALSE (w.saved().value ("roles", Json::object()).contains ("stylus"));
    w.key ("ctrl + z");
    CHECK (w.binding() == with_limit);

    // The same device again is no step.
    const auto position = document.history().position();
    w.panel().bindings().bind ("stylus", target.toStdString());
    CHECK (document.history().position() == position);
    for (int i = 0; i < 2; ++i)
        w.key ("ctrl + z");
    CHECK_FALSE (w.graph().root.find ("drag")->bypass);
}

TEST_CASE ("a workspace that is typed while the graph runs moves the tool without a step of the force", "[app][sessions][undo]")
{
    Bench w;
    w.start();
    w.watchRun ("hand.position.x");
    w.type ("offset", "[0, 0, \"-1 mm\"]");
    CHECK (w.until ([&] { return w.force() > 0.0 && w.origin() == Vec3 (0.0, 0.0, -0.001); }));
    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + z");
    CHECK (w.until ([&] { return w.force() > 0.0 && w.origin().isZero (0.0); }));
    CHECK (w.isSameRun());
    stepsChecked (w.run());

    // A turn begins another run.
    w.type ("axes", "-x y z");
    CHECK (w.until ([&] { return ! w.isSameRun() && w.playback.run().isRunning() && w.force() > 0.0; }));
    stepsChecked (w.run());
}

TEST_CASE ("with two hands, moving a workspace restarts the run, because the guard of the other hand would not know of it",
           "[app][sessions][safety]")
{
    Bench w { "two_fingers.json", "thumb" };
    w.playback.start ({});
    REQUIRE (w.until ([&] { return w.playback.run().isRunning() && w.ticks() > 0; }));
    w.watchRun ("creak.value");
    w.type ("offset", "[0, 0, \"-1 mm\"]");
    CHECK (w.until ([&] { return ! w.isSameRun() && w.playback.run().isRunning() && w.origin() == Vec3 (0.0, 0.0, -0.001); }));
}

TEST_CASE ("the scene shows the box that a device can reach, and an arrow moves it while the graph runs", "[app][scene][sessions][undo]")
{
    Bench w;
    w.set ("/workspace/scale", "0.25");
    w.set ("/workspace/axes", "y -x z");
    w.start();
    REQUIRE (w.until ([&] { return ! w.scene().reaches().empty(); }));
    const auto reach = w.scene().reaches().front();
    CHECK (reach.role == "stylus");
    REQUIRE (reach.hasBox());
    scene::Bounds box;
    for (const auto& corner : reach.corners())
        box.add (corner);
    CHECK (box.low.isApprox (0.25 * Vec3 (-0.0635, -0.127, -0.089), 1e-9));   // x of the graph is y of the device
    CHECK (box.high.isApprox (0.25 * Vec3 (0.0635, 0.127, 0.089), 1e-9));

    // The picture has a line along an edge of the box, and none without it.
    w.scene().grabKeyboardFocus();
    w.key ("f");
    const auto differs = [&] {
        const auto with = w.scene().createComponentSnapshot (w.scene().getLocalBounds());
        w.scene().showReach (false);
        const auto without = w.scene().createComponentSnapshot (w.scene().getLocalBounds());
        w.scene().showReach (true);
        const auto corners = reach.corners();
        const auto at = w.scene().camera().pixel (0.5 * (corners[6] + corners[7])).roundToInt();
        int pixels = 0;
        for (int x = -2; x <= 2; ++x)
            for (int y = -2; y <= 2; ++y)
                pixels += with.getPixelAt (at.x + x, at.y + y) != without.getPixelAt (at.x + x, at.y + y) ? 1 : 0;
        return pixels;
    };
    CHECK (differs() > 2);

    w.watchRun ("hand.position.x");
    const auto position = w.document.history().position();
    const auto area = w.scene().getLocalBounds().toFloat();
    const auto handle = scene::Overlay::handle (w.scene().camera(), area, reach, 2);
    REQUIRE (handle);
    const auto from = handle->getPointAlongLineProportionally (0.7f);
    const juce::Point<float> by = (handle->getStart() - handle->getEnd()) * 0.15f;
    const double metres = scene::Overlay::dragged (w.scene().camera(), reach, 2, by);
    CHECK (metres < 0.0);
    const double yaw = w.scene().camera().yaw;
    w.stage->drag (w.stage->getLocalPoint (&w.scene(), from), w.stage->getLocalPoint (&w.scene(), from + by));
    CHECK (w.scene().camera().yaw == yaw);   // the drag does not turn the scene
    REQUIRE (w.until ([&] { return w.force() > 0.0 && w.origin().z() < 0.0; }));
    const double z = w.workspace()["offset"][2].get<double>();
    CHECK (z == Approx (metres).epsilon (0.1));   // nearer by, a pixel is less
    CHECK (w.origin() == Vec3 (0.0, 0.0, z));
    CHECK (w.until ([&] { return w.scene().reaches().front().middle.z() == z; }));
    CHECK (w.document.history().position() == position + 1);
    CHECK (latestStep (w.document) == "offset of stylus");

    w.canvas.grabKeyboardFocus();
    w.key ("ctrl + z");
    CHECK_FALSE (w.workspace().contains ("offset"));
    CHECK (w.until ([&] { return w.force() > 0.0 && w.origin().isZero (0.0); }));
    CHECK (w.isSameRun());
    stepsChecked (w.run());

    // Moved by the mouse, the tool is no device of the session.
    w.playback.run().moveBy (LiveRun::Hand::pointer());
    CHECK (w.until ([&] { return w.scene().reaches().empty(); }));
}

TEST_CASE ("a device whose box is not known has handles at its origin", "[app][scene][sessions]")
{
    Bench w;
    w.panel().bindings().bind ("stylus", "gesture circle");
    REQUIRE (w.until ([&] { return ! w.scene().reaches().empty() && ! w.scene().reaches().front().hasBox(); }));
    const auto handle = scene::Overlay::handle (w.scene().camera(), w.scene().getLocalBounds().toFloat(), w.scene().reaches().front(), 0);
    REQUIRE (handle);
    const auto from = w.stage->getLocalPoint (&w.scene(), handle->getEnd());
    w.stage->drag (from, from + (handle->getEnd() - handle->getStart()));
    OnStage::settle();
    CHECK (w.workspace()["offset"][0].get<double>() > 0.0);   // also while nothing runs
    CHECK (w.workspace()["offset"][1].get<double>() == 0.0);
}
