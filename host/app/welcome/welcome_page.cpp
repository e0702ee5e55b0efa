// SPDX-License-Identifier: GPL-3.0-or-later
#include "welcome_page.hpp"

#include <host/app/look/button.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int columns = 3;   // of cards
constexpr std::size_t most_cards = 6;
constexpr int margin = 32, gap = 12, line_height = 15, low = 420, lowest = 224;   // of the page, in pixels

/// The first sentence.
juce::String firstSentence (const std::string& about)
{
    const auto text = juce::String (about);
    const int dot = text.indexOf (". ");
    return dot > 0 ? text.substring (0, dot + 1) : text;
}
}   // namespace

std::vector<Preset> firstOnes (const std::vector<Preset>& presets, std::size_t most)
{
    constexpr std::array names { "Dry wood", "Soft pad", "Aluminium bar", "Layered cloth", "Notched rail", "Rubber ball" };
    std::vector<Preset> found;
    const auto take = [&] (const Preset& p) {
        if (found.size() < most && p.problem.empty() && p.placeholders.empty() && std::ranges::count (found, p.file, &Preset::file) == 0) found.push_back (p);
    };
    for (const auto* name : names)
        if (const auto p = std::ranges::find (presets, name, &Preset::name); p != presets.end()) take (*p);
    for (const auto& p : presets)
        take (p);
    return found;
}

/// The card of a preset: its name, what it feels like, and a plot of its force.
class WelcomePage::Card final : public Button
{
public:
    Card (const Preset& p, PictureStore& s) : Button (p.name), preset (p), pictures (s)
    {
        setDescription (p.about);
        setWantsKeyboardFocus (true);
        setMouseCursor (juce::MouseCursor::PointingHandCursor);
    }

    const Preset preset;
    std::function<void()> onKey;   ///< called by Return and the space bar

    bool keyPressed (const juce::KeyPress& key) override
    {
        if (key != juce::KeyPress::returnKey && key != juce::KeyPress::spaceKey) return false;
        if (onKey) onKey();
        return true;
    }

    void paintButton (juce::Graphics& g, bool over, bool) override
    {
        const auto& look = lookOf (*this);
        const auto& theme = look.theme();
        const auto area = getLocalBounds().toFloat().reduced (0.5f);
        g.setColour (theme.raised);
        g.fillRoundedRectangle (area, 8.0f);
        g.setColour (over || hasKeyboardFocus (false) ? theme.accent : theme.hairline);
        g.drawRoundedRectangle (area, 8.0f, over ? 1.5f : 1.0f);
        auto inside = getLocalBounds().reduced (12, 8);
        auto top = inside.removeFromTop (20);
        g.setColour (theme.text);
        g.setFont (look.font (14.0f, true));
        g.drawText (preset.name, top, juce::Justification::centredLeft, true);
        if (over)
        {
            g.setColour (theme.accent);
            g.setFont (look.font (12.0f, true));
            g.drawText (TRANS ("Feel it"), top, juce::Justification::centredRight, false);
        }
        const int lines = inside.getHeight() > 100 ? 3 : 2;
        drawFittedText (g, firstSentence (preset.about), look.font (12.0f), theme.dim, inside.removeFromTop (lines * line_height));
        drawPicture (g, look, inside.withTrimmedTop (6).toFloat(), pictures.get (preset.file).get());
    }

private:
    PictureStore& pictures;
};

WelcomePage::WelcomePage (PictureStore& p) : pictures (p)
{
    setTitle (TRANS ("Welcome"));
    create.onClick = [this] {
        if (onNew) onNew();
    };
    open.onClick = [this] {
        if (onOpen) onOpen();
    };
    tour.onClick = [this] {
        if (onTour) onTour();
    };
    tour.setTooltip (TRANS ("A tour of the window in five steps. It is in the menu, too."));
    addAndMakeVisible (create);
    addAndMakeVisible (open);
    addChildComponent (tour);
}

WelcomePage::~WelcomePage() = default;

