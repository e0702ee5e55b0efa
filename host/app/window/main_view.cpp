// SPDX-License-Identifier: GPL-3.0-or-later
#include "main_view.hpp"
#include "appearance.hpp"
#include "panels.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/storage/language.hpp>
#include <host/app/text/filled.hpp>
#include <host/base/juce/native_window.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int refreshes_per_second = 30;
constexpr int refreshes_at_rest = 4, refreshes_until_rest = 60;   // at rest, only devices and other threads can change anything
constexpr int repaints_for_caret = 20;                            // at rest; it blinks every 380 ms
}   // namespace

MainView::MainView (const Catalogue& c)
    : catalogue (c), pictures (c), files (edited, question, settings, fileCallbacks()),
      playback (edited, c, sound, device_setup, [this] { files.beforeRun(); }),
      limits (edited, device_setup, playback.run(), c),
      patching (edited, c), inspector (edited, c), live (patching, playback.run()),
      help (c)
{
    setOpaque (true);
    setTitle ("Tactus");
    setWantsKeyboardFocus (true);
    chooseFile = [this] (bool saves, const std::filesystem::path& begin,
                         std::function<void (const std::filesystem::path&)> chosen) { dialogs.choose (saves, begin, std::move (chosen)); };
    setDesk();
    addPanels();
    connect();
    edited.add (*this);   // added after the canvas, which must be up to date when this view is notified
    documentChanged();
    juce::Desktop::getInstance().addFocusChangeListener (this);
    addMouseListener (this, true);   // any input wakes the window
    wake();
}

MainView::~MainView()
{
    removeMouseListener (this);
    juce::Desktop::getInstance().removeFocusChangeListener (this);
    if (focused != nullptr) focused->removeKeyListener (this);
    if (ticks_to_save > 0) static_cast<void> (saveSettings (settings, home));
    edited.remove (*this);
}

void MainView::addPanels()
{
    const auto attach = [this] (Tabs* tabs, Panel panel) {
        auto& component = *panel.component;
        if (tabs != nullptr) tabs->add (panel.name, std::move (panel.component));
        for (const auto& key : panel.keys)
            help.addKey (key.shown, key.help);
        panels.push_back ({ std::move (panel), component, tabs });
    };
    [[maybe_unused]] Tabs *const left = &this->left, *const bottom = &this->bottom, *const over = nullptr;
#define TACTUS_ATTACH(place, make) attach (place, make (desk));
    TACTUS_PANELS (TACTUS_ATTACH)
#undef TACTUS_ATTACH
    addPages();
    for (auto* c : std::initializer_list<juce::Component*> { &strip, &hand, left, bottom, &top, &patching, &inspector, &status })
        addAndMakeVisible (c);
    for (const auto& [name, edge] : edges())
        addAndMakeVisible (*edge);
    for (auto* page : std::initializer_list<juce::Component*> { &templates, &palette, &welcome, &help, &tour })
        addChildComponent (page);
    for (const auto& p : panels)
        if (p.tabs == nullptr) addChildComponent (p.component);
    for (auto* above : std::initializer_list<juce::Component*> { &question, &shade })
        addChildComponent (above);
    addAndMakeVisible (menus);
    resized();
}

void MainView::begin (const StartOptions& how)
{
    home = how.home;
    desk.program = how.program;
    auto read = loadSettings (home);
    settings = std::move (read.settings);
    light = how.light || settings.light;
    applySettings();
    templates.show (templatesIn (presetFolder(), catalogue));
    files.setSafe (how.safe);
    if (how.stops_directly) direct_stop.emplace (playback.stopSwitch());
    if (how.osc) openOscPort (*how.osc);
    if (! how.live.empty()) live_nodes.emplace (how.live);
    files.beginSession (home);
    desk.session = files.sessionFolder();
    for (const auto& p : panels)
        if (p.panel.reload) p.panel.reload();
    for (const auto& file : how.files)
        open (file);
    const bool is_asked = files.recover();
    if (is_asked) playback.current().letGo();   // no forces while a question is open
    if (how.files.empty())
    {
        welcome.show (desk.presets(), ! settings.toured);
        welcome.setVisible (true);
        if (how.safe && ! is_asked) status.notify (TRANS ("Safe mode: nothing runs until you press START."));
    }
    device_setup.open (home);
    if (! settings.language.empty() && settings.language != english && translationFor (settings.language, home).empty())
        status.notify (filled (TRANS ("There is no file %1, so the texts are in English."), (home / "text" / (settings.language + ".txt")).string()));
    if (! read.problem.empty()) status.notify (read.problem);
    for (const auto& m : device_setup.session().messages)
        status.notify (juce::String (m.file + ": " + messageText (m)));
    if (! settings.welcomed)
    {
        settings.welcomed = true;
        saveSettingsSoon();
    }
}

std::array<std::pair<const char*, Splitter*>, 5> MainView::edges()
{
    return { { { "left", &left_edge }, { "right", &right_edge }, { "bottom", &bottom_edge }, { "hand", &hand_edge }, { "page", &page_edge } } };
}

MainView::Shares MainView::shares()
{
    Shares all;
    std::ranges::transform (edges(), all.begin(), [] (const auto& e) { return e.second->share(); });
    return all;
}

void MainView::rememberPanels()
{
    if (is_canvas_alone) return;   // the next start shows the panels
    settings.panels.clear();
    for (const auto& [name, edge] : edges())
        if (const auto share = edge->share()) settings.panels[name] = *share;
    saveSettingsSoon();
}

void MainView::edgeMoved()
{
    rememberPanels();
    resized();
}

