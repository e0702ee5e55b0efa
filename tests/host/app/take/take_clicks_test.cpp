// SPDX-License-Identifier: GPL-3.0-or-later
// The Take panel beside the hand, with a mouse.
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/lowest_place.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/layers/layers_panel.hpp>
#include <host/app/run/views/safety_strip.hpp>
#include <host/app/take/take_panel.hpp>
#include <host/app/top_bar/top_bar.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <filesystem>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::latestStep;
using tactus::host::test::lowest;
using tactus::host::test::OnStage;
using tactus::host::test::waitFor;

TEST_CASE ("undo of another hand starts nothing that a person has stopped", "[app][take][safety]")
{
    DeskStage w ("dry_wood.json");
    auto& run = w.playback.run();
    auto& panel = w.show<TakePanel> (takesPanel);
    w.desk.chooseFile = [&] (bool, const std::filesystem::path& begin, const auto& chosen) { chosen (w.home / begin.filename().string()); };
    REQUIRE (w.start());
    w.click ("Record");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::recording && panel.plot().length() > 0.05; }));
    w.click ("Stop");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready; }));
    w.click ("Make a gesture...");
    REQUIRE (waitFor ([&] { return w.question.isOpen(); }));
    w.click ("Use now");
    REQUIRE (run.hand().kind == LiveRun::Hand::Kind::path);
    w.playback.stop();
    w.key ("ctrl + z");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::described);
    CHECK_FALSE (run.isWanted());
    w.key ("ctrl + y");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::path);
    CHECK_FALSE (run.isWanted());
}

TEST_CASE ("Record starts nothing that a person has stopped: the take begins with START", "[app][take][safety]")
{
    DeskStage w ("dry_wood.json");
    auto& run = w.playback.run();
    auto& panel = w.show<TakePanel> (takesPanel);
    REQUIRE (w.start());
    w.playback.stop();
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    w.click ("Record");
    DeskStage::settle();
    CHECK_FALSE (run.isWanted());
    CHECK_FALSE (run.isRunning());
    CHECK (panel.take().state() == Take::State::recording);
    w.click ("Stop");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::empty; }));   // nothing was recorded
    w.click ("Record");
    REQUIRE (w.start());
    REQUIRE (waitFor ([&] { return run.isLogged() && panel.plot().length() > 0.05; }));
    w.click ("Stop");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready; }));
    CHECK (panel.take().seconds() > 0.05);
}

TEST_CASE ("a take shows its curve while it records, Stop ends the take and not the graph, and what is saved can be used at once", "[app][take]")
{
    DeskStage w ("dry_wood.json");
    setenv ("TACTUS_GRAPHS", w.home.path().c_str(), 1);
    auto& run = w.playback.run();
    const auto layers = layersPanel (w.desk);   // adds clips
    auto& panel = w.show<TakePanel> (takesPanel);
    w.desk.chooseFile = [&] (bool, const std::filesystem::path& begin, const auto& chosen) { chosen (w.home / begin.filename().string()); };
    REQUIRE (w.start());
    const auto ticks = [&] { return run.status() ? run.status()->ticks : 0; };
    const auto says = [&] (const char* button, const char* beginning) {
        auto* b = OnStage::buttonIn (panel, button);
        return b != nullptr && b->getTooltip().startsWith (beginning);
    };
    CHECK (says ("Record", "Start the run again"));
    w.click ("Record");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::recording && panel.plot().length() > 0.05; }));
    CHECK (says ("Stop", "End the recording"));
    w.click ("Stop");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready; }));
    CHECK (run.isRunning());
    const auto before = ticks();
    CHECK (waitFor ([&] { return ticks() > before + 400; }));
    CHECK (panel.plot().length() > 0.05);

    w.click ("Make a gesture...");
    REQUIRE (waitFor ([&] { return w.question.isOpen(); }));
    w.click ("Use now");
    CHECK (run.hand().kind == LiveRun::Hand::Kind::path);
    CHECK (run.hand().path == (w.home / "gesture.csv").string());
    w.key ("ctrl + z");   // the previous hand moves the tool again, and the take stays
    CHECK (run.hand().kind == LiveRun::Hand::Kind::described);
    OnStage::settle (200);
    CHECK_FALSE (w.question.isOpen());
    CHECK (panel.take().state() == Take::State::ready);
    CHECK (panel.plot().length() > 0.05);
    w.key ("ctrl + z");   // and then the take
    CHECK (panel.take().state() == Take::State::empty);
    OnStage::settle (200);
    CHECK_FALSE (w.question.isOpen());
    w.key ("ctrl + y");
    w.key ("ctrl + y");
    CHECK (run.hand().path == (w.home / "gesture.csv").string());
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready && panel.plot().length() > 0.05; }));

    w.click ("Make a test...");
    REQUIRE (waitFor ([&] { return w.question.isOpen(); }));
    w.click ("Use now");
    REQUIRE (waitFor ([&] { return w.question.isOpen(); }));
    CHECK (w.question.getTitle().contains ("passes"));
    w.click ("Close");

    w.click ("Make a clip...");
    REQUIRE (waitFor ([&] { return w.question.isOpen(); }));
    const auto named = w.question.getDescription().fromFirstOccurrenceOf ("set the gain of signal.clip to ", false, false);
    w.click ("Use now");
    const auto clip = std::ranges::find (w.graph().root.nodes, "signal.clip", &graph::Node::type);
    REQUIRE (clip != w.graph().root.nodes.end());
    CHECK (clip->settings.at ("clip").asString().ends_with ("take.wav"));
    const auto gain = clip->params.at ("gain").asString();   // as strong as it was recorded
    INFO (gain << " | " << named);
    CHECK (gain.ends_with (" N"));
    CHECK ((named.isEmpty() ? gain == "1 N" : named.startsWith (juce::String (gain).dropLastCharacters (2))));
    run.letGo();
    unsetenv ("TACTUS_GRAPHS");
}

