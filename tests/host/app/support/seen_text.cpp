// SPDX-License-Identifier: GPL-3.0-or-later
#include "seen_text.hpp"

#include <cmath>
#include <map>
#include <optional>

namespace tactus::host::test
{

namespace
{
constexpr float word_gap = 0.14f, longest_gap = 0.6f;   // between glyphs, as parts of the height of the font: a space, and another text

/// The letter and the width of each glyph of a typeface.
struct Letters
{
    std::map<int, std::pair<juce::juce_wchar, float>> of;

    explicit Letters (juce::Typeface& face)
    {
        const auto add = [&] (juce::juce_wchar from, juce::juce_wchar to) {
            for (auto c = from; c < to; ++c)
            {
                juce::Array<int> glyphs;
                juce::Array<float> places;
                face.getGlyphPositions (juce::String::charToString (c), glyphs, places);
                if (glyphs.size() == 1 && places.size() == 2) of.emplace (glyphs[0], std::pair { c, places[1] });
            }
        };
        add ('!', 0x7f);
        add (0xa1, 0x400);
        add (0x2010, 0x2300);
    }
};

class Reader final : public juce::LowLevelGraphicsSoftwareRenderer
{
public:
    using LowLevelGraphicsSoftwareRenderer::LowLevelGraphicsSoftwareRenderer;

    // A layer would have its own coordinates.
    void beginTransparencyLayer (float) override { saveState(); }
    void endTransparencyLayer() override { restoreState(); }

    void drawGlyph (int glyph, const juce::AffineTransform& t) override
    {
        const auto& font = getFont();
        const auto face = font.getTypefacePtr();
        auto& letters = known[face.get()];
        if (! letters) letters.emplace (*face);
        const auto found = letters->of.find (glyph);
        const auto [letter, width] = found != letters->of.end() ? found->second : std::pair<juce::juce_wchar, float> { '?', 0.5f };
        const float height = font.getHeight();
        const juce::Rectangle<float> box (0.0f, -0.75f * height, width * height * font.getHorizontalScale(), 0.9f * height);
        const auto inside = getClipBounds().toFloat().expanded (1.5f);
        add (letter, box.transformedBy (stack->transform.getTransformWith (t)), ! inside.contains (box.transformedBy (t)));
    }

    std::vector<SeenText> all;

private:
    void add (juce::juce_wchar letter, juce::Rectangle<float> box, bool is_cut)
    {
        if (! all.empty())
        {
            auto& last = all.back();
            const float gap = box.getX() - last.place.getRight();
            const bool goes_on = std::abs (box.getBottom() - last.place.getBottom()) < 0.5f && std::abs (box.getHeight() - last.place.getHeight()) < 0.5f;
            if (goes_on && gap > -1.0f && gap < longest_gap * box.getHeight())
            {
                if (gap > word_gap * box.getHeight()) last.text << ' ';
                last.text << juce::String::charToString (letter);
                last.place = last.place.getUnion (box);
                last.is_cut = last.is_cut || is_cut;
                return;
            }
        }
        all.push_back ({ juce::String::charToString (letter), box, is_cut });
    }

    std::map<juce::Typeface*, std::optional<Letters>> known;
};

bool isText (const SeenText& t) { return t.text.length() > 2 && t.text.containsAnyOf ("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"); }
}   // namespace

std::vector<SeenText> readTexts (juce::Component& c)
{
    const juce::Image image (juce::Image::RGB, std::max (1, c.getWidth()), std::max (1, c.getHeight()), false, juce::SoftwareImageType());
    Reader reader (image);
    juce::Graphics g (reader);
    c.paintEntireComponent (g, true);
    return reader.all;
}

bool showsText (juce::Component& c, const juce::String& text)
{
    return std::ranges::any_of (readTexts (c), [&] (const SeenText& t) { return t.text == text; });
}

bool mentions (juce::Component& c, const juce::String& words)
{
    return std::ranges::any_of (readTexts (c), [&] (const SeenText& t) { return t.text.contains (words); });
}

juce::StringArray overlaps (const std::vector<SeenText>& texts, juce::Rectangle<float> area)
{
    juce::StringArray all;
    for (std::size_t i = 0; i < texts.size(); ++i)
    {
        if (! isText (texts[i]) || ! area.contains (texts[i].place.getCentre())) continue;
        for (std::size_t k = 0; k < i; ++k)
            if (isText (texts[k]) && texts[i].place.reduced (1.5f).intersects (texts[k].place.reduced (1.5f))) all.add (texts[k].text + " | " + texts[i].text);
    }
    return all;
}

juce::StringArray cutOff (const std::vector<SeenText>& texts, juce::Rectangle<float> area)
{
    juce::StringArray all;
    for (const auto& t : texts)
        if (isText (t) && t.is_cut && area.contains (t.place.getCentre())) all.add (t.text);
    return all;
}

}   // namespace tactus::host::test
