// SPDX-License-Identifier: GPL-3.0-or-later
#include "main_view.hpp"

#include <host/app/look/focus.hpp>

#include <framework/file/graph_file.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int line_height = 26, hand_width = 420, refreshes_per_second = 30;
constexpr int least_canvas = 240;   // pixels, each way
const char* const keys_to_begin_with = "Space: add a node   F: frame   G: group   B: bypass   Ctrl+Z: undo   F1: help";
}   // namespace

MainView::MainView (const Catalogue& c) : catalogue (c), pictures (c), help (c)
{
    setWantsKeyboardFocus (true);
    chooseFile = [this] (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)> chosen)
    { askForFile (saves, begin, std::move (chosen)); };
    auto browser = std::make_unique<PresetBrowser> (catalogue, settings, pictures);
    presets = browser.get();
    left.add ("Presets", std::move (browser));
    presets->onOpen = [this] (const Preset& p, bool is_own)
    { is_own ? files->open (p.file) : files->openCopy (p.file, false); };
    presets->onSettings = [this]
    { remember(); };
    presets->onPreview = [this] (const std::filesystem::path& file)
    { preview (file); };
    presets->onPreviewEnd = [this]
    { endPreview(); };
    strip.onStop = [this]
    { current().stop(); };
    strip.onRearm = [this]
    { current().rearm(); };
    strip.onStart = [this]
    { start (performance->hand()); };
    hand.view().onPoint = [this] (const Vec3& p)
    { performance->point (p); };
    hand.view().onTakesOver = [this]
    { start (Performance::Hand::pointer()); };
    hand.onHint = [this] (const juce::String& text)
    { say (text); };
    hand.onHand = [this] (Performance::Hand h)
    { start (std::move (h)); };
    help.onExample = [this] (const std::string& type)
    { openExample (type); };
    welcome.onFeel = [this] (const std::filesystem::path& file)
    {
        files->openCopy (file, true);
        notify (files->isSafe() ? "Safe mode: press START, then press and drag on the surface below." : "Press and drag on the surface below: the mouse is your hand.");
    };
    welcome.onOpenFile = [this] (const std::filesystem::path& file)
    { files->open (file); };
    welcome.onNew = [this]
    { files->create(); };
    welcome.onOpen = [this]
    { files->open(); };
    addAndMakeVisible (strip);
    addAndMakeVisible (hand);
    addAndMakeVisible (left);
    addAndMakeVisible (bottom);
    show();
    addChildComponent (palette);
    addChildComponent (welcome);
    addChildComponent (help);
    addChildComponent (question);
    juce::Desktop::getInstance().addFocusChangeListener (this);
    startTimerHz (refreshes_per_second);
}

MainView::~MainView()
{
    juce::Desktop::getInstance().removeFocusChangeListener (this);
    if (listened != nullptr) listened->removeKeyListener (this);
    if (ticks_to_remember > 0) saveSettings (settings, home);
    edited->remove (*this);
}

