// SPDX-License-Identifier: GPL-3.0-or-later
#include "raster.hpp"

namespace tactus::host::scene
{

void Raster::begin (int width, int height, int fineness, Shading shading)
{
    samples = std::max (1, fineness);
    columns = std::max (0, width) * samples;
    rows = std::max (0, height) * samples;
    const auto size = static_cast<std::size_t> (columns) * static_cast<std::size_t> (rows);
    colours.assign (size, 0);
    nearest.assign (size, 0.0f);
    by_pixel = shading == Shading::pixel && samples == 2;
    triangle_number = 0;
    if (by_pixel) pixels.assign (size / 4, {});
    counted = {};
}

void Raster::write (juce::Image& image) const
{
    const int width = std::min (columns / samples, image.getWidth()), height = std::min (rows / samples, image.getHeight());
    if (width == 0 || height == 0) return;
    juce::Image::BitmapData pixels (image, 0, 0, width, height, juce::Image::BitmapData::writeOnly);
    const auto all = static_cast<std::uint32_t> (samples * samples);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
        {
            std::uint32_t alpha = 0, red = 0, green = 0, blue = 0;   // a sample is opaque or empty, so these sums are premultiplied
            for (int j = 0; j < samples; ++j)
            {
                const auto row = static_cast<std::size_t> (y * samples + j) * static_cast<std::size_t> (columns);
                const auto* sample = &colours[row + static_cast<std::size_t> (x * samples)];
                for (int i = 0; i < samples; ++i)
                {
                    alpha += sample[i] >> 24;
                    red += (sample[i] >> 16) & 255;
                    green += (sample[i] >> 8) & 255;
                    blue += sample[i] & 255;
                }
            }
            const auto part = [all] (std::uint32_t sum) { return static_cast<std::uint8_t> (sum / all); };
            reinterpret_cast<juce::PixelARGB*> (pixels.getPixelPointer (x, y))->setARGB (part (alpha), part (red), part (green), part (blue));
        }
}

double Raster::coverage() const noexcept
{
    if (nearest.empty()) return 0.0;
    const auto covered = std::ranges::count_if (nearest, [] (float n) { return n > 0.0f; });
    return static_cast<double> (covered) / static_cast<double> (nearest.size());
}

}   // namespace tactus::host::scene
