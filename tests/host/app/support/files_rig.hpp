// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/temporary_folder.hpp"

#include <host/app/files/files.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <memory>
#include <optional>

namespace tactus::host::test
{

namespace fs = std::filesystem;

inline const fs::path wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json", pad = TACTUS_SOURCE_DIR "/graphs/soft_pad.json";

/// The files of a window, without the window.
struct FilesRig
{
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;
    struct Default
    {
        explicit Default (Look& l) { juce::LookAndFeel::setDefaultLookAndFeel (&l); }
        ~Default() { juce::LookAndFeel::setDefaultLookAndFeel (nullptr); }
    } as_default { look };

    TemporaryFolder folder, own;
    const int own_is_set = setenv ("TACTUS_GRAPHS", own.path().c_str(), 1);
    Document document { graph::Graph {} };
    Question question;
    Settings settings;
    double now = 1000.0;
    bool runs = false, by_pointer = false;
    int starts = 0;
    juce::String notice;
    std::function<void (graph::Graph&)> keep;   // what panels write into a file
    fs::path chosen;                            // the file that the user picks when asked; empty: cancels
    std::unique_ptr<Files> files = make();

    std::unique_ptr<Files> make()
    {
        Files::Callbacks callbacks {
            .notify = [this] (const juce::String& t) { notice = t; },
            .stop = [this] { runs = false; },
            .run = [this] (bool pointer) {
                files->beforeRun();
                runs = true;
                by_pointer = pointer;
                ++starts; },
            .isRunning = [this] { return runs; },
            .isStopped = [this] { return ! runs; },
            .isByPointer = [this] { return by_pointer; },
            .usePointer = [this] { by_pointer = true; },
            .prepare = {},
            .openTake = {},
            .onSettings = [] {},
            .onWrite = [this] (graph::Graph& g) { if (keep) keep (g); },
            .choose = [this] (bool, const fs::path&, const std::function<void (const fs::path&)>& then) {
                if (! chosen.empty()) then (chosen); }
        };
        auto made = std::make_unique<Files> (document, question, settings, std::move (callbacks));
        made->clock = [this] { return now; };
        return made;
    }

    void edit (double mu) { REQUIRE (document.perform (graph::SetParam { "", "drag", "mu", Json (mu) })); }

    /// Reads what another instance would find if this one were killed now.
    std::optional<AutosavedDocument> autosaved() const
    {
        for (const auto& entry : fs::directory_iterator (folder / "sessions"))
            if (const auto text = readTextFile (entry.path() / "kept.json")) return *readAutosave (*text);
        return std::nullopt;
    }
    bool isInTrial() const
    {
        for (const auto& entry : fs::directory_iterator (folder / "sessions"))
            if (fs::exists (entry.path() / "trial")) return true;
        return false;
    }
};

}   // namespace tactus::host::test
