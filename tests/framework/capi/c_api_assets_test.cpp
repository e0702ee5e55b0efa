// SPDX-License-Identifier: MIT
#include "c_handles.hpp"

#include <framework/capi/caller_assets.hpp>
#include <support/temporary_folder.hpp>
#include <support/with_limits.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

using namespace tactus::test;

namespace
{
/// What a test supplies, and what it was asked for.
struct Supplier
{
    tactus_asset_answer answer = TACTUS_ASSET_SUPPLIED;
    tactus_asset asset {};
    std::vector<std::string> asked {};   // "kind path"

    static tactus_asset_answer read (void* context, tactus_asset_kind kind, const char* path, tactus_asset* to)
    {
        auto& mine = *static_cast<Supplier*> (context);
        mine.asked.push_back (std::to_string (kind) + " " + path);
        CHECK (to->size == sizeof (tactus_asset));
        CHECK (to->values == nullptr);
        const auto size = to->size;
        *to = mine.asset;
        to->size = size;
        return mine.answer;
    }
};

const std::vector<double> relief { 0.0, 0.25, 0.5, 0.25, 1.0, 0.75 };   // 2 rows, 3 columns
const std::vector<double> corners { 0, 0, 0, 0.02, 0, 0, 0, 0.02, 0, 0.02, 0.02, 0 };
const std::vector<std::int32_t> faces { 0, 1, 2, 1, 3, 2 };
const char* const square = "v 0 0 0\nv 0.02 0 0\nv 0 0.02 0\nv 0.02 0.02 0\nf 1 2 3\nf 2 4 3\n";
const std::string curves = R"("curves": [[{"power": [1000, 1]}, {"power": [1000, 1]}, {"power": [500, 1]}]], "mu": 0.5)";

tactus_asset gridOf (const std::vector<double>& values, size_t rows, size_t columns)
{
    tactus_asset asset {};
    asset.rows = rows;
    asset.columns = columns;
    asset.values = values.data();
    return asset;
}

tactus_asset meshOf (const std::vector<double>& points, const std::vector<std::int32_t>& triangles)
{
    tactus_asset asset {};
    asset.points = points.data();
    asset.point_count = points.size() / 3;
    asset.triangles = triangles.data();
    asset.triangle_count = triangles.size() / 3;
    return asset;
}

/// A graph with one node, which has one setting.
GraphHandle oneNode (const char* type, const char* setting, const std::string& value, const TemporaryFolder& folder, const MessageList& m)
{
    const auto text = R"({"format": "tactus-graph", "version": 2, "name": "One", "rate_hz": 1000, "nodes": {"it": {"type": ")" + std::string (type)
                      + R"(", "settings": {")" + setting + "\": " + value + "}}}, \"wires\": []}";
    GraphHandle g { tactus_graph_parse (text.data(), text.size(), folder.path().string().c_str(), m.get()) };
    INFO (said (m));
    REQUIRE (g);
    return g;
}

GraphHandle withMap (const std::string& map, const TemporaryFolder& folder, const MessageList& m)
{
    return oneNode ("texture.height_map", "map", map, folder, m);
}

GraphHandle withSurface (const std::string& mesh, const TemporaryFolder& folder, const MessageList& m)
{
    return oneNode ("deform.surface", "surface", "{" + mesh + ", " + curves + "}", folder, m);
}

/// A run whose position is fed and whose force is recorded. Null if the graph does not compile.
RunHandle runOf (const GraphHandle& g, Supplier* supplier, const MessageList& m)
{
    const char* const feeds[] = { "it.position.x", "it.position.y", "it.position.z" };
    const char* const records[] = { "it.force" };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.feeds = feeds;
    options.feed_count = 3;
    options.records = records;
    options.record_count = 1;
    if (supplier != nullptr)
    {
        options.assets = Supplier::read;
        options.asset_context = supplier;
    }
    return RunHandle { tactus_run_create (g.get(), &options, m.get()) };
}

/// The forces on a path that presses and strokes.
std::vector<double> forces (const RunHandle& run, const MessageList& m)
{
    INFO (said (m));
    REQUIRE (run);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    constexpr size_t ticks = 400;
    std::vector<double> path, force (3 * ticks);
    for (size_t k = 0; k < ticks; ++k)
        for (const double c : { 0.004 + 2e-5 * static_cast<double> (k), 0.007, 0.002 - 1.5e-5 * static_cast<double> (k) })
            path.push_back (c);
    REQUIRE (tactus_run_steps (run.get(), ticks, path.data(), force.data()) == TACTUS_OK);
    return force;
}

/// Renders a graph, and checks that something is felt.
std::vector<double> felt (const GraphHandle& g, Supplier* supplier, const MessageList& m)
{
    auto force = forces (runOf (g, supplier, m), m);
    CHECK (std::ranges::any_of (force, [] (double v) { return std::abs (v) > 1e-6; }));
    return force;
}

/// Why a graph does not compile.
std::string refusal (const GraphHandle& g, Supplier* supplier)
{
    const MessageList m { tactus_messages_create() };
    CHECK_FALSE (runOf (g, supplier, m));
    return said (m);
}

/// The largest value of a wavetable after a hit.
double loudest (const GraphHandle& g, Supplier& supplier, const MessageList& m)
{
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    const char* const records[] = { "it.value" };
    options.records = records;
    options.record_count = 1;
    options.assets = Supplier::read;
    options.asset_context = &supplier;
    const RunHandle run { tactus_run_create (g.get(), &options, m.get()) };
    INFO (said (m));
    REQUIRE (run);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_hit (run.get(), "it.hit", 1.0, m.get()) == TACTUS_OK);
    std::vector<double> rung (150);
    REQUIRE (tactus_run_steps (run.get(), rung.size(), nullptr, rung.data()) == TACTUS_OK);
    double largest = 0.0;
    for (const double v : rung)
        largest = std::max (largest, std::abs (v));
    return largest;
}

