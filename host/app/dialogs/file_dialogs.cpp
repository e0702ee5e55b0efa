// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_dialogs.hpp"
#include "file_dialog_parts.hpp"

#include <host/app/inspector/settings/setting_editor.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/tools/stems/stems.hpp>
#include <tactus/text/quote.hpp>

#include <utility>

namespace tactus::host
{

namespace
{
constexpr const char* graphs_and_clips = "*.json;*.tactus;*.haptic;*.ahap;*.hjif;*.wav";
constexpr int opens = juce::FileBrowserComponent::openMode | juce::FileBrowserComponent::canSelectFiles;
constexpr int saves_as = juce::FileBrowserComponent::saveMode | juce::FileBrowserComponent::canSelectFiles;
constexpr int saves_in = juce::FileBrowserComponent::saveMode | juce::FileBrowserComponent::canSelectDirectories;

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

/// Makes a dialog choose the named folder, which may exist. JUCE would begin in it, and enter it at Return.
void nameFolder (juce::FileChooserDialogBox& dialog, juce::FileBrowserComponent& browser, juce::TextEditor& name, const juce::File& folder)
{
    browser.setRoot (folder.getParentDirectory());
    name.setText (folder.getFileName());
    name.onReturnKey = [&dialog] { dialog.exitModalState (1); };
}
}   // namespace

/// The title of a dialog in which a file is saved, the files that it shows, and what it chooses.
struct FileDialogs::SaveWords
{
    juce::String title, patterns;
    int how = saves_as;

