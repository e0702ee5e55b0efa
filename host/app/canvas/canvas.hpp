// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "actions.hpp"
#include "paint_scene.hpp"

#include <host/app/model/document.hpp>

namespace tactus::host
{

/// What the mouse is doing from button down to button up.
class Drag
{
public:
    virtual ~Drag() = default;
    virtual void move (const juce::MouseEvent&) = 0;
    virtual void end (const juce::MouseEvent&) {}
    virtual void paint (juce::Graphics&) const {}   ///< over the scene, in pixels
};

/// The port a wire is drawn from.
struct WireStart
{
    graph::Id node = 0;
    Role role = Role::output;
    std::string port;
};

/// Where graphs are patched: nodes and wires of one patch, under the pointer and the keyboard.
///
/// Drag on nothing selects; the middle or the right button pans; the wheel zooms to the pointer, and a trackpad pans. A drag from a port draws a wire; it lights what it fits and says why it does not fit elsewhere.
class Canvas final : public juce::Component, private Document::Listener
{
public:
    Canvas (Document&, const Catalogue&);
    ~Canvas() override;

    Document& edited() noexcept { return document; }
    const Scene& scene() const noexcept { return *shown; }
    View& view() noexcept { return window; }
    Highlights& lit() noexcept { return highlights; }
    const Selection& selection() const noexcept { return highlights.selected; }
    void select (Selection);

    /// From the graph itself inwards: the names of the subgraph nodes, and of the subgraphs, that were entered.
    const std::vector<std::pair<std::string, std::string>>& way() const noexcept { return entered; }
    std::string patch() const { return entered.empty() ? std::string {} : entered.back().second; }
    void leaveTo (std::size_t depth);
    void enter (const SceneNode&);   ///< of a subgraph of this file; else nothing

    void frameAll();
    void frameSelection();

    void removeSelection();
    void duplicateSelection();
    void copySelection() const;
    void pasteText();

    std::function<void()> onSelection, onWay;
    std::function<void (const juce::String&)> onHint;   ///< a word on what is under the pointer, or ""

    /// A node is wanted at a place of the canvas: on a double click, a key, or where a wire was let go on nothing.
    std::function<void (juce::Point<float>, std::optional<WireStart>)> onWantsNode;
    void wantNode (juce::Point<float> at, std::optional<WireStart> start = std::nullopt)
    {
        if (onWantsNode) onWantsNode (at, std::move (start));
    }

    /// Adds it and, if a wire waits, joins it to the first port that fits.
    void addNodeAt (const std::string& type, juce::Point<float>, const std::optional<WireStart>&);

    void hint (const juce::String&);

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseMove (const juce::MouseEvent&) override;
    void mouseExit (const juce::MouseEvent&) override;
    void mouseDoubleClick (const juce::MouseEvent&) override;
    void mouseWheelMove (const juce::MouseEvent&, const juce::MouseWheelDetails&) override;
    void mouseMagnify (const juce::MouseEvent&, float) override;
    bool keyPressed (const juce::KeyPress&) override;

private:
    void documentChanged() override;
    void rebuild();
    std::unique_ptr<Drag> dragFor (const juce::MouseEvent&);

    Document& document;
    const Catalogue& catalogue;
    std::unique_ptr<Scene> shown;
    View window;
    Highlights highlights;
    std::vector<std::pair<std::string, std::string>> entered;
    std::unique_ptr<Drag> drag;
    bool framed = false;   // once there was room
};

}   // namespace tactus::host
