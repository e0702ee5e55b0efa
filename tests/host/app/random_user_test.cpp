// SPDX-License-Identifier: MIT
// A monkey test of the window: random actions in random order, with checks after each one. TACTUS_UI_ACTIONS sets the total
// number of actions. TACTUS_UI_SEED runs one seed only and prints each action before it is performed.
#include "support/stage.hpp"
#include "support/temporary_folder.hpp"

#include <framework/file/graph_file.hpp>
#include <framework/graph/endpoints.hpp>
#include <host/app/canvas/commands.hpp>
#include <host/app/window/main_view.hpp>
#include <host/assets/nearest_by_embree.hpp>

#include <deque>
#include <iostream>
#include <random>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
constexpr int usual_actions = 10000, actions_of_a_seed = 500;
constexpr std::size_t reported_actions = 30;

int numberFrom (const char* variable, int otherwise)
{
    const auto* text = std::getenv (variable);
    return text == nullptr ? otherwise : std::atoi (text);
}

/// Sets an environment variable for the lifetime of this object.
class Environment
{
public:
    Environment (const char* n, const fs::path& value) : name (n), before (juce::SystemStats::getEnvironmentVariable (n, {}))
    {
        setenv (name, value.c_str(), 1);
    }

    ~Environment() { before.isEmpty() ? unsetenv (name) : setenv (name, before.toRawUTF8(), 1); }

    Environment (const Environment&) = delete;
    Environment& operator= (const Environment&) = delete;

private:
    const char* name;
    const juce::String before;
};

/// The whole window, with its own home folder and a copy of the presets that may be overwritten.
class Monkey
{
public:
    explicit Monkey (unsigned seed) : dice (seed)
    {
        fs::copy (TACTUS_SOURCE_DIR "/graphs", presets, fs::copy_options::recursive);
        fs::create_directories (own);
        folder.write ("damaged.json", R"({ "format": "tactus-graph", "nodes": { "a": )");
        folder.write ("stroke.csv", "t,x,y,z\n0,0,0,0.005\n1,0.02,0,-0.001\n2,0,0,0.005\n");
        folder.write ("text.csv", "no numbers\n");
        for (const auto& entry : fs::directory_iterator (presets))
            if (entry.path().extension() == ".json") shipped.push_back (entry.path());
        std::ranges::sort (shipped);
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        stage.emplace (1280, 720);
        begin();
    }

    ~Monkey()
    {
        view.reset();
        stage.reset();
        juce::PopupMenu::dismissAllActiveMenus();   // later messages delete the menus, which use the look until then
        juce::MessageManager::getInstance()->runDispatchLoopUntil (20);
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
        juce::Desktop::getInstance().setGlobalScaleFactor (1.0f);
        juce::SystemClipboard::copyTextToClipboard ({});
    }

    /// Performs a random action. Returns its description.
    std::string act()
    {
        static constexpr std::pair<int, std::string (Monkey::*)()> actions[] {
            { 8, &Monkey::clickAnywhere },
            { 14, &Monkey::clickSomething },
            { 6, &Monkey::dragAnywhere },
            { 6, &Monkey::dragSomething },
            { 12, &Monkey::drawWire },
            { 10, &Monkey::dragOnNode },
            { 8, &Monkey::clickOnCanvas },
            { 18, &Monkey::canvasKey },
            { 10, &Monkey::windowKey },
            { 6, &Monkey::addByPalette },
            { 6, &Monkey::addDirectly },
            { 10, &Monkey::typeSomewhere },
            { 4, &Monkey::wheel },
            { 6, &Monkey::wait },
            { 3, &Monkey::group },
            { 2, &Monkey::enter },
            { 3, &Monkey::rename },
            { 1, &Monkey::resize },
            { 1, &Monkey::openFile },
            { 1, &Monkey::preview },
            { 3, &Monkey::startOrStop },
            { 2, &Monkey::goInHistory },
            { 1, &Monkey::drop },
            { 1, &Monkey::beginAgain },
        };
        if (juce::ModalComponentManager::getInstance()->getNumModalComponents() > 0 && upTo (4) != 0) return chooseInMenu();
        if (view->asked().isOpen() && upTo (3) != 0) return answer();
        int sum = 0;
        for (const auto& [weight, action] : actions)
            sum += weight;
        int left = upTo (sum);
        for (const auto& [weight, action] : actions)
            if ((left -= weight) < 0) return (this->*action)();
        return {};
    }

