// SPDX-License-Identifier: GPL-3.0-or-later
#include "main_view.hpp"

#include <host/app/look/appearance.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/files/clip_io.hpp>
#include <host/base/files/preset_pack.hpp>
#include <host/base/juce/native_window.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

constexpr int refreshes_per_second = 30;
constexpr int refreshes_at_rest = 4, refreshes_until_rest = 60;   // at rest, only devices and other threads can change anything
constexpr int repaints_for_caret = 20;                            // at rest; it blinks every 380 ms

bool isRecording (const fs::path& file)
{
    const auto extension = extensionOf (file);
    return extension == ".csv" || extension == ".tsv" || extension == ".txt";
}

/// The text about an undo or a redo, which may have changed something that is not in view.
juce::String steppedText (const Document& document)
{
    const auto from = *document.steppedFrom(), to = document.history().position();
    const auto first = std::min (from, to), steps = std::max (from, to) - first;
    const auto what = steps == 1 ? valueText (document.stepName (first)) : filled (TRANS ("%1 steps"), steps);
    return filled (to < from ? TRANS ("Undone: %1") : TRANS ("Redone: %1"), what);
}
}   // namespace

MainView::MainView (const Catalogue& c) : parts (c, *this, fileCallbacks())
{
    setOpaque (true);
    setTitle ("Tactus");
    setWantsKeyboardFocus (true);
    setDesk();
    parts.add();
    connect();
    setKeys();
    resized();
    parts.edited.add (*this);   // added after the canvas, which must be up to date when this view is notified
    documentChanged();
    addMouseListener (this, true);   // any input wakes the window
    wake();
}

MainView::~MainView()
{
    removeMouseListener (this);
    parts.edited.remove (*this);
}

void MainView::begin (const StartOptions& how)
{
    parts.saver.begin (how.home);
    parts.desk.program = how.program;
    auto read = loadSettings (how.home);
    parts.settings = std::move (read.settings);
    readSettings (how.light || parts.settings.light);
    parts.templates.show (templatesIn (presetFolder(), parts.catalogue));
    auto& files = parts.files;
    files.setSafe (how.safe);
    if (how.stops_directly) direct_stop.emplace (parts.playback.stopSwitch());
    if (how.osc) listenForOsc (*how.osc);
    if (! how.live.empty()) live_nodes.emplace (how.live);
    files.beginSession (how.home);
    parts.desk.session = files.sessionFolder();
    for (const auto& p : parts.panels)
        if (p.panel.reload) p.panel.reload();
    for (const auto& file : how.files)
        open (file);
    const bool is_asked = files.recover();
    if (is_asked) parts.playback.current().letGo();   // no forces while a question is open
    auto& status = parts.status;
    if (how.files.empty())
    {
        beginnings.showWelcome();
        if (how.safe && ! is_asked) status.notify (TRANS ("Safe mode: nothing runs until you press START."));
    }
    parts.device_setup.open (how.home);
    if (const auto& code = parts.settings.language; ! code.empty() && code != english && translationFor (code, how.home).empty())
        status.notify (filled (TRANS ("There is no file %1, so the texts are in English."), (how.home / "text" / (code + ".txt")).string()));
    if (! read.problem.empty()) status.notify (read.problem);
    for (const auto& m : parts.device_setup.session().messages)
        status.notify (juce::String (m.file + ": " + messageText (m)));
    if (! std::exchange (parts.settings.welcomed, true)) parts.desk.settingsChanged();
}

void MainView::readSettings (bool light)
{
    parts.light = light;
    parts.layout.readSettings();
    parts.applyTheme();
    applyScale (parts.settings.scale);
    parts.hand.showScene (parts.settings.scene);
    parts.hand.film().setLength (parts.settings.film_s);
    parts.applyFusion();
    resized();
}

void MainView::open (const fs::path& file)
{
    if (isRecording (file)) return parts.desk.fitRecording (file);
    // A shipped preset is opened as a copy, whichever way its path is written.
    std::error_code failed;
    const auto whole = fs::absolute (file, failed);
    const bool is_shipped = fs::equivalent (whole.parent_path(), presetFolder(), failed) && ! failed;
    is_shipped ? parts.files.openCopy (whole, false) : parts.files.open (file);
}

bool MainView::isInterestedInFileDrag (const juce::StringArray& dragged)
{
    if (dragged.size() != 1 || parts.question.isOpen()) return false;
    const fs::path file { dragged[0].toStdString() };
    return isClipExtension (file) || isRecording (file) || extensionOf (file) == ".json" || isPresetPack (file);
}

void MainView::wake()
{
    awake_for = refreshes_until_rest;
    if (getTimerInterval() == 1000 / refreshes_per_second) return;
    startTimer (1000 / refreshes_per_second);
    if (! tooltips) tooltips.emplace (this, 600);
    if (auto* window = getPeer()) setRepaintRate (*window, {});
}

/// No timer runs faster than this one, unless a tooltip is shown or the caret of a text field blinks.
void MainView::rest()
{
    if (getTimerInterval() != 1000 / refreshes_at_rest) startTimer (1000 / refreshes_at_rest);
    if (tooltips && ! tooltips->isVisible()) tooltips.reset();
    const bool has_caret = dynamic_cast<juce::TextEditor*> (getCurrentlyFocusedComponent()) != nullptr;
    if (auto* window = getPeer()) setRepaintRate (*window, has_caret ? repaints_for_caret : refreshes_at_rest);
}

void MainView::mouseDown (const juce::MouseEvent& e)
{
    wake();
    keyboard.pressed (*e.eventComponent);
}

void MainView::mouseDrag (const juce::MouseEvent&)
{
    wake();
    parts.status.endRefusal();   // a drag says what it does
}