namespace
{
/// The panel beside the hand, which records a take of the running graph.
struct Recorder
{
    DeskStage w { "dry_wood.json" };
    LiveRun& run { w.playback.run() };
    TakePanel& panel { w.show<TakePanel> (takesPanel) };
    Take& take { panel.take() };

    Recorder()
    {
        w.showHand();
        REQUIRE (w.start());
        record();
    }

    void record()
    {
        w.click ("Record");
        REQUIRE (waitFor ([&] { return run.isLogged() && hasCurve(); }));
    }

    bool hasCurve() { return panel.plot().length() > 0.05; }
    bool isReady() { return take.state() == Take::State::ready && hasCurve(); }

    /// The mouse goes down right of the middle of the surface, and stays down.
    void press()
    {
        auto* surface = w.titled ("Surface");
        REQUIRE (surface != nullptr);
        w.stage->hold();
        w.stage->move (w.middleOf (*surface).translated (60.0f, 0.0f));
        w.stage->press();
    }

    /// Chooses from the list of takes.
    void choose (int steps) { w.choose (w.middleOf (*w.titled ("Takes")), steps, juce::ModifierKeys::leftButtonModifier); }
};
}   // namespace

TEST_CASE ("a press on the surface during a take takes the tool: the take begins again, and the one before stays in the list", "[app][take]")
{
    Recorder r;
    REQUIRE (r.run.hand().kind == LiveRun::Hand::Kind::described);
    const auto first = r.take.recorded();
    r.press();
    REQUIRE (waitFor ([&] { return r.take.recorded() != first; }));
    CHECK (r.run.hand().kind == LiveRun::Hand::Kind::pointer);
    CHECK (r.take.state() == Take::State::recording);
    CHECK (r.w.status.text().contains ("so does the take"));
    CHECK (first->length_s > 0.05);
    REQUIRE (waitFor ([&] { return r.hasCurve() && r.run.tool() && r.run.tool()->position.z() < -0.1e-3; }));
    const double x = r.run.tool()->position.x();
    CHECK (x > 5e-3);
    r.w.stage->release();
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.run.isRunning());
    CHECK (r.take.seconds() == r.panel.plot().length());
    CHECK (r.panel.unsaved() == std::vector { first, r.take.recorded() });
    const auto place = lowest (r.take.log(), r.take.program);   // what the mouse did
    CHECK (place.z() < -0.1e-3);
    CHECK (place.x() == Approx (x).margin (0.01));

    r.choose (1);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.take.recorded() == first);
    CHECK (r.take.seconds() == r.panel.plot().length());
    CHECK (latestStep (r.w.document) == "record a take");
    r.w.key ("ctrl + z");
    r.w.key ("ctrl + z");
    CHECK (r.take.state() == Take::State::empty);
    CHECK (r.panel.unsaved().size() == 2);
}

TEST_CASE ("a take that was undone is not lost by the next edit", "[app][take][undo]")
{
    Recorder r;
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    const auto take = r.take.recorded();
    r.w.key ("ctrl + z");
    CHECK (r.take.state() == Take::State::empty);
    REQUIRE (r.w.document.perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));   // there is nothing to redo
    REQUIRE (r.w.document.history().position() == r.w.document.history().size());
    r.choose (1);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.take.recorded() == take);
}

