// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "files.hpp"
#include "node_palette.hpp"
#include "splitter.hpp"
#include "status_line.hpp"
#include "tabs.hpp"
#include "top_bar.hpp"

#include <host/app/browser/browser.hpp>
#include <host/app/compose/add_preset.hpp>
#include <host/app/devices_panel/devices_panel.hpp>
#include <host/app/devices_panel/reach.hpp>
#include <host/app/dialogs/question.hpp>
#include <host/app/dialogs/shade.hpp>
#include <host/app/fit_panel/fit_panel.hpp>
#include <host/app/history/history_panel.hpp>
#include <host/app/inspector/inspector.hpp>
#include <host/app/layers/layers_panel.hpp>
#include <host/app/node_list/node_list.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/problems/problem_list.hpp>
#include <host/app/problems/unfelt.hpp>
#include <host/app/run/asset_load.hpp>
#include <host/app/run/limit_watch.hpp>
#include <host/app/run/live_nodes.hpp>
#include <host/app/run/osc_server.hpp>
#include <host/app/run/views/direct_stop.hpp>
#include <host/app/run/views/hand_panel.hpp>
#include <host/app/run/views/live_feed.hpp>
#include <host/app/run/views/safety_strip.hpp>
#include <host/app/scopes/scope_panel.hpp>
#include <host/app/stems/stem_export.hpp>
#include <host/app/take/take_panel.hpp>
#include <host/app/welcome/help_panel.hpp>
#include <host/app/welcome/template_row.hpp>
#include <host/app/welcome/tour.hpp>
#include <host/app/welcome/welcome_page.hpp>
#include <tactus/file/clips/clip_file.hpp>

#include <array>
#include <utility>

namespace tactus::host
{

/// The content of the main window: all panels around the canvas, and what connects them.
class MainView final : public juce::Component,
                       public juce::FileDragAndDropTarget,
                       public juce::DragAndDropContainer,
                       private Document::Listener,
                       private juce::Timer,
                       private juce::FocusChangeListener,
                       public juce::KeyListener
{
public:
    explicit MainView (const Catalogue&);
    ~MainView() override;

    /// The options with which the program was started.
    struct StartOptions
    {
        std::filesystem::path home;   ///< the folder of the settings and autosaves
        bool safe = false;            ///< safe mode: nothing runs until START
        bool light = false;           ///< light theme, whatever the settings say
        std::vector<std::filesystem::path> files {};
        std::vector<LiveSource> live {};   ///< plugins whose code to watch; only if the view was made with catalogue()
        std::optional<OscListen> osc {};   ///< where to listen for OSC
        bool stops_directly = false;       ///< the view is in a native window, which DirectStop can watch
        std::string program = "tactus";    ///< this program and its version, as logs state it
    };

    /// Reads the settings, offers to recover crashed sessions, and opens the files or the welcome page.
    void begin (const StartOptions&);

    /// Opens a graph file. Problems appear in the status line.
    void open (const std::filesystem::path&);

    /// Opens the panel that fits a model to a recording. [main thread]
    void fitRecordingIn (const std::filesystem::path&);

    /// Calls `close` once unsaved changes, a take and a film are saved or discarded.
    void closeWhenSaved (std::function<void()> close);
    void closeSuddenly();   ///< autosaves unsaved changes for the next start

    /// Runs another graph with its own gesture in place of the document, until endPreview().
    void preview (const std::filesystem::path&);
    void endPreview();
    bool isPreviewing() const noexcept { return playback.isPreviewing(); }

    Document& document() noexcept { return edited; }
    Canvas& canvas() noexcept { return patching; }
    LiveRun& run() noexcept { return playback.run(); }
    Question& asked() noexcept { return question; }
    HelpPanel& helpPanel() noexcept { return help; }
    FitPanel& fitPanel() noexcept { return fitting; }
    WelcomePage& welcomePage() noexcept { return welcome; }
    PresetBrowser& browser() noexcept { return presets; }
    const ProblemList& problemList() const noexcept { return problems; }
    TakePanel& takePanel() noexcept { return takes; }
    HandPanel& handPanel() noexcept { return hand; }
    NodeList& nodeList() noexcept { return nodes; }
    TemplateRow& templateRow() noexcept { return templates; }
    Tour& guidedTour() noexcept { return tour; }
    void beginTour();   ///< if nothing is open, with a preset to feel
    Inspector& inspected() noexcept { return inspector; }
    DevicesPanel& devicesPanel() noexcept { return devices; }
    juce::String statusText() const { return status.text(); }
    bool isAtRest() const noexcept { return awake_for == 0; }   ///< nothing runs, and there was no input for a while: it polls and paints less often
    void report (const Message&);                               ///< an error that belongs to no part of the window, in the status line

    /// Asks for a file, see Files::Callbacks. Tests answer immediately.
    std::function<void (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)> chooseFile;
    std::function<void (const juce::String&)> onTitle;
    std::function<void()> onQuit;      ///< called when the user chooses Quit, which there is only if this is set
    std::function<void()> onRefresh;   ///< Called a few times a second, also while nothing changes.

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;
    bool keyStateChanged (bool is_down) override;
    using juce::KeyListener::keyStateChanged;

    /// Opens a graph or clip that is dropped where no panel takes it. For a table, opens the panel that fits a model to it.
    bool isInterestedInFileDrag (const juce::StringArray&) override;
    void filesDropped (const juce::StringArray&, int x, int y) override;

private:
    void documentChanged() override;
    void findMissing();
    void documentRefused (const Message&) override;
    void timerCallback() override;
    void wake();   ///< polls and paints often again
    void rest();   ///< call many times while nothing runs and there was no input for a while
    void mouseMove (const juce::MouseEvent&) override { wake(); }
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override
    {
        wake();
        status.endRefusal();   // a drag says what it does
    }
    void mouseUp (const juce::MouseEvent&) override { wake(); }
    void mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& d) override
    {
        wake();
        juce::Component::mouseWheelMove (e, d);
    }
    void globalFocusChanged (juce::Component*) override;
    bool keyPressed (const juce::KeyPress&, juce::Component*) override;

