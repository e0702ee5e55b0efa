// SPDX-License-Identifier: GPL-3.0-or-later
// Closing the window or opening another graph loses no film without a question. For takes, see take/kept_take_test.cpp.
#include "host/app/support/closing_window.hpp"

#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::ClosingWindow;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;
namespace fs = std::filesystem;

TEST_CASE ("closing while a film is being saved waits for it, with progress", "[app][closing]")
{
    ClosingWindow c;
    c.saveFilm();
    c.close();
    REQUIRE (c.question().isOpen());
    CHECK (c.closed == 0);
    CHECK (c.question().title() == "A film is being saved");
    CHECK (c.question().getDescription().contains (" %"));
    SECTION ("by a choice, with the question closed")
    {
        c.question().answer (0);
        CHECK_FALSE (c.question().isOpen());
        CHECK (c.closed == 0);
    }
    SECTION ("with the question open") {}
    REQUIRE (waitFor ([&] { return c.closed > 0; }));
    CHECK_FALSE (c.film().isSaving());
    const auto table = readTable (filmFile (c.chosen, ".csv"));
    REQUIRE (table);
    CHECK (table->rows() > 100);
    CHECK (fs::exists (filmFile (c.chosen, ".png")));
    WindowRig::settle (100);
    CHECK (c.closed == 1);
}

TEST_CASE ("Cancel keeps the window, and the film is saved, and so does a film that cannot be saved", "[app][closing]")
{
    ClosingWindow c;
    SECTION ("cancelled")
    {
        c.saveFilm();
        c.close();
        c.w.stage->key ("escape");
        REQUIRE (waitFor ([&] { return ! c.film().isSaving(); }));
        CHECK (c.film().isSaved());
        CHECK (fs::exists (c.chosen));
    }
    SECTION ("failed")
    {
        c.folder.write ("in the way", "");
        c.w.view->chooseFile = [&] (bool, const fs::path&, const std::function<void (const fs::path&)>& then) { then (c.folder / "in the way" / "film.png"); };
        c.saveFilm();
        c.close();
        REQUIRE (waitFor ([&] { return ! c.film().isSaving(); }));
        CHECK_FALSE (c.film().isSaved());
        CHECK (c.w.view->statusText().isNotEmpty());   // why
        CHECK (c.film().unsaved() > 0.0);
    }
    WindowRig::settle (100);
    CHECK_FALSE (c.question().isOpen());
    CHECK (c.closed == 0);
}

TEST_CASE ("a film that was filmed is kept until it is saved, whatever the user cancels, and closing asks about it", "[app][closing]")
{
    ClosingWindow c;
    const auto save = c.w.view->chooseFile;
    c.w.view->chooseFile = [] (bool, const fs::path&, const auto&) {};   // Cancel
    c.filmSomething();
    c.film().end();
    CHECK_FALSE (c.film().isSaving());
    const double length = c.film().unsaved();
    CHECK (length > 0.3);

    c.close();
    REQUIRE (c.question().title().startsWith ("Save the film"));
    c.question().answer (2);   // Cancel
    CHECK (c.closed == 0);

    c.folder.write ("in the way", "");
    c.w.view->chooseFile = [&] (bool, const fs::path&, const std::function<void (const fs::path&)>& then) { then (c.folder / "in the way" / "film.png"); };
    c.film().saveKept();
    REQUIRE (waitFor ([&] { return ! c.film().isSaving(); }));
    CHECK (c.w.view->statusText().contains ("keeps the film"));
    CHECK (c.film().unsaved() == length);

    c.w.view->chooseFile = save;
    c.close();
    c.question().answer (0);   // Save
    REQUIRE (c.question().title() == "A film is being saved");
    c.question().answer (0);
    REQUIRE (waitFor ([&] { return c.closed == 1; }));
    const auto table = readTable (filmFile (c.chosen, ".csv"));
    REQUIRE (table);
    CHECK (table->rows() > 100);
}

TEST_CASE ("a film can be discarded at closing, and what was changed while it was saved is asked about", "[app][closing]")
{
    ClosingWindow c;
    SECTION ("discarded")
    {
        c.saveFilm();
        c.close();
        c.question().answer (1);
        CHECK (c.closed == 1);
    }
    SECTION ("an answer about the graph counts")
    {
        REQUIRE (c.w.view->document().perform (graph::SetHeader { .about = "before" }));
        c.saveFilm();
        c.close();
        c.question().answer (1);   // Don't save
        REQUIRE (c.question().title() == "A film is being saved");
        REQUIRE (waitFor ([&] { return c.closed > 0; }));
    }
    SECTION ("until the graph is changed")
    {
        c.saveFilm();
        c.close();
        c.question().answer (0);
        REQUIRE (c.w.view->document().perform (graph::SetHeader { .about = "meanwhile" }));
        REQUIRE (waitFor ([&] { return c.question().isOpen(); }));
        CHECK (c.question().title().startsWith ("Save changes to"));
        CHECK (c.closed == 0);
        c.question().answer (1);
        CHECK (c.closed == 1);
    }
}

TEST_CASE ("what is being filmed is saved before the window closes or another graph is opened", "[app][closing]")
{
    ClosingWindow c;
    c.filmSomething();
    SECTION ("closing, and Cancel")
    {
        c.close();
        REQUIRE (c.question().title().startsWith ("Save the film"));
        c.w.stage->key ("escape");
        WindowRig::settle();
        CHECK (c.film().isFilming());
        CHECK (c.closed == 0);
    }
    SECTION ("closing, and Save")
    {
        c.close();
        c.question().answer (0);
        REQUIRE (c.question().title() == "A film is being saved");
        REQUIRE (waitFor ([&] { return c.closed > 0; }));
        CHECK (fs::exists (c.chosen));
    }
    SECTION ("another graph")
    {
        c.w.view->open (TACTUS_SOURCE_DIR "/graphs/soft_pad.json");
        CHECK (c.w.graph().name == "Soft pad");
        CHECK_FALSE (c.film().isFilming());
        REQUIRE (waitFor ([&] { return ! c.film().isSaving(); }));
        const auto table = readTable (filmFile (c.chosen, ".csv"));
        REQUIRE (table);
        CHECK (table->rows() > 100);
    }
}
