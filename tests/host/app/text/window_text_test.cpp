// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/fit_panel/fit_panel.hpp>
#include <host/app/storage/language.hpp>

#include <algorithm>
#include <fstream>

using namespace tactus::host;
using tactus::host::test::WindowRig;
namespace app_test = tactus::host::test;

namespace
{
/// While this lives, the texts of the window are those of a user's file. Each is a third longer than in English.
class InLongTexts
{
public:
    InLongTexts()
    {
        const auto file = folder / "de.txt";
        std::ofstream (file) << "language: Deutsch\n"
                                "\"START\" = \"STARTEN\"\n\"STOP\" = \"STOPPEN\"\n\"stopped\" = \"angehalten\"\n\"edited\" = \"bearbeitet\"\n"
                                "\"peak %1\" = \"Spitze %1\"\n\"late ticks: %1\" = \"verspaetete Ticks: %1\"\n\"guard ready\" = \"Waechter ist bereit\"\n"
                                "\"delay %1 ticks\" = \"Verzoegerung %1 Ticks\"\n\"walls stable up to %1\" = \"Waende sind stabil bis %1\"\n"
                                "\"running at %1 Hz\" = \"laeuft jetzt mit %1 Hz\"\n\"Snapshots\" = \"Schnappschuesse\"\n\"Duplicate\" = \"Verdoppeln\"\n";
        useTranslation (file);
    }
    ~InLongTexts() { useTranslation ({}); }

private:
    TemporaryFolder folder;
};

bool sees (juce::Component& c, const juce::String& text)
{
    return std::ranges::any_of (app_test::readTexts (c), [&] (const auto& t) { return t.text.contains (text); });
}

/// Waits until the component shows a text.
bool comesToSee (juce::Component& c, const juce::String& text)
{
    for (int i = 0; i < 200 && ! sees (c, text); ++i)
        WindowRig::settle (50);
    return sees (c, text);
}

/// Checks that no texts overlap in an area, and that none is cut off.
void checkLayout (juce::Component& c, juce::Rectangle<int> area)
{
    const auto texts = app_test::readTexts (c);
    CHECK (app_test::overlaps (texts, area.toFloat()).joinIntoString ("\n") == juce::String());
    CHECK (app_test::cutOff (texts, area.toFloat()).joinIntoString ("\n") == juce::String());
}

void checkBars (WindowRig& rig)
{
    checkLayout (*rig.stage, { rig.stage->getWidth(), SafetyStrip::height + TopBar::height });
}

/// Without the mouse: START ignores a click that comes soon after STOP.
void press (WindowRig& rig, const char* text)
{
    REQUIRE (comesToSee (*rig.stage, text));
    auto* button = WindowRig::buttonIn (*rig.view, text);
    REQUIRE (button != nullptr);
    button->triggerClick();
}
}   // namespace

TEST_CASE ("the window runs in the language of a user's file, and longer texts neither overlap nor are cut off in its bars", "[app][text]")
{
    const InLongTexts german;
    for (const int width : { 1280, 1920 })
    {
        INFO (width << " pixels");
        WindowRig rig ("dry_wood.json", width, 720);
        WindowRig::settle (200);
        checkBars (rig);
        press (rig, "STARTEN");
        REQUIRE (comesToSee (*rig.stage, "laeuft jetzt mit"));
        CHECK (sees (*rig.stage, "Waechter"));
        WindowRig::settle (300);
        checkBars (rig);
        press (rig, "STOPPEN");
        CHECK (comesToSee (*rig.stage, "angehalten"));
    }
}

TEST_CASE ("texts neither overlap nor are cut off in questions, in the fit panel and in the help", "[app][text]")
{
    WindowRig rig ("dry_wood.json", 1280, 720);
    rig.view->canvas().select ({ rig.graph().root.nodes.front().id });
    rig.view->canvas().grabKeyboardFocus();
    rig.key ("ctrl + d");
    rig.view->closeWhenSaved ([] {});
    WindowRig::settle();
    auto& question = rig.view->asked();
    REQUIRE (question.isOpen());
    checkLayout (question, question.getLocalBounds());
    rig.key ("escape");
    rig.view->desk().fitRecording (rig.home / "nowhere.csv");
    checkLayout (rig.view->part<FitPanel>(), rig.view->part<FitPanel>().getLocalBounds());
    rig.key ("escape");
    rig.key ("F1");
    auto& help = rig.view->part<HelpPanel>();
    REQUIRE (help.isOpen());
    CHECK (app_test::overlaps (app_test::readTexts (help), help.getLocalBounds().toFloat()).joinIntoString ("\n") == juce::String());
}

TEST_CASE ("texts on each other are seen, and so is one that is cut off", "[app][text]")
{
    struct Page final : juce::Component
    {
        void paint (juce::Graphics& g) override
        {
            g.setFont (14.0f);
            g.drawText ("Feel something", 10, 10, 200, 20, juce::Justification::left);
            g.drawText ("Feel nothing", 14, 12, 200, 20, juce::Justification::left);
            g.drawText ("further down", 10, 60, 200, 20, juce::Justification::left);
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
    CHECK (app_test::overlaps (texts, page.getLocalBounds().toFloat()) == juce::StringArray { "Feel something | Feel nothing" });
    CHECK (texts[3].is_cut);
    CHECK_FALSE (texts[2].is_cut);
}
