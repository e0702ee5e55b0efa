// SPDX-License-Identifier: GPL-3.0-or-later
#include "vector_canvas.hpp"

#include <array>
#include <charconv>
#include <cstdio>
#include <set>
#include <string_view>

namespace tactus::host
{

namespace
{
/// A number with at most this many decimals, and never in the user's locale.
std::string number (double value, int decimals = 2)
{
    std::array<char, 64> text;
    std::string out (text.data(), std::to_chars (text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr);
    out.erase (out.find_last_not_of ('0') + 1);
    if (out.back() == '.') out.pop_back();
    return out == "-0" ? "0" : out;
}

std::string pair (double x, double y) { return number (x) + ' ' + number (y); }

/// Writes the outline as SVG path commands.
std::string pathData (const juce::Path& path, int decimals = 2)
{
    std::string out;
    const auto point = [decimals] (double x, double y) { return number (x, decimals) + ' ' + number (y, decimals); };
    for (juce::Path::Iterator i (path); i.next();)
        switch (i.elementType)
        {
        case juce::Path::Iterator::startNewSubPath:
            out += 'M' + point (i.x1, i.y1);
            break;
        case juce::Path::Iterator::lineTo:
            out += 'L' + point (i.x1, i.y1);
            break;
        case juce::Path::Iterator::quadraticTo:
            out += 'Q' + point (i.x1, i.y1) + ' ' + point (i.x2, i.y2);
            break;
        case juce::Path::Iterator::cubicTo:
            out += 'C' + point (i.x1, i.y1) + ' ' + point (i.x2, i.y2) + ' ' + point (i.x3, i.y3);
            break;
        case juce::Path::Iterator::closePath:
            out += 'Z';
            break;
        }
    return out;
}

/// Writes the outline in the operators of PDF, which has no quadratic curves.
std::string pathOperators (const juce::Path& path)
{
    std::string out;
    double x = 0.0, y = 0.0;
    const auto towards = [] (double from, double to) { return from + 2.0 / 3.0 * (to - from); };
    for (juce::Path::Iterator i (path); i.next();)
        switch (i.elementType)
        {
        case juce::Path::Iterator::startNewSubPath:
            out += pair (i.x1, i.y1) + " m\n";
            x = i.x1, y = i.y1;
            break;
        case juce::Path::Iterator::lineTo:
            out += pair (i.x1, i.y1) + " l\n";
            x = i.x1, y = i.y1;
            break;
        case juce::Path::Iterator::quadraticTo:
            out += pair (towards (x, i.x1), towards (y, i.y1)) + ' ' + pair (towards (i.x2, i.x1), towards (i.y2, i.y1)) + ' ' + pair (i.x2, i.y2) + " c\n";
            x = i.x2, y = i.y2;
            break;
        case juce::Path::Iterator::cubicTo:
            out += pair (i.x1, i.y1) + ' ' + pair (i.x2, i.y2) + ' ' + pair (i.x3, i.y3) + " c\n";
            x = i.x3, y = i.y3;
            break;
        case juce::Path::Iterator::closePath:
            out += "h\n";
            break;
        }
    return out;
}

std::string hex (juce::Colour colour)
{
    std::array<char, 8> text;
    std::snprintf (text.data(), text.size(), "#%02x%02x%02x", unsigned { colour.getRed() }, unsigned { colour.getGreen() }, unsigned { colour.getBlue() });
    return text.data();
}

std::string escapedForXml (const std::string& text)
{
    std::string out;
    for (const char c : text)
        switch (c)
        {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        default:
            out += static_cast<unsigned char> (c) < 0x20 ? ' ' : c;
        }
    return out;
}

/// A text string of PDF: UTF-16, in hexadecimal digits.
std::string hexText (const std::string& text)
{
    std::string out = "<FEFF";
    const auto owner = juce::String::fromUTF8 (text.c_str());
    for (auto utf16 = owner.toUTF16(); ! utf16.isEmpty();)
    {
        const auto add = [&out] (unsigned unit) {
            std::array<char, 8> digits;
            std::snprintf (digits.data(), digits.size(), "%04X", unit);
            out += digits.data();
        };
        const auto c = static_cast<unsigned> (utf16.getAndAdvance());
        if (c < 0x10000)
            add (c);
        else
        {
            add (0xd800 + ((c - 0x10000) >> 10));
            add (0xdc00 + ((c - 0x10000) & 0x3ff));
        }
    }
    return out + '>';
}

std::string compressed (const std::string& text)
{
    juce::MemoryOutputStream out;
    {
        juce::GZIPCompressorOutputStream zip (out, 9);   // zlib's format, as PDF requires
        zip.write (text.data(), text.size());
    }
    return { static_cast<const char*> (out.getData()), out.getDataSize() };
}

/// The six numbers of a transform, in the order of SVG and PDF.
std::string matrix (const juce::AffineTransform& t)
{
    std::string out;
    for (const float v : { t.mat00, t.mat10, t.mat01, t.mat11, t.mat02, t.mat12 })
        out += (out.empty() ? "" : " ") + number (v, 6);
    return out;
}

std::string pngOf (const juce::Image& image)
{
    juce::MemoryOutputStream png;
    juce::PNGImageFormat().writeImageToStream (image, png);
    return juce::Base64::toBase64 (png.getData(), png.getDataSize()).toStdString();
}

/// An image as an object of PDF: its colours, row by row.
std::string imageObject (const juce::Image& image)
{
    std::string pixels;
    for (int y = 0; y < image.getHeight(); ++y)
        for (int x = 0; x < image.getWidth(); ++x)
            for (const auto c = image.getPixelAt (x, y); const auto part : { c.getRed(), c.getGreen(), c.getBlue() })
                pixels += static_cast<char> (part);
    const auto data = compressed (pixels);
    return "<< /Type /XObject /Subtype /Image /Width " + std::to_string (image.getWidth()) + " /Height " + std::to_string (image.getHeight())
           + " /ColorSpace /DeviceRGB /BitsPerComponent 8 /Filter /FlateDecode /Length " + std::to_string (data.size()) + " >>\nstream\n" + data
           + "\nendstream";
}

/// A PDF from its objects, which are numbered from 1. The first one is the catalogue, the last one the information on the document.
std::string pdfFile (const std::vector<std::string>& objects)
{
    std::string file = "%PDF-1.4\n%\xe2\xe3\xcf\xd3\n", table;
    for (std::size_t i = 0; i < objects.size(); ++i)
    {
        std::array<char, 32> row;
        std::snprintf (row.data(), row.size(), "%010zu 00000 n \n", file.size());
        table += row.data();
        file += std::to_string (i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
    }
    const auto at = file.size(), count = objects.size() + 1;
    file += "xref\n0 " + std::to_string (count) + "\n0000000000 65535 f \n" + table;
    return file + "trailer\n<< /Size " + std::to_string (count) + " /Root 1 0 R /Info " + std::to_string (objects.size()) + " 0 R >>\nstartxref\n"
           + std::to_string (at) + "\n%%EOF\n";
}
}   // namespace

std::string VectorCanvas::svgOf (const Shape& shape) const
{
    if (shape.image.isValid())
        return "<image width=\"" + number (shape.image.getWidth()) + "\" height=\"" + number (shape.image.getHeight()) + "\" transform=\"matrix("
               + matrix (shape.at) + ")\" xlink:href=\"data:image/png;base64," + pngOf (shape.image) + "\"/>\n";
    const auto paint = [&shape] (const std::string& what) {
        return ' ' + what + "=\"" + hex (shape.colour) + '"'
               + (shape.colour.isOpaque() ? "" : ' ' + what + "-opacity=\"" + number (shape.colour.getFloatAlpha(), 3) + '"');
    };
    if (shape.glyph >= 0)
        return "<use xlink:href=\"#g" + std::to_string (shape.glyph) + "\" transform=\"matrix(" + matrix (shape.at) + ")\"" + paint ("fill") + "/>\n";
    const auto path = "<path d=\"" + pathData (shape.outline) + '"';
    if (shape.thickness > 0.0f)
        return path + " fill=\"none\"" + paint ("stroke") + " stroke-width=\"" + number (shape.thickness)
               + "\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n";
    return path + paint ("fill") + (shape.outline.isUsingNonZeroWinding() ? "/>\n" : " fill-rule=\"evenodd\"/>\n");
}

std::string VectorCanvas::svg (const std::string& title, double units_per_inch) const
{
    std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\""
                      " xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\""
                      + number (25.4 * width / units_per_inch)
                      + "mm\" height=\"" + number (25.4 * height / units_per_inch) + "mm\" viewBox=\"0 0 " + pair (width, height) + "\">\n";
    if (! title.empty()) out += "<title>" + escapedForXml (title) + "</title>\n";

    if (! glyphs.empty()) out += "<defs>\n";
    for (std::size_t i = 0; i < glyphs.size(); ++i)
        out += "<path id=\"g" + std::to_string (i) + "\" d=\"" + pathData (glyphs[i].outline, 4) + "\"/>\n";
    if (! glyphs.empty()) out += "</defs>\n";

    auto clip = picture();
    int clips = 0;
    for (const auto& shape : shapes)
    {
        if (shape.clip != clip)
        {
            if (clip != picture()) out += "</g>\n";
            clip = shape.clip;
            if (clip != picture())
            {
                const auto id = "clip" + std::to_string (++clips);
                out += "<clipPath id=\"" + id + "\"><rect x=\"" + number (clip.getX()) + "\" y=\"" + number (clip.getY()) + "\" width=\""
                       + number (clip.getWidth()) + "\" height=\"" + number (clip.getHeight()) + "\"/></clipPath>\n<g clip-path=\"url(#" + id + ")\">\n";
            }
        }
        out += svgOf (shape);
    }
    if (clip != picture()) out += "</g>\n";
    return out + "</svg>\n";
}

std::string VectorCanvas::pdf (const std::string& title, double units_per_inch) const
{
    const double point = 72.0 / units_per_inch;
    const auto scale = number (point, 6);
    std::vector<std::string> images;
    std::set<int> opacities;   // of the shapes, 0 to 255
    std::string page = scale + " 0 0 -" + scale + " 0 " + number (point * height) + " cm 1 j 1 J\n";

    auto clip = picture();
    for (const auto& shape : shapes)
    {
        if (shape.clip != clip)
        {
            if (clip != picture()) page += "Q\n";
            clip = shape.clip;
            if (clip != picture())
                page += "q " + pair (clip.getX(), clip.getY()) + ' ' + pair (clip.getWidth(), clip.getHeight()) + " re W n\n";
        }
        if (shape.image.isValid())
        {
            // An image of PDF is a unit square whose first row is at the top.
            const auto across = static_cast<float> (shape.image.getWidth()), down = static_cast<float> (shape.image.getHeight());
            const auto square = juce::AffineTransform (across, 0.0f, 0.0f, 0.0f, -down, down);
            page += "q " + matrix (square.followedBy (shape.at)) + " cm /I" + std::to_string (images.size()) + " Do Q\n";
            images.push_back (imageObject (shape.image));
            continue;
        }
        const int opacity = shape.colour.getAlpha();
        opacities.insert (opacity);
        page += "/A" + std::to_string (opacity) + " gs\n";
        auto outline = shape.outline;
        if (shape.glyph >= 0) (outline = glyphs[static_cast<std::size_t> (shape.glyph)].outline).applyTransform (shape.at);
        const bool is_line = shape.thickness > 0.0f;
        for (const auto part : { shape.colour.getFloatRed(), shape.colour.getFloatGreen(), shape.colour.getFloatBlue() })
            page += number (part, 4) + ' ';
        page += is_line ? "RG " + number (shape.thickness) + " w\n" : "rg\n";
        page += pathOperators (outline) + (is_line ? "S\n" : outline.isUsingNonZeroWinding() ? "f\n"
                                                                                             : "f*\n");
    }
    if (clip != picture()) page += "Q\n";

    const auto data = compressed (page);
    constexpr std::size_t first_image = 5;
    std::string resources;
    for (std::size_t i = 0; i < images.size(); ++i)
        resources += (i == 0 ? "/XObject << /I" : " /I") + std::to_string (i) + ' ' + std::to_string (first_image + i) + " 0 R";
    if (! images.empty()) resources += " >> ";
    for (const int opacity : opacities)
    {
        const auto part = number (opacity / 255.0, 4);
        resources += (opacity == *opacities.begin() ? "/ExtGState << /A" : " /A") + std::to_string (opacity) + " << /ca " + part + " /CA " + part + " >>";
    }
    if (! opacities.empty()) resources += " >> ";
    std::vector<std::string> objects {
        "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " + pair (point * width, point * height) + "] /Resources << " + resources + ">> /Contents 4 0 R >>",
        "<< /Length " + std::to_string (data.size()) + " /Filter /FlateDecode >>\nstream\n" + data + "\nendstream"
    };
    objects.insert (objects.end(), images.begin(), images.end());
    objects.push_back ("<< /Title " + hexText (title) + " /Creator (Tactus) >>");
    return pdfFile (objects);
}

void VectorCanvas::add (Shape shape, juce::Rectangle<float> drawn)
{
    if (! drawn.intersects (now.clip)) return;
    shape.clip = now.clip.contains (drawn) ? picture() : now.clip;
    shape.colour = now.colour.withMultipliedAlpha (now.layer_opacity);
    shapes.push_back (std::move (shape));
}

void VectorCanvas::add (juce::Path path, float thickness)
{
    path.applyTransform (now.transform);
    if (path.isEmpty()) return;
    const auto drawn = path.getBounds().expanded (thickness);
    add ({ .outline = std::move (path), .thickness = thickness }, drawn);
}

void VectorCanvas::drawImage (const juce::Image& image, const juce::AffineTransform& t)
{
    const auto at = t.followedBy (now.transform);
    add ({ .image = image, .at = at }, image.getBounds().toFloat().transformedBy (at));
}

void VectorCanvas::drawGlyph (int glyph, const juce::AffineTransform& t)
{
    const auto face = now.font.getTypefacePtr();
    const auto [known, is_new] = glyph_numbers.try_emplace ({ face, glyph }, static_cast<int> (glyphs.size()));
    if (is_new)
    {
        glyphs.push_back ({ face, {} });
        face->getOutlineForGlyph (glyph, glyphs.back().outline);
    }
    const float height = now.font.getHeight();
    const auto at = juce::AffineTransform::scale (height * now.font.getHorizontalScale(), height).followedBy (t).followedBy (now.transform);
    add ({ .glyph = known->second, .at = at }, glyphs[static_cast<std::size_t> (known->second)].outline.getBoundsTransformed (at));
}

void VectorCanvas::stroke (const juce::Path& line, float thickness) { add (line, thickness); }

void VectorCanvas::setOrigin (juce::Point<int> at) { addTransform (juce::AffineTransform::translation (at.toFloat())); }
void VectorCanvas::addTransform (const juce::AffineTransform& inner) { now.transform = inner.followedBy (now.transform); }

void VectorCanvas::clipTo (juce::Rectangle<float> area) { now.clip = now.clip.getIntersection (area.transformedBy (now.transform)); }

bool VectorCanvas::clipToRectangle (const juce::Rectangle<int>& area)
{
    clipTo (area.toFloat());
    return ! isClipEmpty();
}

bool VectorCanvas::clipToRectangleList (const juce::RectangleList<int>& areas) { return clipToRectangle (areas.getBounds()); }
void VectorCanvas::clipToPath (const juce::Path& path, const juce::AffineTransform& t) { clipTo (path.getBoundsTransformed (t)); }

juce::Rectangle<int> VectorCanvas::getClipBounds() const { return now.clip.transformedBy (now.transform.inverted()).getSmallestIntegerContainer(); }

void VectorCanvas::restoreState()
{
    if (saved.empty()) return;
    now = saved.back();
    saved.pop_back();
}

void VectorCanvas::beginTransparencyLayer (float opacity)
{
    saveState();
    now.layer_opacity *= opacity;
}

void VectorCanvas::setFill (const juce::FillType& fill)
{
    const bool has_gradient = fill.isGradient() && fill.gradient->getNumColours() > 0;
    now.colour = has_gradient ? fill.gradient->getColour (0).withMultipliedAlpha (fill.getOpacity()) : fill.colour;
}

void VectorCanvas::fillRect (const juce::Rectangle<int>& area, bool) { fillRect (area.toFloat()); }

void VectorCanvas::fillRect (const juce::Rectangle<float>& area)
{
    juce::Path path;
    path.addRectangle (area);
    add (std::move (path), 0.0f);
}

void VectorCanvas::fillRectList (const juce::RectangleList<float>& areas)
{
    for (const auto& area : areas)
        fillRect (area);
}

void VectorCanvas::fillPath (const juce::Path& path, const juce::AffineTransform& t)
{
    auto moved = path;
    moved.applyTransform (t);
    add (std::move (moved), 0.0f);
}

void VectorCanvas::drawLine (const juce::Line<float>& line)
{
    juce::Path path;
    path.addLineSegment (line, 1.0f);
    add (std::move (path), 0.0f);
}

}   // namespace tactus::host
