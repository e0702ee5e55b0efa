// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "asset_wait.hpp"
#include "beginnings.hpp"
#include "closing.hpp"
#include "command_search.hpp"
#include "keyboard.hpp"
#include "main_menu.hpp"
#include "window_parts.hpp"

#include <host/app/run/live_nodes.hpp>
#include <host/app/run/osc_server.hpp>
#include <host/app/run/views/direct_stop.hpp>

#include <stdexcept>

namespace tactus::host
{

/// The content of the main window: its parts, and the loop over them.
class MainView final : public juce::Component,
                       public juce::FileDragAndDropTarget,
                       public juce::DragAndDropContainer,
                       private Document::Listener,
                       private juce::Timer
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

    /// Opens a graph file, or the panel that fits a model to a table. Problems appear in the status line.
    void open (const std::filesystem::path&);

    /// Calls `close` once unsaved changes, a take and a film are saved or discarded.
    void closeWhenSaved (std::function<void()> close) { closing.whenSaved (std::move (close)); }
    void closeSuddenly() { closing.atOnce(); }   ///< autosaves unsaved changes for the next start

    Desk& desk() noexcept { return parts.desk; }
    Document& document() noexcept { return parts.edited; }
    Canvas& canvas() noexcept { return parts.patching; }
    LiveRun& run() noexcept { return parts.playback.run(); }
    Question& asked() noexcept { return parts.question; }

    /// A part of the window, such as its inspector or a panel, by its type.
    template <typename Part>
    Part& part()
    {
        for (auto* child : getChildren())
            if (auto* found = dynamic_cast<Part*> (child)) return *found;
        for (const auto& p : parts.panels)
            if (auto* found = dynamic_cast<Part*> (&p.component)) return *found;
        throw std::logic_error ("the window has no such part");
    }

    const std::vector<Keyboard::Key>& keys() const noexcept { return keyboard.keys; }   ///< of the window itself
    juce::String statusText() const { return parts.status.text(); }
    bool isAtRest() const noexcept { return awake_for == 0; }   ///< nothing runs, and there was no input for a while: it polls and paints less often

    /// Asks for a file, see Files::Callbacks. Tests answer immediately.
    std::function<void (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)> chooseFile;
    std::function<void (const juce::String&)> onTitle;
    std::function<void()> onRefresh;                 ///< Called a few times a second, also while nothing changes.
    void allowQuit (const std::function<void()>&);   ///< the user can choose Quit, which calls this

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress& key) override { return keyboard.press (key); }
    bool keyStateChanged (bool is_down) override;

    /// Opens a graph or clip that is dropped where no panel takes it.
    bool isInterestedInFileDrag (const juce::StringArray&) override;
    void filesDropped (const juce::StringArray& dropped, int, int) override { open (dropped[0].toStdString()); }

private:
    void documentChanged() override;
    void documentRefused (const Message&) override;
    void showName();
    void timerCallback() override;
    void wake();   ///< polls and paints often again
    void rest();   ///< call many times while nothing runs and there was no input for a while
    void mouseMove (const juce::MouseEvent&) override { wake(); }
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override { wake(); }
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;

    Files::Callbacks fileCallbacks();   ///< which part calls what: main_view_wiring.cpp
    void setDesk();
    void setKeys();
    void connect();
    void readSettings (bool light);
    void listenForOsc (const OscListen&);
    void preview (const std::filesystem::path&);   ///< with its own gesture, in place of the document
    void refreshPanels();
    void pollLiveNodes();

    WindowParts parts;
    std::unique_ptr<OscServer> osc_server;
    std::optional<LiveNodes> live_nodes;
    std::optional<DirectStop> direct_stop;
    AssetWait assets { parts };
    Beginnings beginnings { parts };
    Closing closing { parts };
    Keyboard keyboard { parts };
    MainMenu menu { parts };
    CommandSearch search { parts, menu, keyboard };
    bool was_trying = false;                                      // a device was being tested
    bool was_dragging = false;                                    // something was being dragged on the canvas
    const void* const first_identity = parts.edited.identity();   // of the empty document that the window begins with
    const void* shown_identity = nullptr;                         // identity of the document that is shown
    double refreshed_at = 0.0;                                    // ms
    bool leaves_out = false;                                      // the last refresh was left out
    int awake_for = 0;                                            // timer ticks until the window polls less often; 0: it does
    std::optional<juce::TooltipWindow> tooltips;                  // only while the window is awake, because it looks for the pointer all the time
};

}   // namespace tactus::host
