// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "environment.hpp"
#include "stage.hpp"
#include "support/temporary_folder.hpp"

#include <host/app/window/main_view.hpp>

#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace tactus::host::test
{

/// Someone who does random things in the window, in random order. Has the whole window, with its own home folder and a copy of the
/// presets that may be overwritten. The seed determines what is done, as far as it does not depend on time.
class Monkey
{
public:
    explicit Monkey (unsigned seed);
    ~Monkey();

    /// Performs a random action. Returns its description.
    std::string act();

    /// Lets the window work for this time, then closes dialogs of JUCE.
    void poll (int ms);

    void paint();

    /// Closes all menus and dialogs.
    void settle();

private:
    TemporaryFolder folder;
    const std::filesystem::path presets = folder / "graphs", own = folder / "own", home = folder / "home";
    const Environment presets_are { "TACTUS_PRESETS", presets }, own_is { "TACTUS_GRAPHS", own }, home_is { "HOME", folder.path() };
    std::vector<std::filesystem::path> shipped;
    std::mt19937 dice;
    juce::ScopedJuceInitialiser_GUI gui;
    Look look;

public:
    std::optional<Stage> stage;
    std::unique_ptr<MainView> view;

private:
    int upTo (int n) { return n <= 0 ? 0 : static_cast<int> (dice() % static_cast<unsigned> (n)); }   // 0…n-1
    float part() { return static_cast<float> (upTo (1000)) / 1000.0f; }

    template <typename C>
    auto& oneOf (C&& all)
    {
        return all[static_cast<std::size_t> (upTo (static_cast<int> (std::size (all))))];
    }

    void begin();
    std::filesystem::path someFile (bool saves);
    bool isAtHome (const std::filesystem::path& file) const { return file.string().starts_with (folder.path().string()); }

    // The actions return their descriptions.

    /// Closes and reopens the window: either normally, or by a simulated crash with something to recover.
    std::string beginAgain();

    //==========================================================================
    // monkey_mouse.cpp
    juce::Point<float> anywhere();
    static juce::String coordinates (juce::Point<float> p);
    int someButton();
    int someKeys();
    juce::Component* something();               ///< a random visible component without children
    juce::Point<float> in (juce::Component&);   ///< a random place in a component
    static std::string describe (juce::Component&);
    std::string clickAt (juce::Point<float> at);
    std::string dragFromTo (juce::Point<float> from, juce::Point<float> to);
    std::string clickAnywhere();
    std::string dragAnywhere();
    std::string clickSomething();
    std::string dragSomething();
    std::string wheel();
    std::string drop();

    //==========================================================================
    // monkey_canvas.cpp
    void focusCanvas();
    juce::Point<float> onCanvas (juce::Point<float> of_scene);
    juce::Point<float> onNode (const SceneNode&, bool title);
    const SceneNode* someNode();
    std::string drawWire();
    std::string dragOnNode();
    std::string clickOnCanvas();
    std::string canvasKey();
    std::string group();
    std::string enter();
    std::string rename();   ///< in any patch, as the history and the inspector can do while another patch is shown
    const NodeType& someType();
    std::string addByPalette();
    std::string addDirectly();

    //==========================================================================
    // monkey_window.cpp
    std::string windowKey();
    std::string typeSomewhere();
    std::string wait();
    std::string resize();
    std::string openFile();
    std::string preview();
    std::string startOrStop();
    std::string goInHistory();
    std::string compose();     ///< adds a preset, mixes, pastes as a layer, modulates, varies values, exports stems
    std::string turnDepth();   ///< drags the ring of a modulation, or a strip of the mixer, in the inspector and on the knobs
    std::string chooseInMenu();
    std::string answer();
};

}   // namespace tactus::host::test
