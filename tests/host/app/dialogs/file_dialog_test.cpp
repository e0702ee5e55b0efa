// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/contrast.hpp"
#include "host/app/support/environment.hpp"
#include "host/app/support/screen.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <host/app/dialogs/file_dialog_parts.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::contrast;
using tactus::host::test::Environment;
using tactus::host::test::onScreen;
using tactus::host::test::showsText;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
bool isDialogOpen() { return juce::Component::getNumCurrentlyModalComponents() > 0; }
}   // namespace

TEST_CASE ("Ctrl+S, a name and Return save, and the graph, the header and the title have the name of the file", "[app][files]")
{
    const TemporaryFolder mine;
    const Environment own_is { "TACTUS_GRAPHS", mine.path() };
    WindowRig w;
    juce::String title;
    w.view->onTitle = [&] (const juce::String& t) { title = t; };
    w.key ("ctrl + n");
    w.key ("ctrl + s");
    REQUIRE (isDialogOpen());
    const auto* name = dynamic_cast<juce::TextEditor*> (WindowRig::focused());
    REQUIRE (name != nullptr);
    CHECK (name->getText() == "untitled.json");
    WindowRig::settle (200);   // the window behind is dimmed, and the dialog is not
    auto* dialog = juce::Component::getCurrentlyModalComponent();
    for (auto* child : w.view->getChildren())
        if (dynamic_cast<Shade*> (child) != nullptr)
            CHECK ((child->isVisible() && w.view->getIndexOfChildComponent (child) < w.view->getIndexOfChildComponent (dialog)));
    CHECK (name->getHighlightedText() == name->getText());
    w.stage->type ("my board");
    CHECK (name->getText() == "my board");
    CHECK (w.graph().root.nodes.empty());   // the canvas gets no key
    w.key ("return");
    REQUIRE (waitFor ([&] { return std::filesystem::exists (mine / "my board.json"); }));
    CHECK_FALSE (isDialogOpen());
    CHECK (w.graph().name == "My board");
    CHECK (loadGraph (mine / "my board.json").graph.name == "My board");
    CHECK (title == "My board (my board.json)");
    CHECK (showsText (*w.view, "my board.json"));

    SECTION ("the name of its file is proposed while it is that of the graph")
    {
        w.key ("ctrl + shift + s");
        REQUIRE (isDialogOpen());
        CHECK (dynamic_cast<juce::TextEditor&> (*WindowRig::focused()).getText() == "my board.json");
        w.key ("escape");
        CHECK (waitFor ([] { return ! isDialogOpen(); }));
    }
    SECTION ("a new name of the graph is proposed as the name of a new file, and Esc closes the dialog")
    {
        w.view->document().perform (graph::SetHeader { .name = "Old oak" });
        CHECK (title == "Old oak (my board.json, edited)");
        w.key ("ctrl + shift + s");
        REQUIRE (isDialogOpen());
        CHECK (dynamic_cast<juce::TextEditor&> (*WindowRig::focused()).getText() == "old_oak.json");
        w.key ("escape");
        CHECK (waitFor ([] { return ! isDialogOpen(); }));
        CHECK (w.graph().name == "Old oak");
        w.key ("ctrl + shift + s");
        w.key ("return");
        CHECK (waitFor ([&] { return std::filesystem::exists (mine / "old_oak.json"); }));
        CHECK (w.graph().name == "Old oak");   // as before: the names agree
    }
    SECTION ("saving again asks nothing and renames nothing")
    {
        w.view->document().perform (graph::SetHeader { .name = "Old oak" });
        w.key ("ctrl + s");
        CHECK_FALSE (isDialogOpen());
        CHECK (loadGraph (mine / "my board.json").graph.name == "Old oak");
    }
}

