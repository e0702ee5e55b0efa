// SPDX-License-Identifier: GPL-3.0-or-later
// One search finds nodes: to go to, to add, and to wire.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

namespace
{
/// A window in which nodes are searched.
struct SearchDesk
{
    WindowRig w;

    explicit SearchDesk (const std::string& preset) : w (preset) {}

    Canvas& canvas() { return w.view->canvas(); }
    graph::Id id (const std::string& node) { return w.graph().root.find (node)->id; }

    const SceneNode& shown (const std::string& node)
    {
        const auto& nodes = canvas().scene().nodes();
        const auto found = std::ranges::find (nodes, node, &SceneNode::name);
        REQUIRE (found != nodes.end());
        return *found;
    }

    /// Whether all of a node is on the canvas as it is shown.
    bool isInView (const std::string& node)
    {
        const auto b = shown (node).bounds();
        const auto& view = canvas().view();
        return canvas().getLocalBounds().toFloat().contains (juce::Rectangle<float> (view.toPixels (b.getTopLeft()), view.toPixels (b.getBottomRight())));
    }

    /// What the list has for these words after this key.
    std::vector<PaletteEntry> listed (const char* key, const char* words)
    {
        w.key (key);
        auto* palette = dynamic_cast<Palette*> (w.titled ("Palette"));
        REQUIRE (palette != nullptr);
        w.stage->type (words);
        WindowRig::settle();
        return palette->entries();
    }

    void choose (const char* key, const char* words)
    {
        INFO (key << ' ' << words);
        static_cast<void> (listed (key, words));
        w.key ("return");
        WindowRig::settle();
    }

    bool hasWire (const std::string& text) { return std::ranges::count (canvas().scene().wires(), text, &SceneWire::text) > 0; }
};

/// A graph with a hand and a node of each kind of friction.
std::filesystem::path allFrictions (const TemporaryFolder& folder)
{
    graph::Graph g;
    g.name = "frictions";
    const auto add = [&] (const std::string& name, const std::string_view type) {
        graph::Node n;
        n.id = static_cast<graph::Id> (g.root.nodes.size() + 1);
        n.name = name;
        n.type = std::string (type);
        g.root.nodes.insert (g.root.nodes.begin(), std::move (n));   // not in the order of the catalogue
    };
    add ("hand", "device.position");
    for (int i = 0; const auto& type : catalogue())
        if (type.info.id.starts_with ("friction.")) add ("n" + std::to_string (i++), type.info.id);
    REQUIRE (g.root.nodes.size() > 2);
    auto file = folder / "frictions.json";
    REQUIRE (saveGraph (g, file).has_value());
    return file;
}

/// The types of friction in a list, each once, in the order of the list.
std::vector<std::string> frictionsIn (const std::vector<PaletteEntry>& entries)
{
    std::vector<std::string> types;
    for (const auto& e : entries)
    {
        const auto type = e.type.substr (0, e.type.find (' '));
        if (type.starts_with ("friction.") && std::ranges::count (types, type) == 0) types.push_back (type);
    }
    return types;
}
}   // namespace

TEST_CASE ("Ctrl+K finds a node by its name and by its type, in a group, too, and shows it", "[app][keyboard]")
{
    SearchDesk d ("dry_wood.json");
    for (const auto& [words, node] : { std::pair { "drag", "drag" }, std::pair { "elasto-plastic", "drag" }, std::pair { "motor", "motor" } })
    {
        INFO (words);
        d.canvas().select ({});
        d.canvas().view().origin += juce::Point<float> (5000.0f, 0.0f);
        REQUIRE_FALSE (d.isInView (node));
        d.choose ("ctrl + k", words);
        CHECK (d.canvas().selection() == Selection { d.id (node) });
        CHECK (d.isInView (node));
        CHECK (WindowRig::focused() == &d.canvas());
    }
    d.canvas().select ({ d.id ("grain"), d.id ("grain_felt") });
    d.w.key ("g");
    REQUIRE (d.w.graph().graphs.size() == 1);
    const auto& [group, inside] = d.w.graph().graphs.front();
    const auto grain = inside.find ("grain")->id;
    d.canvas().select ({});
    d.choose ("F3", "grain");
    CHECK (d.canvas().patch() == group);
    CHECK (d.canvas().selection() == Selection { grain });
    CHECK (d.isInView ("grain"));
    d.choose ("F3", "board");   // and back
    CHECK (d.canvas().patch().empty());
    CHECK (d.canvas().selection() == Selection { d.id ("board") });
}