    void attend (int ms)
    {
        juce::MessageManager::getInstance()->runDispatchLoopUntil (ms);
        juce::ModifierKeys::currentModifiers = {};
        host::test::Stage::plugIn();
        // Close dialogs of JUCE, which are separate windows.
        for (int i = juce::Desktop::getInstance().getNumComponents(); --i >= 0;)
            if (auto* c = juce::Desktop::getInstance().getComponent (i); c != &*stage) c->exitModalState (0);
    }

    void paint() { stage->createComponentSnapshot (stage->getLocalBounds()); }

    /// Closes all menus and dialogs.
    void settle()
    {
        for (int i = 0; i < 20 && juce::ModalComponentManager::getInstance()->getNumModalComponents() > 0; ++i)
        {
            juce::ModalComponentManager::getInstance()->cancelAllModalComponents();
            attend (1);
        }
        if (view->asked().isOpen()) view->asked().cancel();
        view->endPreview();
    }

    bool isAtHome (const fs::path& file) const { return file.string().starts_with (folder.path().string()); }

private:
    TemporaryFolder folder;
    const fs::path presets = folder / "graphs", own = folder / "own", home = folder / "home";
    const Environment presets_are { "TACTUS_PRESETS", presets }, own_is { "TACTUS_GRAPHS", own }, home_is { "HOME", folder.path() };
    std::vector<fs::path> shipped;
    std::mt19937 dice;
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;

public:
    std::optional<host::test::Stage> stage;
    std::unique_ptr<MainView> view;

private:
    int upTo (int n) { return n <= 0 ? 0 : static_cast<int> (dice() % static_cast<unsigned> (n)); }   // 0…n-1
    float part() { return static_cast<float> (upTo (1000)) / 1000.0f; }

    template <typename C>
    auto& oneOf (C&& all)
    {
        return all[static_cast<std::size_t> (upTo (static_cast<int> (std::size (all))))];
    }

    void begin()
    {
        view = std::make_unique<MainView> (catalogue());
        view->chooseFile = [this] (bool saves, const fs::path& from, const std::function<void (const fs::path&)>& chosen) {
            if (! isAtHome (from)) throw std::runtime_error ("the window looks for a file in " + from.string());
            const auto file = someFile (saves);
            if (upTo (4) == 0) return;
            if (upTo (4) != 0) return chosen (file);
            juce::MessageManager::callAsync (
                [safe = juce::Component::SafePointer<juce::Component> (view.get()), chosen, file] { if (safe != nullptr) chosen (file); });
        };
        stage->fill (*view);
        MainView::Start how { .home = home, .safe = upTo (5) == 0, .light = upTo (4) == 0 };
        if (upTo (3) != 0) how.files.push_back (oneOf (shipped));
        view->begin (how);
        host::test::Stage::plugIn();
        view->grabKeyboardFocus();
    }

    fs::path someFile (bool saves)
    {
        const int kind = upTo (10);
        if (kind < 4) return own / ("graph_" + std::to_string (upTo (4)) + (upTo (2) == 0 ? "" : ".json"));
        if (kind < 7) return oneOf (shipped);
        if (kind == 7) return saves ? own : folder / "damaged.json";
        if (kind == 8) return own / "not there" / "a.json";
        return folder / "stroke.csv" / "a.json";
    }

    //==========================================================================
    juce::Point<float> anywhere() { return { part() * static_cast<float> (stage->getWidth()), part() * static_cast<float> (stage->getHeight()) }; }
    static juce::String coordinates (juce::Point<float> p) { return juce::String (juce::roundToInt (p.x)) + "," + juce::String (juce::roundToInt (p.y)); }

    int someButton()
    {
        const int n = upTo (8);
        if (n == 0) return juce::ModifierKeys::rightButtonModifier;
        return n == 1 ? juce::ModifierKeys::middleButtonModifier : juce::ModifierKeys::leftButtonModifier;
    }

    int someKeys()
    {
        const int keys[] { juce::ModifierKeys::shiftModifier, juce::ModifierKeys::ctrlModifier, juce::ModifierKeys::altModifier };
        return upTo (4) == 0 ? oneOf (keys) : 0;
    }