TEST_CASE ("a file is replaced only after a question of the window, which offers another name", "[app][files]")
{
    const TemporaryFolder mine;
    const Environment own_is { "TACTUS_GRAPHS", mine.path() };
    std::ofstream (mine / "old.json") << "old";
    WindowRig w ("dry_wood.json");
    const auto saveAs = [&] {
        w.key ("ctrl + shift + s");
        REQUIRE (isDialogOpen());
        w.stage->type ("old");   // its ending is added
        w.key ("return");
        REQUIRE (waitFor ([&] { return w.view->asked().isOpen(); }));
        CHECK_FALSE (isDialogOpen());
        CHECK (w.view->asked().title() == "Replace old.json?");
        CHECK (mine.textOf ("old.json") == "old");
    };
    saveAs();
    w.key ("escape");
    CHECK_FALSE (w.view->asked().isOpen());
    CHECK (mine.textOf ("old.json") == "old");
    CHECK (w.view->document().file().filename() != "old.json");

    saveAs();
    w.click ("Choose another name ...");
    REQUIRE (isDialogOpen());
    CHECK (dynamic_cast<juce::TextEditor&> (*WindowRig::focused()).getText() == "old.json");
    w.key ("escape");
    REQUIRE (waitFor ([] { return ! isDialogOpen(); }));

    saveAs();
    w.key ("return");   // a second Return that comes too soon must not replace the file unread
    REQUIRE (isDialogOpen());
    CHECK (mine.textOf ("old.json") == "old");
    w.key ("escape");
    REQUIRE (waitFor ([] { return ! isDialogOpen(); }));

    saveAs();
    w.click ("Replace");
    CHECK (waitFor ([&] { return mine.textOf ("old.json") != "old"; }));
    CHECK (w.view->document().file() == mine / "old.json");
}

TEST_CASE ("on a screen: a new folder", "[.screen]")
{
    const TemporaryFolder mine;
    const Environment own_is { "TACTUS_GRAPHS", mine.path() };
    WindowRig w ("dry_wood.json");
    w.key ("ctrl + shift + s");
    REQUIRE (isDialogOpen());
    auto* dialog = juce::Component::getCurrentlyModalComponent();
    w.click ("New Folder");
    REQUIRE (waitFor ([&] { return juce::Component::getCurrentlyModalComponent() != dialog; }));
    CHECK (waitFor ([] { return dynamic_cast<juce::TextEditor*> (WindowRig::focused()) != nullptr; }));
    w.stage->type ("oak");
    w.key ("return");
    CHECK (waitFor ([&] { return std::filesystem::is_directory (mine / "oak"); }));
    REQUIRE (waitFor ([&] { return juce::Component::getCurrentlyModalComponent() == dialog; }));
    const auto* browser = browserIn (*dialog);
    REQUIRE (browser != nullptr);
    CHECK (waitFor ([&] { return browser->getRoot() == juce::File ((mine / "oak").string()); }));   // one looks into it
    CHECK (waitFor ([&] { return WindowRig::focused() == nameField (*dialog); }));
    w.stage->type ("bark");
    w.key ("return");
    CHECK (waitFor ([&] { return std::filesystem::exists (mine / "oak" / "bark.json"); }));
    CHECK (waitFor ([] { return ! isDialogOpen(); }));
}

TEST_CASE ("a new folder of the dialog for files has the name that is typed at once", "[app][files]")
{
    onScreen ("on a screen: a new folder");
}

TEST_CASE ("a film is saved under the typed name", "[app][files][film]")
{
    const TemporaryFolder own;
    const Environment home_is { "HOME", own.path() };
    WindowRig w ("dry_wood.json", 1280, 720, false);
    w.click ("3D");
    REQUIRE (waitFor ([&] { return w.view->run().film().end() > 2000; }));
    auto* label = WindowRig::buttonIn (*w.view, "Film");
    REQUIRE (label != nullptr);
    auto* film = label->findParentComponentOfClass<FilmButton>();
    REQUIRE (film != nullptr);
    film->saveLast();   // as the first entry of its menu
    REQUIRE (waitFor ([] { return isDialogOpen(); }));
    const auto* name = dynamic_cast<juce::TextEditor*> (WindowRig::focused());
    REQUIRE (name != nullptr);
    CHECK (name->getText().startsWith ("film "));
    w.stage->type ("oak v1.2");
    w.key ("return");
    const auto file = own / "Documents" / "Tactus" / "oak v1.2.png";   // the dot is part of the name
    CHECK (waitFor ([&] { return std::filesystem::exists (file); }));
    CHECK (waitFor ([&] { return std::filesystem::exists (file.parent_path() / "oak v1.2.csv"); }));
    w.view->run().letGo();
}

