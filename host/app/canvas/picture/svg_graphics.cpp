// SPDX-License-Identifier: GPL-3.0-or-later
#include "svg_graphics.hpp"

#include <tactus/text/number_text.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
std::string number (float v, double per_unit = 100.0) { return numberText (std::round (static_cast<double> (v) * per_unit) / per_unit + 0.0); }

std::string point (float x, float y, double per_unit) { return number (x, per_unit) + ' ' + number (y, per_unit); }

/// The attribute `d` of a path.
std::string dataOf (const juce::Path& path, double per_unit)
{
    std::string data;
    for (juce::Path::Iterator i (path); i.next();)
        switch (i.elementType)
        {
        case juce::Path::Iterator::startNewSubPath:
            data += 'M' + point (i.x1, i.y1, per_unit);
            break;
        case juce::Path::Iterator::lineTo:
            data += 'L' + point (i.x1, i.y1, per_unit);
            break;
        case juce::Path::Iterator::quadraticTo:
            data += 'Q' + point (i.x1, i.y1, per_unit) + ' ' + point (i.x2, i.y2, per_unit);
            break;
        case juce::Path::Iterator::cubicTo:
            data += 'C' + point (i.x1, i.y1, per_unit) + ' ' + point (i.x2, i.y2, per_unit) + ' ' + point (i.x3, i.y3, per_unit);
            break;
        case juce::Path::Iterator::closePath:
            data += 'Z';
            break;
        }
    return data;
}

std::string rectangle (juce::Rectangle<float> r)
{
    return "<rect x=\"" + number (r.getX()) + "\" y=\"" + number (r.getY()) + "\" width=\"" + number (r.getWidth()) + "\" height=\""
           + number (r.getHeight()) + '"';
}

bool isUpright (const juce::AffineTransform& t) { return t.mat01 == 0.0f && t.mat10 == 0.0f; }
}   // namespace

SvgGraphics::SvgGraphics (int w, int h) : width (w), height (h)
{
    states.push_back ({ {}, juce::Rectangle<int> (w, h).toFloat(), juce::Colours::black, {} });
}

