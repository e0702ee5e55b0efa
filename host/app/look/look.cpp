// SPDX-License-Identifier: GPL-3.0-or-later
#include "look.hpp"

#include "caret.hpp"

#include <host/tools/figures/typeface.hpp>

namespace tactus::host
{

namespace
{
juce::LookAndFeel_V4::ColourScheme schemeOf (const Theme& t)
{
    const auto highlight = t.raised.interpolatedWith (t.accent, 0.25f);
    // In the order of JUCE: window, widget, menu, outline, text, fill, text and fill of what is highlighted, text of menus.
    return { t.panel, t.raised, t.raised, t.hairline, t.text, t.dim, t.text, highlight, t.text };
}
}   // namespace

Look::Look() : regular (regularTypeface()), bold_face (boldTypeface()) { setTheme (Theme::dark()); }

std::unique_ptr<Look> Look::apart (const Theme& t)
{
    auto look = std::make_unique<Look>();
    look->font_width = 1.001f;
    look->setTheme (t);
    return look;
}

void Look::setTheme (const Theme& t)
{
    current = &t;
    setColourScheme (schemeOf (t));   // what the dialogs of JUCE use, such as that for files
    setColour (juce::ResizableWindow::backgroundColourId, t.panel);
    setColour (juce::TextEditor::textColourId, t.text);
    setColour (juce::TextEditor::backgroundColourId, t.raised);
    setColour (juce::TextEditor::highlightColourId, t.accent.withAlpha (0.35f));
    setColour (juce::TextEditor::highlightedTextColourId, t.text);
    setColour (juce::CaretComponent::caretColourId, t.accent);
    setColour (juce::Label::textColourId, t.text);
    setColour (juce::TooltipWindow::backgroundColourId, t.raised);
    setColour (juce::TooltipWindow::textColourId, t.text);
    setColour (juce::TooltipWindow::outlineColourId, t.hairline);
    setColour (juce::ComboBox::textColourId, t.text);
    setColour (juce::Slider::textBoxTextColourId, t.text);
    setColour (juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    setColour (juce::Slider::trackColourId, juce::Colours::transparentBlack);
    setColour (juce::PopupMenu::backgroundColourId, t.raised);
    setColour (juce::PopupMenu::textColourId, t.text);
    setColour (juce::PopupMenu::headerTextColourId, t.dim);
    setColour (juce::PopupMenu::highlightedBackgroundColourId, t.accent.withAlpha (0.25f));
    setColour (juce::PopupMenu::highlightedTextColourId, t.text);
}

juce::Font Look::font (float size, bool bold) const
{
    juce::Font f (bold ? bold_face : regular);
    f.setHeight (size * 1.2f);   // JUCE's height is ascent plus descent
    if (font_width != 1.0f) f.setHorizontalScale (font_width);
    return f;
}

juce::Typeface::Ptr Look::getTypefaceForFont (const juce::Font& f)
{
    if (f.getTypefaceName() == juce::Font::getDefaultSansSerifFontName()) return f.isBold() ? bold_face : regular;
    return juce::LookAndFeel_V4::getTypefaceForFont (f);
}

void Look::drawScrollbar (juce::Graphics& g, juce::ScrollBar&, int x, int y, int width, int height, bool vertical, int thumb_start,
                          int thumb_size, bool over, bool down)
{
    auto thumb = vertical ? juce::Rectangle<int> (x, thumb_start, width, thumb_size) : juce::Rectangle<int> (thumb_start, y, thumb_size, height);
    g.setColour (theme().dim.withAlpha (over || down ? 0.7f : 0.35f));
    g.fillRoundedRectangle (thumb.reduced (2).toFloat(), 3.0f);
}

void Look::fillTextEditorBackground (juce::Graphics& g, int width, int height, juce::TextEditor& editor)
{
    g.setColour (theme().raised);
    g.fillRoundedRectangle (juce::Rectangle<int> (width, height).toFloat(), 4.0f);
    // JUCE hides the hint once the field has the focus, and the palette always has it.
    if (! editor.hasKeyboardFocus (false) || ! editor.isEmpty() || editor.getTextToShowWhenEmpty().isEmpty()) return;
    g.setColour (theme().dim);
    g.setFont (editor.getFont());
    const juce::Rectangle<int> area (editor.getLeftIndent(), editor.getTopIndent(), width - editor.getLeftIndent(), height - editor.getTopIndent());
    g.drawText (editor.getTextToShowWhenEmpty(), area, editor.getJustificationType(), true);
}

juce::CaretComponent* Look::createCaretComponent (juce::Component* field) { return new Caret (field); }

void Look::drawTextEditorOutline (juce::Graphics& g, int width, int height, juce::TextEditor& editor)
{
    g.setColour (editor.hasKeyboardFocus (true) ? theme().accent : theme().hairline);
    g.drawRoundedRectangle (juce::Rectangle<int> (width, height).toFloat().reduced (0.5f), 4.0f, 1.0f);
}

void Look::drawComboBox (juce::Graphics& g, int width, int height, bool, int, int, int, int, juce::ComboBox& box)
{
    const auto area = juce::Rectangle<int> (width, height).toFloat();
    g.setColour (theme().raised);
    g.fillRoundedRectangle (area, 4.0f);
    g.setColour (box.hasKeyboardFocus (true) ? theme().accent : theme().hairline);
    g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);
    juce::Path arrow;
    const auto at = area.getCentre().withX (area.getRight() - 12.0f);
    arrow.startNewSubPath (at.translated (-4.0f, -2.0f));
    arrow.lineTo (at.translated (0.0f, 2.0f));
    arrow.lineTo (at.translated (4.0f, -2.0f));
    g.setColour (theme().dim);
    g.strokePath (arrow, juce::PathStrokeType (1.4f));
}

void Look::positionComboBoxText (juce::ComboBox& box, juce::Label& label)
{
    label.setBounds (box.getLocalBounds().withTrimmedLeft (4).withTrimmedRight (22));
    label.setBorderSize ({ 1, 4, 1, 2 });
    label.setFont (getComboBoxFont (box));
    label.setMinimumHorizontalScale (1.0f);   // a text that is too long ends with an ellipsis; narrow letters look broken
}

void Look::drawPopupMenuBackground (juce::Graphics& g, int width, int height)
{
    g.fillAll (theme().raised);
    g.setColour (theme().hairline.interpolatedWith (theme().dim, 0.4f));
    g.drawRect (0, 0, width, height);
}

void Look::drawLinearSlider (juce::Graphics& g, int x, int y, int width, int height, float at, float, float, juce::Slider::SliderStyle,
                             juce::Slider& slider)
{
    const auto area = juce::Rectangle<int> (x, y, width, height).toFloat();
    g.setColour (theme().raised);
    g.fillRoundedRectangle (area, 4.0f);
    g.setColour (theme().accent.withAlpha (0.35f));
    g.fillRoundedRectangle (area.withRight (juce::jmax (area.getX(), at)), 4.0f);
    g.setColour (slider.isMouseOverOrDragging() ? theme().dim : theme().hairline);
    g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);
}

