// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "window_rig.hpp"

#include <host/app/take/take_panel.hpp>

#include <filesystem>
#include <functional>
#include <string>

namespace tactus::host::test
{

/// A window with a graph that runs. Files are saved in a folder of the test under the names that the window proposes.
struct ClosingWindow
{
    TemporaryFolder folder;
    WindowRig w;
    int closed = 0;
    std::filesystem::path chosen;   // the latest file

    explicit ClosingWindow (const std::string& preset = "dry_wood.json") : w (preset, 1280, 720, false)
    {
        w.view->chooseFile = [this] (bool, const std::filesystem::path& begin, const std::function<void (const std::filesystem::path&)>& then) {
            chosen = folder / begin.filename().string();
            then (chosen);
        };
    }
    ~ClosingWindow()
    {
        if (w.view) w.view->run().letGo();
    }

    Question& question() { return w.view->asked(); }
    FilmButton& film() { return w.view->part<HandPanel>().film(); }
    Take& take() { return w.view->part<TakePanel>().take(); }
    void close()
    {
        w.view->closeWhenSaved ([this] { ++closed; });
    }

    void filmSomething()
    {
        film().begin();
        REQUIRE (waitFor ([&] { return film().filmed() > 0.3; }));
    }

    /// Whether a film is being saved changes only while messages are handled.
    void saveFilm()
    {
        filmSomething();
        film().end();
        REQUIRE (film().isSaving());
    }

    void record()
    {
        w.click ("Take");
        w.click ("Record");
        REQUIRE (waitFor ([&] { return take().state() == Take::State::recording && w.view->part<TakePanel>().plot().length() > 0.05; }));
    }

    void stopRecording()
    {
        w.click ("Stop");
        REQUIRE (waitFor ([&] { return take().state() == Take::State::ready; }));
    }
};

}   // namespace tactus::host::test
