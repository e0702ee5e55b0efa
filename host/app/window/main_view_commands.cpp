// SPDX-License-Identifier: GPL-3.0-or-later
// What the keys of the window do.
#include "main_view.hpp"

#include <host/app/compose/variation.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <host/app/welcome/example.hpp>
#include <tactus/file/graph_file.hpp>

namespace tactus::host
{

namespace
{
constexpr int ticks_before_saving = 15;   // timer ticks; half a second, so that a drag writes the settings only once
}   // namespace

bool MainView::keyPressed (const juce::KeyPress& key)
{
    // A dialog for files or a menu, which is inside this window, has had the key. Its buttons may still want it.
    if (juce::Component::getNumCurrentlyModalComponents() > 0)
    {
        const bool stops = key.getKeyCode() == juce::KeyPress::escapeKey && playback.current().isWanted() && (key.getModifiers().isShiftDown() || escStops());
        if (stops) stopBy (key);
        return stops;
    }
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
    if (openCover() != nullptr) return true;   // it has had the key
    if (fileKey (key) || panelKey (key)) return true;
    if (key == juce::KeyPress::createFromDescription ("shift + F1"))
    {
        beginTour();
        return true;
    }
    if (key == juce::KeyPress::F1Key || key.getTextCharacter() == '?')
    {
        help.isOpen() ? help.close() : helpOnSelection();
        return true;
    }
    if (clutchKey (key) || top.snapshotKey (key)) return true;
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
    // Keys that move or delete the selected nodes are for the canvas alone. In a panel, such a key is meant for a value.
    const bool is_in_panel = inspector.hasKeyboardFocus (true) || bottom.hasKeyboardFocus (true);
    if (is_in_panel && (isErasing (key) || isArrow (key))) return false;
    const bool is_hidden = ! patching.isVisible();   // you would not see what you edit
    return ! is_hidden && patching.keyPressed (key);
}

const MainView::Attached* MainView::openCover() const
{
    const auto found = std::ranges::find_if (panels, [] (const Attached& p) { return p.tabs == nullptr && p.component.isVisible(); });
    return found == panels.end() ? nullptr : &*found;
}

/// True if Esc would close something: a question, the help, the palette, a menu, a dialog, or a field in which text is typed; or if it would
/// bring the keyboard from the inspector back to the canvas.
bool MainView::isAnythingOpen() const
{
    return inspector.hasKeyboardFocus (true) || question.isOpen() || openCover() != nullptr || help.isOpen() || tour.isOpen() || palette.isVisible()
           || juce::Component::getNumCurrentlyModalComponents() > 0
           || dynamic_cast<juce::TextEditor*> (juce::Component::getCurrentlyFocusedComponent()) != nullptr;
}

/// Esc closes a page, a dialog or a field before it stops, unless there are motors: then the user should not have to look first. While a graph runs, it
/// stops before it closes the palette or a menu, which open briefly over the graph.
bool MainView::escStops()
{
    const auto* modal = juce::Component::getCurrentlyModalComponent();
    const bool is_menu_open = modal != nullptr && menus.isParentOf (modal);
    return playback.current().drivesDevice() || is_menu_open || palette.isVisible() || ! isAnythingOpen();
}

/// A stop must work whichever component has the focus: a text field or a menu would swallow the key.
void MainView::globalFocusChanged (juce::Component* now)
{
    if (focused != nullptr) focused->removeKeyListener (this);
    focused = now != this ? now : nullptr;
    if (focused != nullptr) focused->addKeyListener (this);
    if (focused != nullptr) inspector.reveal (*focused);
    if (now == nullptr) endDrag();
    attendClutch();
    keepKeyboard();
}

/// Another program has the keyboard: it gets the release of a button, too, for example after the window was minimised. So a drag ends here, and the
/// mouse does not go on pressing the tool without a button.
void MainView::endDrag()
{
    auto* peer = getPeer();
    const auto mouse = juce::Desktop::getInstance().getMainMouseSource();
    if (peer == nullptr || peer->isFocused() || ! mouse.isDragging()) return;
    const auto released = juce::ModifierKeys::currentModifiers = juce::ModifierKeys::currentModifiers.withoutMouseButtons();
    peer->handleMouseEvent (juce::MouseInputSource::InputSourceType::mouse, peer->globalToLocal (mouse.getScreenPosition()), released,
                            juce::MouseInputSource::defaultPressure, juce::MouseInputSource::defaultOrientation, juce::Time::currentTimeMillis());
}

/// Applies what is typed before a button acts, because a button may undo, store a snapshot or make a file. `focused` is still the field: a press
/// takes the focus at once, but tells of it later.
void MainView::mouseDown (const juce::MouseEvent& e)
{
    wake();
    if (focused != nullptr && e.eventComponent != focused && ! focused->isParentOf (e.eventComponent)) endTyping (focused);
}

bool MainView::keyPressed (const juce::KeyPress& key, juce::Component*)
{
    if (key.getKeyCode() != juce::KeyPress::escapeKey) return false;
    const bool stops = playback.current().isWanted() && (key.getModifiers().isShiftDown() || escStops());
    if (stops) stopBy (key);
    if (patching.cancelDrag() || stops) return true;   // the next Esc closes what is open
    const bool has_dialog = question.isOpen() || palette.isVisible() || juce::Component::getNumCurrentlyModalComponents() > 0;
    if (! help.isOpen() || openCover() != nullptr || has_dialog) return false;
    help.close();   // even while a field has the keyboard, which would keep the key
    return true;
}

void MainView::stopBy (const juce::KeyPress& key) { key.getModifiers().isShiftDown() ? playback.emergencyStop() : playback.stop(); }

void MainView::escape (const juce::KeyPress& key)
{
    status.clearNotice();
    if (playback.current().isWanted() && (key.getModifiers().isShiftDown() || escStops())) return stopBy (key);
    if (question.isOpen()) return question.cancel();
    if (const auto* cover = openCover()) return cover->panel.escape();
    if (help.isOpen()) return help.close();
    if (tour.isOpen() && ! palette.isVisible()) return tour.close();
    if (hand.isEnlarged() && ! palette.isVisible()) return hand.enlarge (false);
    palette.close();
    if (inspector.hasKeyboardFocus (true)) turnTo (patching);
    takeFocus (keyboardHome());
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
    else if (is ("ctrl + q") && onQuit)
        onQuit();
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
    const auto shipped = desk.presets();
    const Preset* smallest = nullptr;
    for (const auto& p : shipped)
        if (p.problem.empty() && p.types.contains (type) && (smallest == nullptr || p.types.size() < smallest->types.size())) smallest = &p;
    if (smallest != nullptr) return files.openCopy (smallest->file, false);
    if (const auto* known = catalogue.find (type)) files.openGraph (exampleOf (*known, catalogue), filled (TRANS ("example of %1"), type).toStdString(), false);
}

/// New values for the selected nodes, or for all of the patch.
void MainView::randomise()
{
    std::vector<graph::Id> nodes;
    for (const auto& n : patching.scene().nodes())
        if (patching.selection().empty() || patching.selection().contains (n.id)) nodes.push_back (n.id);
    const auto seed = static_cast<std::uint64_t> (1 + juce::Random::getSystemRandom().nextInt (9999));
    auto batch = randomised (edited.graph(), patching.patch(), nodes, catalogue, seed);
    if (batch.commands.empty()) return status.notify (TRANS ("Nothing here has a number with a usual range."));
    const auto count = batch.commands.size();
    if (edited.perform (std::move (batch)))
        status.notify (filled (TRANS ("%1 new values, with the seed %2. Ctrl+Z restores the old ones."), count, juce::String (seed)));
}

void MainView::saveSettingsSoon()
{
    if (! home.empty()) ticks_to_save = ticks_before_saving;
    wake();
}

}   // namespace tactus::host
