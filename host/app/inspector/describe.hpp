// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "rows.hpp"

#include <host/app/inspector/settings/setting_editor.hpp>
#include <host/app/limits/limit_list.hpp>
#include <host/app/model/patch.hpp>
#include <tactus/text/message.hpp>

namespace tactus::host
{

/// The objects and functions that the blocks of an inspector need.
struct InspectorContext
{
    Document& document;
    const Catalogue& catalogue;
    std::string patch;   ///< "" is the graph itself
    std::string path;    ///< how the patch is seen, see SeenPatch
    Refusal refused;
    EditorContext editors;
    std::function<Messages()> messages;                                               ///< returns the messages about the current graph; may be null
    std::function<std::vector<ContactLimit> (const std::string& node)> contacts {};   ///< the contacts whose steepest node this is; may be null
    std::function<void (juce::PopupMenu&, const std::string& node, const std::string& port)> menuOfParam {};
    LiveValues live {};

    const graph::Patch* in() const { return findPatch (document.graph(), patch); }

    const graph::Node* node (const std::string& name) const
    {
        const auto* p = in();
        return p == nullptr ? nullptr : p->find (name);
    }
};

/// Text that is recomputed after each change; amber if it reports a problem.
struct Remark
{
    juce::String text;
    bool is_problem = false;
};
std::unique_ptr<Block> remark (std::function<Remark()>);

void describeGraph (const InspectorContext&, Column&);
void describeNode (const InspectorContext&, const graph::Node&, bool help, const std::function<void()>& toggleHelp, Column&);
void describeWire (const InspectorContext&, graph::Id, Column&);
void describeDevice (const InspectorContext&, const graph::Node&, Column&);

/// A text that changes whenever the inspector has to show different blocks for the node.
std::string shapeOf (const InspectorContext&, const graph::Node&);

}   // namespace tactus::host
