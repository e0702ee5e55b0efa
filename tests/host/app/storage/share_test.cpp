// SPDX-License-Identifier: GPL-3.0-or-later
// Presets that are shared as one file. tests/host/cli/pack_test.py makes files that do harm.
#include "host/app/support/desk_rig.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/with_limits.hpp"

#include <host/app/storage/share.hpp>
#include <host/app/window/graph_commands.hpp>
#include <host/base/assets/file_assets.hpp>
#include <host/base/files/preset_pack.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;

namespace
{
constexpr const char* tetrahedron = "v 0 0 0\nv 0.02 0 0\nv 0 0.02 0\nv 0 0 0.02\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// The graph of the liver with this mesh.
graph::Graph liverWith (const std::filesystem::path& mesh)
{
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/liver.json").graph;
    for (auto& n : g.root.nodes)
        if (n.settings.contains ("surface")) n.settings["surface"]["mesh"] = mesh.string();
    return g;
}

struct Tip final : public Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return { .position = { 0.0, 0.0, -1e-4 * static_cast<double> (++ticks % 50) } }; }
    void write (const Effort& e) noexcept override { efforts.push_back (e.force); }

    std::vector<Vec3> efforts;
    int ticks = 0;
};

std::vector<Vec3> played (const graph::Graph& g)
{
    FileAssets assets;
    auto compiled = compile (g, catalogue(), { .assets = &assets });
    REQUIRE (compiled.plan);
    CHECK (std::ranges::none_of (compiled.messages, [] (const Message& m) { return m.severity == Message::Severity::error; }));
    Engine engine (std::move (compiled.plan));
    std::map<std::string, Tip> tips;
    for (const auto& [role, device] : g.devices)
        engine.attach (role, tips[role]);
    for (int i = 0; i < 500; ++i)
        engine.tick();
    return tips.begin()->second.efforts;
}
}   // namespace

TEST_CASE ("a shared preset has its files, and plays the same bits elsewhere", "[app][share]")
{
    const TemporaryFolder folder;
    for (const char* name : { "dry_wood", "heartbeat", "liver", "pebbled_leather", "zip" })
    {
        INFO (name);
        const auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/" + std::string (name) + ".json").graph;
        const auto file = folder / (std::string (name) + ".tactus");
        const auto shared = sharePreset (g, file);
        INFO ((shared ? "" : shared.error().text));
        REQUIRE (shared);
        const auto first = readFile (file);
        REQUIRE (sharePreset (g, file));
        CHECK (*readFile (file) == *first);   // the same bytes each time
        const auto unpacked = unpackPreset (file);
        REQUIRE (unpacked);
        const auto again = loadGraph (*unpacked);
        CHECK (again.messages.empty());
        CHECK (again.graph.name == g.name);
        CHECK (played (again.graph) == played (g));
    }
}

TEST_CASE ("a graph that names a file elsewhere is not shared", "[app][share]")
{
    const TemporaryFolder folder;
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/heartbeat.json").graph;
    folder.write ("secret.haptic", "{}");
    for (auto& n : g.root.nodes)
        if (n.type == "signal.clip") n.settings["clip"] = (folder / "secret.haptic").string();
    const auto shared = sharePreset (g, folder / "x.tactus");
    REQUIRE_FALSE (shared);
    CHECK (shared.error().id == "share/outside");
    CHECK_FALSE (std::filesystem::exists (folder / "x.tactus"));
}

TEST_CASE ("a file in another folder goes along if the person agrees, also from a graph that has no folder yet", "[app][share]")
{
    const TemporaryFolder folder, others;
    const auto mesh = std::filesystem::canonical (others.path()) / "shape.obj";
    others.write ("shape.obj", tetrahedron);
    auto g = liverWith (mesh);
    if (GENERATE (false, true)) g.folder.clear();
    const auto before = writeGraph (g);
    CHECK (filesElsewhere (g) == std::vector { mesh });
    CHECK_FALSE (sharePreset (g, folder / "x.tactus"));
    CHECK_FALSE (sharePreset (g, folder / "x.tactus", { mesh.parent_path() / "other.obj" }));
    REQUIRE (sharePreset (g, folder / "x.tactus", { mesh }));
    CHECK (writeGraph (g) == before);

    const auto unpacked = unpackPreset (folder / "x.tactus");
    REQUIRE (unpacked);
    const auto again = loadGraph (*unpacked);
    CHECK (again.messages.empty());
    CHECK (filesElsewhere (again.graph).empty());
    CHECK (*readFile (std::filesystem::path (again.graph.folder) / "assets/shape.obj") == tetrahedron);
    CHECK (played (again.graph) == played (g));
}

