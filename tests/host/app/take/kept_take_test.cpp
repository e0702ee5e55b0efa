// SPDX-License-Identifier: GPL-3.0-or-later
// Closing the window, opening another graph, or a crash loses no take without a question.
#include "host/app/support/closing_window.hpp"
#include "host/app/support/lowest_place.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::ClosingWindow;
using tactus::host::test::lowest;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;
namespace fs = std::filesystem;

TEST_CASE ("closing asks about a take of which nothing was made, and saves it so that it can be played again", "[app][closing][take]")
{
    ClosingWindow c { "pebbled_leather.json" };   // it reads a picture, which the saved take must find
    c.record();
    const bool is_complete = GENERATE (true, false);
    if (is_complete) c.stopRecording();
    c.close();
    REQUIRE (c.question().isOpen());
    CHECK (c.question().title().startsWith ("Save the take"));
    CHECK (c.question().getDescription().contains ("'tactus capture'"));
    SECTION ("Cancel")
    {
        c.w.key ("escape");
        WindowRig::settle (50);
        CHECK (c.closed == 0);
        CHECK_FALSE (c.w.view->part<TakePanel>().unsaved().empty());
        CHECK ((c.take().state() == Take::State::recording) == ! is_complete);
    }
    SECTION ("Don't save")
    {
        c.question().answer (1);
        CHECK (c.closed == 1);
    }
    SECTION ("Save")
    {
        FileAssets assets;
        Messages warnings;
        Result<Stretch> original { Stretch {} };
        c.w.view->chooseFile = [&, choose = c.w.view->chooseFile] (bool saves, const fs::path& begin, const std::function<void (const fs::path&)>& then) {
            original = readStretch (c.take().log().string(), { .assets = &assets, .program = c.take().program }, warnings);
            choose (saves, begin, then);
        };
        c.question().answer (0);
        CHECK (c.closed == 1);
        CHECK (c.chosen == c.folder / "take.jsonl");
        const auto played = readStretch (c.chosen.string(), { .assets = &assets, .program = c.take().program }, warnings);
        INFO ((played ? "" : describe (played.error())));
        REQUIRE (played);
        REQUIRE (original);
        CHECK (played->ticks() > 40);
        CHECK (played->values == original->values);
        c.close();   // now it is saved
        CHECK (c.closed == 2);
    }
}

TEST_CASE ("a take of which something was made needs no question, a new graph keeps a take, and a new take keeps the one before", "[app][closing][take]")
{
    ClosingWindow c;
    c.record();
    SECTION ("something was made of it")
    {
        c.stopRecording();
        c.w.click ("Make a gesture...");
        REQUIRE (waitFor ([&] { return c.question().isOpen(); }));
        c.w.click ("Close");
        c.close();
        CHECK_FALSE (c.question().isOpen());
        CHECK (c.closed == 1);
    }
    SECTION ("undone")
    {
        c.stopRecording();
        c.w.view->document().undo();
        c.close();
        CHECK (c.question().title().startsWith ("Save the take"));
        CHECK (c.closed == 0);
        c.question().answer (1);
        CHECK (c.closed == 1);
    }
    SECTION ("a new graph")
    {
        const bool is_complete = GENERATE (true, false);
        if (is_complete) c.stopRecording();
        const auto log = c.take().log();
        is_complete ? c.w.key ("ctrl + n") : c.w.view->open (TACTUS_SOURCE_DIR "/graphs/soft_pad.json");
        REQUIRE (waitFor ([&] { return c.take().state() == Take::State::empty; }));   // it is in the list, and not shown
        CHECK (c.w.graph().name != "Dry wood");
        CHECK (c.w.view->part<TakePanel>().unsaved().size() == 1);
        CHECK (fs::exists (log));
        c.close();
        CHECK (c.question().title().startsWith ("Save the take"));
        CHECK (c.closed == 0);
    }
    SECTION ("a new take")
    {
        c.stopRecording();
        const auto first = c.take().log();
        c.record();
        c.stopRecording();
        CHECK (c.take().log() != first);
        c.w.view->document().undo();
        CHECK (c.take().log() == first);
        c.close();
        REQUIRE (c.question().title().startsWith ("Save 2 takes"));
        c.question().answer (0);
        CHECK (c.closed == 1);
        CHECK (fs::exists (c.folder / "take.jsonl"));
        CHECK (fs::exists (c.folder / "take_2.jsonl"));
    }
}

TEST_CASE ("a signal or a crash loses no take: the next start offers it", "[app][take][recovery]")
{
    ClosingWindow c;
    c.record();
    const bool is_crash = GENERATE (false, true), is_complete = GENERATE (false, true);
    INFO ((is_crash ? "crash, " : "signal, ") << (is_complete ? "complete" : "recording"));
    if (is_complete) c.stopRecording();
    REQUIRE (waitFor ([&] { return fs::file_size (c.take().log()) > 10000; }));
    const auto sessions = c.w.home / "sessions";
    const auto own = fs::directory_iterator (sessions)->path();
    if (is_crash)   // what is on the disk now
        fs::copy (own, sessions / "crashed", fs::copy_options::recursive);
    else
        c.w.view->closeSuddenly();
    const auto left = c.take().log();
    c.w.view.reset();
    CHECK (fs::exists (left) == ! is_crash);
    if (is_crash) fs::remove_all (own);

    auto& w = c.w;
    w.begin ({ .home = w.home.path() });
    REQUIRE (w.view->asked().isOpen());
    CHECK (w.view->asked().getDescription().contains ("A take was not saved."));
    w.click ("Recover without running");
    auto& panel = w.view->part<TakePanel>();
    REQUIRE (waitFor ([&] { return panel.take().state() == Take::State::ready && panel.plot().length() > 0.05; }));
    CHECK (panel.unsaved() == std::vector { panel.take().recorded() });
    CHECK (panel.port() == "motor.force");
    CHECK_FALSE (fs::exists (sessions / "crashed"));
    CHECK_FALSE (fs::exists (left));
    CHECK (lowest (panel.take().log(), panel.take().program).z() < 0.01);
    w.view->chooseFile = [&] (bool, const fs::path&, const std::function<void (const fs::path&)>& then) { then (w.home / "gesture.csv"); };
    w.click ("Take");
    w.click ("Make a gesture...");   // as of any other take
    REQUIRE (waitFor ([&] { return w.view->asked().isOpen(); }));
}

TEST_CASE ("a take of which only a gesture was saved is offered after a crash", "[app][take][recovery]")
{
    ClosingWindow c;
    c.record();
    c.stopRecording();
    c.w.click ("Make a gesture...");
    REQUIRE (waitFor ([&] { return c.w.view->asked().isOpen(); }));
    const auto sessions = c.w.home / "sessions";
    const auto own = fs::directory_iterator (sessions)->path();
    fs::copy (own, sessions / "crashed", fs::copy_options::recursive);
    c.w.view.reset();
    fs::remove_all (own);
    c.w.begin ({ .home = c.w.home.path() });
    CHECK (c.w.view->asked().getDescription().contains ("take"));   // a gesture is only its movement
}
