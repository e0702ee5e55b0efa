// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/wait_for.hpp"

#include <host/app/browser/browser.hpp>
#include <host/app/window/main_view.hpp>

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
namespace fs = std::filesystem;

namespace
{
struct Opened
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    struct Default
    {
        explicit Default (Look& l)
        {
            juce::LookAndFeel::setDefaultLookAndFeel (&l);
            setenv ("TACTUS_PRESETS", TACTUS_SOURCE_DIR "/graphs", 1);
        }
        ~Default() { juce::LookAndFeel::setDefaultLookAndFeel (nullptr); }
    } as_default { look };
    TemporaryFolder home, mine;
    const int mine_is_set = setenv ("TACTUS_GRAPHS", (mine / "own").c_str(), 1);
    const fs::path wood = mine / "wood.json";   // a copy, because tests save
    std::unique_ptr<MainView> view = make();

    std::unique_ptr<MainView> make()
    {
        fs::copy_file (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", wood, fs::copy_options::overwrite_existing);
        auto made = std::make_unique<MainView> (catalogue());
        made->setSize (1280, 720);
        return made;
    }

    /// Does what the timer does for the run, until the condition holds.
    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually (std::chrono::milliseconds (5), [&] {
            view->run().poll();
            return isSo();
        });
    }

    void press (const char* key) { view->keyPressed (juce::KeyPress::createFromDescription (key)); }
};
}   // namespace

TEST_CASE ("with simulated devices, Esc first closes what is open and then stops the forces, and Shift+Esc stops in any case")
{
    Opened o;
    o.view->begin ({ o.home.path(), false, false, { o.wood } });
    CHECK_FALSE (o.view->part<WelcomePage>().isVisible());
    REQUIRE (o.view->run().isRunning());
    o.press ("F1");
    REQUIRE (o.view->part<HelpPanel>().isOpen());
    REQUIRE_FALSE (o.view->run().drivesDevice());
    o.press ("escape");
    CHECK_FALSE (o.view->part<HelpPanel>().isOpen());
    CHECK (o.view->run().isWanted());
    o.press ("F1");
    o.press ("shift + escape");
    CHECK (o.until ([&] { return o.view->run().isStoppedForGood(); }));
    CHECK (o.view->part<HelpPanel>().isOpen());
    o.press ("escape");
    CHECK (o.view->run().isWanted());
    o.press ("escape");
    CHECK_FALSE (o.view->run().isWanted());
}

TEST_CASE ("while a real device is driven, Esc stops the forces whatever is open")
{
    Opened o;
    o.home.write ("session.json", R"({ "format": "tactus-session", "version": 1,
        "roles": { "stylus": { "driver": "hid", "profile": "woodenhaptics_usb" } } })");
    o.view->begin ({ o.home.path(), false, false, { o.wood } });
    REQUIRE (o.view->run().isWanted());
    // The session is read after the graph, and then binds its roles. The device is awaited, and may be plugged in at any time.
    REQUIRE (o.until ([&] { return o.view->run().drivesDevice(); }));
    o.press ("F1");
    REQUIRE (o.view->part<HelpPanel>().isOpen());
    o.press ("escape");
    CHECK_FALSE (o.view->run().isWanted());
    CHECK (o.view->part<HelpPanel>().isOpen());
    o.press ("escape");
    CHECK_FALSE (o.view->part<HelpPanel>().isOpen());
}

TEST_CASE ("a stopped run stays stopped during edits")
{
    Opened o;
    o.view->begin ({ o.home.path(), false, false, { o.wood } });
    o.press ("escape");
    REQUIRE (o.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.5) }));
    CHECK_FALSE (o.view->run().isWanted());
}

TEST_CASE ("a window without input rests: only its own slow timer runs, and no tooltip looks for the pointer")
{
    Opened o;
    o.view->begin ({ .home = o.home.path(), .safe = true, .files = { o.wood } });
    const auto hasTooltips = [&] { return std::ranges::any_of (o.view->getChildren(), [] (const auto* c) { return c->getName() == "tooltip"; }); };
    const auto comesTo = [&] (bool rest) {
        return host::test::waitFor ([&] { return o.view->isAtRest() == rest; }, 5);
    };
    CHECK_FALSE (o.view->isAtRest());
    CHECK (hasTooltips());
    REQUIRE (comesTo (true));
    CHECK_FALSE (hasTooltips());
    REQUIRE (o.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.7) }));
    CHECK_FALSE (o.view->isAtRest());
    CHECK (hasTooltips());
    REQUIRE (comesTo (true));
    o.view->run().start ({});
    CHECK (comesTo (false));
    CHECK (hasTooltips());
}

