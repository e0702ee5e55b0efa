// SPDX-License-Identifier: MIT
#include "host/app/support/pseudo.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/inspector/formula_block.hpp>
#include <host/app/limits/limit_light.hpp>
#include <host/app/look/text.hpp>
#include <host/fitting/fitting.hpp>

#include <algorithm>
#include <fstream>
#include <set>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;
namespace app_test = tactus::host::test;

namespace
{
juce::String shownText (const char* text) { return juce::translate (text); }

/// The window in the pseudo-translation, and what is not translated in it.
struct PseudoWindow
{
    app_test::InPseudo pseudo;
    app_test::Data data;
    WindowRig rig;
    std::set<juce::String> told;   // problems that were reported before

    explicit PseudoWindow (const std::string& preset = {}, int width = 1280, int height = 720) : rig (preset, width, height)
    {
        data.add (juce::String (rig.home.path().string()));
        const auto session = juce::String ((rig.home.path() / "session.json").string());
        for (float room = 60.0f; room < 600.0f; room += 4.0f)   // as it is shown where there is less room
            data.add (fittedPath (session, rig.look.font (12.0f), room));
        data.add ("Tactus\nEnglish\nJSON\nRate hz\nsim\ntrace\ngesture\nhid\naudio");
        data.add ("alpha\nbeta\ngamma\ndelta\nsigma");   // in formulas
        FileAssets assets;
        for (const auto& l : limitsOf ({ rig.graph(), 0.0, limitRolesOf (rig.graph(), {}, {}) }, catalogue(), assets).limits)
            data.add (juce::String (l.text).fromLastOccurrenceOf (";", false, false));   // the law
    }

    void check (const char* where)
    {
        for (const auto& t : app_test::readTexts (*rig.stage))
            checkOne (t.text, where);
        for (const auto& t : app_test::toldTexts (*rig.stage))
            checkOne (t, where);
    }

    /// Checks that no texts overlap in a component, and that none is cut off.
    void checkLayout (juce::Component& c, juce::Rectangle<int> area, const char* where)
    {
        const auto texts = app_test::readTexts (c);
        INFO (where << ", " << rig.stage->getWidth() << " pixels wide");
        CHECK (app_test::overlaps (texts, area.toFloat()).joinIntoString ("\n") == juce::String());
        CHECK (app_test::cutOff (texts, area.toFloat()).joinIntoString ("\n") == juce::String());
    }

    void checkOne (const juce::String& text, const char* where)
    {
        const auto left = data.wordsLeft (text);
        if (left.isEmpty() || ! told.insert (left).second) return;
        INFO (where << ": " << text);
        CHECK (left == juce::String());
    }

    /// Checks the menu that is open, and closes it. It has the given entry. JUCE closes it as soon as the mouse moves, because this
    /// program is not in the foreground of a desktop.
    void checkMenu (const char* where, const char* entry)
    {
        CHECK (sees (entry));
        check (where);
        juce::PopupMenu::dismissAllActiveMenus();
        WindowRig::settle (60);
    }

    bool sees (const char* text)
    {
        const auto translated = shownText (text);
        const auto texts = app_test::readTexts (*rig.stage);
        return translated.contains ("~") && std::ranges::any_of (texts, [&] (const auto& t) { return t.text.contains (translated); });
    }

    void clickMenu (const char* button, const char* entry)
    {
        auto* b = WindowRig::buttonIn (*rig.view, shownText (button));
        REQUIRE (b != nullptr);
        REQUIRE (b->onClick);
        b->onClick();
        checkMenu (button, entry);
    }

    bool shows (const char* button) { return WindowRig::buttonIn (*rig.view, shownText (button)) != nullptr; }

    /// Without the mouse: START ignores a click that comes soon after STOP.
    void start()
    {
        for (int i = 0; i < 100 && ! shows ("START"); ++i)
            WindowRig::settle (50);
        REQUIRE (shows ("START"));
        WindowRig::buttonIn (*rig.view, shownText ("START"))->triggerClick();
        for (int i = 0; i < 100 && ! shows ("STOP"); ++i)
            WindowRig::settle (50);
        WindowRig::settle (300);
    }
};

/// The documentation of nodes is not translated, and is typeset, so it looks different from its source.
void hideFormulas (juce::Component& c)
{
    if (dynamic_cast<FormulaBlock*> (&c) != nullptr) c.setVisible (false);
    for (auto* child : c.getChildren())
        hideFormulas (*child);
}

/// The end of a right click, and nothing after it.
void rightClick (juce::Component& c)
{
    using Source = juce::MouseInputSource;
    const auto at = c.getLocalBounds().getCentre().toFloat();
    const auto time = juce::Time::getCurrentTime();
    c.mouseUp ({ juce::Desktop::getInstance().getMainMouseSource(), at, juce::ModifierKeys (juce::ModifierKeys::rightButtonModifier),
                 Source::defaultPressure, Source::defaultOrientation, Source::defaultRotation, Source::defaultTiltX, Source::defaultTiltY,
                 &c, &c, time, at, time, 1, false });
}

LimitLight* findLight (juce::Component& c)
{
    if (auto* light = dynamic_cast<LimitLight*> (&c)) return light;
    for (auto* child : c.getChildren())
        if (auto* light = findLight (*child)) return light;
    return nullptr;
}

void checkTabs (PseudoWindow& w)
{
    for (const char* tab : { "Layers", "Devices", "Scopes", "Take", "History", "Presets" })
    {
        w.rig.click (shownText (tab));
        w.check (tab);
        INFO (tab);
        CHECK (app_test::overlaps (app_test::readTexts (*w.rig.stage), w.rig.stage->getLocalBounds().toFloat()).joinIntoString ("\n") == juce::String());
    }
}
}   // namespace

