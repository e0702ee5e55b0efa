// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <host/app/dialogs/question.hpp>
#include <host/app/presets/picture_store.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/run/limit_watch.hpp>
#include <host/app/run/playback.hpp>
#include <host/app/scene/reach.hpp>
#include <host/app/storage/settings.hpp>
#include <host/base/platform/preset_folder.hpp>

namespace tactus::host
{

/// The things that the panels of a window share: what they show, what they ask the window for, and what they offer each other. A function does nothing, or
/// returns nothing, until the window or a panel has set it, so a test sets those that its panel needs. All of it outlives the panels. [main thread]
struct Desk
{
    using Path = std::filesystem::path;
    using TakePath = std::function<void (const Path&)>;
    using Ports = std::vector<std::string>;   ///< full paths, as scopes name them: "grain/wave.value"

    const Catalogue& types;
    Document& document;
    Canvas& canvas;   ///< the patch that is shown, and what is selected in it
    Playback& playback;
    DeviceSetup& devices;
    LimitWatch& limits;
    Settings& settings;
    PictureStore& pictures;
    Question& question;
    std::string program {};   ///< this program and its version, as logs state it
    Path session {};          ///< where files are kept that a crash leaves; empty if it leaves nothing

    // The window sets these.
    std::function<void (const juce::String&)> hint = [] (const auto&) {};     ///< in the status line, while the pointer stays; empty: ends the hint
    std::function<void (const juce::String&)> notify = [] (const auto&) {};   ///< in the status line, until the next notice
    std::function<void (const juce::String&)> refuse = [] (const auto&) {};   ///< why something was not done; it comes before hints for a while
    std::function<void()> settingsChanged = [] {};                            ///< they are saved soon
    std::function<Messages()> liveMessages = [] { return Messages(); };       ///< about plugins whose code is watched

    /// Asks for a file to open or to save, beginning with a folder or a file. Calls back unless the user cancels.
    std::function<void (bool saves, const Path& begin, TakePath)> chooseFile = [] (bool, const auto&, const auto&) {};
    /// Asks for a file that a setting names, beginning with a folder; empty: that of the user.
    std::function<void (const juce::String& patterns, const Path& begin, TakePath)> chooseInput = [] (const auto&, const auto&, const auto&) {};

    /// Opens a graph; a preset that ships with Tactus as a copy.
    std::function<void (const Path&)> openGraph = [] (const auto&) {};
    /// Opens a graph that has no file. One that is work of the user, such as a fit, is an unsaved change.
    std::function<void (const graph::Graph&, const std::string& step, bool is_work, std::function<void()> then)> openMade = [] (const auto&...) {};
    std::function<void (const Path& preset, bool by_pointer)> feel = [] (const auto&, bool) {};   ///< opens it as a copy, and shows the hand
    std::function<void (const Path&)> preview = [] (const auto&) {};
    std::function<void()> endPreview = [] {};
    std::function<void (const std::string& type)> addNode = [] (const auto&) {};   ///< in the middle of the canvas
    /// Selects a node on the canvas, and brings it into view.
    std::function<void (const std::string& patch, graph::Id)> show = [] (const auto&, graph::Id) {};
    std::function<void()> turnToCanvas = [] {};                                                  ///< in a small window, shows its page
    std::function<void (const juce::Component& panel)> toFront = [] (const auto&) {};            ///< brings the tab of a panel to the front
    std::function<void (const juce::Component& panel)> reveal = [] (const auto&) {};             ///< like toFront(), even if its tabs are folded
    std::function<void()> leave = [] {};                                                         ///< the keyboard goes back to the canvas
    std::function<std::function<void()>()> useDevice = [] { return std::function<void()>(); };   ///< see HandPanel::useDevice()
    /// The edit that makes a layer of a signal. Must be set.
    std::function<Result<graph::Command> (const std::string& sink, const std::string& port)> layerOf {};

    // Panels set these for each other, and for the window.
    std::function<void (const Ports&)> probe = [] (const auto&) {};                        ///< shows or hides them in a scope
    std::function<Ports()> probed = [] { return Ports(); };                                ///< the ports that scopes show
    std::function<std::vector<Preset>()> presets = [] { return std::vector<Preset>(); };   ///< those that Tactus brings
    std::function<void (const Path&)> fitRecording = [] (const auto&) {};
    std::function<void()> showProblems = [] {};                                                          ///< brings the list of problems to the front
    std::function<void (const Path&, std::optional<double> gain)> addClip = [] (const auto&, auto) {};   ///< as a layer, with a gain in N
    /// Copies and shows a take. False if that fails.
    std::function<bool (const Path&)> recoverTake = [] (const auto&) { return false; };
    std::function<std::vector<scene::Reach>()> reaches = [] { return std::vector<scene::Reach>(); };                   ///< where devices can reach
    std::function<void (const std::string& role, const Vec3& origin)> moveOrigin = [] (const auto&, const auto&) {};   ///< of a workspace, in m

    /// The folder where the user saves next: that of the graph, if it is the user's file, or the user's own.
    Path savingFolder() const
    {
        const auto beside = document.file().parent_path();
        return beside.empty() || beside == presetFolder() ? ownFolder() : beside;
    }

    /// Asks where to save a file of the user, with this name at first.
    void chooseOwnFile (const std::string& name, TakePath chosen) const
    {
        const auto folder = savingFolder();
        std::error_code failed;
        std::filesystem::create_directories (folder, failed);
        chooseFile (true, folder / name, std::move (chosen));
    }

    /// A message that the user closes. With `use`, what was made can be used at once.
    void tell (const juce::String& title, const juce::String& text, std::function<void()> use = {}) const
    {
        std::vector<Question::Choice> choices { { TRANS ("Close"), {} } };
        if (use) choices.insert (choices.begin(), { TRANS ("Use now"), std::move (use) });
        question.ask (title, text, std::move (choices));
    }
};

}   // namespace tactus::host