void MainView::restorePanels (const Shares& to)
{
    shares_before = to;
    for (std::size_t i = 0; const auto& [name, edge] : edges())
        edge->restore (to[i++]);
    is_canvas_alone = is_canvas_alone && left_edge.isFolded() && right_edge.isFolded() && bottom_edge.isFolded();
    edgeMoved();
}

void MainView::panelsMoved()
{
    const auto before = std::exchange (shares_before, shares()), now = shares_before;
    if (before == now) return;
    const auto restored = [safe = SafePointer (this)] (const Shares& to) {
        return [safe, to] {
            if (safe != nullptr) safe->restorePanels (to);
        };
    };
    edited.addWindowStep (NEEDS_TRANS ("move panels"), restored (before), restored (now));
}

/// Leaves the window to the canvas, or brings back the panels that were open before.
void MainView::foldPanels()
{
    const std::array folding { &left_edge, &right_edge, &bottom_edge };
    if (is_canvas_alone || std::ranges::all_of (folding, &Splitter::isFolded))
    {
        // A panel that was opened meanwhile stays open.
        for (std::size_t i = 0; i < folding.size(); ++i)
            folding[i]->fold (folding[i]->isFolded() && folded_before[i]);
        folded_before = {};
        is_canvas_alone = false;
    }
    else
    {
        std::ranges::transform (folding, folded_before.begin(), &Splitter::isFolded);
        for (auto* edge : folding)
            edge->fold (true);
        is_canvas_alone = true;
    }
    edgeMoved();
    panelsMoved();
    if (is_canvas_alone) status.notify (TRANS ("The panels are hidden. Z shows them again."));
}

void MainView::applySettings()
{
    for (const auto& [name, edge] : edges())
        if (const auto share = settings.panels.find (name); share != settings.panels.end()) edge->setShare (share->second);
    shares_before = shares();
    applyTheme (*getTopLevelComponent(), light ? Theme::light() : Theme::dark());
    applyScale (settings.scale);
    hand.showScene (settings.scene);
    hand.film().setLength (settings.film_s);
    applyFusion();
    resized();
}

void MainView::applyFusion()
{
    const Fuser::Options how { .compiler = { .cache = FusionCompiler::usualCache() } };
    run().fuse (settings.fuse ? std::optional (how) : std::nullopt);
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

void MainView::timerCallback()
{
    const bool is_busy = playback.current().isRunning() || ticks_to_save > 0;
    if (is_busy)
        wake();
    else if (awake_for == 0 || --awake_for == 0)
        rest();
    device_setup.follow();
    playback.poll();
    if (std::exchange (was_trying, playback.isTrying()) && ! was_trying) status.hint ({});   // what the test of a device said
    attendClutch();
    keepKeyboard();
    shade.follow();
    if (osc_server) osc_server->poll();
    strip.refresh();
    if (direct_stop)
    {
        direct_stop->letEscStop (escStops());
        if (const auto why = direct_stop->follow (strip, strip.stopPlace()))
            status.notify (filled (TRANS ("While the window is busy, Esc and STOP have to wait: %1"), messageText (*why)));
    }
    hand.setSeen (hand.isShowing() && ! hand.getBounds().isEmpty());
    hand.refresh();
    attendFilm();
    if (stems.isRunning())
    {
        wake();
        stems.attend();
    }
    attendLoad();
    live.refresh();
    inspector.refreshLive();
    limits.poll();
    attendLiveNodes();
    strip.limitLight().show (limits.list());
    inspector.showLimits (limits.list().contacts);
    files.poll();
    if (welcome.isVisible()) welcome.refresh (std::ranges::any_of (device_setup.session().session.roles(), [this] (const auto& r) { return bindsTool (r); }));
    if (ticks_to_save > 0 && --ticks_to_save == 0)
        if (const auto saved = saveSettings (settings, home); ! saved)
            status.notify (filled (TRANS ("Could not save the settings: %1"), fromUtf8 (saved.error().text)));
    for (const auto& [panel, component, tabs] : panels)
    {
        if (panel.refresh) panel.refresh();
        if (! panel.title || tabs == nullptr) continue;
        const auto title = panel.title();
        tabs->rename (component, title.text, title.alarms);
    }
    if (onRefresh) onRefresh();
}

void MainView::attendLiveNodes()
{
    if (! live_nodes || ! live_nodes->poll()) return;
    edited.renew();
    pictures.use (catalogue);
    if (help.isOpen() && ! help.type().empty()) help.showNode (help.type());
    live_nodes->forget();
    status.notify (juce::String (live_nodes->latest()));
}

void MainView::documentChanged()
{
    wake();
    status.clearNotice();
    const bool is_other = edited.identity() != shown_identity;
    if (is_other)
    {
        shown_identity = edited.identity();
        if (loaded_for != shown_identity) loaded_assets.reset();
        hand.view().letGo();                               // it held the tool of the graph before
        if (! run().isRunning()) run().traces().clear();   // they are of the graph before
        patching.leaveTo (0);
        patching.select ({});
        patching.frameStart();
        for (const auto& p : panels)
            if (p.panel.restore) p.panel.restore();
    }
    const bool is_begun = edited.identity() != first_identity || edited.isChanged();
    if (welcome.isVisible() && is_begun) welcome.setVisible (false);
    showBeginnings();
    if (is_other && left.isParentOf (getCurrentlyFocusedComponent())) takeFocus (patching);   // what is typed next is for this graph, not for a search
    top.show();
    const auto saved = top.savedText();
    if (onTitle) onTitle (top.graphName() + (saved.isEmpty() ? saved : " (" + saved + ")"));
}

void MainView::documentRefused (const Message& m) { report (m); }
void MainView::report (const Message& m) { status.notify (juce::String (messageText (m))); }

void MainView::paint (juce::Graphics& g) { g.fillAll (themeOf (*this).panel); }

}   // namespace tactus::host