TEST_CASE ("the dialog for the clip of a node waits for a name, and lists clips but no graphs", "[app][files]")
{
    const TemporaryFolder mine;
    const std::filesystem::path assets = TACTUS_SOURCE_DIR "/graphs/assets";
    std::filesystem::copy_file (assets / "heartbeat.haptic", mine / "heartbeat.haptic");
    std::filesystem::copy_file (assets / "zip.json", mine / "zip.json");   // a clip
    std::ofstream (mine / "board.json") << R"({ "format": "tactus-graph", "version": 2,
        "nodes": { "beat": { "type": "signal.clip", "settings": { "clip": "heartbeat.haptic" } } }, "wires": [] })";
    WindowRig w ({}, 1280, 1400);   // so that all rows of the inspector are in view
    w.view->open (mine / "board.json");
    WindowRig::settle();
    REQUIRE (w.graph().root.nodes.size() == 1);
    w.view->canvas().select ({ w.graph().root.nodes[0].id });
    WindowRig::settle();
    w.click ("Browse...");
    REQUIRE (isDialogOpen());
    CHECK (dynamic_cast<juce::TextEditor*> (WindowRig::focused()) != nullptr);
    auto* dialog = juce::Component::getCurrentlyModalComponent();
    CHECK (waitFor ([&] { return showsText (*dialog, "zip.json") && showsText (*dialog, "heartbeat.haptic") && ! showsText (*dialog, "board.json"); }));
    w.stage->type ("zip.json");
    w.key ("return");
    CHECK (waitFor ([&] { return w.graph().root.nodes[0].settings.at ("clip") == Json ("zip.json"); }));
    CHECK_FALSE (isDialogOpen());
}

TEST_CASE ("the dialog for files has a border all around, and the window behind it is dimmed while it is open, but not STOP", "[app][look]")
{
    WindowRig w ("dry_wood.json");
    const auto brightness = [] (const juce::Image& image, juce::Rectangle<int> area) {
        double sum = 0.0;
        for (int y = area.getY(); y < area.getBottom(); ++y)
            for (int x = area.getX(); x < area.getRight(); ++x)
                sum += static_cast<double> (image.getPixelAt (x, y).getBrightness());
        return sum / (area.getWidth() * area.getHeight());
    };
    const auto safety = w.stage->getLocalBounds().withHeight (SafetyStrip::height), corner = w.stage->getLocalBounds().withTop (660).withRight (300);
    const auto before = w.stage->painted();

    juce::FileBrowserComponent files (juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles,
                                      juce::File (TACTUS_SOURCE_DIR "/graphs"), nullptr, nullptr);
    juce::FileChooserDialogBox box ("Open", {}, files, false, themeOf (*w.view).panel, w.stage.get());
    box.setBounds (340, 110, 600, 500);
    box.enterModalState (false);
    WindowRig::settle (200);
    const auto open = w.stage->painted();
    CHECK (brightness (open, corner) < 0.7 * brightness (before, corner));
    CHECK (brightness (open, safety) > 0.9 * brightness (before, safety));

    const auto picture = box.createComponentSnapshot (box.getLocalBounds());
    const auto inside = themeOf (*w.view).panel;
    for (const auto at : { juce::Point (0, 250), juce::Point (599, 250), juce::Point (300, 0), juce::Point (300, 499) })
        CHECK (contrast (picture.getPixelAt (at.x, at.y), inside) > 1.5);
    CHECK (contrast (picture.getPixelAt (2, 250), inside) < 1.05);

    box.exitModalState (0);
    box.setVisible (false);
    WindowRig::settle (200);
    CHECK (brightness (w.stage->painted(), corner) > 0.9 * brightness (before, corner));   // pictures of presets may have come meanwhile
}

TEST_CASE ("a recording to fit is chosen in the folder of the last one, or else in the folder of the user", "[app][files][fit]")
{
    const TemporaryFolder mine;
    const Environment own_is { "TACTUS_GRAPHS", mine.path() };
    WindowRig w ("dry_wood.json");
    const auto begin = [&] {
        w.key ("ctrl + k");
        w.stage->type ("fit a recording");
        w.key ("return");
        REQUIRE (isDialogOpen());
        const auto folder = browserIn (*juce::Component::getCurrentlyModalComponent())->getRoot().getFullPathName().toStdString();
        w.key ("escape");
        REQUIRE (waitFor ([] { return ! isDialogOpen(); }));
        return std::filesystem::path (folder);
    };
    CHECK (std::filesystem::equivalent (begin(), mine.path()));
    w.home.write ("strokes.csv", "t,x,force\n0,0,0\n1,1,1\n");
    w.view->open (w.home / "strokes.csv");   // as if it had been dropped on the window
    w.key ("escape");
    CHECK (std::filesystem::equivalent (begin(), w.home.path()));
}

