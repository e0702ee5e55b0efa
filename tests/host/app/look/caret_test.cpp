// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/caret.hpp>

#include "host/app/support/desk_stage.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;

namespace
{
void addCarets (juce::Component& from, std::vector<Caret*>& to)
{
    if (auto* caret = dynamic_cast<Caret*> (&from)) to.push_back (caret);
    for (auto* child : from.getChildren())
        addCarets (*child, to);
}

struct Count
{
    std::size_t all = 0, blinking = 0, visible = 0;
};

Count count (juce::Component& within)
{
    std::vector<Caret*> carets;
    addCarets (within, carets);
    return { carets.size(), static_cast<std::size_t> (std::ranges::count_if (carets, &Caret::isBlinking)),
             static_cast<std::size_t> (std::ranges::count_if (carets, &Caret::isVisible)) };
}

bool becomes (std::size_t visible, juce::Component& within)
{
    for (int i = 0; i < 500 && count (within).visible != visible; ++i)
        OnStage::settle (20);
    return count (within).visible == visible;
}

juce::TextEditor* fieldIn (juce::Component& from)
{
    if (auto* field = dynamic_cast<juce::TextEditor*> (&from); field != nullptr && field->isShowing() && field->isCaretVisible()) return field;
    for (auto* child : from.getChildren())
        if (auto* field = fieldIn (*child)) return field;
    return nullptr;
}
}   // namespace

TEST_CASE ("only the caret of the field that has the keyboard blinks", "[app][look]")
{
    DeskStage w ("dry_wood.json");
    w.canvas.grabKeyboardFocus();
    OnStage::settle (100);
    const auto none = count (*w.stage);
    CHECK (none.all > 1);
    CHECK (none.blinking == 0);
    CHECK (none.visible == 0);

    auto* field = fieldIn (*w.stage);
    REQUIRE (field != nullptr);
    field->grabKeyboardFocus();
    OnStage::settle (100);
    REQUIRE (field->hasKeyboardFocus (false));
    CHECK (count (*w.stage).blinking == 1);
    CHECK (becomes (0, *w.stage));
    CHECK (becomes (1, *w.stage));

    w.canvas.grabKeyboardFocus();
    OnStage::settle (100);
    CHECK (count (*w.stage).blinking == 0);
    CHECK (count (*w.stage).visible == 0);
}