bool contains (const std::string& text, const std::string& part) { return text.find (part) != std::string::npos; }
}   // namespace

TEST_CASE ("C API: a mesh next to the graph gives the bits of the same mesh in the graph, and of one that the caller supplies", "[c_api][assets]")
{
    const TemporaryFolder folder;
    folder.write ("square.obj", square);
    const MessageList m { tactus_messages_create() };
    const auto inside = felt (withSurface (R"("nodes": [[0,0,0],[0.02,0,0],[0,0.02,0],[0.02,0.02,0]], "triangles": [[0,1,2],[1,3,2]])", folder, m), nullptr, m);
    const auto file = withSurface (R"("mesh": "square.obj")", folder, m);
    CHECK (felt (file, nullptr, m) == inside);

    Supplier supplier { .asset = meshOf (corners, faces) };
    CHECK (felt (withSurface (R"("mesh": "not_there.obj")", folder, m), &supplier, m) == inside);
    CHECK (supplier.asked == std::vector<std::string> { "4 " + (folder / "not_there.obj").string() });
    supplier.answer = TACTUS_ASSET_FROM_FILE;
    CHECK (felt (file, &supplier, m) == inside);
}

TEST_CASE ("C API: a table next to the graph gives the bits of one that the caller supplies", "[c_api][assets]")
{
    const TemporaryFolder folder;
    folder.write ("scan.csv", "0,0.25,0.5\n0.25,1,0.75\n");
    const MessageList m { tactus_messages_create() };
    const auto g = withMap (R"({"csv": "scan.csv", "pitch": "1 mm", "height": "1 mm"})", folder, m);
    const auto read = felt (g, nullptr, m);
    Supplier supplier { .asset = gridOf (relief, 2, 3) };
    CHECK (felt (g, &supplier, m) == read);
    CHECK (supplier.asked == std::vector<std::string> { "3 " + (folder / "scan.csv").string() });
}

