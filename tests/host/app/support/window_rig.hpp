// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "on_stage.hpp"

#include <host/app/window/main_view.hpp>

#include "support/temporary_folder.hpp"

namespace tactus::host::test
{

/// The whole window on a screen, with a mouse and a keyboard that reach only what is visible.
struct WindowRig : OnStage
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    TemporaryFolder home;
    std::unique_ptr<MainView> view;

    /// Opens a preset, or the graph at an absolute path. Without: the welcome page. In safe mode, nothing runs until START. `session`: the devices of the
    /// user, as in the file.
    explicit WindowRig (const std::string& preset = {}, int width = 1280, int height = 720, bool safe = true, const std::string& session = {})
    {
        if (! session.empty()) home.write ("session.json", session);
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        setenv ("TACTUS_PRESETS", TACTUS_SOURCE_DIR "/graphs", 1);
        stage = std::make_unique<Stage> (width, height);
        view = std::make_unique<MainView> (catalogue());
        stage->fill (*view);
        MainView::StartOptions start { .home = home.path(), .safe = safe };
        if (! preset.empty()) start.files = { std::filesystem::path (TACTUS_SOURCE_DIR "/graphs") / preset };
        view->begin (start);
        if (! view->asked().isOpen()) view->grabKeyboardFocus();   // as the program does
        settle();
    }

    ~WindowRig()
    {
        view.reset();
        stage.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    const graph::Graph& graph() { return view->document().graph(); }
};

}   // namespace tactus::host::test
