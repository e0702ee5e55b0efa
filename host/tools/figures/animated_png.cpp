// SPDX-License-Identifier: GPL-3.0-or-later
#include "animated_png.hpp"
#include "png_chunks.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace tactus::host
{

namespace
{
using Pixels = juce::Image::BitmapData;
using Row = std::vector<std::uint8_t>;

constexpr std::size_t bytes_per_pixel = 4;   // red, green, blue, opacity

const juce::PixelRGB& pixel (const Pixels& p, int x, int y) noexcept { return *reinterpret_cast<const juce::PixelRGB*> (p.getPixelPointer (x, y)); }

/// Writes a row as it is (None, filter type 0), or as its differences to the pixel on the left (Sub, 1) or above (Up, 2). Returns the sum of the
/// magnitudes, which is small where a row will compress well.
template <int filter>
std::uint64_t filtered (const Row& row, const Row& above, Row& to) noexcept
{
    std::uint64_t sum = 0;
    to[0] = filter;
    for (std::size_t i = 0; i < row.size(); ++i)
    {
        int base = 0;
        if (filter == 1 && i >= bytes_per_pixel) base = row[i - bytes_per_pixel];
        if (filter == 2) base = above[i];
        const auto byte = static_cast<std::uint8_t> (row[i] - base);
        to[i + 1] = byte;
        sum += byte < 128 ? byte : 256u - byte;
    }
    return sum;
}

/// The compressed rows of a PNG of 8-bit RGBA (PNG specification, 9 and 10). `read (y, row)` fills a row, and returns false if all of it is
/// transparent. Drawn scenes are smooth or flat, so three of the five filters and a fast level of compression do.
template <typename Read>
std::string compressed (int width, int height, Read&& read)
{
    constexpr int level = 2;
    const auto size = bytes_per_pixel * static_cast<std::size_t> (width);
    Row row (size), above (size);
    const Row empty (size + 1);
    std::array<Row, 3> tries { Row (size + 1), Row (size + 1), Row (size + 1) };
    juce::MemoryOutputStream data;
    {
        juce::GZIPCompressorOutputStream zlib (data, level);
        for (int y = 0; y < height; ++y, row.swap (above))
        {
            if (! read (y, row))
            {
                std::ranges::fill (row, std::uint8_t { 0 });
                zlib.write (empty.data(), empty.size());
                continue;
            }
            const std::array sums { filtered<0> (row, above, tries[0]), filtered<1> (row, above, tries[1]), filtered<2> (row, above, tries[2]) };
            const auto& best = tries[static_cast<std::size_t> (std::ranges::min_element (sums) - sums.begin())];
            zlib.write (best.data(), best.size());
        }
    }
    return { static_cast<const char*> (data.getData()), data.getDataSize() };
}

std::uint32_t unsignedOf (int v) { return static_cast<std::uint32_t> (v); }
}   // namespace

bool AnimatedPng::differs (const juce::PixelRGB& a, const juce::PixelRGB& b) const noexcept
{
    const auto apart = [this] (int v, int w) { return std::abs (v - w) > tolerance; };
    return apart (a.getRed(), b.getRed()) || apart (a.getGreen(), b.getGreen()) || apart (a.getBlue(), b.getBlue());
}

/// The smallest rectangle that contains all changes from the previous frame; a single pixel if there are none.
juce::Rectangle<int> AnimatedPng::changed (const juce::Image& frame) const
{
    if (! shown.isValid()) return frame.getBounds();
    const Pixels now (frame, Pixels::readOnly), last (shown, Pixels::readOnly);
    int left = now.width, right = -1, top = now.height, bottom = -1;
    for (int y = 0; y < now.height; ++y)
    {
        if (std::memcmp (now.getLinePointer (y), last.getLinePointer (y), static_cast<std::size_t> (now.pixelStride * now.width)) == 0) continue;
        const auto isNew = [&] (int x) { return differs (pixel (now, x, y), pixel (last, x, y)); };
        int first = 0, end = now.width - 1;
        while (first < now.width && ! isNew (first))
            ++first;
        if (first == now.width) continue;
        while (! isNew (end))
            --end;
        left = std::min (left, first);
        right = std::max (right, end);
        top = std::min (top, y);
        bottom = y;
    }
    return right < 0 ? juce::Rectangle<int> (0, 0, 1, 1) : juce::Rectangle<int>::leftTopRightBottom (left, top, right + 1, bottom + 1);
}

/// The rows of this part. What does not change is transparent, which compresses to almost nothing. Notes what is shown then.
std::string AnimatedPng::encoded (const juce::Image& frame, juce::Rectangle<int> part)
{
    const bool is_first = ! shown.isValid();
    if (is_first) shown = juce::Image (juce::Image::RGB, frame.getWidth(), frame.getHeight(), true, juce::SoftwareImageType());
    const Pixels now (frame, Pixels::readOnly);
    Pixels last (shown, Pixels::readWrite);
    return compressed (part.getWidth(), part.getHeight(), [&] (int row, Row& to) {
        bool is_any_new = false;
        auto* out = to.data();
        for (int x = part.getX(); x < part.getRight(); ++x, out += bytes_per_pixel)
        {
            const auto& p = pixel (now, x, part.getY() + row);
            auto& before = *reinterpret_cast<juce::PixelRGB*> (last.getPixelPointer (x, part.getY() + row));
            const bool is_new = is_first || differs (p, before);
            is_any_new = is_any_new || is_new;
            if (is_new) before = p;
            out[0] = is_new ? p.getRed() : 0;
            out[1] = is_new ? p.getGreen() : 0;
            out[2] = is_new ? p.getBlue() : 0;
            out[3] = is_new ? 255 : 0;
        }
        return is_any_new;
    });
}

bool AnimatedPng::add (const juce::Image& given, std::uint16_t milliseconds)
{
    const auto frame = given.convertedToFormat (juce::Image::RGB);
    if (frame.getBounds().isEmpty() || (shown.isValid() && frame.getBounds() != shown.getBounds())) return false;
    const auto part = changed (frame);
    const auto data = encoded (frame, part);
    const auto size = [] (juce::Rectangle<int> r) { return bigEndian (unsignedOf (r.getWidth())) + bigEndian (unsignedOf (r.getHeight())); };
    if (count == 0) header = PngChunk { "IHDR", size (part) + std::string ("\x08\x06\0\0\0", 5) }.bytes();   // 8 bits of RGBA, in rows from top to bottom

    constexpr char keep = 0, over = 1;   // the next frame starts from this one, and this one is drawn over the one before
    const auto place = size (part) + bigEndian (unsignedOf (part.getX())) + bigEndian (unsignedOf (part.getY()));
    body += PngChunk { "fcTL", bigEndian (sequence++) + place + bigEndian (milliseconds, 2) + bigEndian (1000, 2) + keep + over }.bytes();
    body += (count == 0 ? PngChunk { "IDAT", data } : PngChunk { "fdAT", bigEndian (sequence++) + data }).bytes();
    ++count;
    return true;
}

std::string AnimatedPng::file (bool repeats) const
{
    return std::string (png_signature) + header + PngChunk { "acTL", bigEndian (count) + bigEndian (repeats ? 0 : 1) }.bytes() + body
           + PngChunk { "IEND", {} }.bytes();
}

}   // namespace tactus::host
