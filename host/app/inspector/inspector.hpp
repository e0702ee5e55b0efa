// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "describe.hpp"
#include "knob_strip.hpp"

#include <host/base/assets/file_assets.hpp>

#include <functional>
#include <memory>
#include <set>

namespace tactus::host
{

/// Edits the selected node or wire. With nothing selected it edits the graph and its controls.
class Inspector final : public juce::Component, private Document::Listener
{
public:
    Inspector (Document&, const Catalogue&);
    ~Inspector() override;

    void inspect (SeenPatch, std::set<graph::Id> selection);
    void showLimits (const std::vector<ContactLimit>&);
    void setHelp (bool);   ///< true: also shows the descriptions of all ports
    bool showsHelp() const noexcept { return help; }

    std::function<void (const juce::String&)> onHint;     ///< receives the reason why an edit was refused
    std::function<void (const juce::String&)> onNotice;   ///< receives what stays in the status line, such as the range of a param
    std::function<void (const juce::String& patterns, const std::filesystem::path& begin, std::function<void (const std::filesystem::path&)>)>
        onChooseFile;   ///< asks for a file that a setting names, see EditorContext::choose
    std::function<void (const std::string& node, const std::string& param, const std::string& type)>
        onModulate;                          ///< adds a node of this type that moves a param around its value; "": one that the user chooses
    std::function<Messages()> messagesNow;   ///< returns the messages about the current graph
    LiveValues valuesNow;                    ///< of params of the patch that is inspected
    void refreshLive();                      ///< shows these values; call it many times a second

    Column& shown() noexcept { return *column; }
    KnobStrip& knobs() noexcept { return strip; }
    std::string controlAt (juce::Point<int> screen);   ///< the id of the control that is shown there; "" if there is none

    /// Fills the menu of a param of the patch that is inspected.
    void fillParamMenu (juce::PopupMenu&, const std::string& node, const std::string& port);

    void focusFirst();                            ///< gives the keyboard focus to the first field
    void reveal (const juce::Component& field);   ///< scrolls to a field

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    void documentChanged() override { rebuild(); }
    void typesChanged() override;
    void rebuild();
    InspectorContext inspected();

    struct ParamPlace
    {
        SeenPatch patch;
        std::string node, port;
    };
    void onParam (const ParamPlace&, const std::function<void (const graph::Node&, const FacePort&)>&);   ///< no effect if it is gone
    void assign (const graph::Node&, const FacePort&, const std::string& control);                        ///< to a control; "": a new one
    void nameControl (const std::string& id);                                                             ///< opens the field for its name

    struct SelectedItems
    {
        std::vector<const graph::Node*> nodes;
        std::vector<graph::Id> wires;
        std::size_t wire_count = 0;   // these, and those between the nodes
        std::string key;              // changes when the column has to be rebuilt

        bool isEmpty() const noexcept { return nodes.empty() && wires.empty(); }
        bool isOneWire() const noexcept { return nodes.empty() && wires.size() == 1; }
    };
    SelectedItems selected (const InspectorContext&) const;
    std::unique_ptr<Column> makeColumn (const InspectorContext&, const SelectedItems&);

    Document& document;
    const Catalogue& catalogue;
    FileAssets files;
    SeenPatch patch;
    std::set<graph::Id> selection;
    std::uint64_t version = 0;   // of the document, when it was last inspected
    bool help = false;
    std::vector<ContactLimit> contacts;
    std::string made_for;                                 // key of the current column; the column is kept while it matches, so that a drag can continue
    std::unique_ptr<Column> column, retired;              // retired: kept alive because one of its fields may have triggered the rebuild
    std::pair<SeenPatch, std::set<graph::Id>> shown_of;   // patch and selection; the scroll position is kept while they stay the same
    juce::Viewport scroll;
    KnobStrip strip { document, catalogue };   // the controls of the graph, whatever is selected
};

}   // namespace tactus::host