void MainView::show()
{
    edited = std::make_unique<Document> (graph::Graph {});
    files = std::make_unique<Files> (*edited, question, settings,
                                     Files::Ways { [this] (const juce::String& text)
                                                   { notify (text); },
                                                   [this]
                                                   { performance->stop(); },
                                                   [this] (bool by_pointer)
                                                   { start (by_pointer && ! isBound() ? Performance::Hand::pointer() : Performance::Hand {}); },
                                                   [this]
                                                   { return current().isRunning(); },
                                                   [this]
                                                   {
                                                       remember();
                                                       presets->reload(); },
                                                   [this] (bool saves, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)> chosen)
                                                   { chooseFile (saves, begin, std::move (chosen)); } });
    performance = std::make_unique<Performance> (*edited, catalogue, &sound);
    performance->use (plugged);
    plugged.onChange = [this]
    { performance->deskChanged(); };
    left.add ("History", std::make_unique<HistoryPanel> (*edited));

    top = std::make_unique<TopBar>();
    patching = std::make_unique<Canvas> (*edited, catalogue);
    inspector = std::make_unique<Inspector> (*edited, catalogue);
    inspector->messagesNow = [this]
    { return performance->messages(); };
    top->onLeave = [this] (std::size_t depth)
    { patching->leaveTo (depth); };
    top->onRecall = [this] (int number)
    { recall (number); };
    top->onStore = [this] (int number)
    { store (number); };
    top->onUndo = [this]
    { edited->undo(); };
    top->onRedo = [this]
    { edited->redo(); };
    top->onHelp = [this]
    { helpOnSelection(); };
    top->onMenu = [this] (juce::Component& at)
    { openMenu (at); };
    patching->onWay = [this]
    { documentChanged(); };
    patching->onSelection = [this]
    { inspector->inspect (patching->patch(), patching->selection()); };
    patching->onHint = inspector->onHint = [this] (const juce::String& text)
    { say (text); };
    patching->onWantsNode = [this] (const NodeWish& wish)
    { openPalette (wish); };
    patching->onChoose = [this] (const juce::String& purpose, std::vector<PaletteEntry> entries, std::function<void (const std::string&)> chosen)
    { choose (purpose, std::move (entries), std::move (chosen)); };
    auto panel = std::make_unique<ScopePanel> (*edited, *performance, catalogue);
    scopes = panel.get();
    scopes->onHint = [this] (const juce::String& text)
    { say (text); };
    bottom.add ("Scopes", std::move (panel));
    auto desk = std::make_unique<LayersPanel> (*edited, *performance, catalogue);
    layers = desk.get();
    layers->onSelect = [this] (const std::string& patch, graph::Id node)
    { patching->show (patch, node); };
    layers->onHint = scopes->onHint;
    bottom.add ("Layers", std::move (desk));
    patching->onNotice = [this] (const juce::String& text)
    { notify (text); };
    patching->onProbe = [this] (const std::vector<std::string>& ports)
    {
        for (const auto& port : ports)
            scopes->probe (port);
        bottom.show (*scopes);
    };
    live = std::make_unique<LiveFeed> (*patching, *performance);
    auto list = std::make_unique<ProblemList> (*edited);
    problems = list.get();
    problems->onShow = [this] (const Culprit& c)
    { patching->show (c.patch, c.id); };
    auto sheet = std::make_unique<DevicesPanel> (*edited, *performance, plugged);
    devices = sheet.get();
    devices->onHint = scopes->onHint;
    bottom.add ("Devices", std::move (sheet));
    bottom.add ("Problems", std::move (list));
    addAndMakeVisible (*top);
    addAndMakeVisible (*patching);
    addAndMakeVisible (*inspector);
    for (auto* edge : { &left_edge, &right_edge, &bottom_edge })
    {
        edge->onMove = [this]
        {
            rememberPanels();
            resized();
        };
        addAndMakeVisible (*edge);
    }
    palette.toFront (false);
    edited->add (*this);   // after the canvas, so that it shows what is told of
    resized();
    documentChanged();
}

void MainView::begin (const Start& how)
{
    home = how.home;
    auto read = loadSettings (home);
    settings = std::move (read.settings);
    light = how.light || settings.light;
    const auto resize = [this] (const char* name, Splitter& edge)
    {
        if (const auto size = settings.panels.find (name); size != settings.panels.end()) edge.setSize (size->second);
    };
    resize ("left", left_edge);
    resize ("right", right_edge);
    resize ("bottom", bottom_edge);
    applyTheme();
    applyScale();
    resized();
    presets->reload();
    files->setSafe (how.safe);
    if (how.osc) openPort (*how.osc);
    files->beginSession (home);
    for (const auto& file : how.files)
        open (file);
    const bool is_asked = files->recover();
    if (is_asked) current().letGo();   // nothing pushes behind a question
    if (how.files.empty())
    {
        welcome.show (presets->shipped(), settings.recent);
        welcome.setVisible (true);
        if (how.safe && ! is_asked) notify ("Safe mode: nothing runs until you press START.");
    }
    plugged.open (home);
    if (! read.problem.empty()) notify (read.problem);
    for (const auto& m : plugged.session().messages)
        notify (juce::String::fromUTF8 ((m.file + ": " + m.text + "; " + m.remedy).c_str()));
    if (! settings.welcomed)
    {
        settings.welcomed = true;
        remember();
    }
}

void MainView::open (const std::filesystem::path& file)
{
    // What comes with Tactus is opened as a copy, however one names it.
    std::error_code failed;
    const bool is_shipped = std::filesystem::equivalent (std::filesystem::absolute (file, failed).parent_path(), presetFolder(), failed) && ! failed;
    is_shipped ? files->openCopy (std::filesystem::absolute (file), false) : files->open (file);
}

