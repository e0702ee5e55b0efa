// SPDX-License-Identifier: GPL-3.0-or-later
// The menu of the window, and the dialogs for files.
#include "appearance.hpp"
#include "main_view.hpp"

#include <host/app/dialogs/file_dialog_parts.hpp>
#include <host/app/inspector/settings/file_text.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/storage/share.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <tactus/text/quote.hpp>

#include <array>

namespace tactus::host
{

namespace
{
constexpr std::array scales { 1.0, 1.25, 1.5, 2.0 };

/// The folder of a file, from ~ on if it is in the home folder of the user.
juce::String folderText (const std::filesystem::path& file)
{
    const auto folder = fromUtf8 (file.parent_path().string()), home = juce::File::getSpecialLocation (juce::File::userHomeDirectory).getFullPathName();
    return folder == home || folder.startsWith (home + "/") ? "~" + folder.substring (home.length()) : folder;
}

constexpr const char* graphs_and_clips = "*.json;*.tactus;*.haptic;*.ahap;*.hjif;*.wav";

/// One Return on the path of a file chooses the file. JUCE only goes to its folder, and wants a second one.
class PathKeys final : public juce::KeyListener
{
public:
    explicit PathKeys (juce::FileBrowserComponent& b) : browser (b) {}

    bool keyPressed (const juce::KeyPress& key, juce::Component* field) override
    {
        auto* name = dynamic_cast<juce::TextEditor*> (field);
        if (name == nullptr || key != juce::KeyPress::returnKey || ! name->getText().containsChar (juce::File::getSeparatorChar())) return false;
        const auto file = browser.getRoot().getChildFile (name->getText());
        if (file.isDirectory() || ! file.getParentDirectory().isDirectory()) return false;
        browser.setRoot (file.getParentDirectory());
        name->setText (file.getFileName(), false);
        return false;   // the field acts on the key, too
    }

private:
    juce::FileBrowserComponent& browser;
};

/// A filter for files that may be clips. Of the .json files, it lets only clips pass: others are graphs, which may be in the same folder.
class ClipFilter final : public juce::WildcardFileFilter
{
public:
    ClipFilter() : WildcardFileFilter (clip_patterns, "*", {}) {}

    /// Called on the thread of JUCE that lists files.
    bool isFileSuitable (const juce::File& file) const override
    {
        constexpr juce::int64 most = 4 << 20;   // bytes; a longer one is shown unread
        if (! WildcardFileFilter::isFileSuitable (file)) return false;
        return ! file.hasFileExtension (".json") || file.getSize() > most || isClipFile (file.getFullPathName().toStdString());
    }
};

/// A path may be relative, which juce::File does not take.
juce::File fileAt (const std::filesystem::path& path) { return juce::File::getCurrentWorkingDirectory().getChildFile (fromUtf8 (path.string())); }
}   // namespace

/// The title of a dialog in which a file is saved, and the files that it shows.
struct MainView::SaveWords
{
    juce::String title, patterns;

