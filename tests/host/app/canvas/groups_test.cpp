// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of nodes within groups, made with the mouse and the keyboard.
#include "host/app/support/desk_stage.hpp"

#include <host/app/inspector/blocks/depth_ring.hpp>
#include <host/app/inspector/modulation.hpp>
#include <host/app/problems/unfelt.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/plan/rules/unheard.hpp>

#include <bit>
#include <set>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;

namespace
{
struct GroupBench : DeskStage
{
    GroupBench (int width, int height) : DeskStage ("dry_wood.json", width, height) {}

    const Scene& scene() { return canvas.scene(); }
    std::string text() { return writeGraph (graph()); }

    const SceneNode& node (const std::string& name)
    {
        INFO (name);
        const auto found = std::ranges::find (scene().nodes(), name, &SceneNode::name);
        REQUIRE (found != scene().nodes().end());
        return *found;
    }

    bool isInView (juce::Rectangle<float> area)
    {
        const auto& v = canvas.view();
        return canvas.getLocalBounds().toFloat().contains (juce::Rectangle<float> (v.toPixels (area.getTopLeft()), v.toPixels (area.getBottomRight())));
    }

    void click (const std::vector<std::string>& names)
    {
        canvas.select ({});
        for (const auto& name : names)
        {
            const auto at = canvas.view().toPixels (node (name).at + juce::Point<float> (20.0f, Box::header_height / 2));
            const auto on_stage = stage->getLocalPoint (&canvas, at);
            REQUIRE (stage->getComponentAt (on_stage.roundToInt()) == &canvas);
            stage->click (on_stage, juce::ModifierKeys::leftButtonModifier, canvas.selection().empty() ? 0 : juce::ModifierKeys::shiftModifier);
        }
        settle();
        REQUIRE (canvas.selection().size() == names.size());
    }

    /// The nodes that the canvas shows of the graph alone.
    juce::Image picture()
    {
        stage->move ({ 2.0f, 2.0f });   // away from every wire
        settle();
        canvas.select ({});
        return canvas.createComponentSnapshot (canvas.getLocalBounds());
    }

    /// The messages about the graph that the Problems panel gets.
    std::multiset<std::string> problems()
    {
        std::multiset<std::string> all;
        const auto add = [&] (const Messages& messages) {
            for (const auto& m : messages)
                all.insert (m.id + ' ' + m.where + ' ' + m.text);
        };
        add (unfelt (graph(), catalogue()));
        add (plan::unheardNodes (graph(), catalogue()));
        add (compile (graph(), catalogue()).messages);
        return all;
    }

    /// The bits of the force along a stroke.
    std::vector<std::uint64_t> force()
    {
        const auto compiled = compile (graph(), catalogue());
        REQUIRE (compiled.plan != nullptr);
        auto& role = compiled.plan->roles().front();
        std::vector<std::uint64_t> bits;
        for (int i = 0; i < 2000; ++i)
        {
            role.state->reading.position = Vec3 (1e-5 * i, 3e-6 * i, -1e-6 * (i % 300));
            compiled.plan->tick();
            Vec3 sum = Vec3::Zero();
            for (const auto& sink : role.sinks)
                sum += sink.effort (sink.node).force;
            for (const double f : { sum.x(), sum.y(), sum.z() })
                bits.push_back (std::bit_cast<std::uint64_t> (f));
        }
        return bits;
    }
};

bool isSamePicture (const juce::Image& a, const juce::Image& b)
{
    if (a.getBounds() != b.getBounds()) return false;
    for (int y = 0; y < a.getHeight(); ++y)
        for (int x = 0; x < a.getWidth(); ++x)
            if (a.getPixelAt (x, y) != b.getPixelAt (x, y)) return false;
    return true;
}
}   // namespace