bool MainView::isBound() const
{
    const auto& session = plugged.session().session;
    return std::ranges::any_of (rolesNamed (edited->graph()), [&] (const std::string& role)
                                { return session.binding (role) != nullptr; });
}

void MainView::start (Performance::Hand who)
{
    files->beforeRun();
    performance->start (who);
}

void MainView::closeWhenSaved (std::function<void()> close)
{
    files->whenSaved ("before Tactus closes", [this, close = std::move (close)]
                      {
        performance->letGo();
        files->end();
        close(); });
}

void MainView::closeSuddenly()
{
    performance->letGo();
    files->endSuddenly();
}

/// Whoever has the focus, Esc is heard first here: a text field or a menu would take it for itself.
void MainView::globalFocusChanged (juce::Component* focused)
{
    if (listened != nullptr) listened->removeKeyListener (this);
    listened = focused != this ? focused : nullptr;
    if (listened != nullptr) listened->addKeyListener (this);
}

bool MainView::keyPressed (const juce::KeyPress& key, juce::Component*)
{
    if (key.getKeyCode() != juce::KeyPress::escapeKey || ! current().isWanted()) return false;
    stopBy (key);
    return true;   // what is open is closed by the next one
}

void MainView::openPort (const OscListen& where)
{
    auto opened = OscPort::open (where);
    if (! opened) return say (juce::String::fromUTF8 (describe (opened.error()).c_str()));
    reach = std::make_unique<OscReach> (std::move (*opened), *performance, *edited,
                                        OscReach::Switches { [this]
                                                             { start (performance->hand()); },
                                                             [this]
                                                             {
                                                                 resumes = false;
                                                                 current().stop(); },
                                                             [this]
                                                             {
                                                                 resumes = false;
                                                                 current().emergencyStop(); } });
}

void MainView::timerCallback()
{
    performance->attend();
    if (reach) reach->attend();
    if (heard) heard->attend();
    strip.show (current());
    hand.show (current());
    live->refresh();
    problems->show (performance->messages());
    bottom.name (*problems, problems->count() == 0 ? juce::String ("Problems") : "Problems " + juce::String (problems->count()), hasErrors (performance->messages()));
    files->attend();
    presets->refresh();
    if (welcome.isVisible()) welcome.refresh();
    if (ticks_to_remember > 0 && --ticks_to_remember == 0)
        if (const auto why = saveSettings (settings, home)) say ("The settings could not be kept: " + juce::String (*why));
    if (scopes->isVisible()) scopes->refresh();
    layers->refresh();
    devices->refresh();
}

void MainView::notify (const juce::String& text)
{
    tip = text.isEmpty() ? juce::String (keys_to_begin_with) : text;
    said.clear();
    repaint (getLocalBounds().removeFromBottom (line_height));
}

void MainView::openPalette (const NodeWish& wish)
{
    // The ends that wait are looked up anew at each letter: a node may go meanwhile.
    const auto ends = [this, wish]
    {
        std::vector<WireEnd> found;
        const auto& scene = patching->scene();
        const auto add = [&] (const SceneNode* node, Role role, const std::string& id)
        {
            const auto* port = node == nullptr ? nullptr : node->face->find (role, id);
            if (port != nullptr) found.push_back ({ port, node->quantityOf (*port) });
        };
        if (wish.start) add (scene.find (wish.start->node), wish.start->role, wish.start->port);
        if (const auto* wire = wish.wire != 0 ? scene.findWire (wish.wire) : nullptr)
        {
            add (&scene.nodes()[static_cast<std::size_t> (wire->start)], Role::output, wire->out);
            add (&scene.nodes()[static_cast<std::size_t> (wire->end)], wire->in_role, wire->in);
        }
        return found;
    };
    placePalette (patching->view().toPixels (wish.at).toInt() + patching->getPosition());
    palette.open ([this, ends] (const std::string& query)
                  { return searchPalette (query, edited->graph(), catalogue, ends()); },
                  wish.wire != 0 ? "What goes into this wire" : wish.start ? "What fits " + juce::String (wish.start->port)
                                                                           : juce::String ("Add a node"),
                  [this, wish] (const std::string& type)
                  {
        patching->addNodeAt (type, wish);
        takeFocus (*patching); });
}

void MainView::choose (const juce::String& purpose, std::vector<PaletteEntry> entries, std::function<void (const std::string&)> chosen)
{
    placePalette (getMouseXYRelative());
    palette.open ([all = std::move (entries)] (const std::string& query)
                  { return matching (all, query); },
                  purpose, [this, chosen = std::move (chosen)] (const std::string& type)
                  {
        chosen (type);
        takeFocus (*patching); });
}