TEST_CASE ("C API: pictures and recordings come from the caller, because the library has no decoders", "[c_api][assets]")
{
    const TemporaryFolder folder;
    folder.write ("hide.png", "not decoded");
    folder.write ("tap.wav", "not decoded");
    const MessageList m { tactus_messages_create() };
    const auto picture = withMap (R"({"image": "hide.png", "pitch": "1 mm", "height": "1 mm"})", folder, m);
    CHECK (contains (refusal (picture, nullptr), "no decoder for pictures"));
    Supplier supplier { .asset = gridOf (relief, 2, 3) };
    const std::vector<double> upside_down { 0.25, 1.0, 0.75, 0.0, 0.25, 0.5 };   // the first row of a picture is at the top, that of a table at y = 0
    const auto shown = felt (picture, &supplier, m);
    supplier.asset = gridOf (upside_down, 2, 3);
    CHECK (felt (withMap (R"({"csv": "scan.csv", "pitch": "1 mm", "height": "1 mm"})", folder, m), &supplier, m) == shown);

    const auto ring = oneNode ("vibration.wavetable", "table", R"({"wav": "tap.wav", "channel": 2})", folder, m);
    CHECK (contains (refusal (ring, nullptr), "no decoder for recordings"));
    std::vector<double> frames;   // two channels: silence, and a ring
    for (int i = 0; i < 200; ++i)
        for (const double sample : { 0.0, std::exp (-i / 40.0) * std::sin (i / 5.0) })
            frames.push_back (sample);
    supplier.asset = gridOf (frames, 200, 2);
    CHECK (contains (refusal (ring, &supplier), "no sample rate"));
    supplier.asset.rate_hz = 1000.0;
    CHECK (loudest (ring, supplier, m) > 0.3);
    const auto silence = oneNode ("vibration.wavetable", "table", R"({"wav": "tap.wav", "channel": 1})", folder, m);
    CHECK (loudest (silence, supplier, m) == 0.0);
}

TEST_CASE ("C API: files that are missing, damaged or too large are refused in the words of the program", "[c_api][assets]")
{
    const TemporaryFolder folder;
    folder.write ("cut.obj", "v 0 0 0\nv 1 0\n");
    folder.write ("words.csv", "1,2\nthree,4\n");
    folder.write ("long.csv", "1,2,3\n4,5,6\n7,8,9\n");
    folder.write ("square.obj", square);
    const MessageList m { tactus_messages_create() };
    const auto map = [&] (const std::string& csv) { return withMap (R"({"csv": ")" + csv + R"(", "pitch": "1 mm"})", folder, m); };
    const auto missing = refusal (map ("none.csv"), nullptr);
    CHECK (contains (missing, "setting/value: "));
    CHECK (contains (missing, (folder / "none.csv").string() + ": there is no such file"));
    CHECK (contains (refusal (map ("."), nullptr), "not a file"));
    CHECK (contains (refusal (map ("words.csv"), nullptr), "words.csv:2: 'three' is not a finite number"));
    CHECK (contains (refusal (withSurface (R"("mesh": "cut.obj")", folder, m), nullptr), "cut.obj:2: a point needs three numbers"));
    CHECK (contains (refusal (withSurface (R"("mesh": "words.csv")", folder, m), nullptr), "save it as .obj, .off, .ply or .stl"));
    const WithLimits back_to_defaults { "" };
    REQUIRE (tactus_set_limits ("numbers=8,points=3", m.get()) == TACTUS_OK);
    CHECK (contains (refusal (map ("long.csv"), nullptr), "the budget `numbers` allows 8 numbers"));
    CHECK (contains (refusal (withSurface (R"("mesh": "square.obj")", folder, m), nullptr), "the budget `points` allows 3 points"));
    CHECK (tactus_set_limits ("numbers=many", m.get()) == TACTUS_FAILED);
    CHECK (contains (said (m), "limits/value"));
    CHECK (tactus_set_limits (nullptr, m.get()) == TACTUS_MISUSE);
}

