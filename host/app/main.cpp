// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/window/main_view.hpp>
#include <host/platform/signals.hpp>

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
    void fitToScreen()
    {
        const auto screen = juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()->userArea;
        setBounds (screen.withSizeKeepingCentre (std::min (1600, screen.getWidth()), std::min (1000, screen.getHeight())));
    }

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
        const auto arguments = getCommandLineParameterArray();
        MainView::Start how { homeFolder(), arguments.contains ("--safe"), arguments.contains ("--light") };
        for (const auto& a : arguments)
            if (! a.startsWith ("--")) how.files.emplace_back (a.unquoted().toStdString());
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
    void timerCallback() override
    {
        if (! stopRequested()) return;
        stopTimer();
        window->view().closeSuddenly();   // a signal does not wait for an answer
        quit();
    }

    std::unique_ptr<Look> look;
    std::unique_ptr<Window> window;
};
}   // namespace

}   // namespace tactus::host

START_JUCE_APPLICATION (tactus::host::App)
