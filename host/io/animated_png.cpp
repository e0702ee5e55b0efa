// SPDX-License-Identifier: GPL-3.0-or-later
#include "animated_png.hpp"
#include "png_chunks.hpp"

#include <algorithm>
#include <cstring>

namespace tactus::host
{

namespace
{
std::string encoded (const juce::Image& image)
{
    juce::MemoryOutputStream png;
    if (! juce::PNGImageFormat().writeImageToStream (image, png)) return {};
    return { static_cast<const char*> (png.getData()), png.getDataSize() };
}

std::uint32_t number (int v) { return static_cast<std::uint32_t> (v); }
}   // namespace

/// The smallest rectangle that contains all changes from the previous frame; a single pixel if there are none.
juce::Rectangle<int> AnimatedPng::changed (const juce::Image& frame) const
{
    if (! before.isValid()) return frame.getBounds();
    using Data = juce::Image::BitmapData;
    const Data now (frame, Data::readOnly), last (before, Data::readOnly);
    int left = frame.getWidth(), right = -1, top = frame.getHeight(), bottom = -1;
    for (int y = 0; y < frame.getHeight(); ++y)
    {
        if (std::memcmp (now.getLinePointer (y), last.getLinePointer (y), static_cast<std::size_t> (now.pixelStride * now.width)) == 0) continue;
        top = std::min (top, y);
        bottom = y;
        for (int x = 0; x < frame.getWidth(); ++x)
            if (now.getPixelColour (x, y) != last.getPixelColour (x, y))
            {
                left = std::min (left, x);
                right = std::max (right, x);
            }
    }
    return right < 0 ? juce::Rectangle<int> (0, 0, 1, 1) : juce::Rectangle<int>::leftTopRightBottom (left, top, right + 1, bottom + 1);
}

bool AnimatedPng::add (const juce::Image& given, std::uint16_t milliseconds)
{
    const auto frame = given.convertedToFormat (juce::Image::RGB);
    if (before.isValid() && frame.getBounds() != before.getBounds()) return false;
    const auto part = changed (frame);
    const auto png = encoded (frame.getClippedImage (part).createCopy());
    const auto chunks = chunksOf (png);
    if (chunks.empty() || chunks.front().type != "IHDR") return false;
    if (count == 0) header = chunks.front().bytes();

    constexpr char keep = 0, replace = 0;   // the next frame starts from this one, and this one replaces the pixels of its rectangle
    const auto place = bigEndian (number (part.getWidth())) + bigEndian (number (part.getHeight())) + bigEndian (number (part.getX()))
                       + bigEndian (number (part.getY()));
    body += PngChunk { "fcTL", bigEndian (sequence++) + place + bigEndian (milliseconds, 2) + bigEndian (1000, 2) + keep + replace }.bytes();
    for (const auto& chunk : chunks)
        if (chunk.type == "IDAT") body += (count == 0 ? chunk : PngChunk { "fdAT", bigEndian (sequence++) + chunk.data }).bytes();
    before = frame;
    ++count;
    return true;
}

std::string AnimatedPng::file (bool repeats) const
{
    return std::string (png_signature) + header + PngChunk { "acTL", bigEndian (count) + bigEndian (repeats ? 0 : 1) }.bytes() + body
           + PngChunk { "IEND", {} }.bytes();
}

}   // namespace tactus::host