void MainView::placePalette (juce::Point<int> at) { palette.setBounds (juce::Rectangle<int> (Palette::width, Palette::height).withPosition (at).constrainedWithin (getLocalBounds().reduced (8))); }

void MainView::say (const juce::String& text)
{
    if (text == said) return;
    said = text;
    repaint (getLocalBounds().removeFromBottom (line_height));
}

void MainView::documentChanged()
{
    tip = keys_to_begin_with;
    repaint (getLocalBounds().removeFromBottom (line_height));
    const bool is_other = edited->identity() != shown_identity;
    if (is_other)
    {
        shown_identity = edited->identity();
        patching->leaveTo (0);
        patching->select ({});
        patching->frameAll();
        scopes->suggest();
        presets->showOpen (edited->file().empty() ? edited->preset() : edited->file());
    }
    if (edited->history().position() > 0) welcome.setVisible (false);
    TopBar::State state { { edited->graph().name.empty() ? juce::String ("A new graph") : juce::String (edited->graph().name) }, edited->isChanged(), {}, {}, {} };
    for (const auto& [node, subgraph] : patching->way())
        state.way.emplace_back (node);
    const auto steps = edited->history().names();
    const auto done = edited->history().position();
    if (done > 0) state.undo = steps[done - 1];
    if (done < steps.size()) state.redo = steps[done];
    for (int n = 1; n <= snapshot_count; ++n)
        state.snapshots[static_cast<std::size_t> (n - 1)] = hasSnapshot (edited->graph(), n);
    if (onTitle) onTitle (state.way.front() + (state.changed ? " (edited)" : ""));
    top->show (std::move (state));
}

void MainView::documentRefused (const Message& m) { notify (juce::String (m.text + (m.remedy.empty() ? "" : "; " + m.remedy))); }

void MainView::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    auto line = getLocalBounds().removeFromBottom (line_height);
    g.setColour (look.theme().hairline);
    g.drawHorizontalLine (line.getY(), 0.0f, static_cast<float> (getWidth()));
    g.setFont (look.font (12.0f));
    g.setColour (look.theme().dim);
    g.drawText (saying(), line.reduced (16, 0), juce::Justification::centredLeft, true);
}

void MainView::resized()
{
    if (! top) return;
    auto area = getLocalBounds();
    strip.setBounds (area.removeFromTop (SafetyStrip::height));
    top->setBounds (area.removeFromTop (TopBar::height));
    area.removeFromBottom (line_height);
    auto low = bottom_edge.take (area, least_canvas);
    left.setBounds (left_edge.take (area, least_canvas));
    inspector->setBounds (right_edge.take (area, least_canvas));
    hand.setBounds (low.removeFromLeft (std::min (hand_width, low.getWidth() / 2)));
    bottom.setBounds (low);
    patching->setBounds (area);
    welcome.setBounds (area.withRight (getWidth()));
    help.setArea (area.withRight (getWidth()).withBottom (hand.getBottom()).reduced (16));
    question.setBounds (getLocalBounds().withTrimmedTop (SafetyStrip::height));   // the stop stays in reach
}

bool MainView::keyPressed (const juce::KeyPress& key)
{
    if (key.getKeyCode() == juce::KeyPress::escapeKey)
    {
        escape (key);
        return true;
    }
    if (question.isOpen())
    {
        question.keyPressed (key);   // whoever has the focus
        return true;
    }
    if (fileKey (key)) return true;
    if (key == juce::KeyPress::F1Key || key.getTextCharacter() == '?')
    {
        help.isOpen() ? help.close() : helpOnSelection();
        return true;
    }
    const int digit = key.getKeyCode() - '0';
    if (digit >= 1 && digit <= snapshot_count && ! key.getModifiers().isAltDown())
    {
        key.getModifiers().isAnyModifierKeyDown() ? store (digit) : recall (digit);
        return true;
    }
    if (key == juce::KeyPress::createFromDescription ("h"))
    {
        hand.view().hold();
        return true;
    }
    if (key == juce::KeyPress::createFromDescription ("c"))
    {
        live->shows_costs = ! live->shows_costs;
        return true;
    }
    return scopes->keyPressed (key) || patching->keyPressed (key);
}

}   // namespace tactus::host
