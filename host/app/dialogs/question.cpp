// SPDX-License-Identifier: GPL-3.0-or-later
#include "question.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
/// Commands stand in backticks, as in the docs. A question has one font.
juce::String inQuotes (const juce::String& text) { return text.replaceCharacter ('`', '\''); }
}   // namespace

juce::String Question::listOf (const std::vector<std::filesystem::path>& names)
{
    juce::String list;
    for (std::size_t i = 0; i < std::min (most_listed, names.size()); ++i)
        list << fromUtf8 (printableName (names[i].string())) << "\n";
    if (names.size() > most_listed) list << filled (TRANS ("and %1 more"), names.size() - most_listed) << "\n";
    return list + "\n";
}

Question::Question()
{
    setVisible (false);
    setWantsKeyboardFocus (true);
    addMouseListener (this, true);
}

void Question::ask (const juce::String& title, const juce::String& text, std::vector<Choice> all)
{
    if (isOpen())
    {
        waiting.push_back ({ title, text, std::move (all) });
        return;
    }
    is_begun = is_late = is_key_held = false;
    heading = title;
    body = inQuotes (text);
    choices = std::move (all);
    setTitle (title);
    setDescription (body);
    buttons.clear();
    for (std::size_t i = 0; i < choices.size(); ++i)
    {
        auto& b = *buttons.emplace_back (std::make_unique<PlainButton> (choices[i].label));
        b.onClick = [this, i] {
            if (! is_late) answer (i);
        };
        addAndMakeVisible (b);
    }
    mark (0);
    setVisible (true);
    toFront (false);
    resized();
    repaint();
    takeFocus (*this);
}

void Question::say (const juce::String& text)
{
    const auto now = inQuotes (text);
    if (now == body) return;
    body = now;
    setDescription (body);
    resized();
    repaint();
}

void Question::answer (std::size_t choice)
{
    if (! isOpen() || choice >= choices.size()) return;
    const auto act = choices[choice].act;   // may ask the next question
    setVisible (false);
    if (auto* parent = getParentComponent()) takeFocus (*parent);
    if (act) act();
    if (isOpen() || waiting.empty()) return;
    auto next = std::move (waiting.front());
    waiting.pop_front();
    ask (next.title, next.text, std::move (next.choices));
}

void Question::cancel()
{
    if (! choices.empty()) answer (choices.size() - 1);
}

void Question::mark (std::size_t choice)
{
    marked = choice;
    for (std::size_t i = 0; i < buttons.size(); ++i)
        buttons[i]->setFirst (i == marked);
}

juce::TextLayout Question::layout (int w) const
{
    const auto& look = lookOf (*this);
    return wrapText (body, look.font (13.0f), look.theme().text, static_cast<float> (w));
}

juce::TextLayout Question::layoutOfTitle (int w) const
{
    const auto& look = lookOf (*this);
    return wrapText (heading, look.font (16.0f, true), look.theme().text, static_cast<float> (w));
}

int Question::titleHeight (int w) const { return std::max (24, static_cast<int> (std::ceil (layoutOfTitle (w).getHeight()))); }

void Question::resized()
{
    const int w = std::min (width, getWidth() - 32);
    const int text_height = static_cast<int> (std::ceil (layout (w - 2 * margin).getHeight()));
    constexpr int gap = 8, high = 32;
    int in_a_row = -gap;
    for (const auto& b : buttons)
        in_a_row += b->widthFor() + gap;
    const bool is_list = in_a_row > w - 2 * margin;   // long labels: one below the other
    const int rows = is_list ? static_cast<int> (buttons.size()) : 1;
    box = getLocalBounds().withSizeKeepingCentre (w, margin + titleHeight (w - 2 * margin) + 8 + text_height + 24 + rows * (high + gap) - gap + margin);
    auto area = box.reduced (margin).removeFromBottom (rows * (high + gap) - gap);
    for (const auto& b : buttons)
        if (is_list)
            b->setBounds (area.removeFromTop (high + gap).withHeight (high));
        else
        {
            b->setBounds (area.withLeft (area.getRight() - in_a_row).withWidth (b->widthFor()));
            in_a_row -= b->widthFor() + gap;
        }
}

void Question::paint (juce::Graphics& g)
{
    drawDialog (g, themeOf (*this), box);
    auto area = box.reduced (margin);
    const auto title = layoutOfTitle (area.getWidth());
    const auto top = area.removeFromTop (titleHeight (area.getWidth())).toFloat();
    title.draw (g, top.withSizeKeepingCentre (top.getWidth(), title.getHeight()));
    area.removeFromTop (8);
    layout (area.getWidth()).draw (g, area.toFloat());
}

bool Question::keyPressed (const juce::KeyPress& key)
{
    if (key == juce::KeyPress::returnKey || key == juce::KeyPress::spaceKey)
    {
        if (is_key_held) return true;
        answer (marked);
        is_key_held = isOpen();
    }
    else if (key == juce::KeyPress::rightKey || key == juce::KeyPress::downKey || key == juce::KeyPress::tabKey)
        mark ((marked + 1) % choices.size());
    else if (key == juce::KeyPress::leftKey || key == juce::KeyPress::upKey)
        mark ((marked + choices.size() - 1) % choices.size());
    else
        return false;
    return true;
}

bool Question::keyStateChanged (bool is_down)
{
    is_key_held = is_key_held && is_down;
    return false;
}

void Question::mouseDown (const juce::MouseEvent& e)
{
    is_begun = is_begun || e.getNumberOfClicks() == 1;
    is_late = ! is_begun;
}

void Question::mouseUp (const juce::MouseEvent&) { is_late = false; }

}   // namespace tactus::host