    /// A random visible component without children.
    juce::Component* something()
    {
        std::vector<juce::Component*> all;
        const auto add = [&] (auto&& self, juce::Component& c) -> void {
            if (! c.isVisible() || c.getWidth() <= 0 || c.getHeight() <= 0) return;
            bool has_none = true;
            for (auto* child : c.getChildren())
            {
                has_none = has_none && ! child->isVisible();
                self (self, *child);
            }
            if (has_none && &c != &view->canvas()) all.push_back (&c);
        };
        add (add, *view);
        return all.empty() ? nullptr : oneOf (all);
    }

    juce::Point<float> in (juce::Component& c)
    {
        const float x = part() * static_cast<float> (c.getWidth()), y = part() * static_cast<float> (c.getHeight());
        return stage->getLocalPoint (&c, juce::Point<float> (x, y));
    }

    static std::string describe (juce::Component& c)
    {
        const auto* button = dynamic_cast<juce::Button*> (&c);
        auto name = c.getTitle().isNotEmpty() ? c.getTitle() : c.getName();
        if (button != nullptr && button->getButtonText().isNotEmpty()) name = button->getButtonText();
        return std::string (typeid (c).name()) + " '" + name.toStdString() + "'";
    }

    std::string clickAt (juce::Point<float> at)
    {
        const int how = upTo (8), button = someButton(), keys = someKeys();
        how == 0 ? stage->doubleClick (at) : stage->click (at, button, keys);
        return ((how == 0 ? "double click " : "click ") + coordinates (at) + " button " + juce::String (button) + " keys " + juce::String (keys)).toStdString();
    }

    std::string dragFromTo (juce::Point<float> from, juce::Point<float> to)
    {
        const int button = someButton(), keys = someKeys();
        stage->drag (from, to, button, keys);
        return ("drag " + coordinates (from) + " to " + coordinates (to) + " button " + juce::String (button) + " keys " + juce::String (keys)).toStdString();
    }

    std::string clickAnywhere() { return clickAt (anywhere()); }
    std::string dragAnywhere() { return dragFromTo (anywhere(), anywhere()); }

    std::string clickSomething()
    {
        auto* c = something();
        if (c == nullptr) return "nothing to click";
        const auto name = describe (*c);
        return name + ": " + clickAt (in (*c));
    }

    std::string dragSomething()
    {
        auto* c = something();
        if (c == nullptr) return "nothing to drag";
        const auto name = describe (*c);
        const auto from = in (*c);
        return name + ": " + dragFromTo (from, from + juce::Point<float> (part() - 0.5f, part() - 0.5f) * 300.0f);
    }

    //==========================================================================
    juce::Point<float> onCanvas (juce::Point<float> of_scene) { return stage->getLocalPoint (&view->canvas(), view->canvas().view().toPixels (of_scene)); }
    juce::Point<float> onNode (const SceneNode& n, bool title)
    {
        if (title) return onCanvas (n.at + juce::Point<float> (30.0f, 12.0f));
        return onCanvas (n.at + juce::Point<float> (n.box.width - 16.0f, oneOf (n.box.sockets).at.y));
    }
    const SceneNode* someNode() { return view->canvas().scene().nodes().empty() ? nullptr : &oneOf (view->canvas().scene().nodes()); }

    std::string drawWire()
    {
        const auto *a = someNode(), *b = someNode();
        if (a == nullptr || a->box.sockets.empty() || b->box.sockets.empty()) return "no port to draw from";
        // Prefer ports that may fit, or hardly any wire would be drawn.
        const auto &from = oneOf (a->box.sockets), *to = &oneOf (b->box.sockets);
        for (int i = 0; i < 6 && (from.port->role == Role::output) == (to->port->role == Role::output); ++i)
            to = &oneOf (b->box.sockets);
        const auto wire = "from " + a->name + "." + from.port->id + " to " + b->name + "." + to->port->id + ": ";
        const auto start = onCanvas (a->placeOf (from));
        return wire + dragFromTo (start, upTo (8) == 0 ? anywhere() : onCanvas (b->placeOf (*to)));
    }

    std::string dragOnNode()
    {
        const auto* n = someNode();
        if (n == nullptr) return "no node to drag";
        const bool by_title = n->box.sockets.empty() || upTo (2) == 0;
        const auto from = onNode (*n, by_title);
        const auto name = n->name;
        return name + ": " + dragFromTo (from, from + juce::Point<float> (part() - 0.5f, part() - 0.5f) * 200.0f);
    }