void WelcomePage::show (const std::vector<Preset>& presets, bool offers_tour)
{
    tour.setVisible (offers_tour && ! presets.empty());
    chosen = firstOnes (presets, most_cards);
    all.clear();
    for (const auto& p : chosen)
    {
        auto& card = *all.emplace_back (std::make_unique<Card> (p, pictures));
        card.onClick = [this, file = p.file] {
            if (onFeel) onFeel (file, true);
        };
        card.onKey = [this, file = p.file] {
            if (onFeel) onFeel (file, false);
        };
        addAndMakeVisible (card);
    }
    resized();
    repaint();
}

void WelcomePage::refresh (bool has_device)
{
    const int done = pictures.done();
    if (std::exchange (pictures_done, done) == done && is_by_device == has_device) return;
    is_by_device = has_device;
    repaint();
}

juce::String WelcomePage::invitation() const
{
    if (all.empty()) return TRANS ("No presets found next to the program. Set TACTUS_PRESETS to their folder, or start with an empty graph.");
    if (! is_by_device) return TRANS ("Click a preset to run it with the mouse as your hand: press on its surface and drag.");
    return TRANS ("Click a preset to run it. Its tool is moved by the device that you chose for it, or by the mouse: press on its surface and drag.");
}

void WelcomePage::resized()
{
    const bool is_low = getHeight() < low;
    auto area = getLocalBounds().reduced (margin, is_low ? 12 : margin);
    area = area.withSizeKeepingCentre (std::min (area.getWidth(), 1040), std::min (area.getHeight(), 560));
    title = area.removeFromTop (is_low ? 56 : 64);
    const bool is_lowest = getHeight() < lowest;
    const int heading_width = juce::roundToInt (lookOf (*this).font (20.0f, true).getStringWidthFloat (TRANS ("Feel something"))) + 24;
    auto low_row = is_lowest ? title.withHeight (28).withTrimmedLeft (heading_width) : area.removeFromBottom (32);
    create.setBounds (low_row.removeFromLeft (create.widthFor()));
    low_row.removeFromLeft (8);
    open.setBounds (low_row.removeFromLeft (open.widthFor()));
    if (tour.isVisible())
    {
        low_row.removeFromLeft (8);
        tour.setBounds (low_row.removeFromLeft (tour.widthFor()));
    }
    if (! is_lowest) area.removeFromBottom (is_low ? gap : 24);
    const int rows = std::max (1, (static_cast<int> (all.size()) + columns - 1) / columns);
    const int w = (area.getWidth() - (columns - 1) * gap) / columns, h = (area.getHeight() - (rows - 1) * gap) / rows;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i]->setBounds (area.getX() + static_cast<int> (i % columns) * (w + gap), area.getY() + static_cast<int> (i / columns) * (h + gap), w, h);
}

/// Arrows go from card to card, and below the cards is a row of buttons.
bool WelcomePage::keyPressed (const juce::KeyPress& key)
{
    const auto now = std::ranges::find_if (all, [] (const auto& card) { return card->hasKeyboardFocus (false); });
    const bool is_below = now == all.end();
    if (is_below && (all.empty() || key != juce::KeyPress::upKey)) return false;
    auto to = is_below ? std::ssize (all) - 1 + columns : now - all.begin();
    if (key == juce::KeyPress::leftKey)
        --to;
    else if (key == juce::KeyPress::rightKey)
        ++to;
    else if (key == juce::KeyPress::upKey)
        to -= columns;
    else if (key == juce::KeyPress::downKey)
        to += columns;
    else
        return false;
    if (to >= 0 && to < std::ssize (all))
        takeFocus (*all[static_cast<std::size_t> (to)]);
    else if (key == juce::KeyPress::downKey)
        takeFocus (create);
    return true;
}

void WelcomePage::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.canvas);
    auto lines = title;
    g.setColour (theme.text);
    g.setFont (look.font (20.0f, true));
    g.drawText (TRANS ("Feel something"), lines.removeFromTop (28), juce::Justification::centredLeft, false);
    g.setColour (theme.dim);
    g.setFont (look.font (13.0f));
    g.drawText (invitation(), lines.removeFromTop (20), juce::Justification::centredLeft, true);
}

}   // namespace tactus::host
