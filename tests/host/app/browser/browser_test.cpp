// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/browser/browser.hpp>
#include <host/app/browser/tag_chips.hpp>
#include <tactus/file/graph_file.hpp>

#include <chrono>
#include <cstdlib>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;
using tactus::host::test::DeskStage;
using tactus::host::test::readTexts;

TEST_CASE ("the description of a preset has two lines below the list, or is a tooltip, however low the panel is", "[app][presets]")
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    setenv ("TACTUS_PRESETS", TACTUS_SOURCE_DIR "/graphs", 1);
    {
        Settings settings;
        PictureStore pictures (catalogue());
        PresetBrowser browser (catalogue(), settings, pictures);
        browser.showOpen (std::filesystem::path (TACTUS_SOURCE_DIR "/graphs/dry_wood.json"));
        const auto wood = std::ranges::find (browser.shipped(), std::string ("Dry wood"), &Preset::name);
        REQUIRE (wood != browser.shipped().end());
        const juce::String about (wood->about);
        juce::ListBox* list = nullptr;
        for (auto* child : browser.getChildren())
            if (auto* box = dynamic_cast<juce::ListBox*> (child)) list = box;
        REQUIRE (list != nullptr);
        for (int height = 120; height <= 900; height += 20)
        {
            browser.setBounds (0, 0, 232, height);
            int lines = 0;
            bool is_described = false;
            for (const auto& t : tactus::host::test::readTexts (browser))
            {
                const auto line = t.text.trimCharactersAtEnd (juce::String::fromUTF8 (" \xe2\x80\xa6"));
                if (t.place.getY() < static_cast<float> (list->getBottom()) || ! line.containsChar (' ') || ! about.contains (line)) continue;
                ++lines;
                is_described = is_described || about.startsWith (line);
            }
            const bool has_tooltip = list->getModel()->getTooltipForRow (0).length() > 40;
            INFO (height << " high: " << lines << " lines");
            CHECK (((is_described && lines >= 2) || has_tooltip));
            if (height >= 280) CHECK ((is_described && lines >= 2));
        }
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}

TEST_CASE ("the picture of a preset is drawn again after its file has been written", "[app][presets]")
{
    const TemporaryFolder folder;
    const auto file = folder / "board.json";
    std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", file);
    PictureStore pictures (catalogue());
    const auto drawn = [&] (int times) {
        auto picture = pictures.get (file);
        tactus::test::eventually (std::chrono::milliseconds (10), [&] { return pictures.done() >= times; });
        REQUIRE (pictures.done() == times);
        picture = pictures.get (file);
        REQUIRE (picture);
        return picture;
    };
    const auto first = drawn (1);
    CHECK (first->problem.empty());
    CHECK (drawn (1) == first);   // the file is the same

    auto graph = loadGraph (file).graph;
    for (auto& node : graph.root.nodes)
        if (node.name == "board") node.params["stiffness"] = 500.0;
    REQUIRE (saveGraph (graph, file));
    std::filesystem::last_write_time (file, std::filesystem::last_write_time (file) + std::chrono::seconds (2));   // whatever the clock of the disk
    CHECK (pictures.get (file) == first);                                                                          // until the new one is done
    const auto second = drawn (2);
    CHECK (second != first);
    CHECK (second->peak < 0.9 * first->peak);
}

TEST_CASE ("the browser searches by words, and Return opens a preset", "[app][presets]")
{
    DeskRig r;
    auto& browser = r.make<PresetBrowser> (presetsPanel);
    r.panel->reload();
    browser.setSize (232, 600);
    const auto all = browser.rows().size();
    CHECK (all >= 30);
    browser.search ("metal ring");
    CHECK (browser.rows().size() < all);
    REQUIRE_FALSE (browser.rows().empty());
    browser.search ({});
    CHECK (browser.rows().size() == all);
    CHECK (browser.rows().front().heading.isEmpty());   // a single section needs no heading

    Preset opened;
    bool is_own = true;
    browser.onOpen = [&] (const Preset& p, bool own) {
        opened = p;
        is_own = own;
    };
    auto* list = dynamic_cast<juce::ListBox*> (browser.getChildComponent (2));
    REQUIRE (list != nullptr);
    list->getModel()->returnKeyPressed (0);
    CHECK (opened.name == browser.rows().front().preset->name);
    CHECK_FALSE (is_own);
}

TEST_CASE ("the tags stay under the pointer after a click, and the chosen ones come first once it has left", "[app][presets]")
{
    DeskStage w ("dry_wood.json");
    TagChips chips;
    std::vector<std::string> now { "wood", "metal", "soft" };
    chips.onChange = [&] { chips.show (now); };
    chips.show (now);
    w.stage->addAndMakeVisible (chips);
    chips.setBounds (20, 20, 400, chips.heightFor (400, 1));
    const auto tags = [&] {
        juce::StringArray all;
        for (const auto& t : readTexts (chips))
            all.add (t.text);
        return all.joinIntoString (" ");
    };
    const auto placeOf = [&] (const juce::String& tag) {
        for (const auto& t : readTexts (chips))
            if (t.text == tag) return w.stage->getLocalPoint (&chips, t.place.getCentre());
        FAIL ("there is no " << tag);
        return juce::Point<float>();
    };
    REQUIRE (tags() == "wood metal soft");
    const auto soft = placeOf ("soft");
    w.stage->click (soft);
    now = { "wood", "soft" };   // what the search has left
    chips.onChange();
    CHECK (chips.chosen().contains ("soft"));
    CHECK (tags() == "wood metal soft");
    w.stage->click (soft);   // a second click takes back the first
    CHECK (chips.chosen().empty());
    w.stage->click (soft);
    w.stage->move ({ 500.0f, 400.0f });
    CHECK (tags() == "soft wood");
}
