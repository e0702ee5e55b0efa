// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/tools/figures/png_chunks.hpp>

#include <juce_graphics/juce_graphics.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

namespace tactus::test
{

using host::bigEndian, host::chunksOf, host::png_signature, host::PngChunk, host::readBigEndian;

/// What a player shows of an animated PNG. Throws if the file breaks a rule of the format.
struct PlayedPng
{
    std::vector<juce::Image> frames;
    std::vector<double> seconds;   ///< how long each frame is shown
    std::uint32_t plays = 0;       ///< 0: again and again

    explicit PlayedPng (const std::string& file)
    {
        const auto chunks = chunksOf (file);
        require (chunks.size() > 3 && chunks.front().type == "IHDR" && chunks[1].type == "acTL", "the first chunks");
        require (chunks.back().type == "IEND" && chunks.back().data.empty(), "the last chunk");
        std::size_t length = png_signature.size();
        for (const auto& c : chunks)
            length += 12 + c.data.size();
        require (length == file.size(), "a chunk is cut off, or its checksum is wrong");
        header = chunks.front().data;
        plays = number (chunks[1], 4);
        for (const auto& c : chunks)
            read (c);
        show();
        require (frames.size() == number (chunks[1], 0), "the number of frames");
    }

private:
    static void require (bool holds, const char* what)
    {
        if (! holds) throw std::runtime_error (std::string ("animated PNG: ") + what);
    }

    static std::uint32_t number (const PngChunk& c, std::size_t at, std::size_t bytes = 4)
    {
        return readBigEndian (std::string_view (c.data).substr (at, bytes));
    }

    void read (const PngChunk& c)
    {
        if (c.type == "fcTL")
        {
            show();
            require (number (c, 0) == sequence++, "the sequence");
            width = number (c, 4);
            height = number (c, 8);
            x = number (c, 12);
            y = number (c, 16);
            seconds.push_back (static_cast<double> (number (c, 20, 2)) / static_cast<double> (number (c, 22, 2)));
            require (c.data.size() == 26 && c.data[24] == 0 && (c.data[25] == 0 || c.data[25] == 1), "how a frame is put over the one before");
            is_over = c.data[25] == 1;
            is_open = true;
        }
        if (c.type == "IDAT") require (is_open && frames.empty(), "the first frame");
        if (c.type == "IDAT") data += c.data;
        if (c.type != "fdAT") return;
        require (number (c, 0) == sequence++, "the sequence");
        data += c.data.substr (4);
    }

    /// Draws the frame that has been read over the ones before.
    void show()
    {
        if (! std::exchange (is_open, false)) return;
        const auto own = bigEndian (width) + bigEndian (height) + header.substr (8);
        const auto png = std::string (png_signature) + PngChunk { "IHDR", own }.bytes() + PngChunk { "IDAT", data }.bytes() + PngChunk { "IEND", {} }.bytes();
        data.clear();
        juce::MemoryInputStream stream (png.data(), png.size(), false);
        const auto part = juce::PNGImageFormat().decodeImage (stream);
        require (part.isValid(), "a frame");
        const auto all_width = readBigEndian (std::string_view (header).substr (0, 4)), all_height = readBigEndian (std::string_view (header).substr (4, 4));
        require (x + width <= all_width && y + height <= all_height, "the place of a frame");
        require (! frames.empty() || (width == all_width && height == all_height), "the first frame is smaller than the picture");
        const juce::SoftwareImageType in_memory;
        auto whole = frames.empty() ? juce::Image (juce::Image::RGB, static_cast<int> (all_width), static_cast<int> (all_height), true, in_memory)
                                    : frames.back().createCopy();
        for (int j = 0; j < part.getHeight(); ++j)
            for (int i = 0; i < part.getWidth(); ++i)
                if (const auto colour = part.getPixelAt (i, j); ! is_over || ! colour.isTransparent())
                {
                    require (colour.isOpaque(), "a pixel is neither opaque nor transparent");
                    whole.setPixelAt (static_cast<int> (x) + i, static_cast<int> (y) + j, colour);
                }
        frames.push_back (whole);
    }

    std::string header, data;
    std::uint32_t sequence = 0, width = 0, height = 0, x = 0, y = 0;
    bool is_open = false, is_over = false;
};

/// True if no red, green or blue of a pixel differs by more than `tolerance` of 255.
inline bool isSame (const juce::Image& a, const juce::Image& b, int tolerance = 0)
{
    const auto near = [tolerance] (juce::uint8 v, juce::uint8 w) { return std::abs (int { v } - int { w }) <= tolerance; };
    if (a.getBounds() != b.getBounds()) return false;
    for (int y = 0; y < a.getHeight(); ++y)
        for (int x = 0; x < a.getWidth(); ++x)
        {
            const auto p = a.getPixelAt (x, y), q = b.getPixelAt (x, y);
            if (! near (p.getRed(), q.getRed()) || ! near (p.getGreen(), q.getGreen()) || ! near (p.getBlue(), q.getBlue())) return false;
        }
    return true;
}

}   // namespace tactus::test