TEST_CASE ("no text of the window is left untranslated: welcome page, menus and questions", "[app][text]")
{
    PseudoWindow w;
    w.check ("welcome");
    CHECK (w.sees ("Feel something"));
    w.clickMenu ("Menu", "Light theme");
    w.rig.key ("F1");
    w.check ("keys");
    w.rig.key ("escape");
    w.rig.view->open (w.rig.home / "nowhere.json");
    WindowRig::settle();
    w.data.add ("cannot be read: No such file or directory; check the path; a path in a file is relative to the folder of that file");
    w.check ("a file that does not exist");
    w.rig.key ("escape");
}

TEST_CASE ("no text of the window is left untranslated: panels of a graph", "[app][text]")
{
    for (const char* preset : { "dry_wood.json", "layered_cloth.json" })
    {
        PseudoWindow w (preset);
        w.check (preset);
        checkTabs (w);
        auto& canvas = w.rig.view->canvas();
        canvas.grabKeyboardFocus();
        canvas.select ({ w.rig.graph().root.nodes.front().id });
        w.rig.key ("ctrl + d");
        w.rig.key ("n");
        w.rig.key ("escape");
        w.rig.click (shownText ("History"));
        w.check ("history");
        rightClick (canvas);
        w.checkMenu ("menu of the canvas", "Select all");
        w.rig.key ("spacebar");
        w.check ("palette");
        w.rig.key ("escape");
        w.rig.view->closeWhenSaved ([] {});
        WindowRig::settle();
        w.check ("question");
        w.rig.key ("escape");
        w.rig.click (shownText ("3D"));
        w.check ("scene");
        w.clickMenu ("Film", "Film from now on");
    }
}

TEST_CASE ("no text of the window is left untranslated: the inspector and the help, for any node", "[app][text]")
{
    std::set<std::string> types;
    for (const char* preset : { "dry_wood.json", "layered_cloth.json", "bronze_bell.json", "denim.json", "liver.json" })
    {
        PseudoWindow w (preset);
        auto& canvas = w.rig.view->canvas();
        canvas.select ({});
        w.check ("inspector of the graph");
        for (const auto& n : w.rig.graph().root.nodes)
        {
            if (! types.insert (n.type).second) continue;
            INFO (n.type);
            canvas.select ({ n.id });
            hideFormulas (w.rig.view->inspected());
            w.check ("inspector");
            if (auto* help = WindowRig::buttonIn (w.rig.view->inspected(), "?"))
            {
                help->triggerClick();
                WindowRig::settle();
                hideFormulas (w.rig.view->inspected());
                w.check ("inspector with descriptions");
            }
            w.rig.view->helpPanel().showNode (n.type);
            hideFormulas (w.rig.view->helpPanel());
            w.check ("help");
            w.rig.view->helpPanel().close();
        }
        canvas.select ({ w.rig.graph().root.wires.front().id });
        w.check ("inspector of a wire");
    }
}

TEST_CASE ("no text of the window is left untranslated: limits and problems", "[app][text]")
{
    PseudoWindow w ("denim.json");
    auto* light = findLight (*w.rig.view);
    REQUIRE (light != nullptr);
    for (int i = 0; i < 1200 && ! light->isVisible(); ++i)
        WindowRig::settle (50);
    REQUIRE (light->isVisible());
    w.check ("a broken limit");
    w.rig.click (shownText ("Problems"));
    w.check ("list of limits");
    std::ofstream (w.rig.home / "wall.json") << R"({ "format": "tactus-graph", "version": 1, "nodes": { "wall": { "type": "deform.plane" } } })";
    w.rig.view->open (w.rig.home / "wall.json");
    WindowRig::settle (100);
    w.check ("list of problems");
    CHECK (w.sees ("Add a hand"));
    std::ofstream (w.rig.home / "wrong.json") << R"({ "format": "tactus-graph", "version": 1, "nodes": {
        "hand": { "type": "device.position" }, "wal": { "type": "deform.plan" },
        "wall": { "type": "deform.plane", "params": { "stiffness": "2 kg", "stifness": 1, "friction": -1 } },
        "drag": { "type": "friction.elasto_plastic", "params": { "mu": 1e99 }, "count": 3 } },
        "wires": [ "hand.position -> wall.position", "hand.position -> wall.position", "wall.force -> wall.position", "wall.nothing -> drag.position" ] })";
    w.data.add ("stifness");
    w.rig.view->open (w.rig.home / "wrong.json");
    WindowRig::settle (100);
    w.check ("many problems");
}