TEST_CASE ("an undo during a take keeps what was recorded", "[app][take][undo]")
{
    Recorder r;
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    r.record();
    r.w.key ("ctrl + z");
    CHECK (r.take.state() == Take::State::empty);
    CHECK (r.run.isRunning());
    CHECK (r.w.status.text().contains ("list of takes"));
    CHECK (r.panel.unsaved().size() == 2);
    r.choose (2);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.take.recorded() == r.panel.unsaved().back());
}

TEST_CASE ("a take that ends with the run says so, and has the length of what it holds", "[app][take]")
{
    Recorder r;
    const bool is_by_other = GENERATE (false, true);   // another graph, which does not show it
    is_by_other ? r.w.openAndStart ("soft_pad.json") : r.w.playback.stop();
    REQUIRE (waitFor ([&] { return is_by_other ? r.take.state() == Take::State::empty : r.isReady(); }));
    CHECK (r.w.status.text().contains ("ended with the run"));
    CHECK (r.take.seconds() == r.panel.plot().length());
    CHECK (r.panel.unsaved().size() == 1);
}

TEST_CASE ("a take can be undone, which brings back the one before", "[app][take]")
{
    auto rig = std::make_unique<DeskStage> ("dry_wood.json");
    auto& w = *rig;
    auto& panel = w.show<TakePanel> (takesPanel);
    REQUIRE (w.start());
    const auto record = [&] (double seconds) {
        w.click ("Record");
        REQUIRE (waitFor ([&] { return std::filesystem::exists (panel.take().log()); }));   // the run has begun again
        REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::recording && panel.plot().length() > seconds; }));
        w.click ("Stop");
        REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready; }));
        return std::pair (panel.take().log(), panel.plot().length());
    };
    const auto shows = [&] (const std::pair<std::filesystem::path, double>& take) {
        return waitFor ([&] { return panel.take().state() == Take::State::ready && panel.plot().length() == take.second; }) && panel.take().log() == take.first
               && std::filesystem::exists (take.first);
    };
    const auto first = record (0.05), second = record (0.05);
    CHECK (first.first != second.first);
    const auto graph = &w.graph();
    w.document.undo();
    CHECK (shows (first));
    CHECK (&w.graph() == graph);
    w.document.undo();
    CHECK (panel.take().state() == Take::State::empty);
    CHECK (panel.plot().length() == 0.0);
    w.document.goTo (w.document.history().names().size());
    CHECK (shows (second));
    w.document.undo();
    CHECK (shows (first));
    const auto third = record (0.05);   // in place of the second one, which stays in the list
    CHECK (shows (third));
    CHECK (std::filesystem::exists (second.first));
    CHECK (std::filesystem::exists (first.first));
    rig.reset();
    CHECK_FALSE (std::filesystem::exists (third.first));
    CHECK_FALSE (std::filesystem::exists (second.first));
    CHECK_FALSE (std::filesystem::exists (first.first));
}

TEST_CASE ("a take is saved from the list, and opened again, also with another graph", "[app][take]")
{
    Recorder r;
    bool saves = false;
    auto file = r.w.home / "wood.jsonl";
    r.w.desk.chooseFile = [&] (bool to_save, const std::filesystem::path& begin, const auto& chosen) {
        saves = to_save;
        CHECK (begin.filename() == "take.jsonl");
        chosen (file);
    };
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    const double length = r.panel.plot().length();
    const auto port = r.panel.port();
    r.choose (2);
    CHECK (saves);
    REQUIRE (std::filesystem::exists (file));
    CHECK (r.panel.unsaved().empty());

    r.w.openAndStart ("layered_cloth.json");
    r.choose (2);   // there is no take to save
    CHECK_FALSE (saves);
    REQUIRE (waitFor ([&] { return r.isReady() && r.take.log() == file; }));
    CHECK (r.panel.plot().length() == length);
    CHECK (r.take.seconds() == length);
    CHECK (r.panel.port() == port);
    CHECK (r.take.role() == "stylus");
    CHECK (r.panel.unsaved().empty());

    file = r.w.home / "broken.jsonl";
    r.w.home.write ("broken.jsonl", "{}\n");
    r.choose (4);
    REQUIRE (r.w.question.isOpen());
    CHECK (r.w.question.title() == "Cannot open broken.jsonl");
    CHECK (r.w.question.getDescription().contains ("broken.jsonl:1"));
    r.w.click ("Close");
    CHECK (r.take.log() != file);
    CHECK (r.isReady());
    r.w.panel.reset();
    CHECK (std::filesystem::exists (r.w.home / "wood.jsonl"));   // the file of the user
}

