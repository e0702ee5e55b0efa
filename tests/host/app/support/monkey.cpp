// SPDX-License-Identifier: GPL-3.0-or-later
// The life of the window, and the choice of an action.
#include "monkey.hpp"
#include "wait_for.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tactus::host::test
{

namespace fs = std::filesystem;

Monkey::Monkey (unsigned seed) : dice (seed)
{
    fs::copy (TACTUS_SOURCE_DIR "/graphs", presets, fs::copy_options::recursive);
    fs::create_directories (own);
    folder.write ("damaged.json", R"({ "format": "tactus-graph", "nodes": { "a": )");
    folder.write ("stroke.csv", "t,x,y,z\n0,0,0,0.005\n1,0.02,0,-0.001\n2,0,0,0.005\n");
    folder.write ("text.csv", "no numbers\n");
    for (const auto& entry : fs::directory_iterator (presets))
        if (entry.path().extension() == ".json") shipped.push_back (entry.path());
    std::ranges::sort (shipped);
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    stage.emplace (1280, 720);
    begin();
}

Monkey::~Monkey()
{
    view.reset();
    stage.reset();
    juce::PopupMenu::dismissAllActiveMenus();   // later messages delete the menus, which use the look until then
    test::settle();                             // not its own, which needs the window
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    juce::Desktop::getInstance().setGlobalScaleFactor (1.0f);
    juce::SystemClipboard::copyTextToClipboard ({});
}

void Monkey::begin()
{
    view = std::make_unique<MainView> (catalogue());
    view->chooseFile = [this] (bool saves, const fs::path& from, const std::function<void (const fs::path&)>& chosen) {
        if (! isAtHome (from)) throw std::runtime_error ("the window looks for a file in " + from.string());
        const auto file = someFile (saves);
        if (upTo (4) == 0) return;
        if (upTo (4) != 0) return chosen (file);
        juce::MessageManager::callAsync (
            [safe = juce::Component::SafePointer<juce::Component> (view.get()), chosen, file] { if (safe != nullptr) chosen (file); });
    };
    stage->fill (*view);
    MainView::StartOptions how { .home = home, .safe = upTo (5) == 0, .light = upTo (4) == 0 };
    if (upTo (3) != 0) how.files.push_back (oneOf (shipped));
    view->begin (how);
    Stage::plugIn();
    view->grabKeyboardFocus();
}

std::string Monkey::act()
{
    static constexpr std::pair<int, std::string (Monkey::*)()> actions[] {
        { 8, &Monkey::clickAnywhere },
        { 14, &Monkey::clickSomething },
        { 6, &Monkey::dragAnywhere },
        { 6, &Monkey::dragSomething },
        { 12, &Monkey::drawWire },
        { 10, &Monkey::dragOnNode },
        { 8, &Monkey::clickOnCanvas },
        { 18, &Monkey::canvasKey },
        { 10, &Monkey::windowKey },
        { 6, &Monkey::addByPalette },
        { 6, &Monkey::addDirectly },
        { 10, &Monkey::typeSomewhere },
        { 4, &Monkey::wheel },
        { 6, &Monkey::wait },
        { 3, &Monkey::group },
        { 2, &Monkey::enter },
        { 3, &Monkey::rename },
        { 1, &Monkey::resize },
        { 1, &Monkey::openFile },
        { 1, &Monkey::preview },
        { 3, &Monkey::startOrStop },
        { 2, &Monkey::goInHistory },
        { 4, &Monkey::compose },
        { 3, &Monkey::turnDepth },
        { 1, &Monkey::drop },
        { 1, &Monkey::beginAgain },
    };
    if (juce::ModalComponentManager::getInstance()->getNumModalComponents() > 0 && upTo (4) != 0) return chooseInMenu();
    if (view->asked().isOpen() && upTo (3) != 0) return answer();
    if (! view->canvas().isShowing() && upTo (4) == 0)
    {
        stage->key (juce::String ("escape"));
        return "leave the scene";
    }
    int sum = 0;
    for (const auto& [weight, action] : actions)
        sum += weight;
    int left = upTo (sum);
    for (const auto& [weight, action] : actions)
        if ((left -= weight) < 0) return (this->*action)();
    return {};
}

void Monkey::poll (int ms)
{
    handleMessages (ms);
    juce::ModifierKeys::currentModifiers = {};
    Stage::plugIn();
    // Close dialogs of JUCE, which are separate windows.
    for (int i = juce::Desktop::getInstance().getNumComponents(); --i >= 0;)
        if (auto* c = juce::Desktop::getInstance().getComponent (i); c != &*stage) c->exitModalState (0);
}

void Monkey::paint() { stage->createComponentSnapshot (stage->getLocalBounds()); }

void Monkey::settle()
{
    for (int i = 0; i < 20 && juce::ModalComponentManager::getInstance()->getNumModalComponents() > 0; ++i)
    {
        juce::ModalComponentManager::getInstance()->cancelAllModalComponents();
        poll (1);
    }
    if (view->asked().isOpen()) view->asked().cancel();
    view->desk().endPreview();
}

fs::path Monkey::someFile (bool saves)
{
    const int kind = upTo (10);
    if (kind < 4) return own / ("graph_" + std::to_string (upTo (4)) + (upTo (2) == 0 ? "" : ".json"));
    if (kind < 7) return oneOf (shipped);
    if (kind == 7) return saves ? own : folder / "damaged.json";
    if (kind == 8) return own / "not there" / "a.json";
    return folder / "stroke.csv" / "a.json";
}

std::string Monkey::beginAgain()
{
    if (upTo (4) != 0) return "stays";
    settle();
    const bool is_sudden = upTo (2) == 0;
    if (is_sudden)
        view->closeSuddenly();
    else
    {
        view->closeWhenSaved ([] {});
        if (view->asked().isOpen()) view->asked().answer (1);
    }
    view.reset();
    begin();
    return is_sudden ? "crashes and restarts" : "closes and restarts";
}

}   // namespace tactus::host::test