    std::string clickOnCanvas()
    {
        const auto& scene = view->canvas().scene();
        const int what = upTo (4);
        if (what == 0 && ! scene.wires().empty())
        {
            const auto& wire = oneOf (scene.wires());
            const auto path = wire.path();
            const auto text = wire.text;
            return text + ": " + clickAt (onCanvas (path.getPointAlongPath (path.getLength() * part())));
        }
        if (what == 1 && ! scene.notes().empty())
        {
            const auto area = oneOf (scene.notes()).area;
            if (upTo (2) == 0) return "note: " + clickAt (onCanvas (area.getTopLeft().translated (12.0f, 10.0f)));
            return "note: " + dragFromTo (onCanvas (area.getBottomRight().translated (-3.0f, -3.0f)), anywhere());
        }
        const auto* n = someNode();
        if (n == nullptr) return "canvas: " + clickAt (in (view->canvas()));
        const auto name = n->name;
        const bool by_title = n->box.sockets.empty() || upTo (2) == 0;
        return name + ": " + clickAt (onNode (*n, by_title));
    }

    std::string canvasKey()
    {
        const auto& command = oneOf (canvasCommands());
        if (upTo (3) != 0) view->canvas().grabKeyboardFocus();
        if (upTo (4) == 0 && ! view->canvas().scene().nodes().empty())
        {
            Selection some;
            for (const auto& n : view->canvas().scene().nodes())
                if (upTo (3) == 0) some.insert (n.id);
            view->canvas().select (some);
        }
        auto keys = juce::StringArray::fromTokens (command.keys, "|", {});
        const auto k = keys[upTo (keys.size())];
        stage->key (k);
        return "key " + k.toStdString() + ": " + command.name;
    }

    std::string group()
    {
        const auto& nodes = view->canvas().scene().nodes();
        if (nodes.empty()) return "nothing to group";
        Selection some;
        for (int i = 1 + upTo (3); --i >= 0;)
            some.insert (oneOf (nodes).id);
        view->canvas().select (some);
        view->canvas().grabKeyboardFocus();
        stage->key (juce::String ("g"));
        if (upTo (2) == 0) stage->key (juce::String ("return"));
        return "group " + std::to_string (some.size());
    }

    std::string enter()
    {
        for (const auto& n : view->canvas().scene().nodes())
            if (n.type.starts_with ("graph:"))
            {
                const auto name = n.name;
                view->canvas().enter (n);
                return "enter " + name;
            }
        return "nothing to enter";
    }

    /// Renames a node in any patch, which the history and the inspector can do while another patch is shown.
    std::string rename()
    {
        const auto& g = view->document().graph();
        const bool is_root = g.graphs.empty() || upTo (2) == 0;
        const auto patch = is_root ? std::string() : oneOf (g.graphs).first;
        const auto& nodes = is_root ? g.root.nodes : g.find (patch)->nodes;
        if (nodes.empty()) return "nothing to rename";
        const auto before = oneOf (nodes).name, after = "n" + std::to_string (upTo (100));
        view->document().perform (graph::RenameNode { patch, before, after });
        return "rename " + patch + "/" + before + " to " + after;
    }

    std::string windowKey()
    {
        static const char* const keys[] {
            "escape", "escape", "1", "2", "3", "4", "5", "ctrl + 1", "ctrl + 2", "ctrl + 3", "F1", "ctrl + n", "ctrl + o", "ctrl + s",
            "ctrl + shift + s", "ctrl + z", "ctrl + z", "ctrl + y", "c", "h", "x", "tab", "shift + tab", "return", "spacebar", "cursor up",
            "cursor down", "cursor left", "cursor right", "page up", "home", "end", "delete", "backspace", "ctrl + a", "ctrl + v", "ctrl + x", "?"
        };
        const auto* k = oneOf (keys);
        stage->key (k);
        return std::string ("key ") + k;
    }

    const NodeType& someType()
    {
        std::vector<const NodeType*> all;
        for (const auto& type : catalogue())
            all.push_back (&type);
        return *oneOf (all);
    }

    std::string addByPalette()
    {
        view->canvas().grabKeyboardFocus();
        stage->key (juce::String ("spacebar"));
        const std::string type (someType().info.id);
        const auto query = type.substr (0, static_cast<std::size_t> (upTo (static_cast<int> (type.size()) + 1)));
        stage->type (query);
        for (int i = upTo (3); --i >= 0;)
            stage->key (juce::String (upTo (3) == 0 ? "cursor up" : "cursor down"));
        const int end = upTo (5);
        if (end == 0) return "palette stays open at " + query;
        stage->key (juce::String (end == 1 ? "escape" : "return"));
        return "palette: " + query + (end == 1 ? ", escape" : ", return");
    }

