// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_view.hpp"

#include <host/app/model/document.hpp>
#include <host/app/run/performance.hpp>

namespace tactus::host
{

/// Scopes side by side, and a row to add some.
class ScopePanel final : public juce::Component, private Document::Listener
{
public:
    ScopePanel (Document&, Performance&, const Catalogue&);
    ~ScopePanel() override;

    /// Takes in what has run since. To be called 30 times a second while it is seen.
    void refresh();

    /// Shows what suits the graph, in place of what is shown: for one that has just been opened.
    void suggest();

    /// Shows a port as a trace, or does not any more. True if it is shown now.
    bool probe (const std::string& port);
    bool isProbed (const std::string& port) const { return model.shows (port); }
    std::vector<std::string> probes() const;   ///< the ports of the graph that are traces now

    ScopeView& add (ScopeKind);
    void freezeAll (bool);
    bool isFrozen() const;

    /// What is amiss with what is shown: too many ports, a scope that waits; "" if nothing is.
    juce::String warning() const;

    std::function<void (const juce::String&)> onHint;   ///< a word for the line below: where a file is
    std::function<void()> onProbes;                     ///< other ports are traces now: ask probes()

    const ScopeModel& scopes() const noexcept { return model; }
    const std::vector<std::unique_ptr<ScopeView>>& shown() const noexcept { return views; }

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;
    void mouseDown (const juce::MouseEvent&) override;

private:
    static constexpr int row_height = 30;
    static constexpr std::size_t most_scopes = 8;

    void documentChanged() override;
    void showView (ScopeSpec&);
    void close (const ScopeSpec&);
    void wantPorts();
    void listPorts();
    void save (ScopeView&, juce::Component& below);
    void say (const tl::expected<void, Error>&, const juce::File&);
    juce::Rectangle<int> emptyArea() const;

    Document& document;
    const Catalogue& catalogue;
    Traces& traces;
    Traces::Client client;
    ScopeDesk desk;
    ScopeModel model;
    std::vector<std::unique_ptr<ScopeView>> views;   // as the model's
    std::vector<std::unique_ptr<FlatButton>> adders;
    FlatButton freeze_button { "Freeze all (X)" };
    FlatButton offer { "" };   // a port to begin with, where nothing is shown
    juce::String warned;
};

}   // namespace tactus::host
