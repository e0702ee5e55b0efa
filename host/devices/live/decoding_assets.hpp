// SPDX-License-Identifier: MIT
#pragma once

#include <framework/capi/caller_assets.hpp>
#include <host/base/assets/image.hpp>
#include <host/base/files/wav.hpp>

namespace tactus::host
{

/// The assets that the caller supplies, and the files of all others, with pictures and recordings, which libtactus cannot decode. [main thread]
class DecodingAssets final : public capi::CallerAssets
{
public:
    using CallerAssets::CallerAssets;

protected:
    Result<Signal> readSignal (const std::string& path) override { return readWav (path); }
    Result<Grid> readImage (std::string_view bytes, std::string_view path) override { return host::readImage (bytes, path); }
};

}   // namespace tactus::host