TEST_CASE ("C API: numbers of the caller that nodes cannot use are refused", "[c_api][assets]")
{
    const TemporaryFolder folder;
    const MessageList m { tactus_messages_create() };
    const auto picture = withMap (R"({"image": "hide.png", "pitch": "1 mm"})", folder, m);
    Supplier supplier;
    CHECK (contains (refusal (picture, &supplier), "supplies no numbers"));
    const std::vector<double> damaged { 0.0, std::numeric_limits<double>::quiet_NaN() };
    supplier.asset = gridOf (damaged, 1, 2);
    CHECK (contains (refusal (picture, &supplier), "not finite"));
    supplier.asset = gridOf (relief, std::numeric_limits<size_t>::max(), std::numeric_limits<size_t>::max());
    CHECK (contains (refusal (picture, &supplier), "the budget `numbers`"));
    supplier.asset = {};
    supplier.answer = TACTUS_ASSET_REFUSED;
    CHECK (contains (refusal (picture, &supplier), "does not supply it"));
    supplier.asset.problem = "the camera is off";
    CHECK (contains (refusal (picture, &supplier), "hide.png: the camera is off"));

    const auto body = withSurface (R"("mesh": "body.ply")", folder, m);
    supplier = {};
    CHECK (contains (refusal (body, &supplier), "no points and triangles"));
    const std::vector<std::int32_t> stray { 0, 1, 4 }, flat { 0, 1, 1 };
    supplier.asset = meshOf (corners, stray);
    CHECK (contains (refusal (body, &supplier), "not among the 4 points"));
    supplier.asset = meshOf (corners, flat);
    CHECK (contains (refusal (body, &supplier), "no triangles"));
}

TEST_CASE ("C API: a program that knows no assets in tactus_run_options is not asked for any", "[c_api][assets]")
{
    const TemporaryFolder folder;
    folder.write ("scan.csv", "0,0.25,0.5\n0.25,1,0.75\n");
    const MessageList m { tactus_messages_create() };
    const auto g = withMap (R"({"csv": "scan.csv", "pitch": "1 mm"})", folder, m);
    Supplier supplier { .answer = TACTUS_ASSET_REFUSED };
    tactus_run_options options = TACTUS_RUN_OPTIONS;
    options.assets = Supplier::read;
    options.asset_context = &supplier;
    CHECK_FALSE (RunHandle { tactus_run_create (g.get(), &options, m.get()) });
    options.size = offsetof (tactus_run_options, assets);   // compiled with an older tactus.h
    const MessageList none { tactus_messages_create() };
    CHECK (RunHandle { tactus_run_create (g.get(), &options, none.get()) });
    CHECK (supplier.asked.size() == 1);
}

TEST_CASE ("C API: the same numbers from the caller are the same object, so that a contact survives an edit", "[c_api][assets]")
{
    Supplier supplier { .asset = meshOf (corners, faces) };
    tactus::capi::CallerAssets assets { { Supplier::read, &supplier } };
    const auto first = assets.mesh ("body.obj");
    REQUIRE (first);
    const auto copy = corners;
    supplier.asset.points = copy.data();
    CHECK (*assets.mesh ("body.obj") == *first);
    auto moved = corners;
    moved.back() = 1e-4;
    supplier.asset.points = moved.data();
    const auto second = assets.mesh ("body.obj");
    CHECK (*second != *first);
    CHECK ((*first)->points.back().z() == 0.0);
    CHECK ((*second)->points.back().z() == 1e-4);
    supplier.asset = gridOf (relief, 2, 3);
    const auto picture = assets.image ("a");
    CHECK (*assets.image ("a") == *picture);
    CHECK (*assets.table ("a") != *picture);
}
