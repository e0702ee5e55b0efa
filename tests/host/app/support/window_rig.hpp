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
        MainView::StartOptions start { .home = home.path(), .safe = safe };
        if (! preset.empty()) start.files = { std::filesystem::path (TACTUS_SOURCE_DIR "/graphs") / preset };
        begin (start);
    }

    /// Opens another window in place of this one.
    void begin (const MainView::StartOptions& start)
    {
        view = std::make_unique<MainView> (catalogue());
        stage->fill (*view);
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

    /// The node of this name on the canvas.
    const SceneNode& node (const std::string& name)
    {
        const auto& nodes = view->canvas().scene().nodes();
        const auto found = std::ranges::find (nodes, name, &SceneNode::name);
        REQUIRE (found != nodes.end());
        return *found;
    }

    /// The point of the screen at a place of the canvas.
    juce::Point<float> onStage (juce::Point<float> on_canvas) { return stage->getLocalPoint (&view->canvas(), view->canvas().view().toPixels (on_canvas)); }
};

}   // namespace tactus::host::test
