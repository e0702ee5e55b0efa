// SPDX-License-Identifier: GPL-3.0-or-later
// What the menu and the keys of the window do.
#include "appearance.hpp"
#include "main_view.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/text/filled.hpp>
#include <host/app/welcome/example.hpp>
#include <host/io/clip_io.hpp>

#include <tactus/file/graph_file.hpp>

#include <algorithm>
#include <array>

namespace tactus::host
{

namespace
{
constexpr int ticks_before_saving = 15;   // timer ticks; half a second, so that a drag writes the settings only once
constexpr std::array scales { 1.0, 1.25, 1.5, 2.0 };

/// The folder of a file, from ~ on if it is in the home folder of the user.
juce::String folderText (const std::filesystem::path& file)
{
    const auto folder = fromUtf8 (file.parent_path().string()), home = juce::File::getSpecialLocation (juce::File::userHomeDirectory).getFullPathName();
    return folder == home || folder.startsWith (home + "/") ? "~" + folder.substring (home.length()) : folder;
}

/// The title of a dialog and the files that it shows. What is saved follows from the proposed name.
std::pair<juce::String, juce::String> wordsFor (bool saves, const std::filesystem::path& begin)
{
    if (! saves) return { TRANS ("Open graph or clip"), "*.json;*.haptic;*.ahap;*.hjif;*.wav" };
    if (isClipExtension (begin)) return { TRANS ("Save clip; the ending of the name selects the format"), "*.haptic;*.ahap;*.hjif;*.json;*.wav;*.csv" };
    if (extensionOf (begin) == ".csv") return { TRANS ("Save gesture"), "*.csv" };
    if (extensionOf (begin) == ".jsonl") return { TRANS ("Save test"), "*.jsonl" };
    return { TRANS ("Save graph"), "*.json" };
}
}   // namespace

bool MainView::keyPressed (const juce::KeyPress& key)
{
    if (key.getKeyCode() == juce::KeyPress::escapeKey)
    {
        escape (key);
        return true;
    }
    if (question.isOpen())
    {
        question.keyPressed (key);   // even if the question does not have the focus
        return true;
    }
    if (fitting.isOpen()) return true;   // the panel has had the key
    if (fileKey (key)) return true;
    if (key == juce::KeyPress::F1Key || key.getTextCharacter() == '?')
    {
        help.isOpen() ? help.close() : helpOnSelection();
        return true;
    }
    const int digit = key.getKeyCode() - '0';
    if (digit >= 1 && digit <= snapshot_count && ! key.getModifiers().isAltDown())
    {
        key.getModifiers().isAnyModifierKeyDown() ? store (digit) : recall (digit);
        return true;
    }
    if (key == juce::KeyPress::createFromDescription ("z"))
    {
        foldPanels();
        return true;
    }
    if (key == juce::KeyPress::createFromDescription ("h"))
    {
        hand.view().hold();
        return true;
    }
    if (key == juce::KeyPress::createFromDescription ("c"))
    {
        live.shows_costs = ! live.shows_costs;
        return true;
    }
    // Elsewhere, Tab goes to the next field.
    if (key.isKeyCode (juce::KeyPress::tabKey) && ! hasKeyboardFocus (false) && ! patching.hasKeyboardFocus (true)) return false;
    const bool is_hidden = hand.isEnlarged();   // you would not see what you edit
    return scopes.keyPressed (key) || (! is_hidden && patching.keyPressed (key));
}

/// True if Esc would close something: a question, the help, the palette, a menu, a dialog, or a field in which text is typed; or if it would
/// bring the keyboard from the inspector back to the canvas.
bool MainView::isAnythingOpen() const
{
    return inspector.hasKeyboardFocus (true) || question.isOpen() || fitting.isOpen() || help.isOpen() || palette.isVisible()
           || juce::Component::getNumCurrentlyModalComponents() > 0
           || dynamic_cast<juce::TextEditor*> (juce::Component::getCurrentlyFocusedComponent()) != nullptr;
}

/// Esc closes what is open before it stops, unless there are motors: then you should not have to look first.
bool MainView::escStops() { return playback.current().drivesDevice() || ! isAnythingOpen(); }

/// A stop must work whichever component has the focus: a text field or a menu would swallow the key.
void MainView::globalFocusChanged (juce::Component* now)
{
    if (focused != nullptr) focused->removeKeyListener (this);
    focused = now != this ? now : nullptr;
    if (focused != nullptr) focused->addKeyListener (this);
    if (focused != nullptr) inspector.reveal (*focused);
}

bool MainView::keyPressed (const juce::KeyPress& key, juce::Component*)
{
    if (key.getKeyCode() != juce::KeyPress::escapeKey) return false;
    if (playback.current().isWanted() && (key.getModifiers().isShiftDown() || escStops()))
    {
        stopBy (key);
        return true;   // the next Esc closes what is open
    }
    if (! help.isOpen() || question.isOpen() || fitting.isOpen() || palette.isVisible() || juce::Component::getNumCurrentlyModalComponents() > 0) return false;
    help.close();   // even while a field has the keyboard, which would keep the key
    return true;
}

void MainView::stopBy (const juce::KeyPress& key) { key.getModifiers().isShiftDown() ? playback.emergencyStop() : playback.stop(); }

void MainView::escape (const juce::KeyPress& key)
{
    if (playback.current().isWanted() && (key.getModifiers().isShiftDown() || escStops())) return stopBy (key);
    if (question.isOpen()) return question.cancel();
    if (fitting.isOpen()) return fitting.close();
    if (help.isOpen()) return help.close();
    if (hand.isEnlarged() && ! palette.isVisible()) return hand.enlarge (false);
    palette.close();
    if (inspector.hasKeyboardFocus (true)) takeFocus (patching);
}

void MainView::preview (const std::filesystem::path& file)
{
    if (files.isSafe()) return status.notify (TRANS ("Safe mode: open the preset and press START to feel it."));
    auto loaded = loadGraph (file);
    if (hasErrors (loaded.messages)) return;   // the preset list shows them
    const auto name = juce::String (loaded.graph.name);
    playback.preview (std::move (loaded.graph));
    status.notify (filled (TRANS ("%1: previewing with its own gesture. Release to stop."), name));
}

void MainView::endPreview()
{
    if (! isPreviewing()) return;
    playback.endPreview();
    status.notify ({});
}

bool MainView::fileKey (const juce::KeyPress& key)
{
    const auto is = [&] (const char* description) { return key == juce::KeyPress::createFromDescription (description); };
    if (is ("ctrl + n"))
        files.create();
    else if (is ("ctrl + o"))
        files.open();
    else if (is ("ctrl + s"))
        files.save();
    else if (is ("ctrl + shift + s"))
        files.saveAs();
    else
        return false;
    return true;
}

void MainView::helpOnSelection()
{
    const auto& selected = patching.selection();
    const auto* node = selected.size() == 1 ? patching.scene().find (*selected.begin()) : nullptr;
    node != nullptr ? help.showNode (node->type) : help.showKeys();
}

void MainView::openExample (const std::string& type)
{
    const Preset* smallest = nullptr;
    for (const auto& p : presets.shipped())
        if (p.problem.empty() && p.types.contains (type) && (smallest == nullptr || p.types.size() < smallest->types.size())) smallest = &p;
    if (smallest != nullptr) return files.openCopy (smallest->file, false);
    if (const auto* known = catalogue.find (type)) files.openGraph (exampleOf (*known, catalogue), filled (TRANS ("example of %1"), type).toStdString());
}

void MainView::recall (int number)
{
    const juce::String n (number);
    if (! hasSnapshot (edited.graph(), number)) return status.notify (filled (TRANS ("Snapshot %1 is empty. Ctrl+%1 stores all values in it."), n));
    if (auto command = recallSnapshot (edited.graph(), number)) edited.perform (std::move (*command));
    status.notify (filled (TRANS ("Recalled snapshot %1."), n));
}

void MainView::store (int number)
{
    const juce::String n (number);
    if (edited.perform (storeSnapshot (edited.graph(), number))) status.notify (filled (TRANS ("Stored snapshot %1. Press %1 to recall it."), n));
}

juce::PopupMenu::Item MainView::menuItem (const juce::String& text, const juce::String& keys, std::function<void()> act, bool is_ticked)
{
    juce::PopupMenu::Item item (text);
    item.shortcutKeyDescription = keys;
    item.isTicked = is_ticked;
    item.action = [safe = SafePointer (this), act = std::move (act)]   // called later, when the window may be gone
    {
        if (safe != nullptr) act();
    };
    return item;
}

juce::PopupMenu MainView::languageMenu()
{
    juce::PopupMenu menu;
    const auto add = [&] (const juce::String& name, const std::string& code) {
        const auto choose = [this, code] {
            settings.language = code;
            saveSettingsSoon();
            status.notify (TRANS ("The language changes at the next start."));
        };
        menu.addItem (menuItem (name, {}, choose, settings.language == code));
    };
    add (TRANS ("As the system"), {});
    add ("English", english);
    for (const auto& [code, name] : translationsIn (home))
        add (name, code);
    return menu;
}

void MainView::openMenu (juce::Component& at)
{
    constexpr float widest = 280.0f;   // of a part of an entry, in pixels
    const auto font = lookOf (*this).getPopupMenuFont();
    juce::PopupMenu menu, recent, size;
    for (const auto& file : settings.recent)
        recent.addItem (menuItem (fittedPath (fromUtf8 (file.filename().string()), font, widest), fittedPath (folderText (file), font, widest),
                                  [this, file] { files.open (file); }));
    const auto addSize = [&] (const juce::String& name, double scale) {
        size.addItem (menuItem (
            name, {}, [this, scale] {
            settings.scale = scale;
            applyScale (scale);
            saveSettingsSoon(); },
            settings.scale == scale));
    };
    addSize (TRANS ("Automatic"), 0.0);
    for (const double scale : scales)
        addSize (juce::String (juce::roundToInt (100.0 * scale)) + " %", scale);

    menu.addItem (menuItem (TRANS ("New"), keyText ("ctrl + n"), [this] { files.create(); }));
    menu.addItem (menuItem (TRANS ("Open ..."), keyText ("ctrl + o"), [this] { files.open(); }));
    menu.addSubMenu (TRANS ("Open recent"), recent, ! settings.recent.empty());
    menu.addItem (menuItem (TRANS ("Save"), keyText ("ctrl + s"), [this] { files.save(); }));
    menu.addItem (menuItem (TRANS ("Save as ..."), keyText ("ctrl + shift + s"), [this] { files.saveAs(); }));
    menu.addItem (menuItem (TRANS ("Fit a recording ..."), {}, [this] { askForRecording(); }));
    menu.addSeparator();
    menu.addItem (menuItem (
        TRANS ("Light theme"), {}, [this] {
        settings.light = light = ! light;
        applyTheme (*getTopLevelComponent(), light ? Theme::light() : Theme::dark());
        saveSettingsSoon(); },
        light));
    menu.addSubMenu (TRANS ("Interface scale"), size);
    menu.addSubMenu (TRANS ("Language"), languageMenu());
    menu.addItem (menuItem (
        TRANS ("Fuse: run the graph as compiled code"), {}, [this] {
        settings.fuse = ! settings.fuse;
        applyFusion();
        saveSettingsSoon(); },
        settings.fuse));
    menu.addSeparator();
    menu.addItem (menuItem (TRANS ("Help on selected node"), "F1", [this] { helpOnSelection(); }));
    menu.addItem (menuItem (TRANS ("Keyboard shortcuts"), {}, [this] { help.showKeys(); }));
    menu.showMenuAsync (juce::PopupMenu::Options().withParentComponent (this).withTargetComponent (at).withMinimumWidth (240).withStandardItemHeight (28));
}

void MainView::askForFile (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)> chosen)
{
    const auto [title, patterns] = wordsFor (saves, begin);
    using Choice = juce::FileBrowserComponent;
    const int how = saves ? Choice::saveMode | Choice::canSelectFiles | Choice::warnAboutOverwriting : Choice::openMode | Choice::canSelectFiles;
    launchChooser (title, patterns, juce::File (begin.string()), how, std::move (chosen));
}