juce::Component* Look::getParentComponentForMenuOptions (const juce::PopupMenu::Options& options)
{
    const auto areaAround = [] (juce::Component* part) -> juce::Component* {
        for (auto* c = part; c != nullptr; c = c->getParentComponent())
            if (auto* area = c->findChildWithID (menu_area)) return area;
        return nullptr;
    };
    if (auto* parent = options.getParentComponent())
    {
        auto* area = areaAround (parent);
        return area != nullptr ? area : parent;
    }
    const auto mouse = juce::Desktop::getInstance().getMainMouseSource();
    for (auto* near : { options.getTargetComponent(), juce::Component::getCurrentlyFocusedComponent(), mouse.getComponentUnderMouse() })
        if (near != nullptr)
        {
            auto* area = areaAround (near);
            return area != nullptr ? area : near->getTopLevelComponent();
        }
    return nullptr;
}

void Look::preparePopupMenuWindow (juce::Component& menu)
{
    for (auto* c = menu.getParentComponent(); c != nullptr; c = c->getParentComponent())
        if (auto* listens = dynamic_cast<juce::KeyListener*> (c)) return menu.addKeyListener (listens);
}

Look& lookOf (const juce::Component& c) { return dynamic_cast<Look&> (c.getLookAndFeel()); }

void drawNumber (juce::Graphics& g, const juce::String& text, juce::Rectangle<float> area)
{
    const auto font = g.getCurrentFont();
    const float digit = font.getStringWidthFloat ("0");
    const auto isDigit = [] (juce::juce_wchar c) { return c >= '0' && c <= '9'; };
    float x = area.getRight();
    for (int i = text.length(); --i >= 0;)
    {
        const auto c = text.substring (i, i + 1);
        const float width = isDigit (text[i]) ? digit : font.getStringWidthFloat (c);
        x -= width;
        g.drawText (c, juce::Rectangle<float> (x, area.getY(), width, area.getHeight()).expanded (2.0f, 0.0f), juce::Justification::centred, false);
    }
}

void dimWindow (juce::Graphics& g, const Theme& theme) { g.fillAll (juce::Colours::black.withAlpha (theme.is_dark ? 0.55f : 0.35f)); }

void drawDialog (juce::Graphics& g, const Theme& theme, juce::Rectangle<int> box)
{
    dimWindow (g, theme);
    drawCard (g, theme, box);
}

void drawCard (juce::Graphics& g, const Theme& theme, juce::Rectangle<int> box)
{
    constexpr float corner = 8.0f;
    g.setColour (theme.panel);
    g.fillRoundedRectangle (box.toFloat(), corner);
    g.setColour (theme.hairline);
    g.drawRoundedRectangle (box.toFloat().reduced (0.5f), corner, 1.0f);
}

}   // namespace tactus::host