    std::string addDirectly()
    {
        const std::string type (someType().info.id);
        NodeRequest request { { part() * 800.0f - 400.0f, part() * 600.0f - 300.0f } };
        const auto& wires = view->canvas().scene().wires();
        if (! wires.empty() && upTo (3) == 0) request.wire = oneOf (wires).id;
        view->canvas().addNodeAt (type, request);
        return "add " + type + (request.wire != 0 ? " into a wire" : "");
    }

    std::string typeSomewhere()
    {
        auto* editor = dynamic_cast<juce::TextEditor*> (juce::Component::getCurrentlyFocusedComponent());
        if (editor == nullptr || upTo (3) == 0)
        {
            std::vector<juce::Component*> all;
            const auto add = [&] (auto&& self, juce::Component& c) -> void {
                if (! c.isShowing()) return;
                if (dynamic_cast<juce::TextEditor*> (&c) != nullptr || dynamic_cast<juce::Label*> (&c) != nullptr) all.push_back (&c);
                for (auto* child : c.getChildren())
                    self (self, *child);
            };
            add (add, *view);
            if (all.empty()) return "nowhere to type";
            const auto at = in (*oneOf (all));
            upTo (2) == 0 ? stage->click (at) : stage->doubleClick (at);
        }
        static const juce::String texts[] {
            "0.4 mm", "3 N", "nan", "", juce::CharPointer_UTF8 ("\xc3\xa4\xe2\x82\xac \xf0\x9f\x98\x80"), "1e999", "-1", "0", "1e-320", "a", "grain",
            "x y", "12 %", "(0, 0, 1)", "[1, 2, 3]", "{\"a\": 1}", "400 N/m", "0.5", "2 2 2", "friction", "../stroke.csv", "stroke.csv", "/",
            "not.there.wav", "drag", "graph", "inf", "99999999999999999999", "#", "7:7", "\"", "\\", juce::String::repeatedString ("long ", 60)
        };
        const auto text = oneOf (texts);
        const bool replaces = upTo (4) != 0;
        if (replaces) stage->key (juce::String ("ctrl + a"));
        stage->type (text);
        static const char* const ends[] { "return", "return", "escape", "tab", "" };
        const juce::String end = oneOf (ends);
        if (end.isNotEmpty()) stage->key (end);
        auto* focus = juce::Component::getCurrentlyFocusedComponent();
        return "type '" + text.substring (0, 40).toStdString() + "' " + end.toStdString() + ", focus " + (focus != nullptr ? describe (*focus) : "none");
    }

    std::string wheel()
    {
        const auto at = anywhere();
        const float up = part() - 0.5f;
        const int keys = someKeys();
        stage->wheel (at, up, upTo (2) == 0, keys);
        return ("wheel " + coordinates (at) + " by " + juce::String (up) + " keys " + juce::String (keys)).toStdString();
    }

    std::string wait()
    {
        const int ms = 1 + upTo (40);
        attend (ms);
        return "wait " + std::to_string (ms) + " ms";
    }

    std::string resize()
    {
        stage->setSize (960 + upTo (1000), 600 + upTo (500));
        return "resize to " + std::to_string (stage->getWidth()) + " x " + std::to_string (stage->getHeight());
    }

    std::string openFile()
    {
        const auto file = someFile (false);
        view->open (file);
        return "open " + file.string();
    }

    std::string preview()
    {
        if (view->isPreviewing() || upTo (3) == 0)
        {
            view->endPreview();
            return "end of the preview";
        }
        const auto file = oneOf (shipped);
        view->preview (file);
        return "preview " + file.filename().string();
    }

    std::string startOrStop()
    {
        std::string found = "no";
        const auto look_in = [&] (auto&& self, juce::Component& c) -> void {
            const auto* button = dynamic_cast<juce::Button*> (&c);
            if (button != nullptr && (button->getButtonText() == "STOP" || button->getButtonText() == "START"))
            {
                found = button->getButtonText().toStdString();
                stage->click (stage->getLocalPoint (&c, c.getLocalBounds().getCentre()).toFloat());
                return;
            }
            for (int i = 0; i < c.getNumChildComponents() && found == "no"; ++i)
                self (self, *c.getChildComponent (i));
        };
        look_in (look_in, *view);
        return found;
    }