void MainView::askForRecording()
{
    const auto home_folder = juce::File::getSpecialLocation (juce::File::userHomeDirectory);
    launchChooser (TRANS ("Fit a recording"), "*.csv;*.tsv;*.txt;*.wav", recordings.isDirectory() ? recordings : home_folder,
                   juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles, [this] (const std::filesystem::path& file) {
                       recordings = juce::File (file.parent_path().string());
                       fitRecordingIn (file);
                   });
}

void MainView::launchChooser (const juce::String& title, const juce::String& patterns, const juce::File& begin, int how,
                              std::function<void (const std::filesystem::path&)> chosen)
{
    // Never a dialog of the desktop: that is another program, so its window would keep Esc from stopping the forces.
    constexpr bool of_the_desktop = false;
    chooser = std::make_unique<juce::FileChooser> (title, begin, patterns, of_the_desktop);
    chooser->launchAsync (how, [this, chosen = std::move (chosen)] (const juce::FileChooser& c) {
        takeFocus (patching);
        // Later, when the dialog is gone: it gives the focus back, which what `chosen` opens needs.
        if (const auto file = c.getResult(); file != juce::File())
            juce::MessageManager::callAsync ([safe = SafePointer (this), chosen, path = file.getFullPathName().toStdString()] {
                if (safe != nullptr) chosen (path);
            });
    });
}

void MainView::saveSettingsSoon()
{
    if (! home.empty()) ticks_to_save = ticks_before_saving;
}

}   // namespace tactus::host
