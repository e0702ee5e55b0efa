// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "support/temporary_folder.hpp"

#include <host/app/layers/mixer.hpp>
#include <host/app/model/clip_graph.hpp>
#include <host/base/assets/file_assets.hpp>
#include <host/base/files/clip_io.hpp>
#include <tactus/plan/compile.hpp>

#include <catch2/catch.hpp>

#include <fstream>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
namespace fs = std::filesystem;

namespace
{
const fs::path heart = fs::path (TACTUS_SOURCE_DIR) / "graphs" / "assets" / "heartbeat.haptic";

void dropOn (Canvas& canvas, const fs::path& file, juce::Point<float> at)
{
    const juce::StringArray files { juce::String (file.string()) };
    REQUIRE (canvas.isInterestedInFileDrag (files));
    canvas.fileDragEnter (files, juce::roundToInt (at.x), juce::roundToInt (at.y));
    canvas.filesDropped (files, juce::roundToInt (at.x), juce::roundToInt (at.y));
}

const graph::Node* clipIn (const graph::Graph& g)
{
    for (const auto& n : g.root.nodes)
        if (n.type == clip_type) return &n;
    return nullptr;
}

bool compilesWithFiles (const graph::Graph& g)
{
    static host::FileAssets assets;
    const auto compiled = compile (g, catalogue(), { .assets = &assets });
    for (const auto& m : compiled.messages)
        UNSCOPED_INFO (m.where << ": " << m.text);
    return compiled.plan != nullptr && ! hasErrors (compiled.messages);
}
}   // namespace

TEST_CASE ("a clip dropped on the canvas becomes a node that plays it, in one step", "[app][canvas][clips]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.text();
    dropOn (*rig.canvas, heart, rig.nowhere());
    const auto* node = clipIn (rig.graph());
    REQUIRE (node != nullptr);
    CHECK (node->settings.at ("clip") == Json ("assets/heartbeat.haptic"));   // relative to the folder of the graph
    CHECK (node->params.at ("drive") == Json ("run"));
    CHECK (compilesWithFiles (rig.graph()));
    rig.hand().key ("ctrl + z");
    CHECK (rig.text() == before);
}

TEST_CASE ("a clip dropped on a clip node replaces its file, and a clip dropped on another node changes nothing", "[app][canvas][clips]")
{
    CanvasRig rig { CanvasRig::preset ("zip") };
    dropOn (*rig.canvas, heart, rig.title ("teeth"));
    CHECK (clipIn (rig.graph())->settings.at ("clip") == Json ("assets/heartbeat.haptic"));
    CHECK (clipIn (rig.graph())->params.at ("drive") == Json ("position"));   // the other parameters stay
    const auto before = rig.text();
    dropOn (*rig.canvas, heart, rig.title ("motor"));
    CHECK (rig.text() == before);
    CHECK (rig.hint.contains ("does not play clips"));
}

TEST_CASE ("the canvas passes on a dropped graph, and refuses other files", "[app][canvas][clips]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    fs::path opened;
    rig.canvas->onGraphDropped = [&] (const fs::path& file, juce::Point<float>) { opened = file; };
    const fs::path graph = fs::path (TACTUS_SOURCE_DIR) / "graphs" / "zip.json";
    dropOn (*rig.canvas, graph, rig.nowhere());
    CHECK (opened == graph);
    CHECK_FALSE (rig.canvas->isInterestedInFileDrag ({ "a.txt" }));
    CHECK_FALSE (rig.canvas->isInterestedInFileDrag ({ "a.haptic", "b.haptic" }));
    dropOn (*rig.canvas, graph.parent_path() / "assets" / "zip.json", rig.nowhere());   // a clip of Tactus
    CHECK (clipIn (rig.graph()) != nullptr);
}

TEST_CASE ("the menu of a clip node saves its clip", "[app][canvas][clips]")
{
    CanvasRig rig { CanvasRig::preset ("heartbeat") };
    fs::path saved;
    rig.canvas->onSaveClip = [&] (const fs::path& file) { saved = file; };
    rig.canvas->select ({ rig.node ("beat").id });
    rig.canvas->commands().saveClipOfSelection();
    CHECK (fs::equivalent (saved, heart));
}

TEST_CASE ("a clip becomes a layer of a mixer, which compiles", "[app][layers][clips]")
{
    const auto bell = loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph;
    const auto at = mixersOf (bell).at (0);
    const auto layer = addClipLayer (bell, at, catalogue(), "assets/heartbeat.haptic");
    REQUIRE (layer);
    auto edited = bell;
    REQUIRE (graph::apply (edited, layer->command));
    CHECK (layersOf (*findMixer (edited, at), catalogue()) == 4);
    CHECK (layerNames (*findMixer (edited, at), 4).back() == "clip");
    REQUIRE (wireInto (edited, at, 3) != nullptr);
    CHECK (wireInto (edited, at, 3)->from.node == "clip");
    CHECK (compilesWithFiles (edited));
}

TEST_CASE ("the graph of a clip compiles for every format, and a clip that is not one is refused", "[app][clips]")
{
    TemporaryFolder folder;
    const auto read = loadClip (heart);
    REQUIRE (read);
    for (const auto* name : { "a.haptic", "a.ahap", "a.hjif", "a.json", "a.wav" })
    {
        INFO (name);
        REQUIRE (saveClip (read->clip, folder / name));
        CHECK (isClipFile (folder / name));
        CHECK (compilesWithFiles (graphOfClip (folder / name)));
    }
    std::ofstream (folder / "b.json") << "{}";
    CHECK_FALSE (isClipFile (folder / "b.json"));
}
