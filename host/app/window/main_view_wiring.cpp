// SPDX-License-Identifier: GPL-3.0-or-later
// Which panel of the window calls what. All connections between panels are here.
#include "main_view.hpp"

#include <host/app/compose/banks.hpp>
#include <host/app/desk/save_clip.hpp>
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
        .openTake = [this] (const std::filesystem::path& take) { return desk.recoverTake (take); },
        .onSettings = [this] {
            saveSettingsSoon();
            for (const auto& p : panels)
                if (p.panel.reload) p.panel.reload(); },
        .onWrite = [this] (graph::Graph& graph) {
            for (const auto& p : panels)
                if (p.panel.keep) p.panel.keep (graph); },
        .choose = [this] (bool saves, const std::filesystem::path& begin,
                          std::function<void (const std::filesystem::path&)> chosen) { chooseFile (saves, begin, std::move (chosen)); }
    };
}

/// Sets the functions that panels ask the window for.
void MainView::setDesk()
{
    desk.hint = [this] (const juce::String& text) { status.hint (text); };
    desk.notify = [this] (const juce::String& text) { status.notify (text); };
    desk.refuse = [this] (const juce::String& text) { status.refuse (text); };
    desk.settingsChanged = [this] { saveSettingsSoon(); };
    desk.liveMessages = [this] { return live_nodes ? live_nodes->messages() : Messages(); };
    desk.chooseFile = [this] (bool saves, const std::filesystem::path& begin, auto chosen) { chooseFile (saves, begin, std::move (chosen)); };
    desk.chooseInput = [this] (const juce::String& patterns, const std::filesystem::path& begin, auto chosen) {
        dialogs.chooseInput (patterns, begin, std::move (chosen));
    };
    desk.openGraph = [this] (const std::filesystem::path& file) { open (file); };
    desk.turnToCanvas = [this] { turnTo (patching); };
    desk.openMade = [this] (const graph::Graph& made, const std::string& step, std::function<void()> then) {
        files.openGraph (made, step, true, std::move (then));
    };
    desk.preview = [this] (const std::filesystem::path& file) { preview (file); };
    desk.endPreview = [this] { endPreview(); };
    desk.addNode = [this] (const std::string& type) { addNode (type, { patching.view().toCanvas (patching.getLocalBounds().getCentre().toFloat()) }); };
    desk.show = [this] (const std::string& patch, graph::Id id) {
        turnTo (patching);
        patching.show (patch, id);
    };
    desk.toFront = [this] (const juce::Component& panel) {
        withTabs (panel, [&] (Tabs& tabs) { tabs.show (panel); });
    };
    desk.reveal = [this] (const juce::Component& panel) {
        withTabs (panel, [&] (Tabs& tabs) { reveal (tabs, panel); });
    };
    desk.leave = [this] { takeFocus (keyboardHome()); };
    desk.useDevice = [this] { return hand.useDevice(); };
    desk.layerOf = [this] (const std::string& sink, const std::string& port) { return compose::mixIn (edited.graph(), sink, port, catalogue); };
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
    patching.onHint = desk.hint;
    patching.onNotice = desk.refuse;
    patching.onBreadcrumbs = [this] { documentChanged(); };
    patching.onSelection = [this] { inspector.inspect (patching.seen(), patching.selection()); };
    patching.onParamMenu = [this] (juce::PopupMenu& menu, const std::string& node, const std::string& port) { inspector.fillParamMenu (menu, node, port); };
    patching.onEditParams = [this] {
        turnTo (inspector);
        inspector.focusFirst();
    };
    patching.onNodeRequested = [this] (const NodeRequest& request) { chooseNode (request); };
    patching.onChoose = [this] (const auto& purpose, auto search, auto chosen) { choose (purpose, std::move (search), std::move (chosen)); };
    patching.onProbe = [this] (const auto& ports) { desk.probe (ports); };
    patching.onGraphDropped = [this] (const std::filesystem::path& file, juce::Point<float> at) { addGraph (desk, file, {}, at); };
    patching.onLayerPasted = [this] (const graph::Graph& g) { addGraph (desk, g); };
    patching.onTypeDropped = [this] (const std::string& type, const NodeRequest& request) { addNode (type, request); };
    patching.onSaveClip = [this] (const std::filesystem::path& file) { saveClipAs (desk, file); };
}

void MainView::connectSides()
{
    inspector.onHint = desk.hint;
    inspector.onNotice = desk.refuse;
    inspector.onChooseFile = desk.chooseInput;
    inspector.messagesNow = [this] { return run().messages(); };
    inspector.valuesNow = [this] (const std::string& param) { return live.valuesOf (param); };

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
    strip.onProblems = strip.limitLight().onClick = [this] { desk.showProblems(); };
    live.limits = &limits;

    hand.onHint = desk.hint;
    hand.onEnlarge = [this] { resized(); };
    hand.onSceneToggled = [this] { rememberScene(); };
    hand.scene().reachesNow = desk.reaches;
    hand.scene().onMoveOrigin = desk.moveOrigin;
    hand.film().onLength = [this] { rememberFilmLength(); };
    hand.film().onChoose = [this] (const std::filesystem::path& begin, auto chosen) { chooseFile (true, begin, std::move (chosen)); };
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
        if (step.part == &bottom) bottom.show (0);
    };
    tour.onEnd = [this] {
        settings.toured = true;
        saveSettingsSoon();
    };

    help.onExample = [this] (const std::string& type) { openExample (type); };
}

}   // namespace tactus::host