TEST_CASE ("of other folders, a graph offers only files of the kind that it reads there, and no hidden ones", "[app][share]")
{
    const TemporaryFolder others;
    const auto place = std::filesystem::canonical (others.path());
    std::filesystem::create_directories (place / ".keys");
    for (const char* name : { "shape.txt", ".shape.obj", ".keys/shape.obj" })
    {
        INFO (name);
        others.write (name, tetrahedron);
        CHECK (filesElsewhere (liverWith (place / name)).empty());
        CHECK_FALSE (sharePreset (liverWith (place / name), place / "x.tactus", { place / name }));
    }
    std::filesystem::create_symlink (place / ".keys/shape.obj", place / "link.obj");
    CHECK (filesElsewhere (liverWith (place / "link.obj")).empty());
    CHECK (filesElsewhere (liverWith (place / "gone.obj")).empty());
}

TEST_CASE ("Share asks about files in other folders, and a failure is a message that the user closes", "[app][share]")
{
    TemporaryFolder others;
    const auto mesh = std::filesystem::canonical (others.path()) / "shape.obj";
    others.write ("shape.obj", tetrahedron);
    DeskRig r (liverWith (mesh));
    r.chosen = others / "x.tactus";
    shareAs (r.desk);
    REQUIRE (r.question.isOpen());
    CHECK (r.question.text().contains (mesh.string()));
    SECTION ("agreed")
    {
        r.question.answer (0);
        CHECK_FALSE (r.question.isOpen());
        CHECK (r.said.contains ("x.tactus"));
        CHECK (std::filesystem::exists (r.chosen));
    }
    SECTION ("refused")
    {
        r.question.cancel();
        CHECK_FALSE (std::filesystem::exists (r.chosen));
    }
    SECTION ("the graph names another file by then")
    {
        others.write ("later.obj", tetrahedron);
        r.document.open (liverWith (mesh.parent_path() / "later.obj"), {}, "open");
        r.question.answer (0);
        REQUIRE (r.question.isOpen());
        CHECK (r.question.title() == "The graph was not shared");
        CHECK (r.question.text().contains ("later.obj"));
        CHECK_FALSE (std::filesystem::exists (r.chosen));
    }
}

TEST_CASE ("Share does not ask about more files of other folders than it shows", "[app][share]")
{
    TemporaryFolder others;
    graph::Graph g;
    for (std::size_t i = 0; i <= Question::most_listed; ++i)
    {
        const auto name = "clip" + std::to_string (i);
        std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic", others / (name + ".haptic"));
        auto clip = tactus::test::Sketch::makeNode (name, "signal.clip");
        clip.settings["clip"] = (others / (name + ".haptic")).string();
        g.root.nodes.push_back (clip);
    }
    DeskRig r (g);
    r.chosen = others / "x.tactus";
    shareAs (r.desk);
    CHECK (r.question.title() == "The graph was not shared");
    CHECK (r.question.text().contains ("21 files"));
    r.question.answer (0);
    CHECK_FALSE (std::filesystem::exists (r.chosen));
    g.root.nodes.pop_back();
    r.document.open (g, {}, "one less");
    shareAs (r.desk);
    CHECK (r.question.title() == "Share these files, too?");
}

TEST_CASE ("what no program would open again is not shared", "[app][share]")
{
    const TemporaryFolder folder;
    const auto file = folder / "x.tactus";
    const auto refused = [&] (const graph::Graph& g) {
        const auto shared = sharePreset (g, file);
        REQUIRE_FALSE (shared);
        CHECK_FALSE (std::filesystem::exists (file));
        CHECK (shared.error().where == file.string());
        CHECK_FALSE (shared.error().remedy.empty());
        return shared.error().id;
    };
    const auto beat = loadGraph (TACTUS_SOURCE_DIR "/graphs/heartbeat.json").graph;
    for (const auto* limit : { "reading=2kB", "file=1kB", "files=1" })   // the clip of 937 bytes is read twice
    {
        const WithLimits limits (limit);
        CAPTURE (limit);
        CHECK (refused (beat).starts_with ("pack/too_"));
    }
    std::filesystem::create_directories (folder / "assets");
    std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/assets/heartbeat.haptic", folder / "assets/beat|1.haptic");
    std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/heartbeat.json", folder / "beat.json");
    auto g = loadGraph (folder / "beat.json").graph;
    for (auto& n : g.root.nodes)
        if (n.type == "signal.clip") n.settings["clip"] = "assets/beat|1.haptic";
    CHECK (refused (g) == "share/name");
}