TEST_CASE ("a take is compared with later ones: its curve stays behind theirs, in grey", "[app][take]")
{
    Recorder r;
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    const auto texts = [&] {
        juce::StringArray all;
        for (const auto& t : tactus::host::test::readTexts (r.panel.plot()))
            all.add (t.text);
        return all.joinIntoString (" ");
    };
    CHECK_FALSE (texts().contains ("grey:"));
    r.choose (4);   // its own name, save, open, compare
    REQUIRE (r.panel.plot().hasPinned());
    r.record();
    r.w.click ("Stop");
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    const auto port = r.panel.port();
    CHECK (texts().contains ("grey: Take 1, " + port));
    r.panel.showPort ("hand.position");   // in another unit
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK_FALSE (texts().contains ("grey:"));
    r.panel.showPort (port);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (texts().contains ("grey: Take 1"));
    r.choose (5);   // two takes now
    CHECK_FALSE (r.panel.plot().hasPinned());
    CHECK_FALSE (texts().contains ("grey:"));
}

TEST_CASE ("another graph does not show the take of the one before, which stays in the list under the name of its graph", "[app][take]")
{
    const bool still_records = GENERATE (false, true);
    Recorder r;
    if (! still_records)
    {
        r.w.click ("Stop");
        REQUIRE (waitFor ([&] { return r.isReady(); }));
    }
    r.w.openAndStart ("layered_cloth.json");
    REQUIRE (waitFor ([&] { return r.take.state() == Take::State::empty; }));
    CHECK (r.panel.plot().length() == 0.0);
    REQUIRE (r.panel.unsaved().size() == 1);
    REQUIRE (waitFor ([&] { return r.run.isRunning(); }));
    OnStage::settle (100);
    CHECK (r.take.state() == Take::State::empty);
    CHECK (r.panel.nameOf (0).contains ("not saved (Dry wood)"));
    r.choose (1);
    REQUIRE (waitFor ([&] { return r.isReady(); }));
    CHECK (r.take.recorded() == r.panel.unsaved()[0]);
    CHECK (r.w.graph().name != "Dry wood");
}

TEST_CASE ("the labels of a take are whole in a small window", "[app][small][take]")
{
    const auto [width, height] = GENERATE (std::pair (512, 350), std::pair (640, 360), std::pair (1280, 720));
    INFO (width << " x " << height);
    DeskStage w ("dry_wood.json", width, height);
    auto& panel = w.show<TakePanel> (takesPanel);
    const int around = SafetyStrip::height + TopBar::height + StatusLine::height;   // as in a window of this size
    panel.setSize (width < 680 ? width / 2 : width - 420, (width < 680 ? height - around : w.panel_height) - Tabs::row_height);
    REQUIRE (w.start());
    const auto checkLabels = [&] (const std::vector<std::array<juce::String, 2>>& wanted) {
        const auto texts = host::test::readTexts (panel);
        CHECK (host::test::cutOff (texts, panel.getLocalBounds().toFloat()).joinIntoString ("; ") == "");
        CHECK (host::test::overlaps (texts, panel.getLocalBounds().toFloat()).joinIntoString ("; ") == "");
        for (const auto& either : wanted)
        {
            INFO (either[0]);
            CHECK (std::ranges::any_of (texts, [&] (const auto& t) { return t.text == either[0] || t.text == either[1]; }));
        }
        for (const auto& t : texts)
            CHECK_FALSE ((t.text.endsWith ("...") && ! t.text.startsWithIgnoreCase ("make a") && ! t.text.startsWith ("Clip") && ! t.text.startsWith ("Gesture")
                          && ! t.text.startsWith ("Test")));   // shortened, because it does not fit
    };
    w.click ("Record");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::recording && panel.plot().length() > 0.05; }));
    checkLabels ({ { "Stop", "Stop" }, { "motor.force", "motor.force" } });
    w.click ("Stop");
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready; }));
    OnStage::settle (100);
    std::vector<std::array<juce::String, 2>> all { { "Record", "Record" }, { "motor.force", "motor.force" }, { "from", "from" }, { "until", "until" } };
    for (const auto* what : { "clip", "gesture", "test" })
    {
        const juce::String name (what);
        all.push_back ({ "Make a " + name + "...", name.substring (0, 1).toUpperCase() + name.substring (1) + "..." });
    }
    checkLabels (all);
}
