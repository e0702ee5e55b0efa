// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Writes what is painted as SVG. Texts become outlines, so the picture looks the same without the typeface. Images are left out, and a gradient
/// becomes its first colour: a canvas has neither. [message thread]
class SvgGraphics final : public juce::LowLevelGraphicsContext
{
public:
    SvgGraphics (int width, int height);

    std::string text() const;   ///< the whole file

    bool isVectorDevice() const override { return true; }
    void setOrigin (juce::Point<int>) override;
    void addTransform (const juce::AffineTransform&) override;
    float getPhysicalPixelScaleFactor() override { return 1.0f; }
    bool clipToRectangle (const juce::Rectangle<int>&) override;
    bool clipToRectangleList (const juce::RectangleList<int>&) override;
    void excludeClipRectangle (const juce::Rectangle<int>&) override {}
    void clipToPath (const juce::Path&, const juce::AffineTransform&) override;
    void clipToImageAlpha (const juce::Image&, const juce::AffineTransform&) override {}
    bool clipRegionIntersects (const juce::Rectangle<int>&) override;
    juce::Rectangle<int> getClipBounds() const override;
    bool isClipEmpty() const override { return state().clip.isEmpty(); }
    void saveState() override { states.push_back (states.back()); }
    void restoreState() override;
    void beginTransparencyLayer (float opacity) override;
    void endTransparencyLayer() override;
    void setFill (const juce::FillType&) override;
    void setOpacity (float) override;
    void setInterpolationQuality (juce::Graphics::ResamplingQuality) override {}
    void fillRect (const juce::Rectangle<int>&, bool) override;
    void fillRect (const juce::Rectangle<float>&) override;
    void fillRectList (const juce::RectangleList<float>&) override;
    void fillPath (const juce::Path&, const juce::AffineTransform&) override;
    void drawImage (const juce::Image&, const juce::AffineTransform&) override {}
    void drawLine (const juce::Line<float>&) override;
    void setFont (const juce::Font& f) override { state().font = f; }
    const juce::Font& getFont() override { return state().font; }
    void drawGlyph (int glyph, const juce::AffineTransform&) override;

private:
    struct State
    {
        juce::AffineTransform transform;
        juce::Rectangle<float> clip;   // in the picture
        juce::Colour colour { juce::Colours::black };
        juce::Font font;
    };

    State& state() noexcept { return states.back(); }
    const State& state() const noexcept { return states.back(); }
    void clipTo (juce::Rectangle<float>);
    std::string paint() const;                           // the attributes of colour and opacity
    std::string clipOf (juce::Rectangle<float> drawn);   // the attribute that clips what is drawn there; "" if nothing is cut

    int width, height;
    std::vector<State> states;
    std::string definitions, body;
    std::map<std::pair<const juce::Typeface*, int>, int> glyphs;   // their numbers in the definitions
    std::vector<juce::Typeface::Ptr> faces;                        // keeps the keys of the map alive
    std::map<std::string, int> clips;
};

}   // namespace tactus::host