    /// The words for a dialog, by the file name that it proposes.
    static SaveWords of (const std::filesystem::path& begin)
    {
        if (isClipExtension (begin)) return { TRANS ("Save clip; the ending of the name selects the format: .haptic, .ahap, .hjif or .wav"), clip_patterns };
        const auto name = begin.filename().string();
        if (extensionOf (begin) == ".csv") return { name.starts_with ("gesture") ? TRANS ("Save gesture") : TRANS ("Save data"), "*.csv" };
        if (extensionOf (begin) == ".jsonl") return { name.starts_with ("take") ? TRANS ("Save take") : TRANS ("Save test"), "*.jsonl" };
        if (extensionOf (begin) == ".svg") return { TRANS ("Save picture; the ending of the name selects the format"), "*.svg;*.pdf;*.png" };
        if (extensionOf (begin) == ".png") return { name.starts_with ("film") ? TRANS ("Save film") : TRANS ("Save image"), "*.png" };
        if (extensionOf (begin) == ".tactus") return { TRANS ("Share the graph as one file, with the files that it names"), "*.tactus" };
        if (begin.extension().empty()) return { TRANS ("Name a folder for the stems"), "*", saves_in };
        return { TRANS ("Save graph"), "*.json" };
    }
};

juce::String folderText (const std::filesystem::path& file)
{
    const auto folder = fromUtf8 (file.parent_path().string()), home = juce::File::getSpecialLocation (juce::File::userHomeDirectory).getFullPathName();
    return folder == home || folder.startsWith (home + "/") ? "~" + folder.substring (home.length()) : folder;
}

void FileDialogs::choose (bool saves, const Path& begin, TakePath chosen)
{
    if (saves)
    {
        const auto words = SaveWords::of (begin);
        const bool stays = words.how == saves_in || words.patterns == "*.json";   // a graph is saved beside the one that is open
        return save (words, stays ? begin : folderFor (words.patterns, begin.parent_path()) / begin.filename(), std::move (chosen));
    }
    if (extensionOf (begin) == ".jsonl")
        return open (TRANS ("Open take"), "*.jsonl", begin.parent_path(), std::move (chosen));
    open (TRANS ("Open graph or clip"), graphs_and_clips, begin, std::move (chosen));
}

FileDialogs::Path FileDialogs::folderFor (const juce::String& patterns, const Path& usual) const
{
    std::error_code failed;
    const auto last = folders.find (patterns.toStdString());
    const bool stays = (usual != ownFolder() && usual != presetFolder()) || last == folders.end() || ! std::filesystem::is_directory (last->second, failed);
    return stays ? usual : last->second;
}

void FileDialogs::noteFolder (const juce::String& patterns, const Path& folder)
{
    auto& last = folders[patterns.toStdString()];
    if (std::exchange (last, folder) != folder && onFolder) onFolder();
}

/// A name without one of the endings gets that of the proposed name: in "film v1.2", the dot is part of the name.
void FileDialogs::save (const SaveWords& words, const Path& begin, TakePath chosen)
{
    const auto ask = [this, words, begin, chosen = std::move (chosen)] (std::filesystem::path file) {
        if (! juce::WildcardFileFilter (words.patterns, "*", {}).isFileSuitable (fileAt (file))) file += begin.extension();
        std::error_code failed;
        // Of what is in a folder, only stems are replaced; a folder without them is refused, or empty.
        if (! std::filesystem::exists (words.how == saves_in ? file / list_of_stems : file, failed)) return chosen (file);
        const auto text = words.how == saves_in
                              ? TRANS ("It is in %1 already. The WAV files and clips of its last export are deleted; your own files in it stay.")
                              : TRANS ("It is in %1 already.");
        question.ask (filled (TRANS ("Replace %1?"), printableName (file.filename().string())), filled (text, folderText (file)),
                      { { TRANS ("Choose another name ..."), [this, words, file, chosen] { save (words, file, chosen); } },   // the default
                        { TRANS ("Replace"), [chosen, file] { chosen (file); } },
                        { TRANS ("Cancel"), {} } });
    };
    launch (words.title, words.patterns, begin, words.how, ask);
}

void FileDialogs::open (const juce::String& title, const juce::String& patterns, const Path& begin, TakePath chosen)
{
    std::error_code failed;
    auto from = folderFor (patterns, begin);   // or the nearest folder that exists: JUCE would take the name of a missing one for that of a file
    while (! std::filesystem::exists (from, failed) && from.has_relative_path())
        from = from.parent_path();
    launch (title, patterns, from, opens, std::move (chosen));
}

void FileDialogs::chooseInput (const juce::String& patterns, const Path& begin, TakePath chosen)
{
    static const ClipFilter only_clips;
    open (TRANS ("Choose a file"), patterns, begin.empty() ? ownFolder() : begin, std::move (chosen));
    auto* dialog = juce::Component::getCurrentlyModalComponent();
    if (auto* browser = dialog != nullptr && patterns == clip_patterns ? browserIn (*dialog) : nullptr)
    {
        browser->setFileFilter (&only_clips);
        browser->refresh();
    }
}

void FileDialogs::launch (const juce::String& title, const juce::String& patterns, const Path& begin, int how, TakePath chosen)
{
    // Never a dialog of the desktop: that is another program, so its window would keep Esc from stopping the forces. It is inside this window, so
    // it has the keyboard at once, whatever the window manager does.
    constexpr bool of_the_desktop = false;
    chooser = std::make_unique<juce::FileChooser> (title, fileAt (begin), patterns, of_the_desktop, false, &window);
    chooser->launchAsync (how, [this, patterns, how, chosen = std::move (chosen)] (const juce::FileChooser& c) {
        takeFocus (home);
        if (const auto file = c.getResult(); file != juce::File() && how != saves_in)
            noteFolder (patterns, file.getParentDirectory().getFullPathName().toStdString());
        // Later, when the dialog is gone: it gives the focus back, which what `chosen` opens needs.
        if (const auto file = c.getResult(); file != juce::File())
            juce::MessageManager::callAsync ([safe = juce::Component::SafePointer (&window), chosen, path = file.getFullPathName().toStdString()] {
                if (safe != nullptr) chosen (path);
            });
    });
    auto* dialog = dynamic_cast<juce::FileChooserDialogBox*> (juce::Component::getCurrentlyModalComponent());
    auto* name = dialog == nullptr ? nullptr : nameField (*dialog);
    if (name == nullptr) return;
    dialog->setBounds (dialog->getBounds().constrainedWithin (room()));
    if (auto* browser = browserIn (*dialog))
    {
        // JUCE takes what is typed into its list of places for an absolute path; a path can be typed as the name.
        for (auto* child : browser->getChildren())
            if (auto* places = dynamic_cast<juce::ComboBox*> (child)) places->setEditableText (false);
        path_keys = std::make_unique<PathKeys> (*browser);
        name->addKeyListener (path_keys.get());
        if (how == saves_in) nameFolder (*dialog, *browser, *name, fileAt (begin));
    }
    name->onEscapeKey = [dialog] { dialog->exitModalState (0); };   // the field would keep the key
    takeFocus (*name);
    name->selectAll();
}

void FileDialogs::keepKeyboard (juce::Component& modal)
{
    const auto* now = juce::Component::getCurrentlyFocusedComponent();
    auto* name = dynamic_cast<juce::FileChooserDialogBox*> (&modal) != nullptr ? nameField (modal) : nullptr;
    if (name != nullptr && (now == nullptr || now == &modal || ! modal.isParentOf (now))) takeFocus (*name);
}

/// The part of the window that dialogs may cover: STOP stays within reach.
juce::Rectangle<int> FileDialogs::room() const { return window.getLocalBounds().withTrimmedTop (kept_at_top); }

/// JUCE asks for the name of a new folder in a window of the desktop, which may come up anywhere, and gives the keyboard to its button.
void FileDialogs::attendNewFolder()
{
    auto* asks = dynamic_cast<juce::AlertWindow*> (juce::Component::getCurrentlyModalComponent());
    if (asks == nullptr || asks == begun.getComponent()) return;
    auto* name = nameField (*asks);
    if (name == nullptr) return;
    if (asks->getParentComponent() != &window) placeOverDialog (*asks);
    if (! name->hasKeyboardFocus (false)) return takeFocus (*name);
    begun = asks;
    openWhenMade (*asks, *name);
}

void FileDialogs::placeOverDialog (juce::AlertWindow& asks)
{
    const auto* dialog = juce::Component::getCurrentlyModalComponent (1);
    if (dialog == nullptr) return;
    window.addAndMakeVisible (asks);
    asks.setBounds (asks.getBounds().withCentre (dialog->getBounds().getCentre()).constrainedWithin (room()));
}

/// JUCE makes the folder and goes on to list the one around it.
void FileDialogs::openWhenMade (juce::AlertWindow& asks, juce::TextEditor& name)
{
    auto* dialog = dynamic_cast<juce::FileChooserDialogBox*> (juce::ModalComponentManager::getInstance()->getModalComponent (1));
    auto* browser = dialog == nullptr ? nullptr : browserIn (*dialog);
    if (browser == nullptr) return;
    const auto open = [browser = juce::Component::SafePointer (browser), name = juce::Component::SafePointer (&name)] (int result) {
        if (result == 0 || browser == nullptr || name == nullptr) return;
        const auto folder = browser->getRoot().getChildFile (juce::File::createLegalFileName (name->getText()));
        juce::MessageManager::callAsync ([browser, folder] {   // when it is made
            if (browser != nullptr && folder != browser->getRoot() && folder.isDirectory()) browser->setRoot (folder);
        });
    };
    juce::ModalComponentManager::getInstance()->attachCallback (&asks, juce::ModalCallbackFunction::create (open));
}

}   // namespace tactus::host
