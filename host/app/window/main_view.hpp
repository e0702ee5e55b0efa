// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "status_line.hpp"
#include "tabs.hpp"

#include <host/app/adding/add_graph.hpp>
#include <host/app/adding/node_palette.hpp>
#include <host/app/desk/panel.hpp>
#include <host/app/dialogs/file_dialogs.hpp>
#include <host/app/dialogs/shade.hpp>
#include <host/app/files/files.hpp>
#include <host/app/inspector/inspector.hpp>
#include <host/app/look/splitter.hpp>
#include <host/app/run/asset_load.hpp>
#include <host/app/run/live_nodes.hpp>
#include <host/app/run/osc_server.hpp>
#include <host/app/run/views/direct_stop.hpp>
#include <host/app/run/views/hand_panel.hpp>
#include <host/app/run/views/live_feed.hpp>
#include <host/app/run/views/safety_strip.hpp>
#include <host/app/stems/stem_export.hpp>
#include <host/app/top_bar/top_bar.hpp>
#include <host/app/welcome/help_panel.hpp>
#include <host/app/welcome/template_row.hpp>
#include <host/app/welcome/tour.hpp>
#include <host/app/welcome/welcome_page.hpp>

#include <array>
#include <stdexcept>
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
    void fitRecordingIn (const std::filesystem::path& file) { desk.fitRecording (file); }

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
    WelcomePage& welcomePage() noexcept { return welcome; }
    HandPanel& handPanel() noexcept { return hand; }
    TemplateRow& templateRow() noexcept { return templates; }
    Tour& guidedTour() noexcept { return tour; }
    void beginTour();   ///< if nothing is open, with a preset to feel
    Inspector& inspected() noexcept { return inspector; }

    /// The component of a panel.
    template <typename Component>
    Component& panel()
    {
        for (const auto& p : panels)
            if (auto* found = dynamic_cast<Component*> (&p.component)) return *found;
        throw std::logic_error ("the window has no such panel");
    }

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
    /// A panel, and where it is.
    struct Attached
    {
        Panel panel;
        juce::Component& component;
        Tabs* tabs;   // null: it covers the window while it is visible
    };

    void documentChanged() override;
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
    void setDesk();
    void chooseNode (const NodeRequest&);
    void addNode (const std::string& type, const NodeRequest&);
    void noteType (const std::string&);
    void showBeginnings();   ///< the templates, if the graph is empty
    void savePictureAs();
    void share();
    void choose (const juce::String& purpose, PaletteSearch, std::function<void (const std::string&)> chosen);
    void feel (const std::filesystem::path& preset, bool by_pointer);
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
    void openOscPort (const OscListen&);
    void attendLiveNodes();
    bool hasBoundRole() const;   ///< true if the session binds a role of the graph to a device that moves a tool
    bool bindsTool (const std::string& role) const;
    bool isAnythingOpen() const;
    const Attached* openCover() const;   ///< the panel that covers the window; null: none
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
    void findAction();
    void reveal (Tabs&, const juce::Component& panel);   ///< even if the tabs are folded
    void withTabs (const juce::Component& panel, const std::function<void (Tabs&)>&);
    void askForRecording();
    void applySettings();
    void applyFusion();
    void closePanels (std::size_t first, const std::function<void()>& close);
    std::vector<const void*> work() const;   ///< another value once there is something else that closing asks about
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
    AssetLoad asset_load;
    juce::String loading;                                     // title of the question that offers to cancel
    std::function<void()> after_load;                         // shows the graph whose files are being loaded
    std::shared_ptr<const AssetLoad::Loaded> loaded_assets;   // kept while this graph is open, so that an edit need not load them again
    const void* loaded_for = nullptr;                         // identity of the graph
    std::unique_ptr<OscServer> osc_server;
    std::optional<LiveNodes> live_nodes;
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
    Canvas patching;
    Desk desk { catalogue, edited, patching, playback, device_setup, limits, settings, pictures, question };
    StemExport stems { desk };
    TopBar top { desk };
    Inspector inspector;
    LiveFeed live;
    std::vector<Attached> panels;
    TemplateRow templates;
    Palette palette;
    WelcomePage welcome { pictures };
    HelpPanel help;
    Tour tour;
    Shade shade;
    juce::Component menus;   // menus open inside it: below the strip, so that STOP stays within reach
    FileDialogs dialogs { *this, SafetyStrip::height, patching, question };
    std::filesystem::path recordings;                        // the folder of the last recording that was chosen
    juce::Component::SafePointer<juce::Component> focused;   // the component with the focus, whose keys are listened to
    bool was_trying = false;                                 // a device was being tested
    bool holds_clutch = false, clutch_ends = false;          // the key of the clutch is down; some key has come up since it was pressed
    const void* const first_identity = edited.identity();    // of the empty document that the window begins with
    const void* shown_identity = nullptr;                    // identity of the document that is shown
    std::function<void()> close_after_film;                  // while the window waits for a film that is being saved
    int ticks_to_save = 0;                                   // timer ticks until the settings are saved; 0: nothing to save
    int awake_for = 0;                                       // timer ticks until the window polls less often; 0: it does
    std::optional<juce::TooltipWindow> tooltips;             // only while the window is awake, because it looks for the pointer all the time
};

}   // namespace tactus::host
