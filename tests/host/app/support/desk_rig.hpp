// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/panel.hpp>
#include <host/app/window/panels.hpp>
#include <tactus/file/graph_file.hpp>

#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <functional>

namespace tactus::host::test
{

/// A desk without a window, for the tests of one panel. It has a graph, a run and devices, and remembers what the panel says.
struct DeskRig
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    struct Default
    {
        explicit Default (Look& l) { juce::LookAndFeel::setDefaultLookAndFeel (&l); }
        ~Default() { juce::LookAndFeel::setDefaultLookAndFeel (nullptr); }
    } as_default { look };

    TemporaryFolder home;
    const int presets_are_set = setenv ("TACTUS_PRESETS", TACTUS_SOURCE_DIR "/graphs", 1);
    Document document;
    Sound sound;
    DeviceSetup devices;
    Playback playback { document, catalogue(), sound, devices, [] {} };
    LimitWatch limits { document, devices, playback.run(), catalogue() };
    Canvas canvas { document, catalogue() };
    Settings settings;
    PictureStore pictures { catalogue() };
    Question question;
    Desk desk { catalogue(), document, canvas, playback, devices, limits, settings, pictures, question };
    juce::String said;   // the latest hint or notice
    std::filesystem::path chosen;
    std::optional<Panel> panel;

    /// A file of graphs/, or one with an absolute path; without, the graph is empty.
    static graph::Graph load (const std::string& preset)
    {
        return preset.empty() ? graph::Graph {} : loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR "/graphs") / preset).graph;
    }

    explicit DeskRig (const std::string& preset = {}) : DeskRig (load (preset)) {}

    explicit DeskRig (graph::Graph g) : document (std::move (g))
    {
        devices.open (home.path());
        canvas.setSize (800, 600);
        const auto say = [this] (const juce::String& text) { said = text; };
        desk.hint = desk.notify = desk.refuse = say;
        desk.chooseFile = [this] (bool, const auto&, const auto& take) { take (chosen); };
        desk.chooseInput = [this] (const auto&, const auto&, const auto& take) { take (chosen); };
    }

    ~DeskRig()
    {
        playback.run().letGo();
        panel.reset();
    }

    template <typename Component>
    Component& make (Panel (*maker) (Desk&))
    {
        panel.emplace (maker (desk));
        panel->component->setSize (800, 300);
        return dynamic_cast<Component&> (*panel->component);
    }

    /// Does the work that the window does many times a second.
    void refresh()
    {
        devices.follow();
        playback.poll();
        limits.poll();
        if (panel && panel->refresh) panel->refresh();
    }
};

}   // namespace tactus::host::test
