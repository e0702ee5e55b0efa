// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rows.hpp"
#include "setting_editor.hpp"

#include <framework/message.hpp>

namespace tactus::host
{

/// What the blocks of an inspector work with.
struct Inspected
{
    Document& document;
    const Catalogue& catalogue;
    std::string patch;   ///< "" is the graph itself
    Refusal refused;
    EditorContext editors;
    std::function<Messages()> messages;   ///< of the graph as it is; may be none

    const graph::Patch* in() const { return patch.empty() ? &document.graph().root : document.graph().find (patch); }
};

/// Text that is worked out anew whenever something changes; amber if it is a complaint.
struct Remark
{
    juce::String text;
    bool is_wrong = false;
};
std::unique_ptr<Block> remark (std::function<Remark()>);

void describeGraph (const Inspected&, Column&);
void describeNode (const Inspected&, const graph::Node&, bool help, const std::function<void()>& toggleHelp, Column&);
void describeWire (const Inspected&, graph::Id, Column&);
void describeDevice (const Inspected&, const graph::Node&, Column&);

/// What decides which blocks such a node needs.
std::string shapeOf (const Inspected&, const graph::Node&);

}   // namespace tactus::host