TEST_CASE ("a dialog begins in the folder in which a file of its kind was last chosen, also after a restart", "[app][files]")
{
    const TemporaryFolder mine, elsewhere;
    const Environment own_is { "TACTUS_GRAPHS", mine.path() };
    WindowRig w ("dry_wood.json");
    const auto folderOf = [&] (bool saves, const char* name) {
        w.view->chooseFile (saves, mine / name, [] (const std::filesystem::path&) {});
        REQUIRE (isDialogOpen());
        const auto folder = browserIn (*juce::Component::getCurrentlyModalComponent())->getRoot().getFullPathName().toStdString();
        w.key ("escape");
        REQUIRE (waitFor ([] { return ! isDialogOpen(); }));
        return std::filesystem::path (folder);
    };
    CHECK (std::filesystem::equivalent (folderOf (false, "take.jsonl"), mine.path()));
    std::filesystem::path chosen;
    w.view->chooseFile (true, mine / "test.jsonl", [&] (const std::filesystem::path& file) { chosen = file; });
    w.stage->type ((elsewhere / "press.jsonl").string());
    w.key ("return");
    REQUIRE (waitFor ([&] { return chosen == elsewhere / "press.jsonl"; }));
    for (const bool is_again : { false, true })
    {
        if (is_again)
        {
            w.view.reset();
            w.begin ({ .home = w.home.path() });
        }
        CHECK (std::filesystem::equivalent (folderOf (false, "take.jsonl"), elsewhere.path()));
        CHECK (std::filesystem::equivalent (folderOf (true, "test.jsonl"), elsewhere.path()));
        CHECK (std::filesystem::equivalent (folderOf (true, "gesture.csv"), mine.path()));   // another kind
    }
}

TEST_CASE ("an existing folder of stems is chosen by its name, after a question, and not entered", "[app][files][stems]")
{
    const TemporaryFolder mine;
    std::filesystem::create_directories (mine / "bell");
    mine.write ("bell/tactus_stems.txt", "mix.wav\n");
    std::filesystem::create_directories (mine / "empty");
    WindowRig w ("dry_wood.json");
    std::filesystem::path chosen;
    const auto ask = [&] (const juce::String& name) {
        chosen.clear();
        w.view->chooseFile (true, mine / "Dry wood stems", [&] (const std::filesystem::path& folder) { chosen = folder; });
        REQUIRE (isDialogOpen());
        const auto* field = dynamic_cast<juce::TextEditor*> (WindowRig::focused());
        REQUIRE (field != nullptr);
        CHECK (field->getText() == "Dry wood stems");
        w.stage->type (name);
    };
    const auto isAsked = [&] { return w.view->asked().isOpen(); };
    SECTION ("by Return, and by its path")
    {
        ask (GENERATE (false, true) ? juce::String ((mine / "bell").string()) : juce::String ("bell"));
        w.key ("return");
        REQUIRE (waitFor (isAsked));
        CHECK_FALSE (isDialogOpen());
        CHECK (w.view->asked().title() == "Replace bell?");
        CHECK (w.view->asked().text().endsWith ("clips of its last export are deleted; your own files in it stay."));
        CHECK (chosen.empty());
        SECTION ("replaced")
        {
            w.click ("Replace");
            CHECK (chosen == mine / "bell");
        }
        SECTION ("named again, beside it")
        {
            w.click ("Choose another name ...");
            REQUIRE (isDialogOpen());
            auto* dialog = juce::Component::getCurrentlyModalComponent();
            CHECK (nameField (*dialog)->getText() == "bell");
            CHECK (browserIn (*dialog)->getRoot() == juce::File (mine.path().string()));
            w.stage->type ("gong");
            w.key ("return");
            CHECK (waitFor ([&] { return chosen == mine / "gong"; }));
        }
    }
    SECTION ("by the button")
    {
        ask ("bell");
        w.click ("Choose");
        REQUIRE (waitFor (isAsked));
        w.click ("Replace");
        CHECK (chosen == mine / "bell");
    }
    SECTION ("a folder without stems needs no question")
    {
        ask ("empty");
        w.key ("return");
        CHECK (waitFor ([&] { return chosen == mine / "empty"; }));
        CHECK_FALSE (isAsked());
    }
}