    std::string goInHistory()
    {
        std::string done = "no history";
        const auto look_in = [&] (auto&& self, juce::Component& c) -> void {
            if (auto* panel = dynamic_cast<HistoryPanel*> (&c))
            {
                const int row = upTo (static_cast<int> (view->document().history().names().size()) + 2);
                panel->goToRow (row);
                done = "history row " + std::to_string (row);
                return;
            }
            for (int i = 0; i < c.getNumChildComponents(); ++i)
                self (self, *c.getChildComponent (i));
        };
        // Mostly small jumps in the history, so that there are still nodes to edit.
        if (upTo (4) == 0)
            look_in (look_in, *view);
        else
        {
            const auto at = static_cast<int> (view->document().history().position());
            view->document().goTo (static_cast<std::size_t> (std::max (0, at - 4 + upTo (7))));
            done = "history near " + std::to_string (at);
        }
        return done;
    }

    std::string drop()
    {
        static const char* const names[] { "stroke.csv", "text.csv", "not there.csv", "damaged.json", "graphs/dry_wood.json" };
        const auto file = folder / oneOf (names);
        const auto at = anywhere();
        stage->drop (file.string(), at);
        return "drop " + file.filename().string() + " at " + coordinates (at).toStdString();
    }

    /// Closes and reopens the window: either normally, or by a simulated crash with something to recover.
    std::string beginAgain()
    {
        if (upTo (4) != 0) return "stays";
        settle();
        const bool is_sudden = upTo (2) == 0;
        if (is_sudden)
            view->closeSuddenly();
        else
        {
            view->closeWhenSaved ([] {});
            if (view->asked().isOpen()) view->asked().answer (1);
        }
        view.reset();
        begin();
        return is_sudden ? "crashes and restarts" : "closes and restarts";
    }

    std::string chooseInMenu()
    {
        auto* menu = juce::ModalComponentManager::getInstance()->getModalComponent (0);
        if (menu == nullptr) return "no menu";
        const int how = upTo (6);
        if (how < 3)
        {
            const auto at = in (*menu);
            stage->click (at);
            return "menu: click " + coordinates (at).toStdString();
        }
        if (how == 3)
        {
            stage->key (juce::String ("escape"));
            return "menu: escape";
        }
        for (int i = 1 + upTo (8); --i >= 0;)
        {
            juce::String arrow ("cursor down");
            if (upTo (4) == 0)
                arrow = "cursor up";
            else if (upTo (4) == 0)
                arrow = "cursor right";
            stage->key (arrow);
        }
        stage->key (juce::String ("return"));
        return "menu: some item";
    }

    std::string answer()
    {
        const auto title = view->asked().title().toStdString();
        const int n = upTo (static_cast<int> (view->asked().size()));
        view->asked().answer (static_cast<std::size_t> (n));
        return title + ": answer " + std::to_string (n);
    }
};

//==============================================================================
/// What is inconsistent between graph and canvas; "" if nothing is.
std::string disagreement (MainView& view)
{
    auto& canvas = view.canvas();
    const auto& graph = view.document().graph();
    const auto* patch = &graph.root;
    std::string here;
    for (const auto& [node, subgraph] : canvas.breadcrumbs())
    {
        const auto* entered = patch->find (node);
        if (entered == nullptr) return "the breadcrumbs contain '" + node + "', which is not in '" + here + "'";
        if (entered->type != "graph:" + subgraph) return "the breadcrumbs contain '" + node + "' of '" + subgraph + "', but it is a " + entered->type;
        patch = graph.find (subgraph);
        if (patch == nullptr) return "the breadcrumbs contain '" + subgraph + "', which does not exist";
        here = subgraph;
    }

    const auto& scene = canvas.scene();
    const auto isSame = [] (const SceneNode& s, const graph::Node& n) { return s.id == n.id && s.name == n.name && s.type == n.type && s.bypass == n.bypass; };
    if (! std::ranges::equal (scene.nodes(), patch->nodes, isSame)) return "the nodes on the canvas are not those of '" + here + "'";
    std::vector<graph::Id> wires, drawn;
    for (const auto& w : patch->wires)
        if (patch->find (graph::firstNameOf (w.from.node)) != nullptr && patch->find (graph::firstNameOf (w.to.node)) != nullptr) wires.push_back (w.id);
    for (const auto& w : scene.wires())
        drawn.push_back (w.id);
    if (wires != drawn) return "the wires on the canvas are not those of '" + here + "'";
    if (scene.notes().size() != notesOf (graph, here).size()) return "the notes on the canvas are not those of '" + here + "'";

    for (const auto id : canvas.selection())
    {
        const bool exists = isNote (id) ? noteOf (id) < scene.notes().size() : scene.find (id) != nullptr || scene.findWire (id) != nullptr;
        if (! exists) return "the selection contains something that does not exist";
    }
    if (view.document().history().position() > view.document().history().names().size()) return "the history position is beyond its end";
    return {};
}

