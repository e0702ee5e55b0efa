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
}

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
    hand.onPoint = [this] (const Vec3& p)
    { performance->point (p); };
    hand.onTakesOver = [this]
    { performance->start (Performance::Hand::pointer); };
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
    bottom.clear();
    inspector.reset();
    patching.reset();
    top.reset();
    performance.reset();
    edited = std::make_unique<Document> (std::move (g), file);
    edited->add (*this);
    performance = std::make_unique<Performance> (*edited, catalogue);

    top = std::make_unique<TopBar>();
    patching = std::make_unique<Canvas> (*edited, catalogue);
    inspector = std::make_unique<Inspector> (*edited, catalogue);
    inspector->messagesNow = [this]
    { return performance->messages(); };
    top->onLeave = [this] (std::size_t depth)
    { patching->leaveTo (depth); };
    patching->onWay = [this]
    { documentChanged(); };
    patching->onSelection = [this]
    { inspector->inspect (patching->patch(), patching->selection()); };
    auto desk = std::make_unique<LayersPanel> (*edited, *performance, catalogue);
    layers = desk.get();
    layers->onSelect = [this] (const std::string& patch, graph::Id node)
    {
        if (patch != patching->patch())
        {
            patching->leaveTo (0);
            const auto& nodes = patching->scene().nodes();
            const auto of = std::ranges::find (nodes, "graph:" + patch, &SceneNode::type);
            if (of != nodes.end()) patching->enter (*of);
        }
        if (patch == patching->patch()) patching->select ({ node });
    };
    bottom.add ("Layers", std::move (desk));
    patching->onHint = inspector->onHint = layers->onHint = [this] (const juce::String& text)
    { say (text); };
    patching->onWantsNode = [this] (juce::Point<float> at, std::optional<WireStart> start)
    { openPalette (at, std::move (start)); };
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
    performance->start (Performance::Hand::described);
    say ({});
}

void MainView::timerCallback()
{
    performance->attend();
    strip.show (*performance);
    hand.show (*performance);
    layers->refresh();
}

void MainView::openPalette (juce::Point<float> at, std::optional<WireStart> start)
{
    // The end a wire waits at is looked up anew at each letter: the node may go meanwhile.
    const auto end = [this, start]() -> std::optional<WireEnd>
    {
        const auto* node = start ? patching->scene().find (start->node) : nullptr;
        const auto* port = node == nullptr ? nullptr : node->face->find (start->role, start->port);
        return port == nullptr ? std::nullopt : std::optional (WireEnd { port, node->quantityOf (*port) });
    };
    const auto place = patching->view().toPixels (at).toInt() + patching->getPosition();
    palette.setBounds (juce::Rectangle<int> (Palette::width, Palette::height).withPosition (place).constrainedWithin (getLocalBounds().reduced (8)));
    palette.open ([this, end] (const std::string& query)
                  { return searchPalette (query, edited->graph(), catalogue, end()); },
                  start ? "What fits " + juce::String (start->port) : juce::String ("Add a node"),
                  [this, at, start] (const std::string& type)
                  {
        patching->addNodeAt (type, at, start);
        patching->grabKeyboardFocus(); });
}

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
    return patching->keyPressed (key);
}

}   // namespace tactus::host