void MainView::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& d)
{
    wake();
    juce::Component::mouseWheelMove (e, d);
}

bool MainView::keyStateChanged (bool is_down)
{
    if (! is_down) keyboard.release();
    return false;
}

void MainView::timerCallback()
{
    // JUCE sees what the user does only while no timer is due. After a refresh that took longer than the time until the next one, as on a busy computer,
    // that one is left out, else clicks would wait for as long as the computer is busy.
    const double now = juce::Time::getMillisecondCounterHiRes();
    const bool is_late = now - std::exchange (refreshed_at, now) > 2.0 * getTimerInterval();
    leaves_out = is_late && ! leaves_out;
    if (leaves_out) return;
    auto& playback = parts.playback;
    auto& strip = parts.strip;
    auto& status = parts.status;
    if (playback.current().isRunning() || parts.saver.isWaiting() || parts.stems.isRunning() || assets.isRunning())
        wake();
    else if (awake_for == 0 || --awake_for == 0)
        rest();
    if (std::exchange (was_dragging, parts.patching.isDragging()) && ! was_dragging) showName();
    parts.device_setup.follow();
    playback.poll();
    if (std::exchange (was_trying, playback.isTrying()) && ! was_trying) status.hint ({});   // what the test of a device said
    keyboard.poll();
    parts.shade.follow();
    if (osc_server) osc_server->poll();
    strip.refresh();
    if (direct_stop)
    {
        direct_stop->letEscStop (keyboard.escStops());
        if (const auto why = direct_stop->follow (strip, strip.stopPlace()))
            status.notify (filled (TRANS ("While the window is busy, Esc and STOP have to wait: %1"), messageText (*why)));
    }
    parts.hand.setSeen (parts.hand.isShowing() && ! parts.hand.getBounds().isEmpty());
    parts.hand.refresh();
    closing.poll();
    if (parts.stems.isRunning()) parts.stems.attend();
    assets.poll();
    parts.live.refresh();
    parts.inspector.refreshLive();
    parts.limits.poll();
    pollLiveNodes();
    strip.limitLight().show (parts.limits.list(), parts.limits.isUpToDate());
    parts.inspector.showLimits (parts.limits.list().contacts);
    parts.files.poll();
    beginnings.poll();
    if (const auto saved = parts.saver.poll(); ! saved) status.notify (filled (TRANS ("Could not save the settings: %1"), fromUtf8 (saved.error().text)));
    refreshPanels();
    if (onRefresh) onRefresh();
}

void MainView::refreshPanels()
{
    for (const auto& [panel, component, covers] : parts.panels)
    {
        if (panel.refresh) panel.refresh();
        if (panel.title && ! covers) parts.layout.rename (component, panel.title());
    }
}

void MainView::pollLiveNodes()
{
    if (! live_nodes || ! live_nodes->poll()) return;
    parts.edited.renew();
    parts.pictures.use (parts.catalogue);
    if (parts.help.isOpen() && ! parts.help.type().empty()) parts.help.showNode (parts.help.type());
    live_nodes->forget();
    parts.status.notify (juce::String (live_nodes->latest()));
}

void MainView::documentChanged()
{
    wake();
    auto& edited = parts.edited;
    edited.isStepping() ? parts.status.tell (steppedText (edited)) : parts.status.clearNotice();
    auto& patching = parts.patching;
    const bool is_other = edited.identity() != shown_identity;
    if (is_other)
    {
        shown_identity = edited.identity();
        assets.otherGraph();
        parts.hand.view().letGo();                         // it held the tool of the graph before
        if (! run().isRunning()) run().traces().clear();   // they are of the graph before
        patching.leaveTo (0);
        patching.select ({});
        patching.frameStart();
        for (const auto& p : parts.panels)
            if (p.panel.restore) p.panel.restore();
    }
    if (parts.welcome.isVisible() && (edited.identity() != first_identity || edited.isChanged())) parts.welcome.setVisible (false);
    beginnings.placeTemplates();
    if (is_other && parts.layout.left.isParentOf (getCurrentlyFocusedComponent()))
        takeFocus (patching);   // what is typed next is for this graph, not for a search
    if (patching.isDragging())
        was_dragging = true;   // also if the drag ends before the next look: the name is shown at its end
    else
        showName();
}

void MainView::showName()
{
    parts.top.show();
    const auto saved = parts.top.savedText();
    if (onTitle) onTitle (parts.top.graphName() + (saved.isEmpty() ? saved : " (" + saved + ")"));
}

void MainView::documentRefused (const Message& m) { parts.status.notify (juce::String (messageText (m))); }

void MainView::paint (juce::Graphics& g) { g.fillAll (themeOf (*this).panel); }

void MainView::resized()
{
    auto area = getLocalBounds();
    const auto below_strip = area.withTrimmedTop (SafetyStrip::height);   // STOP stays within reach
    parts.strip.setBounds (area.removeFromTop (SafetyStrip::height));
    parts.top.setBounds (area.removeFromTop (TopBar::height));
    parts.status.setBounds (area.removeFromBottom (StatusLine::height));
    const auto pages = parts.layout.layOut (area);
    beginnings.placeTemplates();
    parts.welcome.setBounds (pages);
    const bool is_small = parts.layout.isSmall();
    parts.help.setArea (is_small ? pages.reduced (4) : pages.withBottom (parts.hand.getBottom()).reduced (16));
    for (const auto& p : parts.panels)
        if (p.covers) p.component.setBounds (below_strip);
    parts.tour.setBounds (getLocalBounds());
    parts.tour.resized();   // what it frames may have moved
    for (auto* over : std::initializer_list<juce::Component*> { &parts.question, &parts.menus, &parts.shade })
        over->setBounds (below_strip);
}

}   // namespace tactus::host
