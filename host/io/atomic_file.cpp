// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/io/atomic_file.hpp>

namespace tactus::host
{

namespace
{
Error unwritable (const std::filesystem::path& path, const std::string& reason)
{
    return { "output/unwritable", path.string(), "cannot be written: " + reason, "choose another file, or make its folder and room for it" };
}
}   // namespace

tl::expected<AtomicFile, Error> createFile (const std::filesystem::path& path)
{
    AtomicFile file (path);
    if (file.refused()) return tl::unexpected (unwritable (path, *file.refused()));
    return file;
}

tl::expected<void, Error> commitFile (AtomicFile& file)
{
    if (const auto reason = file.commit()) return tl::unexpected (unwritable (file.path(), *reason));
    return {};
}

Error writeFailed (const AtomicFile& file) { return unwritable (file.path(), AtomicFile::lastReason()); }

}   // namespace tactus::host
