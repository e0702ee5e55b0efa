// SPDX-License-Identifier: GPL-3.0-or-later
#include "save_picture.hpp"

#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/tools/figures/figure/vector_canvas.hpp>
#include <tactus/file/atomic_file.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr float picture_margin = 32.0f, pixels_per_unit = 2.0f, most_pixels = 12'000.0f;   // the last one along each side

void paintAll (juce::Graphics& g, const Canvas& canvas, juce::Point<float> corner)
{
    const auto& look = lookOf (canvas);
    g.fillAll (look.theme().canvas);
    paintScene (g, canvas.scene(), { .zoom = 1.0f, .origin = -corner }, look, {});
}
}   // namespace

Result<> savePicture (const Canvas& canvas, const std::filesystem::path& path)
{
    const auto area = canvas.scene().bounds().expanded (picture_margin);
    const auto refused = [&] {
        return Message::error ("canvas/picture", path.string(), TRANS ("the picture could not be created").toStdString(),
                               TRANS ("save it as SVG, which has no limit of size").toStdString());
    };
    std::string bytes;
    if (const auto extension = extensionOf (path); extension == ".svg" || extension == ".pdf")
    {
        constexpr double units_per_inch = 96.0;   // as browsers have it
        VectorCanvas shapes (std::ceil (area.getWidth()), std::ceil (area.getHeight()));
        juce::Graphics g (shapes);
        paintAll (g, canvas, area.getPosition());
        bytes = extension == ".pdf" ? shapes.pdf (path.stem().string(), units_per_inch) : shapes.svg (path.stem().string(), units_per_inch);
    }
    else
    {
        const float scale = std::min (pixels_per_unit, most_pixels / std::max (area.getWidth(), area.getHeight()));
        const auto pixels = [&] (float units) { return std::max (1, static_cast<int> (std::ceil (units * scale))); };
        const juce::Image image (juce::Image::RGB, pixels (area.getWidth()), pixels (area.getHeight()), true, juce::SoftwareImageType());
        juce::Graphics g (image);
        g.addTransform (juce::AffineTransform::scale (scale));
        paintAll (g, canvas, area.getPosition());
        juce::MemoryOutputStream png;
        if (! image.isValid() || ! juce::PNGImageFormat().writeImageToStream (image, png)) return refused();
        bytes.assign (static_cast<const char*> (png.getData()), png.getDataSize());
    }
    auto file = AtomicFile::create (path);
    if (! file) return file.error();
    if (! file->stream().write (bytes.data(), static_cast<std::streamsize> (bytes.size()))) return file->writeError();
    return file->commit();
}

}   // namespace tactus::host
