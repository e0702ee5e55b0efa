// SPDX-License-Identifier: MIT
#include "png_density.hpp"
#include <host/tools/figures/png_chunks.hpp>

#include <cmath>

namespace tactus::host
{

std::string withDensity (std::string png, double dpi)
{
    constexpr std::size_t after_header = 8 + 4 + 4 + 13 + 4;   // the signature and the chunk IHDR, which comes first
    const auto per_metre = bigEndian (static_cast<std::uint32_t> (std::lround (dpi / 25.4e-3)));
    return png.insert (after_header, PngChunk { "pHYs", per_metre + per_metre + '\1' }.bytes());
}

}   // namespace tactus::host
