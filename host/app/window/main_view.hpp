// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <host/app/devices_panel/devices_panel.hpp>
#include <host/app/history/history_panel.hpp>
#include <host/app/inspector/inspector.hpp>
#include <host/app/layers/layers_panel.hpp>
#include <host/app/palette/palette.hpp>
#include <host/app/presets/browser.hpp>
#include <host/app/problems/problem_list.hpp>
#include <host/app/run/hand_panel.hpp>
#include <host/app/run/live_feed.hpp>
#include <host/app/run/osc_reach.hpp>
#include <host/app/run/safety_strip.hpp>
#include <host/app/scopes/scope_panel.hpp>
#include <host/app/welcome/help_panel.hpp>
#include <host/app/welcome/welcome_page.hpp>
#include <host/app/window/files.hpp>
#include <host/app/window/question.hpp>
#include <host/app/window/splitter.hpp>
#include <host/app/window/tabs.hpp>
#include <host/app/window/top_bar.hpp>

namespace tactus::host
{

/// All of the window: the safety strip, presets, canvas, inspector, the hand, and a line that says what is under the pointer.
class MainView final : public juce::Component, private Document::Listener, private juce::Timer, private juce::FocusChangeListener, private juce::KeyListener
{
public:
    explicit MainView (const Catalogue&);
    ~MainView() override;

    /// How the program was started.
    struct Start
    {
        std::filesystem::path home;   ///< where settings are, and what is kept for a crash
        bool safe = false;            ///< nothing runs by itself
        bool light = false;           ///< whatever the settings say
        std::vector<std::filesystem::path> files {};
        std::optional<OscListen> osc {};   ///< where to be reached
    };

    /// What only a window does that people see: reads the settings, asks about what a crash left, opens files or welcomes.
    void begin (const Start&);

    /// Opens a graph file; what is wrong with it is said in the line below.
    void open (const std::filesystem::path&);

    void closeWhenSaved (std::function<void()> close);   ///< once what is not saved is decided
    void closeSuddenly();                                ///< what is not saved is kept for the next start

    void showHelp (const std::string& type) { help.showNode (type); }

    Document& document() noexcept { return *edited; }
    Canvas& canvas() noexcept { return *patching; }
    Performance& run() noexcept { return *performance; }

    /// Feels another graph with its own gesture, in the place of the document, until it ends.
    void preview (const std::filesystem::path&);
    void endPreview();
    bool previews() const noexcept { return heard != nullptr; }

    Question& asked() noexcept { return question; }
    HelpPanel& helpPanel() noexcept { return help; }
    WelcomePage& welcomePage() noexcept { return welcome; }
    PresetBrowser& browser() noexcept { return *presets; }
    const Settings& remembered() const noexcept { return settings; }
    DeviceDesk& deviceDesk() noexcept { return plugged; }
    DevicesPanel& devicesPanel() noexcept { return *devices; }
    const juce::String& saying() const noexcept { return said.isEmpty() ? tip : said; }

    /// Asks a person for a file; tests answer at once. See Files::Ways.
    std::function<void (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)> chooseFile;
    std::function<void (const juce::String&)> onTitle;

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;

private:
    void documentChanged() override;
    void documentRefused (const Message&) override;
    void timerCallback() override;
    void openPort (const OscListen&);
    void globalFocusChanged (juce::Component*) override;
    bool keyPressed (const juce::KeyPress&, juce::Component*) override;
    void show();
    void openPalette (const NodeWish&);
    void choose (const juce::String& purpose, std::vector<PaletteEntry>, std::function<void (const std::string&)> chosen);
    void placePalette (juce::Point<int>);
    void say (const juce::String&);      ///< of what is under the pointer
    void notify (const juce::String&);   ///< of what happened: while nothing is said, until the next edit
    void start (Performance::Hand);
    bool isBound() const;   ///< a role of the graph, by the session
    Performance& current() noexcept { return heard ? *heard : *performance; }
    void escape (const juce::KeyPress&);
    void stopBy (const juce::KeyPress&);
    bool fileKey (const juce::KeyPress&);
    void helpOnSelection();
    void openExample (const std::string& type);
    void recall (int snapshot);
    void store (int snapshot);
    void openMenu (juce::Component& at);
    void askForFile (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>);
    void rememberPanels();
    void remember();   ///< the settings, soon
    void applyTheme();
    void applyScale();

    const Catalogue& catalogue;
    Settings settings;
    std::filesystem::path home;   // empty until begin
    bool light = false;           // now; the settings say how it begins
    PictureStore pictures;
    Question question;
    std::unique_ptr<Document> edited;
    Sound sound;
    DeviceDesk plugged;
    std::unique_ptr<Files> files;               // before the performance, so that a change is kept before it runs
    std::unique_ptr<Performance> performance;   // after the document, before what shows it
    std::unique_ptr<OscReach> reach;
    std::unique_ptr<Document> heard_document;
    std::unique_ptr<Performance> heard;   // while a preset is previewed
    bool resumes = false;                 // the document ran before, and goes on after
    SafetyStrip strip;
    HandPanel hand { sound };
    Tabs left, bottom;
    Splitter left_edge { Splitter::Edge::right, 232, 160 }, right_edge { Splitter::Edge::left, 304, 220 }, bottom_edge { Splitter::Edge::top, 264, 140 };
    std::unique_ptr<TopBar> top;
    PresetBrowser* presets = nullptr;   // in the left tabs
    ScopePanel* scopes = nullptr;       // in the bottom tabs
    LayersPanel* layers = nullptr;      // in the bottom tabs
    std::unique_ptr<Canvas> patching;
    std::unique_ptr<LiveFeed> live;
    std::unique_ptr<Inspector> inspector;
    ProblemList* problems = nullptr;   // in the bottom tabs
    DevicesPanel* devices = nullptr;   // in the bottom tabs
    Palette palette;
    WelcomePage welcome { pictures };
    HelpPanel help;
    std::unique_ptr<juce::FileChooser> chooser;
    juce::Component::SafePointer<juce::Component> listened;   // it has the focus
    const void* shown_identity = nullptr;                     // of the document
    int ticks_to_remember = 0;                                // of the timer; 0: nothing to
    juce::String said, tip;
    juce::TooltipWindow tooltips { this, 600 };
};

}   // namespace tactus::host
