// SPDX-License-Identifier: MIT
#pragma once

#include "state_archive.hpp"

namespace tactus
{

/// A part of a state whose form only its owner knows, such as a plugin or a node in Python: the bytes that are given to be saved, or those that were saved.
inline std::string opaqueState (StateArchive& archive, std::string bytes)
{
    std::uint64_t size = bytes.size();
    archive (size);
    if (archive.restores()) bytes.clear();
    for (std::uint64_t i = 0; i < size && ! archive.isRefused(); ++i)
    {
        if (archive.restores()) bytes.push_back (0);
        archive (bytes[i]);
    }
    return bytes;
}

}   // namespace tactus
