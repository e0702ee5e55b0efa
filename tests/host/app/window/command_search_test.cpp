// SPDX-License-Identifier: GPL-3.0-or-later
// The search for commands (Ctrl+K): it finds nodes, what moves the tool, and what a click can do.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <host/app/layers/mixer.hpp>
#include <host/app/storage/snapshots.hpp>
#include <host/app/take/take_panel.hpp>
#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::mentions;
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

    /// True if all of a node is on the canvas as it is shown.
    bool isInView (const std::string& node)
    {
        const auto b = w.node (node).bounds();
        const auto& view = canvas().view();
        return canvas().getLocalBounds().toFloat().contains (juce::Rectangle<float> (view.toPixels (b.getTopLeft()), view.toPixels (b.getBottomRight())));
    }

    /// The entries of the list for these words after this key.
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

TEST_CASE ("Ctrl+K finds the node with exactly this name first in what the canvas shows", "[app][keyboard]")
{
    SearchDesk d ("dry_wood.json");
    graph::Patch inside;
    graph::Node grain;
    grain.name = "grain";
    grain.type = "contact.impact";   // earlier in the list than a texture
    inside.nodes.push_back (grain);
    REQUIRE (d.w.view->document().perform (graph::AddSubgraph { "paper", inside }));
    graph::Node paper;
    paper.name = "paper";
    paper.type = "graph:paper";
    REQUIRE (d.w.view->document().perform (graph::AddNode { "", paper }));
    for (const char* first : { "grain", "paper/grain" })
    {
        const auto listed = d.listed ("ctrl + k", "grain");
        REQUIRE_FALSE (listed.empty());
        CHECK (listed.front().name == first);
        d.w.key ("escape");
        d.choose ("ctrl + k", "paper/grain");   // into the group
    }
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

TEST_CASE ("the search for commands finds what a click can do, wherever it is", "[app][keyboard]")
{
    SearchDesk d ("dry_wood.json");
    auto& w = d.w;
    const auto find = [&] (const char* words) {
        INFO (words);
        d.choose ("ctrl + k", words);
        CHECK (w.titled ("Palette") == nullptr);
    };
    find ("history");
    REQUIRE (w.titled ("History") != nullptr);
    CHECK (WindowRig::focused() == &w.view->canvas());
    find ("select all");
    CHECK (w.view->canvas().selection().size() >= w.graph().root.nodes.size());
    w.key ("z");   // all panels are folded
    find ("take");
    CHECK (w.view->part<TakePanel>().isShowing());
    CHECK (w.view->part<TakePanel>().getHeight() > 100);
    const bool was_dark = themeOf (*w.view).is_dark;
    find ("light theme");
    CHECK (themeOf (*w.view).is_dark != was_dark);
    w.view->canvas().select ({ w.graph().root.find ("drag")->id });
    const auto before = w.graph().controls.size();
    find ("stiffness new control");
    CHECK (w.graph().controls.size() == before + 1);
    w.view->canvas().select ({});
    const auto nodes = w.graph().root.nodes.size();
    find ("roughness modulate lfo");
    CHECK (w.graph().root.nodes.size() == nodes + 1);
    CHECK (w.graph().root.nodes.back().type == "signal.lfo");
}

TEST_CASE ("Ctrl+K finds the snapshots, and the morph between two that are stored", "[app][keyboard]")
{
    SearchDesk d { "dry_wood.json" };
    d.choose ("ctrl + k", "store in snapshot 1");
    d.choose ("ctrl + k", "store in snapshot 2");
    CHECK (hasSnapshot (d.w.graph(), 1));
    CHECK (hasSnapshot (d.w.graph(), 2));
    const auto found = d.listed ("ctrl + k", "morph");
    CHECK (std::ranges::count (found, std::string ("Morph from snapshot 1 to 2"), &PaletteEntry::name) == 1);
    CHECK (std::ranges::count (found, std::string ("Morph from snapshot 1 to 3"), &PaletteEntry::name) == 0);
}

TEST_CASE ("Ctrl+K finds a knob by its name, before what can be done with it, and the arrow keys turn it", "[app][keyboard]")
{
    SearchDesk desk ("dry_wood.json");
    const auto before = desk.w.graph().controls.front();
    const auto entries = desk.listed ("ctrl + k", before.name.c_str());
    REQUIRE (entries.size() > 1);
    CHECK (entries.front().name == before.name);
    desk.w.key ("return");
    WindowRig::settle();
    desk.w.key ("cursor up");
    CHECK (desk.w.graph().controls.front().value == Approx (before.value + 0.01));
}

TEST_CASE ("a preset that Ctrl+K adds takes its layer and its knobs along when Delete removes it", "[app][keyboard][compose]")
{
    SearchDesk desk ("dry_wood.json");
    const auto knobs = desk.w.graph().controls.size();
    desk.choose ("ctrl + k", "add soft pad");
    const auto layers = [&] { return layersOf (*desk.w.graph().root.find ("desk"), catalogue()); };
    REQUIRE (desk.w.graph().root.find ("soft_pad") != nullptr);
    REQUIRE (layers() == 4);
    CHECK (desk.w.graph().controls.size() == knobs + 1);
    desk.canvas().select ({ desk.id ("soft_pad") });
    desk.w.key ("delete");
    WindowRig::settle();
    CHECK (desk.w.graph().root.find ("soft_pad") == nullptr);
    CHECK (layers() == 3);
    CHECK (desk.w.graph().controls.size() == knobs);
}

TEST_CASE ("the key of another search leaves the search for commands, and gets what is typed", "[app][keyboard]")
{
    SearchDesk d { "dry_wood.json" };
    const auto before = writeGraph (d.w.graph());
    static_cast<void> (d.listed ("ctrl + k", "den"));
    d.w.key ("ctrl + f");
    WindowRig::settle();
    d.w.stage->type ("bronze");   // B bypasses a node on the canvas, and N makes a note
    WindowRig::settle();
    const auto* search = dynamic_cast<juce::TextEditor*> (WindowRig::focused());
    REQUIRE (search != nullptr);
    CHECK (search->getText() == "bronze");
    CHECK (writeGraph (d.w.graph()) == before);
}

TEST_CASE ("Quit is in the menu, on a key, and in the search for commands", "[app][keyboard]")
{
    SearchDesk d ("dry_wood.json");
    auto& w = d.w;
    int quits = 0;
    w.view->allowQuit ([&] { ++quits; });
    w.key ("ctrl + q");
    CHECK (quits == 1);
    w.choose (w.middleOf (*w.titled ("Menu")), -1, juce::ModifierKeys::leftButtonModifier);   // the last entry
    CHECK (quits == 2);
    d.choose ("ctrl + k", "quit");
    CHECK (quits == 3);
}

TEST_CASE ("the search for commands finds OSC, and says at which port messages arrive", "[app][keyboard][osc]")
{
    SearchDesk d ("dry_wood.json");
    auto& w = d.w;
    const auto told = [&] {
        d.choose ("ctrl + k", "osc");
        REQUIRE (w.view->asked().isOpen());
        CHECK (w.view->asked().title().contains ("OSC"));
        const auto text = w.view->asked().getDescription();
        w.key ("escape");
        return text;
    };
    CHECK (told().startsWith ("No OSC messages"));
    MainView::StartOptions start { .home = w.home.path(), .safe = true };
    start.osc = OscListen { .port = 0 };
    w.begin (start);
    CHECK (told().contains ("UDP port "));
    CHECK_FALSE (told().contains ("UDP port 0"));
}

TEST_CASE ("a search for commands says nothing about nodes", "[app][small][palette]")
{
    WindowRig w ("dry_wood.json", 640, 360);
    w.key ("ctrl + k");
    auto& palette = *w.titled ("Palette");
    CHECK (mentions (palette, "Search by name"));
    CHECK_FALSE (mentions (palette, "unit"));
    w.stage->type ("zzqq");
    WindowRig::settle();
    CHECK (mentions (palette, "No match"));
    CHECK_FALSE (mentions (palette, "friction"));
}

TEST_CASE ("in an empty graph, Ctrl+K and Space find the presets, and open them", "[app][keyboard]")
{
    const TemporaryFolder folder;
    graph::Graph nothing;
    nothing.name = "nothing";
    REQUIRE (saveGraph (nothing, folder / "nothing.json").has_value());
    for (const auto& [key, words] : { std::pair { "ctrl + k", "open oak board" }, std::pair { "spacebar", "oak b" } })
    {
        INFO (key);
        SearchDesk desk ((folder / "nothing.json").string());
        desk.choose (key, words);
        CHECK (desk.w.graph().name == "Oak board");
    }
}

TEST_CASE ("Ctrl+K finds the ceiling of the mix, also where an added preset has a mixer of its own", "[app][keyboard]")
{
    SearchDesk desk ("bronze_bell.json");
    const auto entries = desk.listed ("ctrl + k", "ceiling");
    REQUIRE_FALSE (entries.empty());
    CHECK (entries.front().name == "Ceiling of the mix");
    desk.w.key ("return");
    WindowRig::settle();
    desk.w.stage->type ("1.5");
    desk.w.key ("return");
    WindowRig::settle();
    const auto isCeiling = [] (const graph::Node& n) { return n.params.value ("ceiling", Json()).dump().find ("1.5") != std::string::npos; };
    CHECK (std::ranges::any_of (desk.w.graph().root.nodes, isCeiling));
}