TEST_CASE ("safe mode opens a file without running it, even after an edit")
{
    Opened o;
    o.view->begin ({ o.home.path(), true, false, { o.wood } });
    CHECK (o.view->document().graph().name == "Dry wood");
    o.view->canvas().hint ("N");   // a hint about what is under the pointer
    CHECK (o.view->statusText() == "N");
    o.view->canvas().hint ({});
    CHECK (o.view->statusText().contains ("START"));
    REQUIRE (o.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.5) }));
    CHECK_FALSE (o.view->run().isWanted());
    CHECK_FALSE (o.view->statusText().contains ("START"));
}

TEST_CASE ("in safe mode, and after a recovery without running, no message starts the graph before a person has pressed START", "[app][osc][safety][recovery]")
{
    Opened o;
    const bool recovers = GENERATE (false, true);
    const auto kept = writeAutosave ({ o.wood, {}, true, 988.0, writeGraph (loadGraph (o.wood).graph) });
    if (recovers) REQUIRE (writeTextFile (o.home / "sessions/gone/kept.json", kept));
    const int port = std::move (*OscPort::open (0))->number();
    MainView::StartOptions how { .home = o.home.path(), .safe = ! recovers, .osc = OscListen { .port = port } };
    if (! recovers) how.files = { o.wood };
    o.view->begin (how);
    if (recovers)
    {
        REQUIRE (o.view->asked().isOpen());
        o.view->asked().answer (1);   // Recover without running
    }
    REQUIRE (o.view->document().graph().name == "Dry wood");

    const auto us = std::move (*OscPort::open (0));
    const auto ask = [&] (const char* address) {
        us->send (port, juce::OSCMessage (address, us->number()));
        std::optional<juce::OSCMessage> answer;
        REQUIRE (host::test::waitFor ([&] { return (answer = us->next()).has_value(); }));
        return *answer;
    };
    const auto refused = ask ("/tactus/start");
    REQUIRE (refused.size() > 2);
    CHECK (refused[2].getString() == "run/stopped_by_person");
    CHECK_FALSE (o.view->run().isWanted());

    o.press ("F5");
    REQUIRE (o.until ([&] { return o.view->run().isRunning(); }));
    ask ("/tactus/stop");
    CHECK_FALSE (o.view->run().isWanted());
    CHECK (ask ("/tactus/start").getAddressPattern().toString() == "/tactus/done");
    CHECK (o.view->run().isWanted());
}

TEST_CASE ("undo and redo of opening another graph bring back the scopes of each, saved or not", "[app][files][scopes]")
{
    Opened o;
    o.view->begin ({ o.home.path(), true, false, { o.wood } });
    auto& scopes = o.view->part<ScopePanel>();
    const auto of_wood = scopes.shown().size();
    scopes.add (ScopeKind::spectrum);
    o.press ("ctrl + n");
    REQUIRE (o.view->document().graph().root.nodes.empty());
    scopes.add (ScopeKind::tool);
    const auto of_new = scopes.shown().size();
    o.press ("ctrl + z");
    REQUIRE (o.view->document().graph().name == "Dry wood");
    CHECK (scopes.shown().size() == of_wood + 1);
    CHECK (scopes.shown().back()->shown().kind == ScopeKind::spectrum);
    o.press ("ctrl + y");
    CHECK (scopes.shown().size() == of_new);
    CHECK (scopes.shown().back()->shown().kind == ScopeKind::tool);
}

TEST_CASE ("while the scene is enlarged, keys do not edit the hidden canvas")
{
    Opened o;
    o.view->begin ({ o.home.path(), true, false, { o.wood } });
    auto& hand = o.view->part<HandPanel>();
    const auto nodes = [&] { return o.view->document().graph().root.nodes.size(); };
    const auto before = nodes();
    o.press ("ctrl + a");
    REQUIRE_FALSE (o.view->canvas().selection().empty());
    hand.showScene (true);
    hand.enlarge (true);
    CHECK_FALSE (o.view->canvas().isVisible());
    o.press ("delete");
    CHECK (nodes() == before);
    o.press ("escape");
    REQUIRE (o.view->canvas().isVisible());
    o.press ("delete");
    CHECK (nodes() < before);
}

