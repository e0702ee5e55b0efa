// SPDX-License-Identifier: GPL-3.0-or-later
// The menu of the window.
#include "appearance.hpp"
#include "main_view.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/storage/share.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/text/quote.hpp>

#include <array>

namespace tactus::host
{

namespace
{
constexpr std::array scales { 1.0, 1.25, 1.5, 2.0 };

}   // namespace

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
    if (! edited.graph().root.nodes.empty()) menu.addItem (menuItem (TRANS ("Add a graph to this one ..."), {}, [this] { askForAdded (desk); }));
    menu.addItem (menuItem (TRANS ("Save"), keyText ("ctrl + s"), [this] { files.save(); }));
    menu.addItem (menuItem (TRANS ("Save as ..."), keyText ("ctrl + shift + s"), [this] { files.saveAs(); }));
    if (! edited.graph().root.nodes.empty()) menu.addItem (menuItem (TRANS ("Share as one file ..."), {}, [this] { share(); }));
    auto revert = menuItem (TRANS ("Reload from the file"), {}, [this] { files.reload(); });
    revert.isEnabled = ! edited.file().empty();
    menu.addItem (revert);
    menu.addItem (menuItem (TRANS ("Save picture of the canvas ..."), {}, [this] { savePictureAs(); }));
    if (! edited.graph().root.nodes.empty()) menu.addItem (menuItem (TRANS ("Export stems ..."), {}, [this] { stems.ask(); }));
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
    desk.tell (TRANS ("Remote control (OSC)"), text);
}

void MainView::openMenu (juce::Component& at)
{
    windowMenu().showMenuAsync (
        juce::PopupMenu::Options().withParentComponent (this).withTargetComponent (at).withMinimumWidth (240).withStandardItemHeight (28));
}

void MainView::share()
{
    const auto& name = edited.graph().name;
    const auto legal = juce::File::createLegalFileName (name.empty() ? "preset" : fromUtf8 (name)).replaceCharacter ('.', '_').toStdString();
    desk.chooseOwnFile (legal + ".tactus", [this] (const std::filesystem::path& file) {
        const auto written = sharePreset (edited.graph(), file);
        status.notify (written ? filled (TRANS ("Saved %1"), file.string()) : fromUtf8 (messageText (written.error())));
    });
}

void MainView::askForRecording()
{
    std::error_code failed;
    const auto home_folder = juce::File::getSpecialLocation (juce::File::userHomeDirectory).getFullPathName().toStdString();
    dialogs.open (TRANS ("Fit a recording"), "*.csv;*.tsv;*.txt;*.wav",
                  std::filesystem::is_directory (recordings, failed) ? recordings : std::filesystem::path (home_folder),
                  [this] (const std::filesystem::path& file) {
                      recordings = file.parent_path();
                      fitRecordingIn (file);
                  });
}

}   // namespace tactus::host
