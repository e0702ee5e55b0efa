// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/tools/figures/figure/vector_canvas.hpp>

#include <catch2/catch.hpp>

#include <juce_events/juce_events.h>

#include <sstream>

using tactus::host::VectorCanvas;

namespace
{
/// A filled rectangle, a clipped line, and a triangle that is moved by a transform.
void drawOn (VectorCanvas& canvas)
{
    juce::Graphics graphics (canvas);
    graphics.setColour (juce::Colour (0xff102030));
    graphics.fillRect (juce::Rectangle<float> (10.0f, 20.0f, 30.0f, 40.0f));
    {
        const juce::Graphics::ScopedSaveState restore (graphics);
        graphics.reduceClipRegion ({ 0, 0, 50, 25 });
        juce::Path line;
        line.startNewSubPath (0.0f, 0.0f);
        line.lineTo (100.0f, 50.5f);
        canvas.stroke (line, 1.5f);
    }
    juce::Path triangle;
    triangle.addTriangle (0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f);
    graphics.setColour (juce::Colours::red);
    graphics.fillPath (triangle, juce::AffineTransform::translation (60.0f, 5.0f));
}

std::string inflated (const std::string& data)
{
    juce::MemoryInputStream compressed (data.data(), data.size(), false);
    juce::GZIPDecompressorInputStream stream (&compressed, false, juce::GZIPDecompressorInputStream::zlibFormat);
    juce::MemoryBlock all;
    stream.readIntoMemoryBlock (all);
    return { static_cast<const char*> (all.getData()), all.getSize() };
}
}   // namespace

TEST_CASE ("vector canvas: an SVG has the size on paper, each shape, its colour and its clip", "[host][io][plot]")
{
    const juce::ScopedJuceInitialiser_GUI juce_is_up;   // JUCE's fonts exist only while this does
    VectorCanvas canvas (200.0f, 100.0f);
    drawOn (canvas);
    const auto text = canvas.svg ("a < b & c", 96.0);
    const auto svg = juce::parseXML (juce::String::fromUTF8 (text.c_str()));
    REQUIRE (svg != nullptr);
    CHECK (svg->getStringAttribute ("width") == "52.92mm");
    CHECK (svg->getStringAttribute ("height") == "26.46mm");
    CHECK (svg->getStringAttribute ("viewBox") == "0 0 200 100");
    REQUIRE (svg->getChildByName ("title") != nullptr);
    CHECK (svg->getChildByName ("title")->getAllSubText() == "a < b & c");

    const auto* rectangle = svg->getChildByName ("path");
    REQUIRE (rectangle != nullptr);
    CHECK (rectangle->getStringAttribute ("fill") == "#102030");
    const auto* clipped = svg->getChildByName ("g");
    REQUIRE (clipped != nullptr);
    const auto* line = clipped->getChildByName ("path");
    REQUIRE (line != nullptr);
    CHECK (line->getStringAttribute ("d") == "M0 0L100 50.5");
    CHECK (line->getStringAttribute ("stroke-width") == "1.5");
    const auto* clip = svg->getChildByName ("clipPath");
    REQUIRE (clip != nullptr);
    CHECK (clip->getChildByName ("rect")->getStringAttribute ("height") == "25");
    const auto* triangle = clipped->getNextElementWithTagName ("path");
    REQUIRE (triangle != nullptr);
    CHECK (triangle->getStringAttribute ("fill") == "#ff0000");
    CHECK (triangle->getStringAttribute ("d").startsWith ("M60 5"));
}

TEST_CASE ("vector canvas: the table of a PDF points to its objects, and the page has the same shapes", "[host][io][plot]")
{
    const juce::ScopedJuceInitialiser_GUI juce_is_up;   // JUCE's fonts exist only while this does
    VectorCanvas canvas (200.0f, 100.0f);
    drawOn (canvas);
    const auto file = canvas.pdf ("Größe", 96.0);
    CHECK (file.starts_with ("%PDF-1.4\n"));
    CHECK (file.ends_with ("%%EOF\n"));
    CHECK (file.find ("/MediaBox [0 0 150 75]") != std::string::npos);
    CHECK (file.find ("/Title <FEFF0047007200F600DF0065>") != std::string::npos);

    const auto start = file.rfind ("startxref\n");
    REQUIRE (start != std::string::npos);
    std::istringstream table (file.substr (std::stoul (file.substr (start + 10))));
    std::string word;
    std::size_t first = 0, count = 0;
    table >> word >> first >> count;
    REQUIRE (word == "xref");
    REQUIRE (count == 6);
    for (std::size_t i = 0; i < count; ++i)
    {
        std::size_t at = 0;
        std::string generation, kind;
        table >> at >> generation >> kind;
        CHECK (kind == (i == 0 ? "f" : "n"));
        if (i > 0) CHECK (file.substr (at).starts_with (std::to_string (i) + " 0 obj\n"));
    }

    const auto begin = file.find ("stream\n") + 7, end = file.find ("\nendstream");
    const auto page = inflated (file.substr (begin, end - begin));
    INFO (page);
    CHECK (page.starts_with ("0.75 0 0 -0.75 0 75 cm"));
    CHECK (page.find ("0.0627 0.1255 0.1882 rg\n10 60 m\n10 20 l\n40 20 l\n40 60 l\nh\nf\n") != std::string::npos);
    CHECK (page.find ("q 0 0 50 25 re W n\n") != std::string::npos);
    CHECK (page.find ("1.5 w\n0 0 m\n100 50.5 l\nS\nQ\n") != std::string::npos);
    CHECK (page.find ("1 0 0 rg\n60 5 m\n") != std::string::npos);
}