TEST_CASE ("the same words find the same nodes in the same order, to add, to wire and to go to", "[app][keyboard]")
{
    const TemporaryFolder folder;
    SearchDesk d (allFrictions (folder).string());
    for (const char* words : { "fric", "friction", "stick", "elasto friction" })
    {
        INFO (words);
        const auto to_add = frictionsIn (d.listed ("spacebar", words));
        d.w.key ("escape");
        CHECK (to_add.size() > (words == std::string ("elasto friction") ? 0u : 1u));
        CHECK (frictionsIn (d.listed ("ctrl + k", words)) == to_add);
        d.w.key ("escape");
        d.canvas().select ({ d.id ("hand") });
        CHECK (frictionsIn (d.listed ("w", words)) == to_add);
        d.w.key ("escape");
    }
}

TEST_CASE ("W wires into the selected node, too, and finds names before descriptions", "[app][keyboard]")
{
    SearchDesk d ("dry_wood.json");
    d.canvas().select ({ d.id ("motor") });
    d.choose ("w", "grain force");
    CHECK (d.hasWire ("grain.force -> motor.force"));
    d.w.key ("ctrl + z");
    REQUIRE_FALSE (d.hasWire ("grain.force -> motor.force"));

    const auto count = d.w.graph().root.nodes.size();
    d.canvas().select ({ d.id ("motor") });
    d.choose ("w", "torque new");   // a new node before the motor
    d.w.stage->type ("edge");
    WindowRig::settle();
    d.w.key ("return");
    WindowRig::settle();
    REQUIRE (d.w.graph().root.nodes.size() == count + 1);
    const auto& added = d.w.graph().root.nodes.back();
    CHECK (added.type == "cut.edge");
    CHECK (d.hasWire (added.name + ".torque -> motor.torque"));
    CHECK (d.shown (added.name).bounds().getRight() < d.shown ("motor").bounds().getX());

    d.canvas().select ({ d.id ("board") });
    bool was_described = false;
    int named = 0;
    for (const auto& e : d.listed ("w", "gain"))
        if (e.name.empty())   // a wire between nodes that are there
        {
            const bool is_named = e.type.find ("gain") != std::string::npos;
            CHECK_FALSE ((was_described && is_named));
            was_described = was_described || ! is_named;
            named += static_cast<int> (is_named);
        }
    CHECK (named > 0);
    d.w.key ("escape");

    d.canvas().select ({});
    d.w.key ("w");
    CHECK (d.w.titled ("Palette") == nullptr);
    const auto texts = tactus::host::test::readTexts (*d.w.view);
    CHECK (std::ranges::any_of (texts, [] (const auto& t) { return t.text.contains ("Select one node first"); }));
}

