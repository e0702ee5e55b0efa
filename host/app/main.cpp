// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/window/main_view.hpp>

namespace tactus::host
{

namespace
{
class Window final : public juce::DocumentWindow
{
public:
    explicit Window (Look& look) : DocumentWindow ("Tactus", look.theme().panel, allButtons)
    {
        auto view = std::make_unique<MainView> (catalogue());
        view->onTitle = [this] (const juce::String& title)
        { setName (title + " - Tactus"); };
        setUsingNativeTitleBar (true);
        content = view.get();
        setContentOwned (view.release(), false);
        setResizable (true, false);
        setResizeLimits (960, 600, 32000, 32000);
        const auto screen = juce::Desktop::getInstance().getDisplays().getPrimaryDisplay()->userArea;
        setBounds (screen.withSizeKeepingCentre (std::min (1600, screen.getWidth()), std::min (1000, screen.getHeight())));
        setVisible (true);
    }

    MainView& view() noexcept { return *content; }
    void closeButtonPressed() override { juce::JUCEApplication::getInstance()->systemRequestedQuit(); }

private:
    MainView* content;
};

class App final : public juce::JUCEApplication
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
        if (arguments.contains ("--light")) look->setTheme (Theme::light());
        window = std::make_unique<Window> (*look);
        for (const auto& a : arguments)
            if (! a.startsWith ("--")) window->view().open (a.unquoted().toStdString());
    }

    void shutdown() override
    {
        window.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
        look.reset();
    }

    void systemRequestedQuit() override { quit(); }

private:
    std::unique_ptr<Look> look;
    std::unique_ptr<Window> window;
};
}   // namespace

}   // namespace tactus::host

START_JUCE_APPLICATION (tactus::host::App)
