// SPDX-License-Identifier: GPL-3.0-or-later
// A graph with a large mesh is loaded on another thread.
#include "host/app/support/window_rig.hpp"

#include "support/waiting.hpp"

#include <host/app/run/asset_load.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>

#include <string>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

namespace
{
/// A graph with a bumpy plate of 2 n n triangles. Its file is large.
void writePlate (const TemporaryFolder& folder, int n)
{
    std::string mesh;
    for (int line = 0; line < 20'000; ++line)
        mesh += "# " + std::string (60, '-') + "\n";
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            mesh += "v " + std::to_string (0.1 * i / n) + " " + std::to_string (0.1 * j / n) + " " + std::to_string (1e-3 * ((i + j) % 3)) + "\n";
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const int a = j * (n + 1) + i + 1;
            mesh += "f " + std::to_string (a) + " " + std::to_string (a + 1) + " " + std::to_string (a + n + 2) + "\n";
            mesh += "f " + std::to_string (a) + " " + std::to_string (a + n + 2) + " " + std::to_string (a + n + 1) + "\n";
        }
    folder.write ("plate.obj", mesh);
    folder.write ("plate.json", R"({ "format": "tactus-graph", "version": 1, "name": "Plate", "rate_hz": 1000, "devices": { "stylus": { "driver": "sim" } },
        "nodes": { "hand": { "type": "device.position", "role": "stylus" },
            "plate": { "type": "deform.surface", "settings": { "surface": { "mesh": "plate.obj",
                "curves": [[{ "power": [300, 1] }, { "power": [300, 1] }, { "power": [300, 1] }]],
                "mu": 0.1 }, "search_ticks": 8 } },
            "motor": { "type": "device.force", "role": "stylus" } },
        "wires": ["hand.position -> plate.position", "plate.force -> motor.force"] })");
}

template <typename F>
bool until (F&& isSo)
{
    return tactus::test::eventually ({}, [&] {
        WindowRig::settle (5);
        return isSo();
    });
}
}   // namespace

TEST_CASE ("a graph with a large mesh opens when its files are there, and the open graph goes on until then", "[app][files]")
{
    const TemporaryFolder folder;
    writePlate (folder, 50);
    WindowRig w ("dry_wood.json", 1280, 720, false);
    REQUIRE (until ([&] { return w.view->run().isRunning(); }));
    w.view->open (folder / "plate.json");
    REQUIRE (w.view->asked().isOpen());
    CHECK (w.view->asked().title() == "Opening Plate");
    CHECK (w.graph().name == "Dry wood");
    CHECK (w.view->run().isRunning());
    REQUIRE (until ([&] { return ! w.view->asked().isOpen(); }));
    CHECK (w.graph().name == "Plate");
    CHECK (w.view->document().file() == folder / "plate.json");
    CHECK (until ([&] { return w.view->run().isRunning(); }));
}

TEST_CASE ("a user who cancels the loading of a large mesh keeps the open graph", "[app][files]")
{
    const TemporaryFolder folder;
    writePlate (folder, 50);
    WindowRig w ("dry_wood.json");
    w.view->open (folder / "plate.json");
    REQUIRE (w.view->asked().isOpen());
    w.view->asked().cancel();
    WindowRig::settle (100);
    CHECK_FALSE (w.view->asked().isOpen());
    CHECK (w.graph().name == "Dry wood");
    w.view->open (folder / "plate.json");   // and can open it later
    REQUIRE (until ([&] { return w.graph().name == "Plate"; }));
}

TEST_CASE ("what was loaded on another thread serves the next compilation, and its memory is given back", "[app][files]")
{
    const TemporaryFolder folder;
    writePlate (folder, 50);
    const auto graph = loadGraph (folder / "plate.json").graph;
    CHECK (assetBytes (graph) > 1e6);
    AssetLoad load;
    load.start (graph, catalogue());
    std::shared_ptr<const AssetLoad::Loaded> loaded;
    REQUIRE (tactus::test::eventually ([&] { return (loaded = load.take()) != nullptr; }));
    CHECK_FALSE (load.isRunning());
    REQUIRE (loaded->compiled.plan);

    FileAssets assets;
    const auto mesh = [&] { return *assets.mesh ((folder / "plate.obj").string()); };
    assets.adopt (loaded->assets);
    const auto shared = mesh();
    CHECK (shared.use_count() > 1);   // the plan of the other thread uses the same one
    const auto compiled = compile (graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } });
    REQUIRE (compiled.plan);
    CHECK (compiled.messages.size() == loaded->compiled.messages.size());
    load.start (graph, catalogue());
    load.cancel();
    CHECK (load.take() == nullptr);
}