TEST_CASE ("groups within groups show their ports at every depth, are no problem, and stay in view", "[app][canvas][groups][undo]")
{
    const auto [width, height] = GENERATE (std::pair { 1368, 656 }, std::pair { 1048, 376 });
    GroupBench w (width, height);
    const bool has_moved_view = GENERATE (false, true);
    const auto text = w.text();
    const auto force = w.force();
    const auto problems = w.problems();
    CHECK (problems.empty());

    struct Level
    {
        std::string text;
        juce::Image outside, inside;
    };
    std::vector<Level> levels;
    std::vector<std::string> members { "board", "drag", "touch", "grain", "grain_felt" };
    const auto begin = w.document.history().position();
    for (std::size_t depth = 1; members.size() > 1; ++depth, members.pop_back())
    {
        INFO ("depth " << depth);
        if (has_moved_view) w.stage->wheel (w.middleOf (w.canvas), -0.2f, false);
        w.click (members);
        w.key ("g");
        const auto name = depth == 1 ? std::string ("group") : "group_" + std::to_string (depth);
        CHECK (w.document.history().position() == begin + depth);
        CHECK (w.isInView (w.node (name).bounds()));
        CHECK (w.canvas.selection() == Selection { w.node (name).id });
        for (const auto& other : w.scene().nodes())
            if (other.name != name) CHECK_FALSE (other.bounds().intersects (w.node (name).bounds()));
        CHECK (w.problems() == problems);
        CHECK (w.force() == force);
        levels.push_back ({ w.text(), w.picture(), {} });

        w.click ({ name });
        w.key ("return");
        REQUIRE (w.canvas.patch() == name);
        CHECK (w.scene().nodes().size() == members.size());
        CHECK (w.canvas.view().zoom >= View::readable);
        for (const auto& n : w.scene().nodes())
            CHECK (w.isInView (n.bounds()));
        // Each port of the node outside is a label inside, and none is missing.
        const auto* inside = w.graph().find (name);
        REQUIRE (inside != nullptr);
        CHECK (w.scene().exposed().size() == inside->expose.inputs.size() + inside->expose.outputs.size() + inside->expose.params.size());
        CHECK (inside->expose.inputs.size() >= 1);
        CHECK (inside->expose.outputs.size() >= 1);
        for (const auto& e : w.scene().exposed())
        {
            INFO (e.name);
            CHECK (w.isInView (e.label));
            CHECK (e.quantity != Quantity::any);
            for (const auto& n : w.scene().nodes())
                CHECK_FALSE (n.bounds().intersects (e.label));
        }
        levels.back().inside = w.picture();
    }
    REQUIRE (levels.size() == 4);

    // Undo from the innermost group leads out of each, and to the same text; redo to the same pictures.
    for (std::size_t i = levels.size(); i-- > 0;)
    {
        w.key ("ctrl + z");
        CHECK (w.text() == (i == 0 ? text : levels[i - 1].text));
        CHECK (w.canvas.breadcrumbs().size() <= i);
        CHECK (w.problems() == problems);
        CHECK (w.force() == force);
    }
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
        w.key ("ctrl + y");
        INFO ("redo " << i);
        CHECK (w.text() == levels[i].text);
        CHECK (w.force() == force);
        const auto name = i == 0 ? std::string ("group") : "group_" + std::to_string (i + 1);
        CHECK (w.isInView (w.node (name).bounds()));
        w.click ({ name });
        w.key ("return");
        CHECK (isSamePicture (w.picture(), levels[i].inside));
    }

    // Ungrouped one by one, the wires are what they were.
    for (std::size_t i = levels.size(); i-- > 0;)
    {
        w.key ("u");
        w.key ("shift + g");
        CHECK (w.force() == force);
        CHECK (w.problems() == problems);
    }
    CHECK (w.graph().graphs.empty());
}

TEST_CASE ("a group of a modulated node shows the depths as the node did, and feels the same", "[app][canvas][groups][modulation]")
{
    GroupBench w (1368, 656);
    w.canvas.commands().addModulatorOf ("roughness", "signal.lfo");
    const auto force = w.force();
    const auto depths = [&] (const std::string& path) {
        std::vector<juce::String> all;
        for (const auto& m : modulationsAt (w.graph(), path, catalogue()))
            all.push_back (textOf (m));
        return all;
    };
    const auto mu = depths ("drag.mu"), amplitude = depths ("grain.amplitude");
    REQUIRE (mu.size() == 1);
    REQUIRE (amplitude.size() == 1);
    const auto shown = [&] (const std::string& node, const char* param) {
        const auto* socket = w.node (node).box.find (Role::param, param);
        return socket == nullptr ? std::string() : socket->value + ' ' + socket->depth;
    };
    const auto on_node = shown ("drag", "mu");
    w.canvas.select ({ w.node ("drag").id, w.node ("grain").id });
    w.canvas.commands().groupSelection();
    OnStage::settle();
    CHECK (shown ("group", "mu") == on_node);
    CHECK (depths ("group/drag.mu") == mu);
    CHECK (depths ("group/grain.amplitude") == amplitude);
    CHECK (w.force() == force);

    w.canvas.commands().enterSelection();
    REQUIRE (w.canvas.patch() == "group");
    w.canvas.select ({ w.node ("drag").id });
    OnStage::settle();
    const auto* ring = dynamic_cast<DepthRing*> (w.titled (juce::String ("Depth of mu by ") + modulationsAt (w.graph(), "group/drag.mu", catalogue())[0].from));
    REQUIRE (ring != nullptr);
    CHECK (textOf (ring->shown()) == mu[0]);
}

