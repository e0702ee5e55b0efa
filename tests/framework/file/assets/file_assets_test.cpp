// SPDX-License-Identifier: MIT
#include <tactus/file/assets/file_assets.hpp>
#include <tactus/file/assets/mesh.hpp>

#include "support/temporary_folder.hpp"
#include "support/with_limits.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace tactus;

namespace
{
/// Decodes every picture as its number of bytes, and every recording as what the test says.
class Decoder final : public readers::FileAssets
{
public:
    Signal recording { .rate_hz = 8000.0, .channels = { { 0.5, -1.0 }, { 0.0, 1.0 } } };
    int decoded = 0;

protected:
    Result<Signal> readSignal (const std::string&) override
    {
        ++decoded;
        return recording;
    }

    Result<Grid> readImage (std::string_view bytes, std::string_view) override
    {
        ++decoded;
        return Grid { .rows = 1, .columns = 1, .values = { static_cast<double> (bytes.size()) } };
    }
};

template <typename T>
std::string idOf (const Assets::Loaded<T>& loaded)
{
    return loaded ? "" : loaded.error().id;
}
}   // namespace

TEST_CASE ("the framework reads tables and meshes, and has no decoders for pictures and recordings", "[file][assets]")
{
    const TemporaryFolder folder;
    folder.write ("a.csv", "1,2,3\n4,5,6\n");
    folder.write ("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write ("a.png", "picture");
    folder.write ("a.wav", "recording");

    readers::FileAssets files;
    const auto table = files.table ((folder / "a.csv").string());
    REQUIRE (table);
    CHECK ((*table)->values == std::vector<double> { 1, 2, 3, 4, 5, 6 });
    const auto mesh = files.mesh ((folder / "a.obj").string());
    REQUIRE (mesh);
    CHECK ((*mesh)->triangles.size() == 1);
    CHECK (*files.mesh ((folder / "a.obj").string()) == *mesh);   // it is not read again
    CHECK (idOf (files.image ((folder / "a.png").string())) == "asset/no_decoder");
    CHECK (idOf (files.signal ((folder / "a.wav").string())) == "asset/no_decoder");
    CHECK (idOf (files.image ((folder / "none.png").string())) == "asset/unreadable");
    CHECK (idOf (files.mesh ((folder / "a.csv").string())) == "mesh/unknown_kind");
    CHECK (idOf (files.table ((folder / "a.png").string())) == "table/empty");
}

TEST_CASE ("a program can add decoders to the reader of assets, and each file is decoded once while it is in use", "[file][assets]")
{
    const TemporaryFolder folder;
    folder.write ("a.png", "picture");
    folder.write ("a.wav", "recording");
    Decoder files;
    const auto image = files.image ((folder / "a.png").string());
    REQUIRE (image);
    CHECK ((*image)->values[0] == 7.0);
    CHECK (*files.image ((folder / "a.png").string()) == *image);
    const auto signal = files.signal ((folder / "a.wav").string());
    REQUIRE (signal);
    CHECK ((*signal)->channels == files.recording.channels);
    CHECK (files.decoded == 2);
}

TEST_CASE ("recordings that nodes cannot use are refused, even if a program decodes them itself", "[file][assets]")
{
    const TemporaryFolder folder;
    folder.write ("a.wav", "recording");
    Decoder files;
    const auto refusal = [&] (Signal recording) {
        files.recording = std::move (recording);
        return idOf (files.signal ((folder / "a.wav").string()));
    };
    const auto nan = std::numeric_limits<double>::quiet_NaN();
    CHECK (refusal ({ .rate_hz = 0.0, .channels = { { 1.0 } } }) == "asset/signal");
    CHECK (refusal ({ .rate_hz = nan, .channels = { { 1.0 } } }) == "asset/signal");
    CHECK (refusal ({ .rate_hz = 1.0, .channels = {} }) == "asset/signal");
    CHECK (refusal ({ .rate_hz = 1.0, .channels = { {} } }) == "asset/signal");
    CHECK (refusal ({ .rate_hz = 1.0, .channels = { { 1.0 }, { 1.0, 2.0 } } }) == "asset/signal");
    CHECK (refusal ({ .rate_hz = 1.0, .channels = { { 1.0, nan } } }) == "asset/signal");
    CHECK (refusal ({ .rate_hz = 1.0, .channels = { { 1.0 } } }) == "");
}

TEST_CASE ("files that take more than the budget of a graph are refused", "[file][assets]")
{
    const TemporaryFolder folder;
    folder.write ("a.csv", "1,2,3\n");
    folder.write ("b.csv", std::string (400, '1') + ",2\n");
    const WithLimits limits ("reading=200,file=300");
    readers::FileAssets files;
    beginReading();
    CHECK (idOf (files.table ((folder / "b.csv").string())) == "asset/unreadable");
    const auto first = files.table ((folder / "a.csv").string());   // 6 bytes, and 8 for each number
    REQUIRE (first);
    std::vector<Assets::Loaded<Grid>> more;
    for (int i = 0; i < 10; ++i)
    {
        folder.write ("c" + std::to_string (i) + ".csv", "1,2,3\n");
        more.push_back (files.table ((folder / ("c" + std::to_string (i) + ".csv")).string()));
    }
    CHECK (idOf (more.front()) == "");
    CHECK (idOf (more.back()) == "asset/unreadable");
    beginReading();
}

TEST_CASE ("a mesh of numbers is the mesh that a file with these numbers gives", "[file][assets][mesh]")
{
    const std::vector<double> points { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1.0000000001, 0, 0, 1, 1, 0 };
    const std::vector<std::int32_t> triangles { 0, 1, 2, 3, 4, 2, 0, 1, 3 };
    const auto given = readers::meshOf (points, triangles, "body");
    const auto read = readers::readMesh ("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.0000000001 0 0\nv 1 1 0\nf 1 2 3\nf 4 5 3\nf 1 2 4\n", "body.obj");
    REQUIRE (given);
    REQUIRE (read);
    CHECK (given->points == read->points);
    CHECK (given->points.size() == 4);
    CHECK (given->triangles == read->triangles);
    CHECK (given->triangles.size() == 2);
    CHECK (readers::meshOf (points, std::vector<std::int32_t> { 0, 1, 5 }, "body").error().id == "mesh/no_such_point");
    CHECK (readers::meshOf (points, std::vector<std::int32_t> { 0, 1, -1 }, "body").error().id == "mesh/no_such_point");
    CHECK (readers::meshOf (points, std::vector<std::int32_t> { 0, 1, 3 }, "body").error().id == "mesh/no_triangles");
    const std::vector<double> stray { 0, 0, 0, 1, 0, 0, 0, std::numeric_limits<double>::infinity(), 0 };
    CHECK (readers::meshOf (stray, std::vector<std::int32_t> { 0, 1, 2 }, "body").error().id == "mesh/syntax");
}