    Files::Callbacks fileCallbacks();
    void connect();   ///< which panel calls what: main_view_wiring.cpp
    void connectCanvas();
    void connectSides();
    void connectRun();
    void connectPages();
    void addPanels();

    void startOpened (bool by_pointer);   ///< runs the graph that has just been opened
    void openPreset (const Preset&, bool is_own);
    void openPresetMenu (const Preset&, bool is_own);
    /// Adds a graph to the open one as a node and a layer, and asks for its roles if there are several ways. If nothing is open, opens it.
    void addToGraph (const std::filesystem::path&, const compose::Parts& = {}, std::optional<juce::Point<float>> at = {});
    void addLoaded (const graph::Graph&, compose::AddOptions, std::optional<juce::Point<float>> at);
    void askForAdded();
    void chooseNode (const NodeRequest&);
    void addNode (const std::string& type, const NodeRequest&);
    void noteType (const std::string&);
    void showBeginnings();   ///< the templates, if the graph is empty
    void savePictureAs();
    void share();
    void choose (const juce::String& purpose, PaletteSearch, std::function<void (const std::string&)> chosen);
    void probe (const std::vector<std::string>& ports);
    void showAdded (const std::string& patch, graph::Id node);
    void feel (const std::filesystem::path& preset, bool by_pointer);
    void openFitted (const FittedGraph&);
    void insertFitted (const FittedGraph&);
    void rememberScene();
    void rememberFilmLength();
    void edgeMoved();
    void addPages();
    std::array<std::pair<const char*, juce::Component*>, 4> pageParts();   ///< what is on each page of a small window
    bool isSmall() const;
    void turnTo (const juce::Component& part);
    void layOutPages (juce::Rectangle<int>);
    void layOutPanels (juce::Rectangle<int>& area);   ///< leaves the area of the canvas
    void panelsMoved();                               ///< makes a step of the history of what has changed since the last call
    void tell (const juce::String& title, const juce::String& text, std::function<void()> use = {});
    void openOscPort (const OscListen&);
    void attendLiveNodes();
    void showProblems();
    bool hasBoundRole() const;   ///< true if the session binds a role of the graph to a device that moves a tool
    bool bindsTool (const std::string& role) const;
    void attendNewFolder();
    void openWhenMade (juce::AlertWindow&, juce::TextEditor& name);
    bool isAnythingOpen() const;
    bool escStops();
    void escape (const juce::KeyPress&);
    juce::Component& keyboardHome();
    void keepKeyboard();
    bool panelKey (const juce::KeyPress&);
    bool clutchKey (const juce::KeyPress&);
    bool hasClutchFocus();
    void attendClutch();
    void endDrag();
    void nextPanel (int step);
    void stopBy (const juce::KeyPress&);
    bool fileKey (const juce::KeyPress&);
    void helpOnSelection();
    void openExample (const std::string& type);
    void saveClipAs (const std::filesystem::path&);
    void chooseOwnFile (const std::string& name, std::function<void (const std::filesystem::path&)>);
    bool writeClip (const Clip&, Messages notes, std::optional<double> gain, const std::filesystem::path& to, const readers::ClipFile* source = nullptr);
    void recall (int snapshot);
    void store (int snapshot);
    void compare();   ///< recalls the snapshot before the last one
    void morph (int from, int to);
    void randomise();
    juce::PopupMenu::Item menuItem (const juce::String& text, const juce::String& keys, std::function<void()> act, bool is_ticked = false);
    juce::PopupMenu languageMenu();
    juce::PopupMenu windowMenu();
    void openMenu (juce::Component& at);
    void tellAboutOsc();
    struct Action;   ///< what a click would do, or the way to a node
    void addEdits (std::vector<Action>&);
    void addTabsAndButtons (std::vector<Action>&);
    void addNodes (std::vector<Action>&);
    void addHands (std::vector<Action>&);
    void addPresets (std::vector<Action>&);
    void findAction();
    void reveal (Tabs&, const juce::Component& panel);   ///< even if the tabs are folded
    void askForRecording();
    void askForMissing (const Message&);
    void launchChooser (const juce::String& title, const juce::String& patterns, const juce::File& begin, int how,
                        std::function<void (const std::filesystem::path&)>);
    void askForSetting (const juce::String& patterns, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>);
    struct SaveWords;
    void askWhereToSave (const SaveWords&, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>);
    void askForFile (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>);
    void applySettings();
    void applyFusion();
    void closeWithTake (const std::function<void()>& close);
    void closeWithFilm (const std::function<void()>& close);
    void attendFilm();
    void loadAssets (const graph::Graph&, const juce::String& name, std::function<void()> show);
    void attendLoad();
    using Shares = std::array<std::optional<double>, 5>;
    std::array<std::pair<const char*, Splitter*>, 5> edges();   ///< of the panels, by the names that the settings give them; only the first three fold
    Shares shares();
    void rememberPanels();
    void foldPanels();
    void saveSettingsSoon();