TEST_CASE ("undo and redo go to the patch that they change, and select what has changed", "[app][canvas][groups][undo]")
{
    GroupBench w (1280, 720);
    w.click ({ "grain", "grain_felt", "drag" });
    w.key ("g");
    REQUIRE (w.graph().graphs.size() == 1);
    const auto inner = w.graph().graphs.front().first;
    const auto group = std::ranges::find (w.graph().root.nodes, "graph:" + inner, &graph::Node::type)->name;
    const auto outside = [&] {
        w.canvas.leaveTo (0);
        w.canvas.select ({});
        REQUIRE (w.canvas.patch().empty());
    };
    const auto selected = [&] {
        std::set<std::string> names;
        for (const auto id : w.canvas.selection())
            if (const auto* n = w.scene().find (id))
                names.insert (n->name);
            else if (w.scene().findWire (id) != nullptr)
                names.insert ("a wire");
        return names;
    };
    w.canvas.enter (w.node (group));
    struct Edit
    {
        graph::Command command;
        std::set<std::string> undone, redone;   // what is selected after it
    };
    auto delayed = w.graph().find (inner)->wires.front();
    delayed.delay = 1;
    const std::vector<Edit> edits {
        { graph::SetParam { inner, "drag", "mu", Json (0.2) }, { "drag" }, { "drag" } },
        { graph::RenameNode { inner, "grain", "bark" }, { "grain" }, { "bark" } },
        { graph::SetNodeKey { inner, "drag", "bypass", Json (true) }, { "drag" }, { "drag" } },
        { graph::SetHeader { .patch = inner, .ui = Json { { "notes", Json::array() } } }, {}, {} },
        { graph::ChangeWire { inner, delayed.id, delayed }, { "a wire" }, { "a wire" } },
        { graph::RemoveNode { inner, "drag" }, { "drag" }, {} },
    };
    for (const auto& e : edits)
    {
        INFO (graph::nameOf (e.command));
        REQUIRE (w.document.perform (e.command));
        outside();
        w.document.undo();
        CHECK (w.canvas.patch() == inner);
        CHECK (std::ranges::includes (selected(), e.undone));
        CHECK (selected().empty() == e.undone.empty());
        for (const auto& n : w.scene().nodes())
            if (e.undone.contains (n.name)) CHECK (w.isInView (n.bounds()));
        outside();
        w.document.redo();
        CHECK (w.canvas.patch() == inner);
        CHECK (std::ranges::includes (selected(), e.redone));
        CHECK (selected().empty() == e.redone.empty());
        w.document.undo();
    }

    // The other way: the group is shown, and what is undone was done around it.
    outside();
    const auto note = setNotes (w.graph(), {}, { Note { { 0.0f, 0.0f, 90.0f, 60.0f }, "bark", {} } }, "add note");
    for (const auto& command : { graph::Command (graph::SetParam { "", "touch", "window", Json ("0.3 mm") }), note })
    {
        REQUIRE (w.document.perform (command));
        w.canvas.enter (w.node (group));
        REQUIRE (w.canvas.patch() == inner);
        w.document.undo();
        CHECK (w.canvas.patch().empty());
    }

    // What no patch shows leaves the canvas where it is, and so does a step in the patch that is shown.
    w.canvas.enter (w.node (group));
    w.canvas.select ({ w.node ("drag").id });
    const auto other = w.graph().controls.front();
    auto turned = other;
    turned.value = other.value > 0.5 ? 0.1 : 0.9;
    const auto snapshots = graph::SetHeader { .ui = Json { { "snapshots", Json::array() } } };
    for (const auto& command : { graph::Command (graph::ChangeControl { other.id, turned }), graph::Command (snapshots),
                                 graph::Command (graph::SetParam { inner, "grain", "spatial_frequency", Json ("900 1/m") }) })
    {
        INFO (graph::nameOf (command));
        REQUIRE (w.document.perform (command));
        w.document.undo();
        CHECK (w.canvas.patch() == inner);
        CHECK (selected() == std::set<std::string> { "drag" });
    }
}

TEST_CASE ("ungrouping selects the nodes that it has added, also where other nodes use the subgraph", "[app][canvas][groups]")
{
    GroupBench w (1368, 656);
    w.canvas.select ({ w.node ("drag").id, w.node ("touch").id });
    w.canvas.commands().groupSelection();
    const auto is_group = [] (const SceneNode& n) { return n.face->kind == Face::Kind::subgraph; };
    const auto group = std::ranges::find_if (w.scene().nodes(), is_group)->id;
    for (const bool is_shared : { true, false })
    {
        if (is_shared)
        {
            w.canvas.select ({ group });
            w.canvas.commands().duplicateSelection();
        }
        std::set<graph::Id> before;
        for (const auto& n : w.scene().nodes())
            before.insert (n.id);
        w.canvas.select ({ group });
        w.canvas.commands().expandSelection();
        std::set<graph::Id> added;
        for (const auto& n : w.scene().nodes())
            if (! before.contains (n.id)) added.insert (n.id);
        INFO ((is_shared ? "shared" : "its own"));
        CHECK (added.size() == 2);
        CHECK (std::ranges::equal (w.canvas.selection(), added));
        w.document.undo();
        if (is_shared) w.document.undo();
    }
}
