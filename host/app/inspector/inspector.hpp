// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "describe.hpp"

#include <host/assets/file_assets.hpp>

#include <functional>
#include <memory>
#include <set>

namespace tactus::host
{

/// What is selected, a node or a wire, with all that can be set of it; or, if nothing is, the graph and its controls.
class Inspector final : public juce::Component, private Document::Listener
{
public:
    Inspector (Document&, const Catalogue&);
    ~Inspector() override;

    void inspect (const std::string& patch, std::set<graph::Id> selection);
    void setHelp (bool);   ///< all ports in words
    bool showsHelp() const noexcept { return help; }

    std::function<void (const juce::String&)> onHint;   ///< why something was not taken
    std::function<Messages()> messagesNow;              ///< what is wrong with the graph as it is

    Column& shown() noexcept { return *column; }

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    void documentChanged() override { rebuild(); }
    void rebuild();
    Inspected inspected();

    Document& document;
    const Catalogue& catalogue;
    FileAssets files;
    std::string patch;
    std::set<graph::Id> selection;
    bool help = false;
    std::string made_for;                                   // what the column shows: another column only for something else, so that a drag goes on
    std::unique_ptr<Column> column, retired;                // retired: a field of it may be what asked for another
    std::pair<std::string, std::set<graph::Id>> shown_of;   // while it is the same, it stays scrolled to where it was
    juce::Viewport scroll;
};

}   // namespace tactus::host
