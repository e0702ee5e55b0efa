// SPDX-License-Identifier: MIT
#include "image.hpp"

#include <tactus/text/budget.hpp>

#include <spng.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

namespace
{
using Read = Result<Grid>;

Message fail (std::string id, std::string_view name, std::string what, std::string remedy)
{
    return Message::error (std::move (id), std::string (name), std::move (what), std::move (remedy));
}

Message broken (std::string_view name, const std::string& why)
{
    return fail ("image/unreadable", name, "it cannot be decoded: " + why, "check that the file is complete, and save it again as PNG or JPEG");
}

Message tooLarge (std::string_view name, std::size_t columns, std::size_t rows)
{
    const double pixels = static_cast<double> (columns) * static_cast<double> (rows);
    auto over = overBudget ("image/too_large", &Budgets::numbers, "with " + std::to_string (columns) + " times " + std::to_string (rows) + " pixels, it",
                            pixels,
                            "make it smaller");
    over.where = name;
    return over;
}

Grid gridOf (std::size_t columns, std::size_t rows)
{
    return { .rows = static_cast<int> (rows), .columns = static_cast<int> (columns), .values = std::vector<double> (rows * columns) };
}

Read readPng (std::string_view bytes, std::string_view name)
{
    const std::unique_ptr<spng_ctx, void (*) (spng_ctx*)> png (spng_ctx_new (0), spng_ctx_free);
    spng_ihdr header {};
    const auto largest_chunk = static_cast<std::size_t> (budgets().file);
    spng_set_chunk_limits (png.get(), largest_chunk, largest_chunk);
    if (const int problem = spng_set_png_buffer (png.get(), bytes.data(), bytes.size()); problem != 0) return broken (name, spng_strerror (problem));
    if (const int problem = spng_get_ihdr (png.get(), &header); problem != 0) return broken (name, spng_strerror (problem));
    if (static_cast<double> (std::size_t { header.width } * header.height) > budgets().numbers) return tooLarge (name, header.width, header.height);

    // Deflate compresses to a thousandth at best.
    std::size_t unfolded = 0;
    if (spng_decoded_image_size (png.get(), SPNG_FMT_RAW, &unfolded) != 0 || unfolded / 1032 > bytes.size())
        return broken (name, "it has fewer pixels than its header says");

    // 16 bits per colour: every kind of PNG can be converted to this.
    constexpr std::size_t channels = 4;
    std::vector<std::uint16_t> row (channels * header.width);
    if (const int problem = spng_decode_image (png.get(), nullptr, 0, SPNG_FMT_RGBA16, SPNG_DECODE_PROGRESSIVE); problem != 0)
        return broken (name, spng_strerror (problem));

    constexpr double white = 65535.0;
    auto grid = gridOf (header.width, header.height);
    for (int problem = 0; problem != SPNG_EOI;)
    {
        spng_row_info at {};
        if (const int no_row = spng_get_row_info (png.get(), &at); no_row != 0) return broken (name, spng_strerror (no_row));
        problem = spng_decode_row (png.get(), row.data(), row.size() * sizeof row[0]);
        if (problem != 0 && problem != SPNG_EOI) return broken (name, spng_strerror (problem));
        for (std::size_t i = 0; i < header.width; ++i)
        {
            const auto* pixel = row.data() + channels * i;
            const bool grey = pixel[0] == pixel[1] && pixel[1] == pixel[2];
            grid.values[std::size_t { at.row_num } * header.width + i] = (grey ? pixel[0] : 0.299 * pixel[0] + 0.587 * pixel[1] + 0.114 * pixel[2]) / white;
        }
    }
    return grid;
}

Read readJpeg (std::string_view bytes, std::string_view name)
{
    const std::unique_ptr<void, int (*) (tjhandle)> jpeg (tjInitDecompress(), tjDestroy);
    const auto* data = reinterpret_cast<const unsigned char*> (bytes.data());
    const auto size = static_cast<unsigned long> (bytes.size());   // has 32 bits on Windows
    if (size != bytes.size()) return broken (name, "it is larger than 4 GB");
    int columns = 0, rows = 0, subsampling = 0, colours = 0;
    if (tjDecompressHeader3 (jpeg.get(), data, size, &columns, &rows, &subsampling, &colours) != 0) return broken (name, tjGetErrorStr2 (jpeg.get()));

    const auto pixels = static_cast<std::size_t> (columns) * static_cast<std::size_t> (rows);
    if (static_cast<double> (pixels) > budgets().numbers) return tooLarge (name, static_cast<std::size_t> (columns), static_cast<std::size_t> (rows));
    std::vector<unsigned char> greys (pixels);
    if (tjDecompress2 (jpeg.get(), data, size, greys.data(), columns, 0, rows, TJPF_GRAY, TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT)
        != 0)
        return broken (name, tjGetErrorStr2 (jpeg.get()));

    constexpr double white = 255.0;
    auto grid = gridOf (static_cast<std::size_t> (columns), static_cast<std::size_t> (rows));
    std::ranges::transform (greys, grid.values.begin(), [] (unsigned char grey) { return grey / white; });
    return grid;
}
}   // namespace

Result<Grid> readImage (std::string_view bytes, std::string_view name)
{
    if (bytes.starts_with ("\x89PNG")) return readPng (bytes, name);
    if (bytes.starts_with ("\xff\xd8")) return readJpeg (bytes, name);
    return fail ("image/unreadable", name, "it is neither a PNG nor a JPEG", "save it as PNG, with 16 bits per pixel for a height map");
}

}   // namespace tactus::host
