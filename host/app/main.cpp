// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/window/main_view.hpp>
#include <host/app/window/places.hpp>
#include <host/osc/osc_options.hpp>
#include <host/platform/home_folder.hpp>
#include <host/platform/signals.hpp>

#include <CLI/CLI.hpp>

#include <cstdio>

namespace tactus::host
{

namespace
{
class Window final : public juce::DocumentWindow
{
public:
    Window (Look& look, const MainView::Start& how) : DocumentWindow ("Tactus", look.theme().panel, allButtons)
    {
        auto view = std::make_unique<MainView> (catalogue());
        view->onTitle = [this] (const juce::String& title)
        { setName (title + " - Tactus"); };
        setUsingNativeTitleBar (true);
        content = view.get();
        setContentOwned (view.release(), false);
        setResizable (true, false);
        setResizeLimits (960, 600, 32000, 32000);
        fitToScreen();
        setVisible (true);
        content->begin (how);
        fitToScreen();   // everything may be of another size now
        if (! content->asked().isOpen()) content->grabKeyboardFocus();
    }

    MainView& view() noexcept { return *content; }
    void closeButtonPressed() override { juce::JUCEApplication::getInstance()->systemRequestedQuit(); }

private:
    void fitToScreen() { setBounds (juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()->userArea); }

    MainView* content;
};

class App final : public juce::JUCEApplication, private juce::Timer
{
public:
    const juce::String getApplicationName() override { return "tactus-host"; }
    const juce::String getApplicationVersion() override { return TACTUS_VERSION; }
    bool moreThanOneInstanceAllowed() override { return true; }

    void initialise (const juce::String&) override
    {
        look = std::make_unique<Look>();
        juce::LookAndFeel::setDefaultLookAndFeel (look.get());
        MainView::Start how { .home = homeFolder() };
        if (! readArguments (how)) return quit();
        window = std::make_unique<Window> (*look, how);
        watchForStop();
        startTimerHz (10);
    }

    void shutdown() override
    {
        stopTimer();
        window.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
        look.reset();
    }

    void systemRequestedQuit() override
    {
        window->view().closeWhenSaved ([]
                                       { quit(); });
    }

private:
    /// False if there is nothing to open a window for: it is said what is wrong, or how the program is called.
    bool readArguments (MainView::Start& how)
    {
        CLI::App options { "Patches haptic effects, and shows what a hand feels.", "tactus-host" };
        options.add_option ("files", how.files, "Graphs to open");
        options.add_flag ("--safe", how.safe, "Nothing runs until START is pressed");
        options.add_flag ("--light", how.light, "Light colours, whatever was chosen");
        std::string osc = std::to_string (OscPort::usual);
        std::string osc_answer;
        auto* osc_given = options.add_option ("--osc", osc, "The UDP port to be reached by from this machine, see docs/osc.md; 0 for any that is free, off, or ADDRESS:PORT to be reached by others too")->check (oscCheck());
        options.add_option ("--osc-answer", osc_answer, "The one other machine that gets answers, by its address: 192.168.1.7")->check (addressCheck());
        options.add_option ("--places", places_file, "Keeps a JSON file with where things are on the screen, for scripts");
        options.set_version_flag ("--version", TACTUS_VERSION);
        std::vector<std::string> arguments;
        for (const auto& a : getCommandLineParameterArray())
            arguments.insert (arguments.begin(), a.unquoted().toStdString());   // CLI11 takes them from the back
        try
        {
            options.parse (std::move (arguments));
            const bool may_be_taken = osc_given->count() == 0;   // by another window
            if (osc != "off" && ! (may_be_taken && OscPort::isTaken (OscPort::usual))) how.osc = readListen (osc);
            if (how.osc) how.osc->answered = osc_answer;
            if (const auto warning = how.osc ? warningOf (*how.osc) : std::string(); ! warning.empty()) std::fprintf (stderr, "warning: %s\n", warning.c_str());
            return true;
        }
        catch (const CLI::ParseError& e)
        {
            setApplicationReturnValue (options.exit (e));
            return false;
        }
    }

    void timerCallback() override
    {
        if (! places_file.empty()) writePlaces();
        if (! stopRequested()) return;
        stopTimer();
        window->view().closeSuddenly();   // a signal does not wait for an answer
        quit();
    }

    /// Whole or not at all, and only when something has moved.
    void writePlaces()
    {
        auto now = placesOf (*window, window->view().canvas()).dump();
        if (now == places) return;
        places = std::move (now);
        const juce::File file (juce::File::getCurrentWorkingDirectory().getChildFile (places_file));
        if (! file.replaceWithText (places)) places.clear();
    }

    std::string places_file, places;
    std::unique_ptr<Look> look;
    std::unique_ptr<Window> window;
};
}   // namespace

}   // namespace tactus::host

START_JUCE_APPLICATION (tactus::host::App)
