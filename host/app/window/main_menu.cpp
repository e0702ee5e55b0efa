// SPDX-License-Identifier: GPL-3.0-or-later
#include "main_menu.hpp"
#include "graph_commands.hpp"

#include <host/app/adding/add_graph.hpp>
#include <host/app/look/appearance.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

juce::PopupMenu::Item MainMenu::item (const juce::String& text, const juce::String& keys, std::function<void()> act, bool is_ticked) const
{
    juce::PopupMenu::Item made (text);
    made.shortcutKeyDescription = keys;
    made.isTicked = is_ticked;
    made.action = [open = juce::Component::SafePointer (&parts.window), act = std::move (act)]   // called later, when the window may be gone
    {
        if (open != nullptr) act();
    };
    return made;
}

juce::PopupMenu MainMenu::items()
{
    juce::PopupMenu menu;
    addFiles (menu);
    addGraph (menu);
    menu.addSeparator();
    addLook (menu);
    menu.addSeparator();
    addHelp (menu);
    if (! onQuit) return menu;
    menu.addSeparator();
    menu.addItem (item (TRANS ("Quit"), keyText ("ctrl + q"), onQuit));
    return menu;
}

void MainMenu::open (juce::Component& at)
{
    items().showMenuAsync (
        juce::PopupMenu::Options().withParentComponent (&parts.window).withTargetComponent (at).withMinimumWidth (240).withStandardItemHeight (28));
}

void MainMenu::addFiles (juce::PopupMenu& menu)
{
    const bool is_empty = parts.edited.graph().root.nodes.empty();
    const auto fresh = templates();
    menu.addItem (item (TRANS ("New"), keyText ("ctrl + n"), [this] { parts.files.create(); }));
    menu.addSubMenu (TRANS ("New from template"), fresh, fresh.getNumItems() > 0);
    menu.addItem (item (TRANS ("Open ..."), keyText ("ctrl + o"), [this] { parts.files.open(); }));
    menu.addSubMenu (TRANS ("Open recent"), recentFiles(), ! parts.settings.recent.empty());
    if (! is_empty) menu.addItem (item (TRANS ("Add a graph to this one ..."), {}, [this] { askForAdded (parts.desk); }));
    menu.addItem (item (TRANS ("Save"), keyText ("ctrl + s"), [this] { parts.files.save(); }));
    menu.addItem (item (TRANS ("Save as ..."), keyText ("ctrl + shift + s"), [this] { parts.files.saveAs(); }));
    if (! is_empty) menu.addItem (item (TRANS ("Share as one file ..."), {}, [this] { shareAs (parts.desk); }));
    auto revert = item (TRANS ("Reload from the file"), {}, [this] { parts.files.reload(); });
    revert.isEnabled = ! parts.edited.file().empty();
    menu.addItem (revert);
}

void MainMenu::addGraph (juce::PopupMenu& menu)
{
    const auto askForRecording = [this] {
        std::error_code failed;
        const auto& last = parts.settings.recordings;
        parts.dialogs.open (TRANS ("Fit a recording"), "*.csv;*.tsv;*.txt;*.wav", std::filesystem::is_directory (last, failed) ? last : ownFolder(),
                            parts.desk.fitRecording);
    };
    const bool is_empty = parts.edited.graph().root.nodes.empty();
    menu.addItem (item (TRANS ("Save picture of the canvas ..."), {}, [this] { savePictureAs (parts.desk); }));
    if (! is_empty) menu.addItem (item (TRANS ("Export stems ..."), {}, [this] { parts.stems.ask(); }));
    if (! is_empty) menu.addItem (item (TRANS ("Randomise the numbers of the selection, or of all nodes"), {}, [this] { randomise (parts.desk); }));
    menu.addItem (item (TRANS ("Fit a recording ..."), {}, askForRecording));
}

void MainMenu::addLook (juce::PopupMenu& menu)
{
    const auto changeTheme = [this] {
        parts.settings.light = parts.light = ! parts.light;
        parts.applyTheme();
        parts.desk.settingsChanged();
    };
    const auto changeFusion = [this] {
        parts.settings.fuse = ! parts.settings.fuse;
        parts.applyFusion();
        parts.desk.settingsChanged();
    };
    const auto fold = [this] { parts.layout.foldPanels(); };
    menu.addItem (item (TRANS ("Light theme"), {}, changeTheme, parts.light));
    menu.addItem (item (TRANS ("Only the canvas: hide the panels"), keyText ("z"), fold, parts.layout.isCanvasAlone()));
    menu.addSubMenu (TRANS ("Interface scale"), scales());
    menu.addSubMenu (TRANS ("Language"), languages());
    menu.addItem (item (TRANS ("Fuse: run the graph as compiled code"), {}, changeFusion, parts.settings.fuse));
}

void MainMenu::addHelp (juce::PopupMenu& menu)
{
    menu.addItem (item (TRANS ("Help on selected node"), "F1", [this] { parts.showHelp(); }));
    menu.addItem (item (TRANS ("Guided tour"), keyText ("shift + F1"), onTour));
    menu.addItem (item (TRANS ("Keyboard shortcuts"), {}, [this] { parts.help.showKeys(); }));
    menu.addItem (item (TRANS ("Find a command ..."), keyText ("ctrl + k"), onFind));
    menu.addItem (item (TRANS ("Remote control (OSC) ..."), {}, onOsc));
}

juce::PopupMenu MainMenu::templates() const
{
    juce::PopupMenu menu;
    for (const auto& t : parts.templates.all())
        menu.addItem (item (juce::translate (juce::String (t.name)), {}, [this, file = t.file] { parts.desk.feel (file, true); }));
    return menu;
}

juce::PopupMenu MainMenu::recentFiles() const
{
    constexpr float widest = 280.0f;   // of a part of an entry, in pixels
    const auto font = lookOf (parts.window).getPopupMenuFont();
    juce::PopupMenu menu;
    for (const auto& file : parts.settings.recent)
        menu.addItem (item (fittedPath (fromUtf8 (file.filename().string()), font, widest), fittedPath (folderText (file), font, widest),
                            [this, file] { parts.files.open (file); }));
    return menu;
}

juce::PopupMenu MainMenu::scales() const
{
    juce::PopupMenu menu;
    const auto add = [&] (const juce::String& name, double scale) {
        const auto choose = [this, scale] {
            parts.settings.scale = scale;
            applyScale (scale);
            parts.desk.settingsChanged();
        };
        menu.addItem (item (name, {}, choose, parts.settings.scale == scale));
    };
    add (TRANS ("Automatic"), 0.0);
    for (const double scale : { 1.0, 1.25, 1.5, 2.0 })
        add (juce::String (juce::roundToInt (100.0 * scale)) + " %", scale);
    return menu;
}

juce::PopupMenu MainMenu::languages() const
{
    juce::PopupMenu menu;
    const auto add = [&] (const juce::String& name, const std::string& code) {
        const auto choose = [this, code] {
            parts.settings.language = code;
            parts.desk.settingsChanged();
            parts.status.notify (TRANS ("The language changes at the next start."));
        };
        menu.addItem (item (name, {}, choose, parts.settings.language == code));
    };
    add (TRANS ("As the system"), {});
    add ("English", english);
    for (const auto& [code, name] : translationsIn (parts.saver.home()))
        add (name, code);
    return menu;
}

}   // namespace tactus::host