TEST_CASE ("the window closes only after the question about unsaved changes is answered")
{
    Opened o;
    o.view->begin ({ o.home.path(), true, false, { o.wood } });
    int closed = 0;
    const auto close = [&] { o.view->closeWhenSaved ([&] { ++closed; }); };
    REQUIRE (o.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.5) }));
    close();
    REQUIRE (o.view->asked().isOpen());
    o.press ("spacebar");   // Return and Space pick the marked choice; the arrow keys move the mark
    CHECK (o.view->asked().isOpen() == false);
    CHECK (closed == 1);
    CHECK (loadGraph (o.wood).graph.root.find ("drag")->params["mu"] == 0.5);
}

TEST_CASE ("while a question is open, keys go only to the question")
{
    Opened o;
    o.view->begin ({ o.home.path(), true, false, { o.wood } });
    REQUIRE (o.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.5) }));
    o.press ("ctrl + n");
    REQUIRE (o.view->asked().isOpen());
    o.press ("ctrl + z");
    o.press ("1");
    CHECK (o.view->document().graph().root.find ("drag")->params["mu"] == 0.5);
    o.press ("escape");
    CHECK_FALSE (o.view->asked().isOpen());
    CHECK (o.view->document().graph().name == "Dry wood");
    o.press ("ctrl + n");
    o.press ("cursor right");
    o.press ("return");   // Don't save
    CHECK (o.view->document().graph().root.nodes.empty());
}

TEST_CASE ("help on a node shows its datasheet, and its example opens a graph that contains the node")
{
    Opened o;
    o.view->begin ({ o.home.path(), true });
    for (const auto& type : catalogue())
    {
        o.view->part<HelpPanel>().showNode (std::string (type.info.id));
        REQUIRE (o.view->part<HelpPanel>().type() == type.info.id);
        o.view->part<HelpPanel>().onExample (o.view->part<HelpPanel>().type());
        INFO (type.info.id);
        const auto& g = o.view->document().graph();
        bool has = false;
        const auto look = [&] (const graph::Patch& p) {
            for (const auto& n : p.nodes)
                has = has || n.type == type.info.id;
        };
        look (g.root);
        for (const auto& [name, patch] : g.graphs)
            look (patch);
        REQUIRE (has);
    }
    o.view->part<HelpPanel>().showNode ("foo.bar");
    CHECK (o.view->part<HelpPanel>().isOpen());
    o.view->part<HelpPanel>().showNode ("graph:grain");
    CHECK (o.view->part<HelpPanel>().isOpen());
}

TEST_CASE ("a preset is previewed while the button is held, and the document does not change")
{
    Opened o;
    o.view->begin ({ o.home.path(), false, false, { o.wood } });
    REQUIRE (o.view->run().isRunning());
    const auto before = writeGraph (o.view->document().graph());
    o.view->desk().preview (TACTUS_SOURCE_DIR "/graphs/soft_pad.json");
    CHECK (o.view->desk().playback.isPreviewing());
    CHECK_FALSE (o.view->run().isRunning());
    CHECK (o.view->statusText().startsWith ("Soft pad"));
    o.view->desk().endPreview();
    CHECK_FALSE (o.view->desk().playback.isPreviewing());
    CHECK (o.view->run().isRunning());
    CHECK (writeGraph (o.view->document().graph()) == before);
    CHECK (o.view->document().history().names().size() == 1);

    o.press ("escape");
    o.view->desk().preview (TACTUS_SOURCE_DIR "/graphs/soft_pad.json");
    o.view->desk().endPreview();
    CHECK_FALSE (o.view->run().isWanted());   // it was stopped before the preview
}

TEST_CASE ("the option --light applies to this start only")
{
    Opened o;
    o.view->begin ({ o.home.path(), true, true });
    CHECK_FALSE (o.look.theme().is_dark);
    o.view.reset();
    CHECK (o.home.textOf ("settings.json").find ("\"theme\": \"dark\"") != std::string::npos);
}