    /// The words for a dialog, by the file name that it proposes.
    static SaveWords of (const std::filesystem::path& begin)
    {
        if (isClipExtension (begin)) return { TRANS ("Save clip; the ending of the name selects the format"), clip_patterns };
        if (extensionOf (begin) == ".csv") return { TRANS ("Save gesture"), "*.csv" };
        if (begin.filename().string().starts_with ("take")) return { TRANS ("Save take"), "*.jsonl" };
        if (extensionOf (begin) == ".jsonl") return { TRANS ("Save test"), "*.jsonl" };
        if (extensionOf (begin) == ".svg") return { TRANS ("Save picture; the ending of the name selects the format"), "*.svg;*.pdf;*.png" };
        if (extensionOf (begin) == ".png") return { TRANS ("Save film"), "*.png" };
        if (extensionOf (begin) == ".tactus") return { TRANS ("Share the graph as one file, with the files that it names"), "*.tactus" };
        if (begin.extension().empty()) return { TRANS ("Name a folder for the stems"), "*" };
        return { TRANS ("Save graph"), "*.json" };
    }
};

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

juce::PopupMenu MainView::windowMenu()
{
    constexpr float widest = 280.0f;   // of a part of an entry, in pixels
    const auto font = lookOf (*this).getPopupMenuFont();
    juce::PopupMenu menu, recent, size, fresh;
    for (const auto& t : templates.all())
        fresh.addItem (menuItem (juce::translate (juce::String (t.name)), {}, [this, file = t.file] { feel (file, true); }));
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
    menu.addSubMenu (TRANS ("New from template"), fresh, fresh.getNumItems() > 0);
    menu.addItem (menuItem (TRANS ("Open ..."), keyText ("ctrl + o"), [this] { files.open(); }));
    menu.addSubMenu (TRANS ("Open recent"), recent, ! settings.recent.empty());
    if (! edited.graph().root.nodes.empty()) menu.addItem (menuItem (TRANS ("Add a graph to this one ..."), {}, [this] { askForAdded(); }));
    menu.addItem (menuItem (TRANS ("Save"), keyText ("ctrl + s"), [this] { files.save(); }));
    menu.addItem (menuItem (TRANS ("Save as ..."), keyText ("ctrl + shift + s"), [this] { files.saveAs(); }));
    if (! edited.graph().root.nodes.empty()) menu.addItem (menuItem (TRANS ("Share as one file ..."), {}, [this] { share(); }));
    auto revert = menuItem (TRANS ("Reload from the file"), {}, [this] { files.reload(); });
    revert.isEnabled = ! edited.file().empty();
    menu.addItem (revert);
    menu.addItem (menuItem (TRANS ("Save picture of the canvas ..."), {}, [this] { savePictureAs(); }));
    if (! edited.graph().root.nodes.empty()) menu.addItem (menuItem (TRANS ("Export stems ..."), {}, [this] { stems.ask (edited.graph()); }));
    if (! edited.graph().root.nodes.empty())
        menu.addItem (menuItem (TRANS ("Randomise the numbers of the selection, or of all nodes"), {}, [this] { randomise(); }));
    menu.addItem (menuItem (TRANS ("Fit a recording ..."), {}, [this] { askForRecording(); }));
    menu.addSeparator();
    menu.addItem (menuItem (
        TRANS ("Light theme"), {}, [this] {
        settings.light = light = ! light;
        applyTheme (*getTopLevelComponent(), light ? Theme::light() : Theme::dark());
        saveSettingsSoon(); },
        light));
    menu.addItem (menuItem (
        TRANS ("Only the canvas: hide the panels"), keyText ("z"), [this] { foldPanels(); }, is_canvas_alone));
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
    menu.addItem (menuItem (TRANS ("Guided tour"), keyText ("shift + F1"), [this] { beginTour(); }));
    menu.addItem (menuItem (TRANS ("Keyboard shortcuts"), {}, [this] { help.showKeys(); }));
    menu.addItem (menuItem (TRANS ("Find a command ..."), keyText ("ctrl + k"), [this] { findAction(); }));
    menu.addItem (menuItem (TRANS ("Remote control (OSC) ..."), {}, [this] { tellAboutOsc(); }));
    if (! onQuit) return menu;
    menu.addSeparator();
    menu.addItem (menuItem (TRANS ("Quit"), keyText ("ctrl + q"), onQuit));
    return menu;
}

void MainView::tellAboutOsc()
{
    auto text = osc_server == nullptr
                    ? TRANS ("No OSC messages are received. Another program may have the port. `tactus-host --osc 0` takes any free port.")
                    : filled (TRANS ("OSC messages to the UDP port %1 set parameters, turn controls, probe ports, and stop the run: "
                                     "`tactus set roughness=0.5`, or /tactus/control with a name and a number from 0 to 1. docs/osc.md lists them."),
                              osc_server->port());
    if (const auto losses = osc_server == nullptr ? std::string() : osc_server->losses(); ! losses.empty())
        text += "\n\n" + filled (TRANS ("Packets or messages dropped: %1"), losses);
    tell (TRANS ("Remote control (OSC)"), text);
}

void MainView::openMenu (juce::Component& at)
{
    windowMenu().showMenuAsync (
        juce::PopupMenu::Options().withParentComponent (this).withTargetComponent (at).withMinimumWidth (240).withStandardItemHeight (28));
}

void MainView::askForFile (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)> chosen)
{
    if (saves) return askWhereToSave (SaveWords::of (begin), begin, std::move (chosen));
    using Choice = juce::FileBrowserComponent;
    if (extensionOf (begin) == ".jsonl")
        return launchChooser (TRANS ("Open take"), "*.jsonl", fileAt (begin.parent_path()), Choice::openMode | Choice::canSelectFiles, std::move (chosen));
    launchChooser (TRANS ("Open graph or clip"), graphs_and_clips, fileAt (begin), Choice::openMode | Choice::canSelectFiles, std::move (chosen));
}

/// A name without one of the endings gets that of the proposed name: in "film v1.2", the dot is part of the name.
void MainView::askWhereToSave (const SaveWords& words, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)> chosen)
{
    using Choice = juce::FileBrowserComponent;
    const auto ask = [this, words, begin, chosen = std::move (chosen)] (std::filesystem::path file) {
        if (! juce::WildcardFileFilter (words.patterns, "*", {}).isFileSuitable (fileAt (file))) file += begin.extension();
        std::error_code failed;
        if (! std::filesystem::exists (file, failed)) return chosen (file);
        question.ask (filled (TRANS ("Replace %1?"), printableName (file.filename().string())), filled (TRANS ("It is in %1 already."), folderText (file)),
                      { { TRANS ("Choose another name ..."), [this, words, file, chosen] { askWhereToSave (words, file, chosen); } },   // the default
                        { TRANS ("Replace"), [chosen, file] { chosen (file); } },
                        { TRANS ("Cancel"), {} } });
    };
    launchChooser (words.title, words.patterns, fileAt (begin), Choice::saveMode | Choice::canSelectFiles, ask);
}