std::set<std::string> errorsOf (const Messages& messages)
{
    std::set<std::string> found;
    for (const auto& m : messages)
    {
        const bool is_device = m.where.starts_with ("/devices") || m.where.starts_with ("/hand");
        if (m.severity == Message::Severity::error && ! is_device) found.insert (m.id + " at " + m.where);
    }
    return found;
}

std::string joined (const std::set<std::string>& all)
{
    std::string text;
    for (const auto& one : all)
        text += "\n    " + one;
    return text;
}

/// Checks that the live run reports the same errors as compiling the graph separately.
std::string disagreementWithCompile (MainView& view, FileAssets& assets)
{
    const auto& graph = view.document().graph();
    const auto compiled = compile (graph, catalogue(), { .assets = &assets, .services = { .nearest_triangle = nearestByEmbree } });
    const auto expected = errorsOf (compiled.messages), reported = errorsOf (view.run().messages());
    if (expected == reported) return {};
    return "compile reports:" + joined (expected) + "\n  and the run:" + joined (reported);
}

std::string instability (const graph::Graph& g)
{
    const auto text = writeGraph (g);
    const auto again = readGraph (text);
    if (hasErrors (again.messages)) return "the written graph cannot be read: " + again.messages.front().text + " at " + again.messages.front().where;
    return writeGraph (again.graph) == text ? std::string() : std::string ("writing the graph again gives different text");
}

std::string historyFault (Document& d)
{
    const auto at = d.history().position(), all = d.history().names().size();
    const auto here = writeGraph (d.graph());
    d.goTo (all);
    const auto last = writeGraph (d.graph());
    d.goTo (0);
    d.goTo (all);
    if (writeGraph (d.graph()) != last) return "undoing and redoing everything changes the graph";
    d.goTo (at);
    return writeGraph (d.graph()) == here ? std::string() : std::string ("jumping through the history and back changes the graph");
}

void play (unsigned seed, int actions, bool prints)
{
    Monkey monkey (seed);
    FileAssets assets;
    std::deque<std::string> done;
    const auto check = [&] (const std::string& fault) {
        if (fault.empty()) return;
        std::string log;
        for (const auto& action : done)
            log += "\n  " + action;
        FAIL ("TACTUS_UI_SEED=" << seed << ": " << fault << "\nafter" << log);
    };
    for (int n = 1; n <= actions; ++n)
    {
        if (prints) std::cerr << n << ": " << std::flush;
        done.push_back (std::to_string (n) + ": " + monkey.act());
        if (prints) std::cerr << done.back().substr (done.back().find (' ') + 1) << std::endl;
        if (done.size() > reported_actions) done.pop_front();
        if (n % 3 == 0) monkey.attend (1);
        check (disagreement (*monkey.view));
        if (n % 20 == 0) check (disagreementWithCompile (*monkey.view, assets));
        if (n % 50 == 0) monkey.paint();
        if (n % 100 == 0) check (instability (monkey.view->document().graph()));
    }
    monkey.settle();
    check (historyFault (monkey.view->document()));
    check (disagreement (*monkey.view));
    check (disagreementWithCompile (*monkey.view, assets));
}
}   // namespace

TEST_CASE ("graph, plan and view stay consistent under random user actions", "[app][random]")
{
    const int all = numberFrom ("TACTUS_UI_ACTIONS", usual_actions);
    if (const int seed = numberFrom ("TACTUS_UI_SEED", -1); seed >= 0) return play (static_cast<unsigned> (seed), std::min (all, actions_of_a_seed), true);
    for (int seed = 0; seed * actions_of_a_seed < all; ++seed)
        play (static_cast<unsigned> (seed), std::min (actions_of_a_seed, all - seed * actions_of_a_seed), false);
}