TEST_CASE ("a wire that is dropped from an input offers what the input is made for first", "[app][canvas]")
{
    SearchDesk d ("dry_wood.json");
    for (const auto& [port, type, wire] :
         { std::tuple { "normal_force", "cut.blade", "resistance" }, std::tuple { "position", "device.position", "position" } })
    {
        INFO (port);
        const auto* socket = d.shown ("drag").box.find (Role::input, port);
        REQUIRE (socket != nullptr);
        auto to = d.canvas().view().toPixels (d.shown ("drag").bounds().getCentre());
        const auto isTaken = [&, &scene = d.canvas().scene()] {
            const auto at = d.canvas().view().toCanvas (to);
            return scene.nodeAt (at) != nullptr || scene.wireAt (at, 12.0f) != nullptr;
        };
        while (isTaken())
            to.y += 10.0f;
        REQUIRE (d.canvas().getLocalBounds().toFloat().contains (to));
        d.w.key ("spacebar");   // what was chosen before is no better
        d.w.stage->type ("lfo");
        WindowRig::settle();
        d.w.key ("return");
        const auto count = d.w.graph().root.nodes.size();
        const auto from = d.canvas().view().toPixels (d.shown ("drag").placeOf (*d.shown ("drag").box.find (Role::input, port)));
        d.w.stage->drag (d.w.stage->getLocalPoint (&d.canvas(), from), d.w.stage->getLocalPoint (&d.canvas(), to));
        WindowRig::settle();
        auto* palette = dynamic_cast<Palette*> (d.w.titled ("Palette"));
        REQUIRE (palette != nullptr);
        const auto texts = tactus::host::test::readTexts (*palette);
        CHECK (std::ranges::any_of (texts, [from = "Connect " + juce::String (port) + " from"] (const auto& t) { return t.text == from; }));
        CHECK (palette->entries()[0].name == "Fits best");
        CHECK (std::ranges::count (palette->entries(), std::string (type), &PaletteEntry::type) == 1);   // not listed again

        if (std::string (port) == "position")   // there are such nodes, but they make forces
        {
            d.w.stage->type ("hunt");
            WindowRig::settle();
            REQUIRE (palette->entries().size() == 1);
            CHECK (palette->entries()[0].isTitle());
            CHECK (palette->entries()[0].name.ends_with ("has no port for this wire"));
            CHECK (tactus::host::test::cutOff (tactus::host::test::readTexts (*palette), palette->getLocalBounds().toFloat()).isEmpty());
            d.w.key ("return");
            CHECK (palette->isVisible());
            CHECK (d.w.graph().root.nodes.size() == count);
            for (int i = 0; i < 4; ++i)
                d.w.key ("backspace");
            WindowRig::settle();
        }
        d.w.key ("return");
        WindowRig::settle();
        REQUIRE (d.w.graph().root.nodes.size() == count + 1);
        const auto& added = d.w.graph().root.nodes.back();
        CHECK (added.type == type);
        CHECK (d.hasWire (added.name + "." + wire + " -> drag." + port));
    }
}

TEST_CASE ("Ctrl+K finds what moves the tool: the mouse, a gesture, and the devices of a role", "[app][keyboard][hand]")
{
    SearchDesk d ("dry_wood.json");
    const auto& run = d.w.view->run();
    d.choose ("ctrl + k", "hand mouse");
    CHECK (run.hand() == LiveRun::Hand::pointer());
    d.choose ("ctrl + k", "gesture circle");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::path);
    CHECK (run.hand().path == "circle");
    auto* list = dynamic_cast<juce::ComboBox*> (d.w.titled ("What moves the tool"));
    REQUIRE (list != nullptr);
    CHECK (list->getText() == "Gesture: circle");   // as if it had been chosen there
    d.choose ("ctrl + k", "hand its own device");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::described);

    const auto devices = d.listed ("ctrl + k", "device of stylus");
    d.w.key ("escape");
    std::vector<std::string> names;
    for (const auto& e : devices)
        if (e.name.starts_with ("Device of ")) names.push_back (e.name);
    REQUIRE (names.size() > 2);   // as in the graph, a simulated tool, the gestures ...
    const auto before = d.w.view->document().history().position();
    const auto simulated = std::ranges::find_if (names, [] (const std::string& n) { return n.find ("simulated") != std::string::npos; });
    REQUIRE (simulated != names.end());
    d.choose ("ctrl + k", simulated->c_str());
    CHECK (d.w.view->document().history().position() == before + 1);   // the choice is a step
}