void MainView::askForSetting (const juce::String& patterns, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)> chosen)
{
    static const ClipFilter only_clips;
    using Choice = juce::FileBrowserComponent;
    const auto folder = begin.empty() ? ownFolder() : begin;
    launchChooser (TRANS ("Choose a file"), patterns, fileAt (folder),
                   Choice::openMode | Choice::canSelectFiles, std::move (chosen));
    auto* dialog = getCurrentlyModalComponent();
    if (auto* browser = dialog != nullptr && patterns == clip_patterns ? browserIn (*dialog) : nullptr)
    {
        browser->setFileFilter (&only_clips);
        browser->refresh();
    }
}

void MainView::share()
{
    const auto& name = edited.graph().name;
    const auto legal = juce::File::createLegalFileName (name.empty() ? "preset" : fromUtf8 (name)).replaceCharacter ('.', '_').toStdString();
    chooseOwnFile (legal + ".tactus", [this] (const std::filesystem::path& file) {
        const auto written = sharePreset (edited.graph(), file);
        status.notify (written ? filled (TRANS ("Saved %1"), file.string()) : fromUtf8 (messageText (written.error())));
    });
}

void MainView::askForRecording()
{
    const auto home_folder = juce::File::getSpecialLocation (juce::File::userHomeDirectory);
    launchChooser (TRANS ("Fit a recording"), "*.csv;*.tsv;*.txt;*.wav", recordings.isDirectory() ? recordings : home_folder,
                   juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles, [this] (const std::filesystem::path& file) {
                       recordings = fileAt (file.parent_path());
                       fitRecordingIn (file);
                   });
}

/// Asks for the file that a setting needs.
void MainView::askForMissing (const Message& m)
{
    const auto missing = missingFileOf (edited.graph(), m);
    if (! missing) return;
    auto begin = missing->expected.empty() ? std::filesystem::path (edited.graph().folder) : missing->expected.parent_path();
    if (std::error_code failed; ! std::filesystem::is_directory (begin, failed)) begin = ownFolder();
    launchChooser (TRANS ("Choose a file"), patternsOf (missing->kind), fileAt (begin),
                   juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles, [this, m] (const std::filesystem::path& file) {
                       if (const auto now = missingFileOf (edited.graph(), m)) edited.perform (useFile (edited.graph(), *now, file));
                   });
}

void MainView::launchChooser (const juce::String& title, const juce::String& patterns, const juce::File& begin, int how,
                              std::function<void (const std::filesystem::path&)> chosen)
{
    // Never a dialog of the desktop: that is another program, so its window would keep Esc from stopping the forces. It is inside this window, so
    // it has the keyboard at once, whatever the window manager does.
    constexpr bool of_the_desktop = false;
    chooser = std::make_unique<juce::FileChooser> (title, begin, patterns, of_the_desktop, false, this);
    chooser->launchAsync (how, [this, chosen = std::move (chosen)] (const juce::FileChooser& c) {
        takeFocus (patching);
        // Later, when the dialog is gone: it gives the focus back, which what `chosen` opens needs.
        if (const auto file = c.getResult(); file != juce::File())
            juce::MessageManager::callAsync ([safe = SafePointer (this), chosen, path = file.getFullPathName().toStdString()] {
                if (safe != nullptr) chosen (path);
            });
    });
    auto* dialog = dynamic_cast<juce::FileChooserDialogBox*> (getCurrentlyModalComponent());
    auto* name = dialog == nullptr ? nullptr : nameField (*dialog);
    if (name == nullptr) return;
    dialog->setBounds (dialog->getBounds().constrainedWithin (getLocalBounds().withTrimmedTop (SafetyStrip::height)));   // STOP stays within reach
    if (auto* browser = browserIn (*dialog))
    {
        // JUCE takes what is typed into its list of places for an absolute path; a path can be typed as the name.
        for (auto* child : browser->getChildren())
            if (auto* places = dynamic_cast<juce::ComboBox*> (child)) places->setEditableText (false);
        path_keys = std::make_unique<PathKeys> (*browser);
        name->addKeyListener (path_keys.get());
    }
    name->onEscapeKey = [dialog] { dialog->exitModalState (0); };   // the field would keep the key
    takeFocus (*name);
    name->selectAll();
}

}   // namespace tactus::host
