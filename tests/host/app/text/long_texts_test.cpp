// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/files_rig.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/fit_panel/fit_panel.hpp>
#include <host/app/run/views/safety_strip.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/top_bar/top_bar.hpp>
#include <host/app/welcome/help_panel.hpp>

#include <algorithm>
#include <fstream>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;
using tactus::host::test::DeskStage;
using tactus::host::test::FilesRig;
using tactus::host::test::Stage;
using tactus::host::test::waitFor;
using tactus::host::test::wood;
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
                                "\"delay %1 ticks\" = \"Verzoegerung %1 Ticks\"\n\"undamped walls passive up to %1\" = \"Waende sind stabil bis %1\"\n"
                                "\"running at %1 Hz\" = \"laeuft jetzt mit %1 Hz\"\n\"Snapshots\" = \"Schnappschuesse\"\n\"Duplicate\" = \"Verdoppeln\"\n";
        useTranslation (file);
    }
    ~InLongTexts() { useTranslation ({}); }

private:
    TemporaryFolder folder;
};

/// Checks that no texts overlap in a component, and that none is cut off.
void checkLayout (juce::Component& c)
{
    const auto texts = app_test::readTexts (c);
    CHECK (app_test::overlaps (texts, c.getLocalBounds().toFloat()).joinIntoString ("\n") == juce::String());
    CHECK (app_test::cutOff (texts, c.getLocalBounds().toFloat()).joinIntoString ("\n") == juce::String());
}
}   // namespace

TEST_CASE ("the bars are in the language of a user's file, and longer texts neither overlap nor are cut off in them", "[app][text]")
{
    const InLongTexts german;
    for (const int width : { 1280, 1920 })
    {
        INFO (width << " pixels");
        DeskStage w ("dry_wood.json", width, 720);
        SafetyStrip strip { w.playback };
        TopBar top { w.desk };
        strip.setBounds (0, 0, width, SafetyStrip::height);
        top.setBounds (0, SafetyStrip::height, width, TopBar::height);
        for (juce::Component* bar : std::initializer_list<juce::Component*> { &strip, &top })
            w.stage->addAndMakeVisible (bar);
        top.show();
        const auto comesToSee = [&] (const char* text) {
            return waitFor ([&] {
                strip.refresh();
                return app_test::mentions (strip, text);
            });
        };
        const auto checkBars = [&] {
            checkLayout (strip);
            checkLayout (top);
        };
        REQUIRE (comesToSee ("STARTEN"));
        checkBars();
        REQUIRE (w.start());
        REQUIRE (comesToSee ("laeuft jetzt mit"));
        CHECK (comesToSee ("Waechter"));
        REQUIRE (comesToSee ("STOPPEN"));
        checkBars();
        w.playback.stop();
        CHECK (comesToSee ("angehalten"));
    }
}

TEST_CASE ("texts neither overlap nor are cut off in questions, in the fit panel and in the help", "[app][text]")
{
    FilesRig files;
    files.files->open (wood);
    files.edit (0.9);
    files.files->create();
    REQUIRE (files.question.isOpen());
    Stage stage (1280, 720);
    stage.fill (files.question);
    checkLayout (files.question);

    DeskRig r;
    auto& fit = r.make<FitPanel> (fitPanel);
    stage.fill (fit);
    r.desk.fitRecording (r.home / "nowhere.csv");
    checkLayout (fit);

    HelpPanel help { catalogue() };
    stage.addChildComponent (help);
    help.setArea (stage.getLocalBounds());
    help.showKeys();
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
