// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

#include <map>
#include <string>
#include <vector>

namespace tactus::host
{

/// Collects what juce::Graphics draws, as outlines, and writes it as SVG or PDF: paths, rectangles, images, texts, which look the same without the
/// typeface, and clips, which are rectangles. A gradient becomes its first colour. A layer has its opacity in each of its shapes.
class VectorCanvas : public juce::LowLevelGraphicsContext
{
public:
    /// The size of the picture, in the unit of the coordinates.
    VectorCanvas (float picture_width, float picture_height) : width (picture_width), height (picture_height) {}

    /// Draws a line that stays a line in the file. juce::Graphics would turn it into an outline with many more points.
    void stroke (const juce::Path& line, float thickness);

    /// The picture as a file. `units_per_inch` gives its size on paper.
    std::string svg (const std::string& title, double units_per_inch) const;
    std::string pdf (const std::string& title, double units_per_inch) const;

    bool isVectorDevice() const override { return true; }
    void setOrigin (juce::Point<int>) override;
    void addTransform (const juce::AffineTransform&) override;
    float getPhysicalPixelScaleFactor() override { return 1.0f; }
    bool clipToRectangle (const juce::Rectangle<int>&) override;
    bool clipToRectangleList (const juce::RectangleList<int>&) override;
    void excludeClipRectangle (const juce::Rectangle<int>&) override {}
    void clipToPath (const juce::Path&, const juce::AffineTransform&) override;
    void clipToImageAlpha (const juce::Image&, const juce::AffineTransform&) override {}
    bool clipRegionIntersects (const juce::Rectangle<int>&) override { return true; }
    juce::Rectangle<int> getClipBounds() const override;
    bool isClipEmpty() const override { return now.clip.isEmpty(); }
    void saveState() override { saved.push_back (now); }
    void restoreState() override;
    void beginTransparencyLayer (float opacity) override;
    void endTransparencyLayer() override { restoreState(); }
    void setFill (const juce::FillType&) override;
    void setOpacity (float opacity) override { now.colour = now.colour.withAlpha (opacity); }
    void setInterpolationQuality (juce::Graphics::ResamplingQuality) override {}
    void fillRect (const juce::Rectangle<int>&, bool) override;
    void fillRect (const juce::Rectangle<float>&) override;
    void fillRectList (const juce::RectangleList<float>&) override;
    void fillPath (const juce::Path&, const juce::AffineTransform&) override;
    void drawImage (const juce::Image&, const juce::AffineTransform&) override;
    void drawLine (const juce::Line<float>&) override;
    void setFont (const juce::Font& chosen) override { now.font = chosen; }
    const juce::Font& getFont() override { return now.font; }
    void drawGlyph (int glyph, const juce::AffineTransform&) override;

private:
    struct State
    {
        juce::AffineTransform transform;
        juce::Rectangle<float> clip;
        juce::Colour colour { juce::Colours::black };
        float layer_opacity = 1.0f;
        juce::Font font {};
    };

    struct Shape
    {
        juce::Path outline {};
        juce::Colour colour {};
        juce::Rectangle<float> clip {};
        float thickness = 0.0f;        // of the line; 0: the shape is filled
        juce::Image image {};          // drawn instead of the outline, if there is one
        int glyph = -1;                // the same, if it is not negative
        juce::AffineTransform at {};   // of the image, whose corner is at the origin, or of the glyph
    };

    struct Glyph
    {
        juce::Typeface::Ptr face;   // keeps the key of the map alive
        juce::Path outline;         // 1 high
    };

    void clipTo (juce::Rectangle<float>);
    void add (juce::Path, float thickness);
    void add (Shape, juce::Rectangle<float> drawn);
    std::string svgOf (const Shape&) const;
    juce::Rectangle<float> picture() const { return { width, height }; }

    float width, height;
    State now { {}, picture() };
    std::vector<State> saved;
    std::vector<Shape> shapes;
    std::vector<Glyph> glyphs;
    std::map<std::pair<const juce::Typeface*, int>, int> glyph_numbers;   // by typeface and its own number
};

}   // namespace tactus::host