TEST_CASE ("no text of the window is left untranslated: fits of all kinds", "[app][text]")
{
    PseudoWindow w ("dry_wood.json");
    auto& panel = w.rig.view->fitPanel();
    int fitted = 0;
    for (const auto& info : fitKinds())
    {
        const auto file = w.rig.home / (info.id + ".csv");
        std::filesystem::copy_file (std::filesystem::path (TACTUS_SOURCE_DIR "/tests/fuzz/corpus/recording") / info.id, file);
        w.data.add (juce::String (file.filename().string()));
        if (const auto table = readRecording (file))
            for (const auto& column : table->columns)
                w.data.add (juce::String (column));
        w.rig.view->fitRecordingIn (file);
        panel.choose (info.kind);
        for (int i = 0; i < 2000 && panel.isFitting(); ++i)
            WindowRig::settle (20);
        REQUIRE_FALSE (panel.isFitting());
        if (panel.fitted())
        {
            ++fitted;
            for (const auto& v : panel.fitted()->report.values)
                if (v.name.find (' ') == v.name.npos) w.data.add (juce::String (v.name));   // a parameter
        }
        INFO (info.id);
        CHECK (w.sees ("Cancel"));
        w.check (info.id.c_str());
    }
    CHECK (fitted >= 5);
    w.rig.view->fitRecordingIn (w.rig.home / "nowhere.csv");
    w.data.add ("No such file or directory");   // the system says so
    w.check ("no recording");
}

TEST_CASE ("a text that is not translated is seen, and so are texts on each other", "[app][text]")
{
    struct Page final : juce::Component
    {
        void paint (juce::Graphics& g) override
        {
            g.setFont (14.0f);
            g.drawText ("Feel something", 10, 10, 200, 20, juce::Justification::left);
            g.drawText ("Feel~~ nothing~~~", 14, 12, 200, 20, juce::Justification::left);
            g.drawText ("further~~ down~~", 10, 60, 200, 20, juce::Justification::left);
            g.drawText ("over the edge", 260, 90, 200, 20, juce::Justification::left);
        }
    };
    const juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    Page page;
    page.setLookAndFeel (&look);
    page.setSize (300, 120);
    const auto texts = app_test::readTexts (page);
    page.setLookAndFeel (nullptr);
    REQUIRE (texts.size() == 4);
    CHECK (texts[0].text == "Feel something");
    CHECK (app_test::overlaps (texts, page.getLocalBounds().toFloat()) == juce::StringArray { "Feel something | Feel~~ nothing~~~" });
    CHECK (texts[3].is_cut);
    CHECK_FALSE (texts[2].is_cut);
    const app_test::Data data;
    CHECK (data.wordsLeft ("Feel something") == "Feel something");
    CHECK (data.wordsLeft ("Feel~~ something new") == "something new");
    CHECK (data.wordsLeft ("Feel~~ something~~~, drag.force 0.3 N/mm").isEmpty());
    CHECK (data.wordsLeft ("Elasto-plastic friction").isEmpty());
}

TEST_CASE ("the window runs in a translation: START, STOP and a snapshot", "[app][text]")
{
    PseudoWindow w ("dry_wood.json");
    w.start();
    w.check ("running");
    w.rig.view->canvas().grabKeyboardFocus();
    w.rig.key ("ctrl + 1");
    w.check ("snapshot");
    w.rig.click (shownText ("STOP"));
    WindowRig::settle (600);
    w.check ("stopped");
}

TEST_CASE ("texts that are a third longer neither overlap nor are cut off in the strip, the top bar and dialogs", "[app][text]")
{
    for (const int width : { 1280, 1920 })
    {
        PseudoWindow w ("dry_wood.json", width, 720);
        const juce::Rectangle<int> bars (width, SafetyStrip::height + TopBar::height);
        WindowRig::settle (200);
        w.checkLayout (*w.rig.stage, bars, "bars");
        w.start();
        w.checkLayout (*w.rig.stage, bars, "bars of a running graph");
        w.rig.click (shownText ("STOP"));
        w.rig.key ("ctrl + d");
        w.rig.view->canvas().select ({ w.rig.graph().root.nodes.front().id });
        w.rig.view->canvas().grabKeyboardFocus();
        w.rig.key ("ctrl + d");
        w.rig.view->closeWhenSaved ([] {});
        WindowRig::settle();
        REQUIRE (w.rig.view->asked().isOpen());
        auto& question = w.rig.view->asked();
        w.checkLayout (question, question.getLocalBounds(), "question");
        w.rig.key ("escape");
        w.rig.view->fitRecordingIn (w.rig.home / "nowhere.csv");
        w.checkLayout (w.rig.view->fitPanel(), w.rig.view->fitPanel().getLocalBounds(), "fit panel");
        w.rig.key ("escape");
        w.rig.key ("F1");
        auto& help = w.rig.view->helpPanel();
        REQUIRE (help.isOpen());
        CHECK (app_test::overlaps (app_test::readTexts (help), help.getLocalBounds().toFloat()).joinIntoString ("\n") == juce::String());
    }
}
