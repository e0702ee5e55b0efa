// SPDX-License-Identifier: MIT
#include <host/base/assets/file_assets.hpp>

#include "pictures.hpp"
#include "support/temporary_folder.hpp"

#include <host/base/files/wav.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <limits>

using namespace tactus;
using host::FileAssets;

namespace
{
template <typename T>
std::shared_ptr<const T> content (const Assets::Loaded<T>& loaded)
{
    if (! loaded) FAIL (sentence (loaded.error()));
    return *loaded;
}

template <typename T>
std::string refusal (const Assets::Loaded<T>& loaded)
{
    return loaded ? "" : sentence (loaded.error());
}

void writeWav (const TemporaryFolder& folder, const std::string& name, const std::vector<double>& samples)
{
    auto writer = host::WavWriter::create (folder / name, 8000.0, 1);
    REQUIRE (writer);
    for (const double s : samples)
        REQUIRE (writer->frame ({ &s, 1 }));
    REQUIRE (writer->commit());
}

bool contains (const std::string& text, const std::string& part) { return text.find (part) != std::string::npos; }
}   // namespace

TEST_CASE ("each kind of file is read", "[host][assets]")
{
    const TemporaryFolder folder;
    folder.write ("a.csv", "1,2,3\n4,5,6\n");
    folder.write ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write ("a.png", test::png (2, 1, SPNG_COLOR_TYPE_GRAYSCALE, std::vector<std::uint8_t> { 0, 255 }));
    writeWav (folder, "a.wav", { 0.5, -2.0 });

    FileAssets files;
    CHECK (content (files.table ((folder / "a.csv").string()))->values[5] == 6.0);
    CHECK (content (files.mesh ((folder / "a.obj").string()))->triangles.size() == 1);
    CHECK (content (files.image ((folder / "a.png").string()))->values[1] == 1.0);
    const auto signal = content (files.signal ((folder / "a.wav").string()));
    CHECK (signal->rate_hz == 8000.0);
    CHECK (signal->channels == std::vector<std::vector<double>> { { 0.5, -2.0 } });
}

TEST_CASE ("a file is read once while it is in use, and again after a change", "[host][assets]")
{
    const TemporaryFolder folder;
    folder.write ("a.csv", "1,2,3\n");
    FileAssets files;
    auto first = content (files.table ((folder / "a.csv").string()));
    CHECK (content (files.table ((folder / "a.csv").string())) == first);

    folder.write ("a.csv", "7,8,9\n");   // same length as before
    std::filesystem::last_write_time (folder / "a.csv", std::filesystem::last_write_time (folder / "a.csv") + std::chrono::seconds (1));
    const auto second = content (files.table ((folder / "a.csv").string()));
    CHECK (first->values[0] == 1.0);
    CHECK (second->values[0] == 7.0);

    const std::weak_ptr<const Grid> watch = first;
    first.reset();
    CHECK (watch.expired());   // no other owner
}

TEST_CASE ("an image and a table with the same name are separate", "[host][assets]")
{
    const TemporaryFolder folder;
    folder.write ("a", "1,2,3\n");
    FileAssets files;
    const auto table = content (files.table ((folder / "a").string()));
    CHECK (contains (refusal (files.image ((folder / "a").string())), "neither a PNG nor a JPEG"));
}

TEST_CASE ("a file that cannot be read is refused with path, cause and remedy", "[host][assets]")
{
    const TemporaryFolder folder;
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    writeWav (folder, "empty.wav", {});
    writeWav (folder, "nan.wav", { 0.0, nan });
    folder.write ("large.csv", "1\n");
    std::filesystem::resize_file (folder / "large.csv", (64u << 20) + 1);
    folder.write ("bad.csv", "1\n2 N\n");

    FileAssets files;
    const auto missing = refusal (files.mesh ((folder / "none.obj").string()));
    CHECK (contains (missing, (folder / "none.obj").string() + ": there is no such file; "));
    CHECK (contains (missing, "folder of the graph"));
    CHECK (contains (refusal (files.table (folder.path().string())), "not a file"));
    CHECK (contains (refusal (files.table ("/dev/zero")), "not a file"));
    CHECK (contains (refusal (files.table ((folder / "large.csv").string())), "64 MB"));
    CHECK (contains (refusal (files.table ((folder / "bad.csv").string())), "bad.csv:2: "));
    CHECK (contains (refusal (files.table (std::string ("a\0b", 3))), "NUL"));
    CHECK (contains (refusal (files.signal ((folder / "bad.csv").string())), "not a supported WAV"));
    CHECK (contains (refusal (files.signal ((folder / "empty.wav").string())), "no samples"));
    CHECK (contains (refusal (files.signal ((folder / "nan.wav").string())), "not finite"));
}
