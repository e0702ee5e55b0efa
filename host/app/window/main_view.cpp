// SPDX-License-Identifier: GPL-3.0-or-later
#include "main_view.hpp"

#include <framework/file/graph_file.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int line_height = 26, hand_width = 420, refreshes_per_second = 30;
constexpr int least_canvas = 240;   // pixels, each way
}   // namespace

MainView::MainView (const Catalogue& c) : catalogue (c)
{
    setWantsKeyboardFocus (true);
    auto browser = std::make_unique<PresetBrowser> (presetFolder());
    presets = browser.get();
    left.add ("Presets", std::move (browser));
    presets->onOpen = [this] (const Preset& p)
    { open (p.file); };
    strip.onStop = [this]
    { performance->stop(); };
    strip.onStart = [this]
    { performance->start (performance->hand()); };
    hand.view().onPoint = [this] (const Vec3& p)
    { performance->point (p); };
    hand.view().onTakesOver = [this]
    { performance->start (Performance::Hand::pointer()); };
    hand.onHint = [this] (const juce::String& text)
    { say (text); };
    hand.onHand = [this] (Performance::Hand h)
    { performance->start (std::move (h)); };
    addAndMakeVisible (strip);
    addAndMakeVisible (hand);
    addAndMakeVisible (left);
    addAndMakeVisible (bottom);
    show ({}, {});
    addChildComponent (palette);
    startTimerHz (refreshes_per_second);
}

MainView::~MainView() { edited->remove (*this); }

void MainView::show (graph::Graph g, const std::filesystem::path& file)
{
    if (edited) edited->remove (*this);
    inspector.reset();
    live.reset();
    bottom.clear();
    patching.reset();
    top.reset();
    performance.reset();
    edited = std::make_unique<Document> (std::move (g), file);
    edited->add (*this);
    performance = std::make_unique<Performance> (*edited, catalogue, &sound);

    top = std::make_unique<TopBar>();
    patching = std::make_unique<Canvas> (*edited, catalogue);
    inspector = std::make_unique<Inspector> (*edited, catalogue);
    top->onLeave = [this] (std::size_t depth)
    { patching->leaveTo (depth); };
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
    live = std::make_unique<LiveFeed> (*patching, *performance);
    auto list = std::make_unique<ProblemList> (*edited);
    problems = list.get();
    problems->onShow = [this] (const Culprit& c)
    { patching->show (c.patch, c.id); };
    bottom.add ("Problems", std::move (list));
    addAndMakeVisible (*top);
    addAndMakeVisible (*patching);
    addAndMakeVisible (*inspector);
    for (auto* edge : { &left_edge, &right_edge, &bottom_edge })
    {
        edge->onMove = [this]
        { resized(); };
        addAndMakeVisible (*edge);
    }
    palette.toFront (false);
    presets->showOpen (file);
    resized();
    documentChanged();
}

void MainView::open (const std::filesystem::path& file)
{
    auto loaded = loadGraph (file);
    const auto error = std::ranges::find (loaded.messages, Message::Severity::error, &Message::severity);
    if (error != loaded.messages.end())
    {
        say (juce::String (file.filename().string()) + ": " + error->text + "; " + error->remedy);
        return;
    }
    show (std::move (loaded.graph), file);
    performance->start ({});
    say ({});
}

void MainView::timerCallback()
{
    performance->attend();
    strip.show (*performance);
    hand.show (*performance);
    live->refresh();
    problems->show (performance->messages());
    bottom.name (*problems, problems->count() == 0 ? juce::String ("Problems") : "Problems " + juce::String (problems->count()));
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
        patching->grabKeyboardFocus(); });
}

void MainView::choose (const juce::String& purpose, std::vector<PaletteEntry> entries, std::function<void (const std::string&)> chosen)
{
    placePalette (getMouseXYRelative());
    palette.open ([all = std::move (entries)] (const std::string& query)
                  { return matching (all, query); },
                  purpose, [this, chosen = std::move (chosen)] (const std::string& type)
                  {
        chosen (type);
        patching->grabKeyboardFocus(); });
}

void MainView::placePalette (juce::Point<int> at) { palette.setBounds (juce::Rectangle<int> (Palette::width, Palette::height).withPosition (at).constrainedWithin (getLocalBounds().reduced (8))); }

void MainView::say (const juce::String& text)
{
    if (text == said) return;
    said = text;
    repaint (getLocalBounds().removeFromBottom (line_height));
}

void MainView::save()
{
    if (edited->file().empty())
    {
        say ("This graph has no file yet. Start with: tactus-host FILE");
        return;
    }
    const auto messages = edited->save (edited->file());
    say (messages.empty() ? "Saved " + juce::String (edited->file().string()) : juce::String (messages.front().text + "; " + messages.front().remedy));
}

void MainView::documentChanged()
{
    std::vector<juce::String> way { edited->graph().name.empty() ? juce::String ("A new graph") : juce::String (edited->graph().name) };
    for (const auto& [node, subgraph] : patching->way())
        way.emplace_back (node);
    const bool changed = edited->isChanged();
    if (onTitle) onTitle (way.front() + (changed ? " (edited)" : ""));
    top->show (std::move (way), changed);
}

void MainView::documentRefused (const Message& m) { say (juce::String (m.text + (m.remedy.empty() ? "" : "; " + m.remedy))); }

void MainView::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    auto line = getLocalBounds().removeFromBottom (line_height);
    g.setColour (look.theme().hairline);
    g.drawHorizontalLine (line.getY(), 0.0f, static_cast<float> (getWidth()));
    g.setFont (look.font (12.0f));
    g.setColour (look.theme().dim);
    g.drawText (said.isEmpty() ? juce::String ("Space: add a node   F: frame   G: group   B: bypass   Ctrl+Z: undo") : said, line.reduced (16, 0), juce::Justification::centredLeft, true);
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
}

bool MainView::keyPressed (const juce::KeyPress& key)
{
    if (key == juce::KeyPress::escapeKey)
    {
        performance->stop();
        return true;
    }
    if (key == juce::KeyPress::createFromDescription ("ctrl + s"))
    {
        save();
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
    return patching->keyPressed (key);
}

}   // namespace tactus::host
