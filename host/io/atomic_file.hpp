// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/file/atomic_file.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

namespace tactus::host
{

/// Opens a file that appears whole or not at all; output/unwritable if that cannot be.
[[nodiscard]] tl::expected<AtomicFile, Error> createFile (const std::filesystem::path&);

/// Puts it in place, or says why it could not.
[[nodiscard]] tl::expected<void, Error> commitFile (AtomicFile&);

/// The error to return when a write failed; call it at once.
[[nodiscard]] Error writeFailed (const AtomicFile&);

}   // namespace tactus::host
