// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "question.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace tactus::host
{

/// The dialogs of a window in which a file is chosen. They open inside the window, below the place of STOP. [main thread]
class FileDialogs
{
public:
    using Path = std::filesystem::path;
    using TakePath = std::function<void (const Path&)>;   ///< called unless the user cancels

    /// The dialogs keep clear of the upper edge of the window. When one closes, `home` gets the keyboard. `last_folders` are those in which files were
    /// last chosen, by the patterns of the dialog; one that would begin in the folder of the user or in that of the presets begins there.
    FileDialogs (juce::Component& in, int upper_edge, juce::Component& gets_keyboard, Question& q,
                 std::map<std::string, std::filesystem::path>& last_folders)
        : window (in), kept_at_top (upper_edge), home (gets_keyboard), question (q), folders (last_folders)
    {
    }

    /// Asks for a graph, a clip or a take to open, or where to save a file; `begin` is the folder or the file to begin with, and says which kind.
    void choose (bool saves, const Path& begin, TakePath);
    void chooseInput (const juce::String& patterns, const Path& begin, TakePath);   ///< a file that a setting names; without a folder: in that of the user
    void open (const juce::String& title, const juce::String& patterns, const Path& begin, TakePath);

    std::function<void()> onFolder;   ///< called when a file was chosen in another folder than the last one

    void attendNewFolder();                 ///< call many times a second
    void keepKeyboard (juce::Component&);   ///< of what is modal: a menu that closes after its entry has opened a dialog takes the keyboard from the name

private:
    struct SaveWords;
    void save (const SaveWords&, const Path& begin, TakePath);
    void launch (const juce::String& title, const juce::String& patterns, const Path& begin, int how, TakePath);
    void placeOverDialog (juce::AlertWindow&);
    Path folderFor (const juce::String& patterns, const Path& usual) const;
    void noteFolder (const juce::String& patterns, const Path&);
    void openWhenMade (juce::AlertWindow&, juce::TextEditor& name);
    juce::Rectangle<int> room() const;

    juce::Component& window;
    const int kept_at_top;
    juce::Component& home;
    Question& question;
    std::map<std::string, Path>& folders;
    std::unique_ptr<juce::KeyListener> path_keys;   // of the chooser's field
    std::unique_ptr<juce::FileChooser> chooser;
    juce::Component::SafePointer<juce::Component> begun;   // the dialog for a new folder, once its name has the keyboard
};

/// The folder of a file, from ~ on if it is in the home folder of the user.
juce::String folderText (const std::filesystem::path& file);

}   // namespace tactus::host
