// SPDX-License-Identifier: GPL-3.0-or-later
// Which panel of the window calls what. All connections between panels are here.
#include "main_view.hpp"

#include <host/app/compose/banks.hpp>
#include <host/app/devices_panel/session_change.hpp>
#include <host/app/look/focus.hpp>

namespace tactus::host
{

Files::Callbacks MainView::fileCallbacks()
{
    return {
        .notify = [this] (const juce::String& text) { status.notify (text); },
        .stop = [this] {
            hand.film().end();   // the next run begins another film
            run().stop(); },
        .run = [this] (bool by_pointer) { startOpened (by_pointer); },
        .isRunning = [this] { return playback.current().isRunning(); },
        .isStopped = [this] { return ! run().isWaiting() && (! playback.current().isRunning() || playback.current().isStoppedForGood()); },
        .isByPointer = [this] { return playback.run().hand() == LiveRun::Hand::pointer(); },
        .usePointer = [this] {
            if (! hasBoundRole()) playback.changeHand (LiveRun::Hand::pointer()); },
        .prepare = [this] (const graph::Graph& graph, const juce::String& name, std::function<void()> show) { loadAssets (graph, name, std::move (show)); },
        .openTake = [this] (const std::filesystem::path& take) { return takes.open (take, true); },
        .onSettings = [this] {
            saveSettingsSoon();
            presets.reload(); },
        .onWrite = [this] (graph::Graph& graph) { scopes.keepIn (graph); },
        .choose = [this] (bool saves, const std::filesystem::path& begin,
                          std::function<void (const std::filesystem::path&)> chosen) { chooseFile (saves, begin, std::move (chosen)); }
    };
}

void MainView::connect()
{
    connectCanvas();
    connectSides();
    connectRun();
    connectPages();
}

void MainView::connectCanvas()
{
    patching.onHint = [this] (const juce::String& text) { status.hint (text); };
    patching.onNotice = [this] (const juce::String& text) { status.refuse (text); };
    patching.onBreadcrumbs = [this] { documentChanged(); };
    patching.onSelection = [this] { inspector.inspect (patching.seen(), patching.selection()); };
    patching.onParamMenu = [this] (juce::PopupMenu& menu, const std::string& node, const std::string& port) { inspector.fillParamMenu (menu, node, port); };
    patching.onEditParams = [this] {
        turnTo (inspector);
        inspector.focusFirst();
    };
    patching.onNodeRequested = [this] (const NodeRequest& request) { chooseNode (request); };
    patching.onChoose = [this] (const auto& purpose, auto search, auto chosen) { choose (purpose, std::move (search), std::move (chosen)); };
    patching.onProbe = [this] (const auto& ports) { probe (ports); };
    patching.onGraphDropped = [this] (const std::filesystem::path& file, juce::Point<float> at) { addToGraph (file, {}, at); };
    patching.onTypeDropped = [this] (const std::string& type, const NodeRequest& request) { addNode (type, request); };
    patching.onSaveClip = [this] (const std::filesystem::path& file) { saveClipAs (file); };
}

void MainView::connectSides()
{
    inspector.onHint = patching.onHint;
    inspector.onNotice = patching.onNotice;
    inspector.onChooseFile = [this] (const juce::String& patterns, const std::filesystem::path& begin, auto chosen) {
        askForSetting (patterns, begin, std::move (chosen));
    };
    inspector.messagesNow = [this] { return run().messages(); };
    inspector.valuesNow = [this] (const std::string& param) { return live.valuesOf (param); };

    presets.onOpen = [this] (const Preset& p, bool is_own) { openPreset (p, is_own); };
    presets.onAdd = [this] (const Preset& p) { addToGraph (p.file); };
    presets.onMenu = [this] (const Preset& p, bool is_own) { openPresetMenu (p, is_own); };
    presets.onSettings = [this] { saveSettingsSoon(); };
    presets.onLeave = nodes.onLeave = [this] { takeFocus (keyboardHome()); };

    nodes.onSearch = [this] (const std::string& query) { return searchPalette (query, edited.graph(), catalogue, {}, {}, patching.patch()); };
    nodes.onAdd = [this] (const std::string& type) { addNode (type, { patching.view().toCanvas (patching.getLocalBounds().getCentre().toFloat()) }); };
    presets.onPreview = [this] (const std::filesystem::path& file) { preview (file); };
    presets.onPreviewEnd = [this] { endPreview(); };

    top.onLeave = [this] (std::size_t depth) { patching.leaveTo (depth); };
    top.onInstance = [this] (int number) { patching.chooseInstance (number); };
    top.onRecall = [this] (int number) { recall (number); };
    top.onStore = [this] (int number) { store (number); };
    top.onMorph = [this] (int from, int to) { morph (from, to); };
    top.onClear = [this] (int number) { edited.perform (clearSnapshot (edited.graph(), number)); };
    top.onHelp = [this] { helpOnSelection(); };
    top.onMenu = [this] (juce::Component& at) { openMenu (at); };

    for (const auto& [name, edge] : edges())
    {
        edge->onMove = [this] { edgeMoved(); };
        edge->onMoved = [this] { panelsMoved(); };
    }
}

void MainView::connectRun()
{
    strip.onProblems = strip.limitLight().onClick = [this] { reveal (bottom, problems); };
    problems.onShow = [this] (const ProblemLocation& c) {
        turnTo (patching);
        patching.show (c.patch, c.id);
    };
    problems.onFix = [this] (graph::Command fix) { patching.commands().performPlaced (std::move (fix)); };
    problems.onChooseFile = [this] (const Message& m) { askForMissing (m); };
    live.limits = &limits;

    hand.onHint = patching.onHint;
    hand.onEnlarge = [this] { resized(); };
    hand.onSceneToggled = [this] { rememberScene(); };
    hand.scene().reachesNow = [this] { return playback.isPreviewing() ? std::vector<scene::Reach> {} : reaches.of (run()); };
    hand.scene().onMoveOrigin = [this] (const std::string& role, const Vec3& origin) { devices.moveOrigin (role, origin); };
    hand.film().onLength = [this] { rememberFilmLength(); };
    hand.film().onChoose = [this] (const std::filesystem::path& begin, auto chosen) { chooseFile (true, begin, std::move (chosen)); };

    scopes.onHint = patching.onHint;
    scopes.selectedPorts = [this] { return patching.commands().selectedPorts(); };

    layers.onHint = patching.onHint;
    layers.onSelect = [this] (const std::string& patch, graph::Id node) {
        turnTo (patching);
        patching.show (patch, node);
    };
    layers.commandToMix = [this] (const UnmixedSignal& u) { return compose::mixIn (edited.graph(), u.sink, u.port, catalogue); };
    layers.onChooseClip = [this] (auto chosen) { askForSetting (clip_patterns, {}, std::move (chosen)); };
    layers.onAdded = [this] (const std::string& patch, graph::Id node) { showAdded (patch, node); };

    device_setup.onChangedElsewhere = [this] (const DeviceSession& before) {
        const bool has_stopped = playback.sessionChanged();
        const auto what = changeText (before, device_setup.session().session);
        status.refuse (filled (has_stopped ? TRANS ("Another program has changed your devices: %1. The run has stopped, and START uses them.")
                                           : TRANS ("Another program has changed your devices: %1."),
                               what));
    };
    devices.onHint = patching.onHint;
    devices.onTry = [this] (const std::string& role) { return playback.tryDevice (role); };
    devices.onBind = [this] (const std::string& role) -> std::function<void()> {
        if (! run().isMovedOtherwise (role)) return {};
        auto exchange = hand.useDevice();
        status.notify (filled (TRANS ("The device of %1 moves its tool from now on. Press and drag on the surface of the hand, and the mouse does."), role));
        return exchange;
    };

    takes.onHint = patching.onHint;
    takes.onNotice = patching.onNotice;
    takes.onOpen = [this] (auto chosen) { chooseFile (false, ownFolder() / "take.jsonl", std::move (chosen)); };
    takes.onChoose = [this] (const std::string& name, auto chosen) { chooseOwnFile (name, std::move (chosen)); };
    takes.onClip = [this] (const Clip& clip, Messages notes, std::optional<double> gain, const std::filesystem::path& to) {
        return writeClip (clip, std::move (notes), gain, to);
    };
    takes.onSaid = [this] (const juce::String& title, const juce::String& text, std::function<void()> use) { tell (title, text, std::move (use)); };
}

void MainView::connectPages()
{
    welcome.onFeel = [this] (const std::filesystem::path& preset, bool by_pointer) { feel (preset, by_pointer); };
    welcome.onNew = [this] { files.create(); };
    welcome.onOpen = [this] { files.open(); };
    welcome.onTour = [this] { beginTour(); };
    templates.onChoose = [this] (const Preset& chosen) { feel (chosen.file, true); };

    tour.onStep = [this] (const Tour::Step& step) {
        if (step.part != nullptr) turnTo (*step.part);
        if (step.part == &bottom) bottom.show (scopes);
    };
    tour.onEnd = [this] {
        settings.toured = true;
        saveSettingsSoon();
    };

    help.onExample = [this] (const std::string& type) { openExample (type); };

    fitting.onOpenGraph = [this] (const FittedGraph& made) { openFitted (made); };
    fitting.onInsert = [this] (const FittedGraph& made) { insertFitted (made); };
}

}   // namespace tactus::host
