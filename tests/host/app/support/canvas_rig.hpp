// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hand.hpp"

#include <host/app/canvas/canvas.hpp>
#include <tactus/file/graph_file.hpp>

#include <stdexcept>

namespace tactus::host::test
{

/// A canvas of 1200 by 800 pixels with a simulated hand.
class CanvasRig
{
public:
    explicit CanvasRig (graph::Graph g = {}) : document (std::move (g))
    {
        juce::LookAndFeel::setDefaultLookAndFeel (&look);
        canvas = std::make_unique<Canvas> (document, catalogue());
        canvas->setBounds (0, 0, 1200, 800);
        canvas->onHint = canvas->onNotice = [this] (const juce::String& text) { hint = text; };
        canvas->onChoose = [this] (const juce::String&, const PaletteSearch& search, const std::function<void (const std::string&)>& chosen) {
            choices = search (query);
            if (choice < choices.size()) chosen (std::string (choices[choice].type));
        };
        canvas->onNodeRequested = [this] (const NodeRequest& r) { request = r; };
        canvas->onProbe = [this] (std::vector<std::string> ports) { probed = std::move (ports); };
    }

    ~CanvasRig()
    {
        canvas.reset();
        juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
    }

    static graph::Graph preset (const std::string& name)
    {
        auto loaded = loadGraph (std::filesystem::path (TACTUS_SOURCE_DIR) / "graphs" / (name + ".json"));
        if (hasErrors (loaded.messages)) throw std::runtime_error (loaded.messages.front().text);
        return std::move (loaded.graph);
    }

    const graph::Graph& graph() const { return document.graph(); }
    std::string text() const { return writeGraph (document.graph()); }

    const SceneNode& node (const std::string& name) const
    {
        const auto& nodes = canvas->scene().nodes();
        const auto found = std::ranges::find (nodes, name, &SceneNode::name);
        if (found == nodes.end()) throw std::runtime_error ("no node " + name);
        return *found;
    }

    /// Positions, in pixels of the canvas.
    juce::Point<float> title (const std::string& name) const { return canvas->view().toPixels (node (name).at + juce::Point<float> (40.0f, 14.0f)); }

    juce::Point<float> port (const std::string& name, Role role, const std::string& id) const
    {
        const auto& n = node (name);
        const auto* socket = n.box.find (role, id);
        if (socket == nullptr) throw std::runtime_error ("no port " + name + "." + id);
        return canvas->view().toPixels (n.placeOf (*socket));
    }

    juce::Point<float> value (const std::string& name, const std::string& param) const
    {
        const auto& n = node (name);
        const auto* socket = n.box.find (Role::param, param);
        if (socket == nullptr) throw std::runtime_error ("no param " + name + "." + param);
        return canvas->view().toPixels (n.at + juce::Point<float> (n.box.width - 20.0f, socket->at.y));
    }

    /// An empty spot on the canvas.
    juce::Point<float> nowhere() const { return canvas->view().toPixels (canvas->scene().bounds().getBottomRight() + juce::Point<float> (120.0f, 120.0f)); }

    juce::Point<float> middleOf (const std::string& wire) const
    {
        for (const auto& w : canvas->scene().wires())
            if (w.text == wire)
            {
                const auto path = w.path();
                return canvas->view().toPixels (path.getPointAlongPath (path.getLength() / 2));
            }
        throw std::runtime_error ("no wire " + wire);
    }

    bool hasWire (const std::string& wire) const
    {
        return std::ranges::count (canvas->scene().wires(), wire, &SceneWire::text) > 0;
    }

private:
    juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;

public:
    Document document;
    std::unique_ptr<Canvas> canvas;
    juce::String hint;
    std::vector<PaletteEntry> choices;
    std::string query;   // typed into the palette
    std::size_t choice = 0;
    std::optional<NodeRequest> request;
    std::vector<std::string> probed;
    Hand hand() { return Hand (*canvas); }
};

}   // namespace tactus::host::test
