// SPDX-License-Identifier: MIT
#include <host/base/assets/image.hpp>

#include "pictures.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using host::readImage;

namespace
{
using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint16_t>;

std::vector<double> greys (const std::string& bytes)
{
    const auto grid = readImage (bytes, "a.png");
    INFO ((grid ? "" : describe (grid.error())));
    REQUIRE (grid);
    return grid->values;
}

std::string problem (const std::string& bytes)
{
    const auto grid = readImage (bytes, "a.png");
    return grid ? "" : grid.error().id;
}
}   // namespace

TEST_CASE ("a 16-bit PNG keeps every grey value, row by row from the top", "[host][assets][image]")
{
    test::property ("any picture", [] {
        const int rows = *rc::gen::inRange (1, 6), columns = *rc::gen::inRange (1, 6);
        const auto values = *rc::gen::container<Words> (static_cast<std::size_t> (rows * columns), rc::gen::arbitrary<std::uint16_t>());
        const auto grid =
            readImage (test::png (static_cast<std::uint32_t> (columns), static_cast<std::uint32_t> (rows), SPNG_COLOR_TYPE_GRAYSCALE, values), "a.png");
        RC_ASSERT (grid);
        RC_ASSERT (grid->rows == rows);
        RC_ASSERT (grid->columns == columns);
        for (std::size_t i = 0; i < values.size(); ++i)
            RC_ASSERT (grid->values[i] == values[i] / 65535.0);
    });
}

TEST_CASE ("8-bit greys map to the range 0 to 1, colours map to their luminance, and transparency is ignored", "[host][assets][image]")
{
    CHECK (greys (test::png (3, 1, SPNG_COLOR_TYPE_GRAYSCALE, Bytes { 0, 51, 255 })) == std::vector { 0.0, 0.2, 1.0 });
    CHECK (greys (test::png (2, 1, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, Bytes { 255, 0, 0, 255 })) == std::vector { 1.0, 0.0 });

    const auto colours = greys (test::png (5, 1, SPNG_COLOR_TYPE_TRUECOLOR, Bytes { 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 51, 51, 51 }));
    CHECK (colours[0] == Approx (0.299));
    CHECK (colours[1] == Approx (0.587));
    CHECK (colours[2] == Approx (0.114));
    CHECK (colours[3] == 1.0);
    CHECK (colours[4] == 0.2);
    CHECK (greys (test::png (1, 1, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, Words { 1, 1, 1, 7 })) == std::vector { 1 / 65535.0 });
}

TEST_CASE ("a JPEG is read with its grey values", "[host][assets][image]")
{
    std::vector<unsigned char> ramp;
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 32; ++column)
            ramp.push_back (static_cast<unsigned char> (8 * column));
    const auto grid = readImage (test::jpeg (32, 16, ramp), "a.jpg");
    REQUIRE (grid);
    CHECK (grid->rows == 16);
    CHECK (grid->columns == 32);
    for (std::size_t i = 0; i < ramp.size(); ++i)
        CHECK (grid->values[i] == Approx (ramp[i] / 255.0).margin (0.01));
}

TEST_CASE ("an unreadable image is refused with a reason", "[host][assets][image]")
{
    const auto whole = test::png (64, 64, SPNG_COLOR_TYPE_GRAYSCALE, Bytes (64 * 64, 7));
    const auto photo = test::jpeg (64, 64, std::vector<unsigned char> (64 * 64, 7));
    CHECK (problem ("") == "image/unreadable");
    CHECK (problem ("GIF89a") == "image/unreadable");
    CHECK (problem (whole.substr (0, whole.size() / 2)) == "image/unreadable");
    CHECK (problem (photo.substr (0, photo.size() / 2)) == "image/unreadable");

    // A header with a correct checksum claims 60000 by 60000 pixels.
    CHECK (problem ({ "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x08\0\0\0\0\xa5\xb9\x2a\x9e", 33 }) == "image/too_large");

    // Another header claims 3000 by 3000 pixels in a file of 100 bytes.
    const auto small = test::png (3000, 3000, SPNG_COLOR_TYPE_GRAYSCALE, Bytes (9'000'000, 7));
    CHECK (problem (small.substr (0, 100)) == "image/unreadable");
}

TEST_CASE ("no damaged image crashes the reader", "[host][assets][image]")
{
    const std::vector<std::string> all { test::png (9, 7, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, Words (9 * 7 * 4, 300)),
                                         test::png (9, 7, SPNG_COLOR_TYPE_GRAYSCALE, Bytes (9 * 7, 3)),
                                         test::jpeg (9, 7, std::vector<unsigned char> (9 * 7, 3)) };
    test::property ("any bytes changed or cut off", [&] {
        auto bytes = *rc::gen::elementOf (all);
        for (const auto& [at, value] : *rc::gen::container<std::vector<std::pair<std::uint16_t, char>>> (rc::gen::arbitrary<std::pair<std::uint16_t, char>>()))
            bytes[at % bytes.size()] = value;
        bytes.resize (*rc::gen::inRange<std::size_t> (0, bytes.size() + 1));
        if (const auto id = problem (bytes); ! id.empty()) RC_ASSERT (id.starts_with ("image/"));
    });
}
