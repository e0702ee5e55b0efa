// SPDX-License-Identifier: MIT
#include <host/base/files/wav/wav_header.hpp>

#include <catch2/catch.hpp>

using tactus::host::wavHeader;

namespace
{
std::uint64_t integerAt (const std::string& bytes, std::size_t at, int size)
{
    std::uint64_t value = 0;
    for (int i = size; i-- > 0;)
        value = value << 8 | static_cast<unsigned char> (bytes.at (at + static_cast<std::size_t> (i)));
    return value;
}

/// The place of a chunk's contents. The chunks follow each other without gaps.
std::size_t contentOf (const std::string& header, const std::string& chunk)
{
    for (std::size_t at = 12; at + 8 <= header.size(); at += 8 + integerAt (header, at + 4, 4))
        if (header.substr (at, 4) == chunk) return at + 8;
    FAIL ("there is no chunk " << chunk);
    return 0;
}
}   // namespace

TEST_CASE ("wav header: a format with an extension, the number of frames and the sizes", "[host][io][wav]")
{
    const auto header = wavHeader (48'000.0, 3, 1000);
    const auto format = contentOf (header, "fmt ");
    CHECK (header.substr (0, 4) == "RIFF");
    CHECK (integerAt (header, 4, 4) == header.size() - 8 + 12'000);
    CHECK (integerAt (header, format - 4, 4) == 18);
    CHECK (integerAt (header, format, 2) == 3);
    CHECK (integerAt (header, format + 2, 2) == 3);
    CHECK (integerAt (header, format + 4, 4) == 48'000);
    CHECK (integerAt (header, format + 8, 4) == 48'000 * 12);
    CHECK (integerAt (header, format + 12, 2) == 12);
    CHECK (integerAt (header, format + 14, 2) == 32);
    CHECK (integerAt (header, format + 16, 2) == 0);
    CHECK (integerAt (header, contentOf (header, "fact"), 4) == 1000);
    CHECK (integerAt (header, contentOf (header, "data") - 4, 4) == 12'000);
    CHECK (contentOf (header, "data") == header.size());
}

TEST_CASE ("wav header: beyond 4 GB the file is an RF64 with the sizes in 64 bits", "[host][io][wav]")
{
    const std::uint64_t frames = 3'000'000'000;
    const auto header = wavHeader (4000.0, 2, frames), small = wavHeader (4000.0, 2, 1);
    REQUIRE (header.size() == small.size());   // so that it can replace the header of a small file
    const auto sizes = contentOf (header, "ds64");
    CHECK (header.substr (0, 4) == "RF64");
    CHECK (integerAt (header, 4, 4) == 0xffffffff);
    CHECK (integerAt (header, sizes, 8) == header.size() - 8 + 8 * frames);
    CHECK (integerAt (header, sizes + 8, 8) == 8 * frames);
    CHECK (integerAt (header, sizes + 16, 8) == frames);
    CHECK (integerAt (header, header.size() - 4, 4) == 0xffffffff);
}
