// SPDX-License-Identifier: GPL-3.0-or-later
#include "header.hpp"

#include <host/app/look/glyph.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
class NodeHeader final : public Block
{
public:
    NodeHeader (const InspectorContext& at, const graph::Node& node, bool help_shown, std::function<void()> toggleHelp) : type (node.type)
    {
        auto& document = at.document;
        name.setFont (lookOf (*this).font (15.0f, true));
        name.setTitle (TRANS ("Name of the node"));
        name.setTooltip (TRANS ("Node name: lower-case letters, digits and _"));
        name.onApply = [&document, patch = at.patch, before = node.name, this] (const juce::String& to) {
            if (! document.perform (graph::RenameNode { patch, before, asNodeName (to) })) name.refuse();
        };
        bypass.onClick = [&document, patch = at.patch, n = node.name, this] {
            const auto value = bypass.getToggleState() ? std::nullopt : std::optional<Json> (true);
            document.perform (graph::SetNodeKey { patch, n, "bypass", value });
        };
        help.setToggleState (help_shown, juce::dontSendNotification);
        help.onClick = std::move (toggleHelp);
        addAndMakeVisible (name);
        addAndMakeVisible (bypass);
        addAndMakeVisible (help);
        bypass.setColour ([] (const Theme& t) { return t.warning; });
        NodeHeader::refresh (&node);
    }

    int heightFor (int) override { return 60; }

    void refresh (const graph::Node* node) override
    {
        if (node == nullptr) return;
        name.show (node->name);
        bypass.setToggleState (node->bypass, juce::dontSendNotification);
    }

    void paint (juce::Graphics& g) override
    {
        const auto& look = lookOf (*this);
        const auto cut = type.find_first_of (".:");
        auto glyph = glyphOf (type.starts_with ("file:") ? "graph" : type.substr (0, cut));
        glyph.applyTransform (juce::AffineTransform::translation (2.0f, 9.0f));
        g.setColour (look.theme().dim);
        g.strokePath (glyph, juce::PathStrokeType (1.5f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded));
        g.setFont (look.font (12.0f));
        g.drawText (type, getLocalBounds().removeFromTop (56).removeFromBottom (22), juce::Justification::centredLeft, true);
    }

    void resized() override
    {
        auto top = getLocalBounds().removeFromTop (32).reduced (0, 2);
        help.setBounds (top.removeFromRight (28));
        top.removeFromRight (4);
        bypass.setBounds (top.removeFromRight (60));
        top.removeFromRight (4);
        name.setBounds (top.withTrimmedLeft (24));
    }

private:
    std::string type;
    TextField name;
    ToolButton bypass { TRANS ("bypass"), ToolButton::Kind::toggle, TRANS ("Pass the input through unchanged") };
    ToolButton help { "?", ToolButton::Kind::toggle, TRANS ("Describe all ports") };
};
}   // namespace

std::unique_ptr<Block> nodeHeader (const InspectorContext& at, const graph::Node& node, bool help, std::function<void()> toggleHelp)
{
    return std::make_unique<NodeHeader> (at, node, help, std::move (toggleHelp));
}

}   // namespace tactus::host
