// SPDX-License-Identifier: GPL-3.0-or-later
// The screen shows what should be there, whatever has happened before: no place keeps an old picture, and nothing of a run or a graph reaches
// the next one.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/look/appearance.hpp>
#include <tactus/file/graph_file.hpp>

#include <cstdlib>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::mentions;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
/// Where two pictures differ by more than the rounding of smoothed edges, which depends on where a picture is cut; empty if they do not.
juce::Rectangle<int> difference (const juce::Image& a, const juce::Image& b)
{
    constexpr int rounding = 24;   // of 255
    if (a.getBounds() != b.getBounds()) return a.getBounds().getUnion (b.getBounds());
    const juce::Image::BitmapData x (a, juce::Image::BitmapData::readOnly), y (b, juce::Image::BitmapData::readOnly);
    int left = x.width, right = 0, top = x.height, bottom = 0;
    for (int row = 0; row < x.height; ++row)
        for (int i = 0; i < x.width; ++i)
        {
            const auto *p = x.getPixelPointer (i, row), *q = y.getPixelPointer (i, row);
            int apart = 0;
            for (int k = 0; k < x.pixelStride; ++k)
                apart = std::max (apart, std::abs (p[k] - q[k]));
            if (apart <= rounding) continue;
            left = std::min (left, i);
            right = std::max (right, i + 1);
            top = std::min (top, row);
            bottom = row + 1;
        }
    return right == 0 ? juce::Rectangle<int>() : juce::Rectangle<int>::leftTopRightBottom (left, top, right, bottom);
}

void save (const juce::Image& image, const char* name)
{
    const auto* folder = std::getenv ("TACTUS_TEST_PICTURES");
    if (folder == nullptr) return;
    juce::FileOutputStream file (juce::File (folder).getChildFile (name));
    file.setPosition (0);
    file.truncate();
    juce::PNGImageFormat().writeImageToStream (image, file);
}

void checkScreen (WindowRig& w, const std::string& after)
{
    juce::Rectangle<int> stale;
    for (int i = 0; i < 20; ++i)   // a picture that another thread has just finished is shown by the next timer
    {
        WindowRig::settle (80);
        const auto& screen = w.stage->screen();
        const auto painted = w.stage->painted();
        stale = difference (screen, painted);
        if (stale.isEmpty()) return;
        save (screen, (after + "-screen.png").c_str());
        save (painted, (after + "-painted.png").c_str());
    }
    INFO ("after: " << after << "; stale: " << stale.toString());
    CHECK (stale.isEmpty());
}

std::filesystem::path preset (const char* name) { return std::filesystem::path (TACTUS_SOURCE_DIR "/graphs") / name; }

/// Waits until a stopped run has let its forces fall.
void stop (WindowRig& w)
{
    w.view->run().letGo();
    WindowRig::settle (100);
}
}   // namespace

TEST_CASE ("no place of the window keeps an old picture", "[app][stale]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    stop (w);
    checkScreen (w, "a stop");
    for (const char* tab : { "Layers", "Devices", "Problems", "Take", "Scopes", "History", "Presets" })
    {
        w.click (tab);
        checkScreen (w, tab);
    }
    w.view->canvas().grabKeyboardFocus();
    w.view->canvas().select ({ w.graph().root.find ("drag")->id });
    checkScreen (w, "a selection");
    REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.7) }));
    checkScreen (w, "an edit");
    w.view->document().undo();
    checkScreen (w, "an undo");
    w.view->document().redo();
    checkScreen (w, "a redo");
    for (const char* key : { "z", "z", "F1", "escape", "f", "home", "c", "m", "m" })
    {
        w.key (key);
        checkScreen (w, key);
    }
    for (int i = 0; i < 3; ++i)
        w.view->document().undo();   // the panels that went and came back, and the edit
    w.view->open (preset ("bronze_bell.json"));
    stop (w);
    checkScreen (w, "another graph");
    w.click ("3D");
    checkScreen (w, "3D");
    w.click ("2D");
    checkScreen (w, "2D");
    for (const auto* theme : { &Theme::light(), &Theme::dark() })
    {
        applyTheme (*w.stage, *theme);
        checkScreen (w, "another theme");
    }
    w.stage->setSize (1024, 700);
    checkScreen (w, "another size");
    w.view->open (preset ("soft_pad.json"));
    stop (w);
    checkScreen (w, "a third graph");
    w.key ("ctrl + n");
    checkScreen (w, "a new graph");
}

