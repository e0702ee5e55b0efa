// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/window/frame_room.hpp>
#include <host/app/window/main_view.hpp>
#include <host/app/window/places.hpp>
#include <host/base/juce/native_window.hpp>
#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/patient_output.hpp>
#include <host/base/platform/signals.hpp>
#include <host/code/plugins/installed_plugins.hpp>
#include <host/devices/osc/osc_options.hpp>
#include <tactus/tactus.h>
#include <tactus/text/caught.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstdio>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tactus::host
{

namespace
{
/// Tells the C library when it gives memory back to the system. A run locks the memory of the program, so new memory is costly: the system fills it
/// with zeros at once. Large blocks, such as those of a mesh, are mapped one by one and go back when they are freed. What is between the small ones
/// stays: a drag takes and frees some 100 kB for each picture.
void setMemoryLimits() noexcept
{
#ifdef __GLIBC__
    constexpr int large = 1 << 20, kept = 16 << 20;   // bytes
    ::mallopt (M_MMAP_THRESHOLD, large);
    ::mallopt (M_TRIM_THRESHOLD, kept);
#endif
}

class Window final : public juce::DocumentWindow
{
public:
    Window (Look& look, const MainView::StartOptions& how) : DocumentWindow ("Tactus", look.theme().panel, allButtons)
    {
        auto view = std::make_unique<MainView> (catalogue());
        view->onTitle = [this] (const juce::String& title) { setName (title + " - Tactus"); };
        setUsingNativeTitleBar (true);
        content = view.get();
        setContentOwned (view.release(), false);
        setResizable (true, false);
        const auto screen = usable();
        setResizeLimits (std::min (800, screen.getWidth()), std::min (600, screen.getHeight()), 32000, 32000);
        fitToScreen();
        setVisible (true);
        content->begin (how);
        fitToScreen();   // the scale may have changed
        if (! content->asked().isOpen()) content->grabKeyboardFocus();
    }

    MainView& view() noexcept { return *content; }
    void closeButtonPressed() override { juce::JUCEApplication::getInstance()->systemRequestedQuit(); }

    /// Call it at each refresh: the window manager may answer late.
    void makeRoomForFrame()
    {
        const auto frame = getPeer() == nullptr ? juce::ComponentPeer::OptionalBorderSize {} : getPeer()->getFrameSizeIfPresent();
        const auto known = frame ? std::optional (*frame) : std::nullopt;
        if (const auto to = place.next (getBounds(), usable(), known, getDesktopScaleFactor(), juce::Time::getMillisecondCounter())) setBounds (*to);
    }

private:
    static juce::Rectangle<int> usable() { return juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()->userArea; }
    void fitToScreen() { setBounds (usable()); }

    MainView* content;
    OpeningPlace place;
};

class App final : public juce::JUCEApplication
{
public:
    const juce::String getApplicationName() override { return "tactus-host"; }
    const juce::String getApplicationVersion() override { return TACTUS_VERSION; }
    bool moreThanOneInstanceAllowed() override { return true; }

    void initialise (const juce::String&) override
    {
        setMemoryLimits();
        if (const auto begun = caught ({}, [this] { begin(); }); ! begun) giveUp (begun.error());
    }

    /// An exception in the main thread, such as one from a file that was dropped on the window. [in a catch block]
    void unhandledException (const std::exception*, const juce::String&, int) override
    {
        const auto why = exceptionAt ({});
        window != nullptr ? window->view().desk().notify (fromUtf8 (messageText (why))) : giveUp (why);
    }

    void shutdown() override
    {
        window.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
        look.reset();
        useTranslation ({});
    }

    void systemRequestedQuit() override
    {
        window->view().closeWhenSaved ([] { quit(); });
    }

private:
    void begin()
    {
        look = std::make_unique<Look>();
        juce::LookAndFeel::setDefaultLookAndFeel (look.get());
        MainView::StartOptions how { .home = homeFolder(), .stops_directly = true, .program = "tactus " TACTUS_VERSION };
        if (! readArguments (how)) return quit();
        std::fputs (textOf (usePlugins (plugin_folders)).c_str(), stderr);
        how.live = liveBuilds (catalogue());
        useTranslation (translationFor (languageSetIn (how.home), how.home));
        takeHeldKeysFromEvents();
        window = std::make_unique<Window> (*look, how);
        watchForStop();
        giveUpBlockedOutputs();
        window->view().onRefresh = [this] { refresh(); };
        window->view().allowQuit ([this] { systemRequestedQuit(); });
    }

    void giveUp (const Message& why)
    {
        std::fprintf (stderr, "tactus-host: error: %s\n    %s [%s]\n", printable (why.text).c_str(), why.remedy.c_str(), why.id.c_str());
        setApplicationReturnValue (1);
        quit();
    }

    /// Returns false if no window should open: after --help or --version, or if the arguments are wrong.
    bool readArguments (MainView::StartOptions& how)
    {
        const Command options { "Edits and runs graphs of haptic effects, and shows the forces on the hand.", "tactus-host" };
        std::vector<std::string> files;
        options.addOption ("files", files, "Graphs or clips to open, or a recording to fit");
        options.addFlag ("--safe", how.safe, "Safe mode: nothing runs until START is pressed");
        options.addFlag ("--light", how.light, "Light theme, whatever the settings say");
        std::string osc = std::to_string (OscPort::usual);
        std::string osc_answer;
        const auto osc_given = options.addOption ("--osc", osc,
                                                  "UDP port for OSC from this machine, see docs/osc.md; 0 for any free port, off for none, "
                                                  "or ADDRESS:PORT to also accept other machines");
        osc_given.check (oscCheck());
        options.addOption ("--osc-answer", osc_answer, "Address of the one other machine that gets answers, such as 192.168.1.7").check (addressCheck());
        options.addOption ("--plugins", plugin_folders, "A folder of plugins, in addition to those that are installed (docs/plugins.md)")
            .oneValueEach();
        options.addOption ("--places", places_file, "JSON file to keep updated with the screen positions of all nodes, ports, wires and buttons, for scripts");
        options.version ("tactus-host " TACTUS_VERSION " (C API " + std::to_string (TACTUS_API_VERSION) + ")");
        std::vector<std::string> arguments;
        for (const auto& a : getCommandLineParameterArray())
            arguments.push_back (a.unquoted().toStdString());
        if (const auto status = options.parse (std::move (arguments)))
        {
            setApplicationReturnValue (*status);
            return false;
        }
        how.files.assign (files.begin(), files.end());
        const bool is_default = ! osc_given.isGiven();   // another window may already use the default port
        if (osc != "off" && ! (is_default && OscPort::isTaken (OscPort::usual))) how.osc = readListen (osc);
        if (how.osc) how.osc->answered = osc_answer;
        if (const auto warning = how.osc ? warningOf (*how.osc) : std::string(); ! warning.empty()) std::fprintf (stderr, "warning: %s\n", warning.c_str());
        return true;
    }

    void refresh()
    {
        window->makeRoomForFrame();
        paintWithoutDisplay();
        if (! places_file.empty()) writePlaces();
        if (! stopRequested() || has_stopped) return;
        has_stopped = true;
        window->view().closeSuddenly();   // a signal cannot wait for an answer
        quit();
    }

    /// Writes the file atomically, and only if something has moved.
    void writePlaces()
    {
        auto now = placesOf (*window, window->view().canvas()).dump();
        if (now == places) return;
        places = std::move (now);
        const juce::File file (juce::File::getCurrentWorkingDirectory().getChildFile (places_file));
        if (! file.replaceWithText (places)) places.clear();
    }

    std::vector<std::string> plugin_folders;
    std::string places_file, places;
    std::unique_ptr<Look> look;
    std::unique_ptr<Window> window;
    bool has_stopped = false;
};
}   // namespace

}   // namespace tactus::host

START_JUCE_APPLICATION (tactus::host::App)
