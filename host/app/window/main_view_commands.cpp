// SPDX-License-Identifier: GPL-3.0-or-later
// What menus and keys of the window do.
#include "main_view.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/welcome/example.hpp>

#include <framework/file/graph_file.hpp>

#include <algorithm>
#include <array>

namespace tactus::host
{

namespace
{
constexpr int ticks_before_remembering = 15;   // half a second, so that a drag writes once
constexpr std::array scales { 1.0, 1.25, 1.5, 2.0 };

/// Those of JUCE's own windows for files.
void colourDialogs (Look& look)
{
    const auto& theme = look.theme();
    const auto set = [&look] (std::initializer_list<int> ids, juce::Colour colour)
    {
        for (const int id : ids)
            look.setColour (id, colour);
    };
    using Browser = juce::FileBrowserComponent;
    using Listed = juce::DirectoryContentsDisplayComponent;
    set ({ juce::AlertWindow::backgroundColourId }, theme.panel);
    set ({ juce::ListBox::backgroundColourId, juce::TextButton::buttonColourId, juce::TextButton::buttonOnColourId, juce::ComboBox::backgroundColourId, Browser::currentPathBoxBackgroundColourId, Browser::filenameBoxBackgroundColourId }, theme.raised);
    set ({ juce::ListBox::outlineColourId, juce::AlertWindow::outlineColourId, juce::ComboBox::outlineColourId }, theme.hairline);
    set ({ juce::ListBox::textColourId, juce::AlertWindow::textColourId, juce::FileChooserDialogBox::titleTextColourId, juce::TextButton::textColourOffId, juce::TextButton::textColourOnId, Listed::textColourId, Listed::highlightedTextColourId, Browser::currentPathBoxTextColourId, Browser::filenameBoxTextColourId, juce::DrawableButton::textColourId }, theme.text);
    set ({ Browser::currentPathBoxArrowColourId }, theme.dim);
    set ({ Listed::highlightColourId }, theme.accent.withAlpha (0.25f));
}

void recolour (juce::Component& c, const Theme& theme)
{
    if (auto* editor = dynamic_cast<juce::TextEditor*> (&c))
    {
        editor->applyColourToAllText (theme.text);
        editor->setTextToShowWhenEmpty (editor->getTextToShowWhenEmpty(), theme.dim);
    }
    for (auto* child : c.getChildren())
        recolour (*child, theme);
}
}   // namespace

/// With Shift it is the emergency stop.
void MainView::stopBy (const juce::KeyPress& key)
{
    resumes = false;   // after a preview
    if (key.getModifiers().isShiftDown())
        current().emergencyStop();
    else
        current().stop();
}

void MainView::escape (const juce::KeyPress& key)
{
    if (current().isWanted()) return stopBy (key);
    if (question.isOpen()) return question.cancel();
    if (help.isOpen()) return help.close();
    palette.close();
}

void MainView::preview (const std::filesystem::path& file)
{
    if (files->isSafe()) return notify ("Safe mode: open the preset and press START to feel it.");
    auto loaded = loadGraph (file);
    if (hasErrors (loaded.messages)) return;   // the list says so
    endPreview();
    resumes = performance->isWanted() && ! performance->isStoppedForGood();
    performance->letGo();
    const auto name = juce::String (loaded.graph.name);
    heard_document = std::make_unique<Document> (std::move (loaded.graph));
    heard = std::make_unique<Performance> (*heard_document, catalogue);
    files->beforeRun();
    heard->start (Performance::Hand {});
    notify (name + " with its own gesture, for as long as you hold.");
}

void MainView::endPreview()
{
    if (! heard) return;
    heard.reset();
    heard_document.reset();
    if (resumes) start (performance->hand());
    notify ({});
}

bool MainView::fileKey (const juce::KeyPress& key)
{
    const auto is = [&] (const char* description)
    { return key == juce::KeyPress::createFromDescription (description); };
    if (is ("ctrl + n"))
        files->create();
    else if (is ("ctrl + o"))
        files->open();
    else if (is ("ctrl + s"))
        files->save();
    else if (is ("ctrl + shift + s"))
        files->saveAs();
    else
        return false;
    return true;
}

void MainView::helpOnSelection()
{
    const auto& selected = patching->selection();
    const auto* patch = patching->patch().empty() ? &edited->graph().root : edited->graph().find (patching->patch());
    if (patch != nullptr && selected.size() == 1)
        if (const auto node = std::ranges::find (patch->nodes, *selected.begin(), &graph::Node::id); node != patch->nodes.end()) return showHelp (node->type);
    help.showKeys();
}

void MainView::openExample (const std::string& type)
{
    const Preset* smallest = nullptr;
    for (const auto& p : presets->shipped())
        if (p.problem.empty() && p.types.contains (type) && (smallest == nullptr || p.types.size() < smallest->types.size())) smallest = &p;
    if (smallest != nullptr) return files->openCopy (smallest->file, false);
    if (const auto* known = catalogue.find (type)) files->openGraph (exampleOf (*known, catalogue), "example of " + type);
}

void MainView::recall (int number)
{
    if (! hasSnapshot (edited->graph(), number)) return notify ("Snapshot " + juce::String (number) + " is empty. Ctrl+" + juce::String (number) + " stores all values in it.");
    if (auto command = recallSnapshot (edited->graph(), number)) edited->perform (std::move (*command));
    notify ("Snapshot " + juce::String (number));
}

void MainView::store (int number)
{
    if (edited->perform (storeSnapshot (edited->graph(), number))) notify ("Stored as snapshot " + juce::String (number) + ". Press " + juce::String (number) + " to bring these values back.");
}

void MainView::openMenu (juce::Component& at)
{
    const auto item = [this] (const juce::String& text, const juce::String& keys, std::function<void()> act)
    {
        juce::PopupMenu::Item i (text);
        i.shortcutKeyDescription = keys;
        i.action = [safe = SafePointer (this), act = std::move (act)]   // which comes later, when the window may be gone
        {
            if (safe != nullptr) act();
        };
        return i;
    };
    juce::PopupMenu menu, recent, size;
    for (const auto& file : settings.recent)
        recent.addItem (item (file.filename().string(), file.parent_path().string(), [this, file]
                              { files->open (file); }));
    const auto addSize = [&] (const juce::String& name, double scale)
    {
        auto i = item (name, {}, [this, scale]
                       {
            settings.scale = scale;
            applyScale();
            remember(); });
        i.isTicked = settings.scale == scale;
        size.addItem (std::move (i));
    };
    addSize ("As the display asks", 0.0);
    for (const double scale : scales)
        addSize (juce::String (juce::roundToInt (100.0 * scale)) + " %", scale);

    menu.addItem (item ("New", "Ctrl+N", [this]
                        { files->create(); }));
    menu.addItem (item ("Open ...", "Ctrl+O", [this]
                        { files->open(); }));
    menu.addSubMenu ("Open recent", recent, ! settings.recent.empty());
    menu.addItem (item ("Save", "Ctrl+S", [this]
                        { files->save(); }));
    menu.addItem (item ("Save as ...", "Ctrl+Shift+S", [this]
                        { files->saveAs(); }));
    menu.addSeparator();
    auto theme = item ("Light", {}, [this]
                       {
        settings.light = light = ! light;
        applyTheme();
        remember(); });
    theme.isTicked = light;
    menu.addItem (std::move (theme));
    menu.addSubMenu ("Size of everything", size);
    menu.addSeparator();
    menu.addItem (item ("Help on the selected node", "F1", [this]
                        { helpOnSelection(); }));
    menu.addItem (item ("All keys", {}, [this]
                        { help.showKeys(); }));
    menu.showMenuAsync (juce::PopupMenu::Options().withParentComponent (this).withTargetComponent (at).withMinimumWidth (240).withStandardItemHeight (28));
}

void MainView::askForFile (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)> chosen)
{
    chooser = std::make_unique<juce::FileChooser> (saves ? "Save the graph" : "Open a graph", juce::File (begin.string()), "*.json");
    using Choice = juce::FileBrowserComponent;
    const int how = saves ? Choice::saveMode | Choice::canSelectFiles | Choice::warnAboutOverwriting : Choice::openMode | Choice::canSelectFiles;
    chooser->launchAsync (how, [this, chosen = std::move (chosen)] (const juce::FileChooser& c)
                          {
        takeFocus (*patching);
        if (const auto file = c.getResult(); file != juce::File()) chosen (file.getFullPathName().toStdString()); });
}

void MainView::rememberPanels()
{
    settings.panels = { { "left", left_edge.size() }, { "right", right_edge.size() }, { "bottom", bottom_edge.size() } };
    remember();
}

void MainView::remember()
{
    if (! home.empty()) ticks_to_remember = ticks_before_remembering;
}

void MainView::applyTheme()
{
    auto& look = lookOf (*this);
    look.setTheme (light ? Theme::light() : Theme::dark());
    colourDialogs (look);
    auto* window = getTopLevelComponent();
    window->sendLookAndFeelChange();
    recolour (*window, look.theme());
    window->repaint();
}

void MainView::applyScale()
{
    auto& desktop = juce::Desktop::getInstance();
    const auto* display = desktop.getDisplays().getPrimaryDisplay();
    if (display == nullptr) return;
    const auto height = juce::roundToInt (static_cast<float> (display->totalArea.getHeight()) * desktop.getGlobalScaleFactor());
    desktop.setGlobalScaleFactor (static_cast<float> (settings.scale > 0.0 ? settings.scale : automaticScale (height)));
}

}   // namespace tactus::host