TEST_CASE ("a window with a history looks as a new one that opens the same graph", "[app][stale]")
{
    const std::vector<juce::String> panels { "Inspector", "Canvas", "Scopes", "Hand", "Layers" };
    const auto pictureOf = [] (WindowRig& w, const juce::String& title) {
        INFO (title);
        juce::Component* panel = nullptr;
        const auto look_in = [&] (auto&& self, juce::Component& c) -> void {
            if (panel == nullptr && c.isShowing() && c.getTitle() == title) panel = &c;
            for (auto* child : c.getChildren())
                self (self, *child);
        };
        look_in (look_in, *w.view);
        REQUIRE (panel != nullptr);
        return panel->createComponentSnapshot (panel->getLocalBounds());
    };
    const char* const graph = GENERATE ("bronze_bell.json", "soft_pad.json");
    std::vector<juce::Image> fresh;
    {
        WindowRig w (graph);
        for (const auto& title : panels)
        {
            if (title == "Layers") w.click (title);
            fresh.push_back (pictureOf (w, title));
            for (int i = 0; i < 20; ++i)   // until it has stopped changing
            {
                WindowRig::settle (100);
                auto next = pictureOf (w, title);
                const bool same = difference (fresh.back(), next).isEmpty();
                fresh.back() = std::move (next);
                if (same) break;
            }
        }
    }
    WindowRig w ("dry_wood.json");
    for (int i = 0; i < 100 && WindowRig::buttonIn (*w.view, "START") == nullptr; ++i)
        WindowRig::settle();
    w.click ("START");
    WindowRig::settle (300);   // it runs
    w.view->canvas().select ({ w.graph().root.find ("drag")->id });
    REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.7) }));
    WindowRig::settle (100);
    w.view->document().undo();
    w.key ("shift + escape");
    applyTheme (*w.stage, Theme::light());
    WindowRig::settle (100);
    applyTheme (*w.stage, Theme::dark());
    w.view->open (preset (graph));
    WindowRig::settle (200);
    stop (w);
    for (std::size_t i = 0; i < panels.size(); ++i)
    {
        if (panels[i] == "Layers") w.click (panels[i]);
        juce::Image now;
        juce::Rectangle<int> stale;
        for (int round = 0; round < 50 && (round == 0 || ! stale.isEmpty()); ++round)   // timers update some parts
        {
            WindowRig::settle (80);
            now = pictureOf (w, panels[i]);
            stale = difference (now, fresh[i]);
        }
        INFO (panels[i] << " differs in " << stale.toString());
        if (! stale.isEmpty())
        {
            save (now, ("now-" + panels[i] + ".png").toRawUTF8());
            save (fresh[i], ("fresh-" + panels[i] + ".png").toRawUTF8());
        }
        CHECK (stale.isEmpty());
    }
}

TEST_CASE ("a new graph shows nothing of the one before it: neither its zoom nor what was said about its run", "[app][stale]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& canvas = w.view->canvas();
    REQUIRE (canvas.view().zoom < 1.0f);
    w.key ("F5");
    REQUIRE (waitFor ([&] { return w.view->run().isRunning(); }));
    w.key ("ctrl + n");
    REQUIRE (w.graph().root.nodes.empty());
    CHECK (canvas.view().zoom == 1.0f);
    w.key ("spacebar");
    w.stage->type ("plane");
    w.key ("return");
    const auto isSaid = [&] { return std::ranges::count (w.view->run().messages(), "watch/guard", &Message::id) > 0; };
    CHECK_FALSE (isSaid());   // the guard of the run that has ended does not matter any more
    REQUIRE (waitFor ([&] { return ! w.view->run().isRunning(); }));
    for (int i = 0; i < 20; ++i)   // while the timer of the window asks for other ports
        WindowRig::settle();
    CHECK_FALSE (isSaid());
}

TEST_CASE ("a new graph shows no curve of the graph before, even for a port with the same name", "[app][window]")
{
    WindowRig w ("dry_wood.json");
    auto& run = w.view->run();
    const auto hasTrace = [&] { return ! run.traces().of ("motor.applied").empty(); };
    if (! run.isWanted()) w.key ("F5");
    REQUIRE (waitFor (hasTrace));
    w.key ("escape");
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    WindowRig::settle();
    CHECK (hasTrace());   // a run that has stopped can be looked at
    w.key ("ctrl + n");
    WindowRig::settle();
    REQUIRE (w.graph().root.nodes.empty());
    CHECK_FALSE (hasTrace());
}

TEST_CASE ("a new graph shows no values of the run before", "[app][scopes]")
{
    WindowRig w ("dry_wood.json", 1920, 1080, false);
    REQUIRE (waitFor ([&] { return mentions (*w.view, "peak"); }));
    w.key ("ctrl + n");
    if (w.view->asked().isOpen()) w.click ("Don't save");
    REQUIRE (w.graph().root.nodes.empty());
    CHECK (waitFor ([&] { return ! mentions (*w.view, "peak") && ! mentions (*w.view, "late ticks"); }));
    w.key ("ctrl + z");   // the graph of that run
    CHECK (waitFor ([&] { return mentions (*w.view, "peak"); }));
}
