// SPDX-License-Identifier: GPL-3.0-or-later
// What the monkey does with the mouse anywhere in the window.
#include "monkey.hpp"

#include <typeinfo>

namespace tactus::host::test
{

juce::Point<float> Monkey::anywhere() { return { part() * static_cast<float> (stage->getWidth()), part() * static_cast<float> (stage->getHeight()) }; }

juce::String Monkey::coordinates (juce::Point<float> p) { return juce::String (juce::roundToInt (p.x)) + "," + juce::String (juce::roundToInt (p.y)); }

int Monkey::someButton()
{
    const int n = upTo (8);
    if (n == 0) return juce::ModifierKeys::rightButtonModifier;
    return n == 1 ? juce::ModifierKeys::middleButtonModifier : juce::ModifierKeys::leftButtonModifier;
}

int Monkey::someKeys()
{
    const int keys[] { juce::ModifierKeys::shiftModifier, juce::ModifierKeys::ctrlModifier, juce::ModifierKeys::altModifier };
    return upTo (4) == 0 ? oneOf (keys) : 0;
}

juce::Component* Monkey::something()
{
    std::vector<juce::Component*> all;
    const auto add = [&] (auto&& self, juce::Component& c) -> void {
        if (! c.isVisible() || c.getWidth() <= 0 || c.getHeight() <= 0) return;
        bool has_none = true;
        for (auto* child : c.getChildren())
        {
            has_none = has_none && ! child->isVisible();
            self (self, *child);
        }
        if (has_none && &c != &view->canvas()) all.push_back (&c);
    };
    add (add, *view);
    return all.empty() ? nullptr : oneOf (all);
}

juce::Point<float> Monkey::in (juce::Component& c)
{
    const float x = part() * static_cast<float> (c.getWidth()), y = part() * static_cast<float> (c.getHeight());
    return stage->getLocalPoint (&c, juce::Point<float> (x, y));
}

std::string Monkey::describe (juce::Component& c)
{
    const auto* button = dynamic_cast<juce::Button*> (&c);
    auto name = c.getTitle().isNotEmpty() ? c.getTitle() : c.getName();
    if (button != nullptr && button->getButtonText().isNotEmpty()) name = button->getButtonText();
    return std::string (typeid (c).name()) + " '" + name.toStdString() + "'";
}

std::string Monkey::clickAt (juce::Point<float> at)
{
    const int how = upTo (8), button = someButton(), keys = someKeys();
    how == 0 ? stage->doubleClick (at) : stage->click (at, button, keys);
    return ((how == 0 ? "double click " : "click ") + coordinates (at) + " button " + juce::String (button) + " keys " + juce::String (keys)).toStdString();
}

std::string Monkey::dragFromTo (juce::Point<float> from, juce::Point<float> to)
{
    const int button = someButton(), keys = someKeys();
    stage->drag (from, to, button, keys);
    return ("drag " + coordinates (from) + " to " + coordinates (to) + " button " + juce::String (button) + " keys " + juce::String (keys)).toStdString();
}

std::string Monkey::clickAnywhere() { return clickAt (anywhere()); }

std::string Monkey::dragAnywhere() { return dragFromTo (anywhere(), anywhere()); }

std::string Monkey::clickSomething()
{
    auto* c = something();
    if (c == nullptr) return "nothing to click";
    const auto name = describe (*c);
    return name + ": " + clickAt (in (*c));
}

std::string Monkey::dragSomething()
{
    auto* c = something();
    if (c == nullptr) return "nothing to drag";
    const auto name = describe (*c);
    const auto from = in (*c);
    return name + ": " + dragFromTo (from, from + juce::Point<float> (part() - 0.5f, part() - 0.5f) * 300.0f);
}

std::string Monkey::wheel()
{
    const auto at = anywhere();
    const float up = part() - 0.5f;
    const int keys = someKeys();
    stage->wheel (at, up, upTo (2) == 0, keys);
    return ("wheel " + coordinates (at) + " by " + juce::String (up) + " keys " + juce::String (keys)).toStdString();
}

std::string Monkey::drop()
{
    static const char* const names[] { "stroke.csv", "text.csv", "not there.csv", "damaged.json", "graphs/dry_wood.json" };
    const auto file = folder / oneOf (names);
    const auto at = anywhere();
    stage->drop (file.string(), at);
    return "drop " + file.filename().string() + " at " + coordinates (at).toStdString();
}

}   // namespace tactus::host::test
