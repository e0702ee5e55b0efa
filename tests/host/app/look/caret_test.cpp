// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/caret.hpp>

#include "host/app/support/window_rig.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace tactus::host;
using tactus::host::test::WindowRig;

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
        WindowRig::settle (20);
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
    WindowRig w ("dry_wood.json");
    w.view->canvas().grabKeyboardFocus();
    WindowRig::settle (100);
    const auto none = count (*w.view);
    CHECK (none.all > 1);
    CHECK (none.blinking == 0);
    CHECK (none.visible == 0);

    auto* field = fieldIn (*w.view);
    REQUIRE (field != nullptr);
    field->grabKeyboardFocus();
    WindowRig::settle (100);
    REQUIRE (field->hasKeyboardFocus (false));
    CHECK (count (*w.view).blinking == 1);
    CHECK (becomes (0, *w.view));
    CHECK (becomes (1, *w.view));

    w.view->canvas().grabKeyboardFocus();
    WindowRig::settle (100);
    CHECK (count (*w.view).blinking == 0);
    CHECK (count (*w.view).visible == 0);
}