TEST_CASE ("vector canvas: an image is in the file with its pixels, at its place", "[host][io][plot]")
{
    const juce::ScopedJuceInitialiser_GUI juce_is_up;
    juce::Image image (juce::Image::RGB, 3, 2, true, juce::SoftwareImageType());
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            image.setPixelAt (x, y, juce::Colour (static_cast<juce::uint8> (40 * x), static_cast<juce::uint8> (90 * y), 7));
    VectorCanvas canvas (200.0f, 100.0f);
    {
        juce::Graphics graphics (canvas);
        graphics.drawImage (image, juce::Rectangle<float> (20.0f, 10.0f, 60.0f, 20.0f), juce::RectanglePlacement::stretchToFit);
    }
    const auto svg = juce::parseXML (juce::String::fromUTF8 (canvas.svg ("", 96.0).c_str()));
    REQUIRE (svg != nullptr);
    const auto* element = svg->getChildByName ("image");
    REQUIRE (element != nullptr);
    CHECK (element->getStringAttribute ("transform") == "matrix(20 0 0 10 20 10)");
    const auto link = element->getStringAttribute ("xlink:href");
    REQUIRE (link.startsWith ("data:image/png;base64,"));
    juce::MemoryOutputStream png;
    REQUIRE (juce::Base64::convertFromBase64 (png, link.fromFirstOccurrenceOf (",", false, false)));
    const auto read = juce::PNGImageFormat::loadFrom (png.getData(), png.getDataSize());
    REQUIRE (read.getBounds() == image.getBounds());
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            CHECK (read.getPixelAt (x, y) == image.getPixelAt (x, y));

    const auto pdf = canvas.pdf ("", 96.0);
    const auto object = pdf.find ("/Subtype /Image /Width 3 /Height 2");
    REQUIRE (object != std::string::npos);
    CHECK (pdf.find ("/XObject << /I0 5 0 R >>") != std::string::npos);
    const auto begin = pdf.find ("stream\n", object) + 7, end = pdf.find ("\nendstream", begin);
    const auto pixels = inflated (pdf.substr (begin, end - begin));
    REQUIRE (pixels.size() == 18);
    CHECK (static_cast<int> (static_cast<unsigned char> (pixels[17])) == 7);
    CHECK (static_cast<int> (static_cast<unsigned char> (pixels[15])) == 80);   // red of the last pixel
    const auto page_begin = pdf.find ("stream\n") + 7;
    const auto page = inflated (pdf.substr (page_begin, pdf.find ("\nendstream", page_begin) - page_begin));
    CHECK (page.find ("q 60 0 0 -20 20 30 cm /I0 Do Q") != std::string::npos);   // its first row is at the top
}

TEST_CASE ("vector canvas: texts are outlines, each defined once, and opacity is kept", "[host][io][plot]")
{
    const juce::ScopedJuceInitialiser_GUI juce_is_up;
    VectorCanvas canvas (200.0f, 100.0f);
    {
        juce::Graphics graphics (canvas);
        graphics.setFont (20.0f);
        graphics.setColour (juce::Colours::blue.withAlpha (0.8f));
        graphics.beginTransparencyLayer (0.5f);
        graphics.drawSingleLineText ("abba", 10, 40);
        graphics.endTransparencyLayer();
        graphics.drawSingleLineText ("a", 1000, 40);   // outside
    }
    const auto svg = juce::parseXML (juce::String::fromUTF8 (canvas.svg ("", 96.0).c_str()));
    REQUIRE (svg != nullptr);
    REQUIRE (svg->getChildByName ("defs") != nullptr);
    CHECK (svg->getChildByName ("defs")->getNumChildElements() == 2);
    juce::StringArray used;
    for (const auto* use : svg->getChildWithTagNameIterator ("use"))
    {
        used.add (use->getStringAttribute ("xlink:href"));
        CHECK (use->getStringAttribute ("fill") == "#0000ff");
        CHECK (use->getStringAttribute ("fill-opacity") == "0.4");
    }
    CHECK (used == juce::StringArray { "#g0", "#g1", "#g1", "#g0" });
    CHECK (canvas.pdf ("", 96.0).find ("/ExtGState << /A102 << /ca 0.4 /CA 0.4 >> >>") != std::string::npos);
}
