// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "support/temporary_folder.hpp"

#include <host/app/canvas/picture/save_picture.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

TEST_CASE ("the canvas is saved as SVG, PDF and PNG, all of it, whatever part is in view", "[app][canvas]")
{
    const TemporaryFolder folder;
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.canvas->view().origin = { 9000.0f, 9000.0f };
    REQUIRE (savePicture (*rig.canvas, folder / "a.svg"));
    REQUIRE (savePicture (*rig.canvas, folder / "a.png"));
    const auto area = rig.canvas->scene().bounds();

    const auto png = juce::ImageFileFormat::loadFrom (juce::File ((folder / "a.png").string()));
    REQUIRE (png.isValid());
    CHECK (png.getWidth() > 2 * static_cast<int> (area.getWidth()));

    // The SVG, painted by JUCE, has the colours of the PNG.
    const auto svg = juce::Drawable::createFromSVGFile (juce::File ((folder / "a.svg").string()));
    REQUIRE (svg != nullptr);
    juce::Image painted (juce::Image::RGB, png.getWidth() / 2, png.getHeight() / 2, true, juce::SoftwareImageType());
    juce::Graphics g (painted);
    svg->draw (g, 1.0f);
    const auto small = png.rescaled (painted.getWidth(), painted.getHeight(), juce::Graphics::highResamplingQuality);
    int different = 0;
    for (int y = 0; y < painted.getHeight(); ++y)
        for (int x = 0; x < painted.getWidth(); ++x)
        {
            const auto a = painted.getPixelAt (x, y), b = small.getPixelAt (x, y);
            different += std::abs (a.getRed() - b.getRed()) + std::abs (a.getGreen() - b.getGreen()) + std::abs (a.getBlue() - b.getBlue()) > 96;
        }
    CHECK (different < painted.getWidth() * painted.getHeight() / 50);
    const auto text = folder.textOf ("a.svg");
    CHECK (text.find ("<use xlink:href=\"#g0\"") != std::string::npos);   // texts are outlines
    REQUIRE (savePicture (*rig.canvas, folder / "a.pdf"));
    CHECK (folder.textOf ("a.pdf").starts_with ("%PDF"));
    const auto refused = savePicture (*rig.canvas, folder / "no" / "folder" / "a.svg");
    REQUIRE_FALSE (refused);
    CHECK_FALSE (refused.error().text.empty());
}