TEST_CASE ("the window fuses the graph if the settings say so, and says what runs")
{
    Opened o;
    o.home.write ("settings.json", R"({"fuse": true})");
    o.view->begin ({ o.home.path(), false, false, { o.wood } });
    REQUIRE (o.view->run().isRunning());
    CHECK (o.view->run().fusion() == "plan");
    o.view.reset();
    CHECK (o.home.textOf ("settings.json").find ("\"fuse\": true") != std::string::npos);

    o.home.write ("settings.json", "{}");
    o.view = o.make();
    o.view->begin ({ o.home.path(), false, false, { o.wood } });
    CHECK (o.view->run().fusion().empty());
}

TEST_CASE ("settings persist between starts, and damaged ones are reported")
{
    Opened o;
    o.home.write ("settings.json", R"({"theme": "light", "panels": {"left": 0.25, "right": 304},
        "favourites": [")" TACTUS_SOURCE_DIR R"(/graphs/dry_wood.json"]})");
    o.view->begin ({ o.home.path(), true });
    CHECK (o.look.theme().is_dark == false);
    CHECK (o.view->part<PresetBrowser>().getWidth() == 320);
    CHECK (o.view->part<Inspector>().getWidth() == 304);   // pixels, as older versions wrote them, are the usual size
    o.view->setSize (1920, 1080);
    CHECK (o.view->part<PresetBrowser>().getWidth() == 480);
    CHECK (o.view->part<Inspector>().getWidth() == 304);
    REQUIRE (o.view->part<PresetBrowser>().rows().size() > 2);
    CHECK (o.view->part<PresetBrowser>().rows()[0].heading == "Favourites");
    CHECK (o.view->part<PresetBrowser>().rows()[1].preset->name == "Dry wood");
    o.view.reset();
    CHECK (o.home.textOf ("settings.json").find ("\"welcomed\": true") != std::string::npos);

    o.home.write ("settings.json", "{ torn");
    o.view = o.make();
    o.view->begin ({ o.home.path(), true });
    CHECK (fs::exists (o.home / "settings.json.broken"));
}

TEST_CASE ("Z gives the window to the canvas, also on small screens, and brings the panels back")
{
    Opened o;
    o.view->begin ({ o.home.path(), true, false, { o.wood } });
    for (const auto& [width, height] : { std::pair { 1024, 700 }, std::pair { 1280, 720 }, std::pair { 1920, 1080 } })
    {
        CAPTURE (width);
        o.view->setSize (width, height);
        const auto before = o.view->canvas().getBounds();
        CHECK (before.getWidth() > 300);
        CHECK (before.getHeight() > 200);
        o.press ("z");
        CHECK (o.view->canvas().getWidth() == width);
        CHECK (o.view->canvas().getHeight() > 0.6 * height);
        o.press ("z");
        CHECK (o.view->canvas().getBounds() == before);
    }
    // Panels that were opened meanwhile are no reason to forget the others.
    o.view->setSize (1280, 720);
    const auto before = o.view->canvas().getBounds();
    o.press ("z");
    CHECK (o.view->statusText().contains ("Z shows them again"));
    o.press ("ctrl + f");   // opens the presets
    CHECK (o.view->canvas().getWidth() < 1280);
    o.press ("z");
    CHECK (o.view->canvas().getBounds() == before);

    // The next start shows the panels.
    o.press ("z");
    o.view.reset();
    o.view = o.make();
    o.view->begin ({ o.home.path(), true, false, { o.wood } });
    CHECK (o.view->canvas().getWidth() < 1000);
}

TEST_CASE ("saving a clip in another format says what it lost")
{
    Opened o;
    o.view->begin ({ o.home.path() });
    o.view->open (TACTUS_SOURCE_DIR "/graphs/heartbeat.json");
    o.view->chooseFile = [&] (bool saves, const fs::path& begin, const std::function<void (const fs::path&)>& then) {
        CHECK (saves);
        CHECK (begin.filename() == "heartbeat.ahap");
        then (o.mine / "heart.ahap");
    };
    const auto& scene = o.view->canvas().scene();
    for (const auto& n : scene.nodes())
        if (n.name == "beat") o.view->canvas().select ({ n.id });
    o.view->canvas().commands().saveClipOfSelection();
    CHECK (fs::exists (o.mine / "heart.ahap"));
    CHECK (o.view->asked().isOpen());
    CHECK (o.view->asked().title() == "Saved heart.ahap");
    o.view->asked().cancel();
}