    const Catalogue& catalogue;
    Settings settings;
    std::filesystem::path home;   // empty until begin()
    bool light = false;           // the current theme; settings.light applies at the next start
    PictureStore pictures;
    Question question;
    StatusLine status;
    Document edited { graph::Graph {} };
    Sound sound;
    DeviceSetup device_setup;
    Files files;         // declared before the run, so that an edit is autosaved before it runs
    Playback playback;   // declared before the panels that show it
    LimitWatch limits;
    StemExport stems { catalogue,
                       { .question = question,
                         .notify = [this] (const juce::String& text) { status.notify (text); },
                         .chooseFolder = [this] (const auto& name, auto chosen) { chooseOwnFile (name, std::move (chosen)); } } };
    AssetLoad asset_load;
    juce::String loading;                                     // title of the question that offers to cancel
    std::function<void()> after_load;                         // shows the graph whose files are being loaded
    std::shared_ptr<const AssetLoad::Loaded> loaded_assets;   // kept while this graph is open, so that an edit need not load them again
    const void* loaded_for = nullptr;                         // identity of the graph
    std::unique_ptr<OscServer> osc_server;
    std::optional<LiveNodes> live_nodes;
    Reaches reaches { device_setup };
    SafetyStrip strip { playback };
    std::optional<DirectStop> direct_stop;
    HandPanel hand { playback, sound };
    Tabs left, bottom, pages;
    Splitter left_edge { Splitter::Edge::right, 232, 160 }, right_edge { Splitter::Edge::left, 304, 220 }, bottom_edge { Splitter::Edge::top, 264, 140 };
    Splitter hand_edge { Splitter::Edge::right, 420, 280, Splitter::Folds::no };
    Splitter page_edge { Splitter::Edge::right, 320, 224, Splitter::Folds::no };   // of the pages of a small window
    void restorePanels (const Shares&);
    Shares shares_before {};                // at the last step of the history
    std::array<bool, 3> folded_before {};   // by panel, before foldPanels() folded them all
    bool is_canvas_alone = false;           // foldPanels() has folded them, until it brings them back
    TopBar top { edited };
    Canvas patching;
    Inspector inspector;
    LiveFeed live;
    PresetBrowser& presets;
    NodeList& nodes;
    ScopePanel& scopes;
    TakePanel& takes;
    LayersPanel& layers;
    DevicesPanel& devices;
    ProblemList& problems;
    TemplateRow templates;
    Palette palette;
    WelcomePage welcome { pictures };
    HelpPanel help;
    FitPanel fitting;
    Tour tour;
    Shade shade;
    juce::Component menus;                          // menus open inside it: below the strip, so that STOP stays within reach
    std::unique_ptr<juce::KeyListener> path_keys;   // of the chooser's field
    std::unique_ptr<juce::FileChooser> chooser;
    juce::File recordings;                                   // the folder of the last recording that was chosen
    juce::Component::SafePointer<juce::Component> begun;     // the dialog for a new folder, once its name has the keyboard
    juce::Component::SafePointer<juce::Component> focused;   // the component with the focus, whose keys are listened to
    bool was_trying = false;                                 // a device was being tested
    bool holds_clutch = false, clutch_ends = false;          // the key of the clutch is down; some key has come up since it was pressed
    Messages missing;                                        // what the graph needs before it can be felt
    const void* const first_identity = edited.identity();    // of the empty document that the window begins with
    const void* shown_identity = nullptr;                    // identity of the document that is shown
    std::function<void()> close_after_film;                  // while the window waits for a film that is being saved
    std::array<int, 2> compared {};                          // the last two snapshots; 0: none
    int ticks_to_save = 0;                                   // timer ticks until the settings are saved; 0: nothing to save
    int awake_for = 0;                                       // timer ticks until the window polls less often; 0: it does
    std::optional<juce::TooltipWindow> tooltips;             // only while the window is awake, because it looks for the pointer all the time

    /// The version of the document of which `missing` speaks, and the ports that scopes showed.
    using VersionAndPorts = std::pair<std::uint64_t, std::vector<std::string>>;
    std::optional<VersionAndPorts> missing_of;
};

}   // namespace tactus::host
