// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/seen_text.hpp"
#include "host/app/support/wait_for.hpp"

#include <host/app/palette/palette.hpp>

#include <catch2/catch.hpp>

using namespace tactus::host;
using tactus::host::test::readTexts;

namespace
{
struct PaletteRig
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    juce::Component window;
    std::unique_ptr<Palette> palette;

    PaletteRig()
    {
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        window.setSize (1280, 720);
        palette = std::make_unique<Palette>();
        window.addChildComponent (*palette);
    }

    ~PaletteRig()
    {
        palette.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    /// Opens the palette with entries that are called "node 0", "node 1" and so on.
    void open (int count, juce::Point<int> at = { 100, 100 })
    {
        std::vector<PaletteEntry> all;
        for (int i = 0; i < count; ++i)
            all.push_back ({ .type = "node " + std::to_string (i), .name = "Node " + std::to_string (i), .summary = "It does something." });
        palette->open (
            at, [all] (const std::string& query) { return matching (all, query); }, "Add node", [] (const std::string&) {});
    }

    juce::TextEditor& query()
    {
        for (auto* child : palette->getChildren())
            if (auto* editor = dynamic_cast<juce::TextEditor*> (child)) return *editor;
        throw std::runtime_error ("no field");
    }

    juce::ListBox& list()
    {
        for (auto* child : palette->getChildren())
            if (auto* box = dynamic_cast<juce::ListBox*> (child)) return *box;
        throw std::runtime_error ("no list");
    }
};
}   // namespace

TEST_CASE ("the palette is as high as its entries, up to its largest height, and stays in the window", "[app][palette]")
{
    PaletteRig r;
    const int rows = GENERATE (1, 2, 5, 8, 9, 40);
    INFO (rows << " entries");
    r.open (rows);
    const int high = r.palette->getHeight(), row = r.list().getRowHeight();
    CHECK (high == std::min (Palette::highest, high - r.list().getHeight() + rows * row));
    CHECK (r.list().getHeight() <= rows * row);
    CHECK (r.palette->getPosition() == juce::Point (100, 100));

    r.open (rows, { 1200, 700 });
    CHECK (r.window.getLocalBounds().contains (r.palette->getBounds()));
    CHECK (r.palette->getHeight() == high);
}

TEST_CASE ("while one types, the palette shrinks to the hits, and its field stays in place", "[app][palette]")
{
    PaletteRig r;
    r.open (40, { 300, 600 });
    const auto field = r.query().getScreenBounds();
    const int all = r.palette->getHeight();
    r.query().setText ("node 39", true);
    tactus::host::test::settle();
    REQUIRE (r.palette->entries().size() == 1);
    CHECK (r.palette->getHeight() <= all - 7 * r.list().getRowHeight());
    CHECK (r.query().getScreenBounds() == field);

    r.query().setText ("zzqq", true);
    tactus::host::test::settle();
    REQUIRE (r.palette->entries().empty());
    const auto texts = readTexts (*r.palette);
    CHECK (std::ranges::any_of (texts, [] (const auto& t) { return t.text.startsWith ("No match"); }));
    CHECK (tactus::host::test::cutOff (texts, r.palette->getLocalBounds().toFloat()).isEmpty());
}

TEST_CASE ("the first heading of the palette is just below the field", "[app][palette]")
{
    PaletteRig r;
    const int entries = GENERATE (2, 30);
    std::vector<PaletteEntry> all { { .type = {}, .name = "Contact", .summary = {} } };
    for (int i = 0; i < entries; ++i)
        all.push_back ({ .type = "contact.n" + std::to_string (i), .name = "Node " + std::to_string (i), .summary = "It does something." });
    REQUIRE (all.front().isTitle());
    r.palette->open (
        { 100, 100 }, [all] (const std::string&) { return all; }, "Add node", [] (const std::string&) {});
    const auto spaceAbove = [&] {
        for (const auto& t : readTexts (*r.palette))
            if (t.text == "Contact") return t.place.getY() - static_cast<float> (r.query().getBottom());
        return 1000.0f;
    };
    CHECK (spaceAbove() < 18.0f);
    CHECK (r.list().getHeight() <= static_cast<int> (all.size()) * r.list().getRowHeight());
}
