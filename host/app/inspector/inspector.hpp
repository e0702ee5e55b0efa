// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rows.hpp"

#include <host/app/model/document.hpp>

#include <functional>
#include <memory>
#include <set>

namespace tactus::host
{

/// What is selected, with all that can be set of it; or, if nothing is, the graph and its controls.
class Inspector final : public juce::Component, private Document::Listener
{
public:
    Inspector (Document&, const Catalogue&);
    ~Inspector() override;

    void inspect (const std::string& patch, std::set<graph::Id> selection);

    std::function<void (const juce::String&)> onHint;   ///< why something was not taken

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    void documentChanged() override;
    void rebuild();
    void describeGraph (Column&) const;
    void describe (const graph::Patch&, const graph::Node&, Column&) const;

    Document& document;
    const Catalogue& catalogue;
    std::string patch;
    std::set<graph::Id> selection;
    std::string made_for;   // what the column shows: another column only for something else, so that a drag goes on
    std::unique_ptr<Column> column;
    juce::Viewport scroll;
};

}   // namespace tactus::host
