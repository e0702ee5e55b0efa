// SPDX-License-Identifier: MIT
#pragma once

#include <spng.h>
#include <turbojpeg.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace tactus::test
{

/// The bytes of a PNG; `colour` is an enum spng_color_type. T has 8 or 16 bits.
template <typename T>
std::string png (std::uint32_t columns, std::uint32_t rows, std::uint8_t colour, const std::vector<T>& values)
{
    const std::unique_ptr<spng_ctx, void (*) (spng_ctx*)> made (spng_ctx_new (SPNG_CTX_ENCODER), spng_ctx_free);
    spng_set_option (made.get(), SPNG_ENCODE_TO_BUFFER, 1);
    spng_ihdr header { columns, rows, 8 * sizeof (T), colour, 0, 0, 0 };
    spng_set_ihdr (made.get(), &header);
    if (spng_encode_image (made.get(), values.data(), values.size() * sizeof (T), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE) != 0) return {};
    std::size_t size = 0;
    int problem = 0;
    const std::unique_ptr<void, void (*) (void*)> bytes (spng_get_png_buffer (made.get(), &size, &problem), std::free);
    return { static_cast<const char*> (bytes.get()), size };
}

/// The bytes of a greyscale JPEG.
inline std::string jpeg (int columns, int rows, const std::vector<unsigned char>& greys)
{
    const std::unique_ptr<void, int (*) (tjhandle)> made (tjInitCompress(), tjDestroy);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    tjCompress2 (made.get(), greys.data(), columns, 0, rows, TJPF_GRAY, &bytes, &size, TJSAMP_GRAY, 100, 0);
    const std::unique_ptr<unsigned char, void (*) (unsigned char*)> owned (bytes, tjFree);
    return { reinterpret_cast<const char*> (bytes), size };
}

}   // namespace tactus::test
