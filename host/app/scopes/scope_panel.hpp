// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_view.hpp"

#include <host/app/model/document.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

/// Scopes in a grid, with a row of buttons to add more. Where they do not fit, they keep a readable size and scroll. A drag of its title moves a
/// scope to another place, and a drag of the edge between two scopes sizes them. What the user does to the scopes is a step of the history.
class ScopePanel final : public juce::Component, private Document::Listener
{
public:
    ScopePanel (Document&, Traces&, const Catalogue&);
    ~ScopePanel() override;

    /// Updates the scopes. Call 30 times a second while visible.
    void refresh();
    void setHandDelay (double ticks) noexcept { context.hand_delay = ticks; }

    /// Replaces all scopes with those that the file of the graph keeps, or else with those that suit the graph, which has just been opened.
    void showOwn();

    /// Keeps the scopes in a graph that is about to be written, if the user has changed them.
    void keepIn (graph::Graph&) const;

    /// Toggles ports as traces, in one step of the history.
    void probe (const std::vector<std::string>& ports);
    bool isProbed (const std::string& port) const { return model.shows (port); }

    ScopeView& add (ScopeKind);   ///< with the selected ports, if it shows traces and there are any
    std::function<std::vector<std::string>()> selectedPorts;
    void freezeAll (bool);
    bool isFrozen() const;

    /// The reason why some ports are not shown; "" if all are.
    juce::String warning() const;

    /// Asks for a file to write; `name` is the suggested name.
    std::function<void (const std::string& name, std::function<void (const std::filesystem::path&)>)> onChoose;
    std::function<void (const juce::String&)> onHint;   ///< for the status line, such as the name of a saved file

    const ScopeModel& scopes() const noexcept { return model; }
    const std::vector<std::unique_ptr<ScopeView>>& shown() const noexcept { return views; }

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;

private:
    static constexpr int row_height = 30, least_scope_width = 200;   // in units of the window
    static constexpr std::size_t most_scopes = 8;

    /// The row of scopes, which may be wider than the panel.
    struct ScopeRow final : juce::Component
    {
        void paint (juce::Graphics&) override;
    };

    class Edge;
    using Scopes = std::vector<ScopeSpec>;

    static Scopes copiesOf (const ScopeModel&);
    void restore (const Scopes&);
    void addStep (const char* name, const Scopes& before);
    void moveTo (std::size_t place);
    std::size_t columns() const;
    void documentChanged() override;
    void offer (ScopeKind);
    void openAdders();
    void reveal (const ScopeView&);
    void layOutScopes();
    void showView (ScopeSpec&);
    void close (const ScopeSpec&);
    void requestPorts();
    void listPorts();
    void save (ScopeView&, juce::Component& below);
    void report (const Result<>&, const std::filesystem::path&);
    juce::Rectangle<int> emptyArea() const;

    Document& document;
    const Catalogue& catalogue;
    Traces& traces;
    Traces::Client client;
    ScopeContext context;
    std::optional<std::uint64_t> listed;   // the version of the document whose ports are listed
    ScopeModel model;
    std::optional<ScopeModel> suggested;   // as first shown; empty if the file has kept them
    ScopeRow scope_row;
    juce::Viewport scroll;
    std::vector<std::unique_ptr<ScopeView>> views;   // in the order of the model
    std::vector<std::unique_ptr<Edge>> edges;        // between scopes that are next to each other
    Scopes before_drag;
    const ScopeSpec* moved = nullptr;   // the scope whose title is being dragged
    std::vector<std::unique_ptr<FlatButton>> adders;
    FlatButton more { "+ " + TRANS ("Scope") };   // in place of the adders, where there is no room for them
    FlatButton freeze_button { TRANS ("Freeze all (X)") };
    FlatButton suggestion { "" };   // a port to start with, while there is no scope
    juce::String warned;
};

}   // namespace tactus::host
