// SPDX-License-Identifier: GPL-3.0-or-later
// The clutch by a key, which moves the workspace of a device with the hand. The force steps nowhere.
#include "host/app/support/board_bench.hpp"
#include "host/app/support/film_steps.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/devices_panel/devices_panel.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::BoardBench;
using tactus::host::test::stepsChecked;
using tactus::host::test::WindowRig;

namespace
{
template <typename T>
T* partIn (juce::Component& c)
{
    if (auto* part = dynamic_cast<T*> (&c)) return part;
    for (auto* child : c.getChildren())
        if (auto* part = partIn<T> (*child)) return part;
    return nullptr;
}

struct Bench final : BoardBench<WindowRig>
{
    explicit Bench (const char* preset = "dry_wood.json", std::string of = "stylus") : BoardBench (preset, std::move (of))
    {
        showPanel();
        bind();
    }
    ~Bench() override { view->run().letGo(); }

    DevicesPanel& panel() override { return *partIn<DevicesPanel> (*view); }
    LiveRun& run() override { return view->run(); }
    void showPanel() override { click ("Devices"); }
    SceneView& scene() { return *partIn<SceneView> (*view); }

    void start()
    {
        view->canvas().grabKeyboardFocus();
        key ("F5");
        REQUIRE (isPushing());
    }
};
}   // namespace

TEST_CASE ("S moves the workspace with the hand while it is held, and the force does not step", "[app][sessions][safety]")
{
    Bench w;
    w.start();
    w.view->canvas().grabKeyboardFocus();
    const auto hold = [&] {   // a key that is held is repeated
        w.stage->key ("s");
        WindowRig::settle (10);
        w.stage->keyUp();   // as some systems do between two repetitions
        w.stage->key ("s");
    };
    REQUIRE (w.until ([&] {
        hold();
        return w.force() == 0.0;
    }));
    CHECK (w.view->statusText().contains ("until you release S"));
    SafetyStrip* strip = nullptr;
    for (auto* child : w.view->getChildren())
        if (auto* found = dynamic_cast<SafetyStrip*> (child)) strip = found;
    REQUIRE (strip != nullptr);
    CHECK (w.until ([&] {
        hold();
        return strip->guardText().contains ("its workspace is being moved");
    }));
    CHECK_FALSE (strip->isAlarmed());   // it is what the person wants
    const auto after = [&] (std::uint64_t more) {
        return w.until ([&, from = w.ticks()] {
            hold();
            return w.ticks() > from + more;
        });
    };
    REQUIRE (after (10));
    const auto place = w.view->run().tool()->position;
    for (int i = 0; i < 10; ++i)
    {
        REQUIRE (after (100));
        CHECK (w.force() == 0.0);
        CHECK (w.view->run().tool()->position == place);   // the circle goes on, but not in the graph
    }
    w.stage->keyUp();
    CHECK (w.until ([&] { return w.force() > 0.0 && ! strip->guardText().contains ("being moved"); }));
    CHECK (w.origin().norm() > 1e-4);
    CHECK (stepsChecked (w.view->run()) == 0);   // nor does the tool jump
    CHECK_FALSE (w.workspace().contains ("offset"));

    SECTION ("in the scene, too, until something else gets the keyboard")
    {
        w.scene().grabKeyboardFocus();
        w.stage->key ("s");
        REQUIRE (w.until ([&] { return w.force() == 0.0; }));
        auto& field = w.field ("scale");
        w.stage->click (w.middleOf (field));
        CHECK (w.until ([&] { return w.force() > 0.0; }));
        w.stage->key ("s");   // is text now
        CHECK (field.getText() == "s");
        CHECK_FALSE (w.view->statusText().contains ("until you release S"));
        w.key ("escape");
    }
    SECTION ("but not without a device of the session")
    {
        w.panel().bindings().bind ("stylus", "as in the graph");
        REQUIRE (w.until ([&] { return w.view->run().isRunning() && w.force() > 0.0; }));
        w.view->canvas().grabKeyboardFocus();
        w.stage->key ("s");
        CHECK (w.view->statusText().contains ("bind one"));
        WindowRig::settle (100);
        CHECK (w.until ([&] { return w.force() > 0.0; }));   // the stroke presses again
    }
    SECTION ("and a STOP stops")
    {
        w.stage->key ("s");
        w.key ("shift + escape");
        w.stage->keyUp();
        REQUIRE (w.until ([&] { return w.view->run().isStoppedForGood() && w.force() == 0.0; }));
        WindowRig::settle (200);
        CHECK (w.force() == 0.0);
    }
}

TEST_CASE ("the help lists the key of the clutch", "[app][sessions]")
{
    WindowRig w ("dry_wood.json");
    w.view->canvas().grabKeyboardFocus();
    w.key ("F1");
    REQUIRE (w.view->part<HelpPanel>().isOpen());
    bool is_listed = false;
    for (const auto& seen : host::test::readTexts (w.view->part<HelpPanel>()))
        is_listed = is_listed || seen.text.contains ("S, held");
    CHECK (is_listed);
}