std::string SvgGraphics::text() const
{
    const auto w = std::to_string (width), h = std::to_string (height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w + ' ' + h + "\">\n<defs>\n" + definitions
           + "</defs>\n" + body + "</svg>\n";
}

void SvgGraphics::setOrigin (juce::Point<int> p) { addTransform (juce::AffineTransform::translation (p.toFloat())); }
void SvgGraphics::addTransform (const juce::AffineTransform& t) { state().transform = t.followedBy (state().transform); }

void SvgGraphics::clipTo (juce::Rectangle<float> r) { state().clip = state().clip.getIntersection (r.transformedBy (state().transform)); }

bool SvgGraphics::clipToRectangle (const juce::Rectangle<int>& r)
{
    clipTo (r.toFloat());
    return ! isClipEmpty();
}

bool SvgGraphics::clipToRectangleList (const juce::RectangleList<int>& all) { return clipToRectangle (all.getBounds()); }
void SvgGraphics::clipToPath (const juce::Path& path, const juce::AffineTransform& t) { clipTo (path.getBoundsTransformed (t)); }

bool SvgGraphics::clipRegionIntersects (const juce::Rectangle<int>& r) { return state().clip.intersects (r.toFloat().transformedBy (state().transform)); }

juce::Rectangle<int> SvgGraphics::getClipBounds() const
{
    return state().clip.transformedBy (state().transform.inverted()).getSmallestIntegerContainer();
}

void SvgGraphics::restoreState()
{
    if (states.size() > 1) states.pop_back();
}

void SvgGraphics::beginTransparencyLayer (float opacity)
{
    saveState();
    body += "<g opacity=\"" + number (opacity) + "\">\n";
}

void SvgGraphics::endTransparencyLayer()
{
    body += "</g>\n";
    restoreState();
}

void SvgGraphics::setFill (const juce::FillType& fill)
{
    const bool has_gradient = fill.isGradient() && fill.gradient->getNumColours() > 0;
    const auto colour = has_gradient ? fill.gradient->getColour (0) : fill.colour;
    state().colour = colour.withMultipliedAlpha (has_gradient ? fill.getOpacity() : 1.0f);
}

void SvgGraphics::setOpacity (float opacity) { state().colour = state().colour.withAlpha (opacity); }

std::string SvgGraphics::paint() const
{
    const auto c = state().colour;
    auto text = " fill=\"#" + c.toDisplayString (false).toLowerCase().toStdString() + '"';
    if (c.getAlpha() < 255) text += " fill-opacity=\"" + number (c.getFloatAlpha(), 1000.0) + '"';
    return text;
}

std::string SvgGraphics::clipOf (juce::Rectangle<float> drawn)
{
    const auto clip = state().clip;
    if (clip.contains (drawn)) return {};
    const auto shape = rectangle (clip) + "/>";
    const auto [known, is_new] = clips.try_emplace (shape, static_cast<int> (clips.size()));
    const auto id = 'c' + std::to_string (known->second);
    if (is_new) definitions += "<clipPath id=\"" + id + "\">" + shape + "</clipPath>\n";
    return " clip-path=\"url(#" + id + ")\"";
}

void SvgGraphics::fillRect (const juce::Rectangle<int>& r, bool) { fillRect (r.toFloat()); }

void SvgGraphics::fillRect (const juce::Rectangle<float>& r)
{
    if (! isUpright (state().transform))
    {
        juce::Path path;
        path.addRectangle (r);
        return fillPath (path, {});
    }
    const auto seen = r.transformedBy (state().transform).getIntersection (state().clip);
    if (! seen.isEmpty()) body += rectangle (seen) + paint() + "/>\n";
}

void SvgGraphics::fillRectList (const juce::RectangleList<float>& all)
{
    for (const auto& r : all)
        fillRect (r);
}

void SvgGraphics::fillPath (const juce::Path& path, const juce::AffineTransform& t)
{
    auto drawn = path;
    drawn.applyTransform (t.followedBy (state().transform));
    const auto bounds = drawn.getBounds();
    if (drawn.isEmpty() || ! bounds.intersects (state().clip)) return;
    body += "<path d=\"" + dataOf (drawn, 100.0) + '"' + paint() + (path.isUsingNonZeroWinding() ? "" : " fill-rule=\"evenodd\"") + clipOf (bounds) + "/>\n";
}

void SvgGraphics::drawLine (const juce::Line<float>& line)
{
    juce::Path path;
    path.addLineSegment (line, 1.0f);
    fillPath (path, {});
}

/// A glyph is defined once, and then used at its places.
void SvgGraphics::drawGlyph (int glyph, const juce::AffineTransform& t)
{
    const auto& font = state().font;
    const auto face = font.getTypefacePtr();
    const auto [known, is_new] = glyphs.try_emplace ({ face.get(), glyph }, static_cast<int> (glyphs.size()));
    if (is_new)
    {
        constexpr double fine = 1e4;   // the outline is as high as 1
        juce::Path outline;
        face->getOutlineForGlyph (glyph, outline);
        faces.push_back (face);
        definitions += "<path id=\"g" + std::to_string (known->second) + "\" d=\"" + dataOf (outline, fine) + "\"/>\n";
    }
    const auto m = juce::AffineTransform::scale (font.getHeight() * font.getHorizontalScale(), font.getHeight()).followedBy (t).followedBy (state().transform);
    const auto box = juce::Rectangle<float> (0.0f, -1.0f, 1.0f, 1.5f).transformedBy (m);
    if (! box.intersects (state().clip)) return;
    std::string matrix;
    for (const float v : { m.mat00, m.mat10, m.mat01, m.mat11, m.mat02, m.mat12 })
        matrix += (matrix.empty() ? "" : " ") + number (v, 1000.0);
    body += "<use href=\"#g" + std::to_string (known->second) + "\" transform=\"matrix(" + matrix + ")\"" + paint() + "/>\n";
}

}   // namespace tactus::host
