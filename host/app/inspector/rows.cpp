// SPDX-License-Identifier: GPL-3.0-or-later
#include "rows.hpp"

#include <host/app/inspector/blocks/depth_ring.hpp>
#include <host/app/inspector/blocks/fields.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/drag_number.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/model/value_in_effect.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoint_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::host
{

namespace
{
const graph::Node* find (const Document& document, const SeenPatch& patch, const std::string& node)
{
    const auto* in = findPatch (document.graph(), patch.name);
    return in == nullptr ? nullptr : in->find (node);
}

/// A parameter: a label, and number fields or a choice.
class ParamRow final : public SetRow
{
public:
    ParamRow (Document& d, const Catalogue& c, SeenPatch p, std::string n, const FacePort& f, const Refusal& r, LiveValues v)
        : SetRow (fromUtf8 (readableName (f))), document (d), catalogue (c), patch (std::move (p)), node_name (std::move (n)), port (f), sheet (*f.sheet),
          refused (r), live (std::move (v))
    {
        const auto id = std::string (port.sheet->id);
        setTooltip (tooltipOf (*port.sheet) + (nameWithId (id) == readable (id) ? juce::String() : "\n" + filled (TRANS ("In files: %1"), id)));
        onReset = [this] { change (std::nullopt, false); };
        const int fields = port.isChoice() ? 0 : port.width;
        for (int i = 0; i < fields; ++i)
        {
            auto& field = *numbers.emplace_back (std::make_unique<NumberField> (sheet));
            field.onChange = [this, i] (const std::optional<Json>& v, bool continues) {
                const bool is_component = v && port.width == 3;
                change (is_component ? std::optional (withComponent (static_cast<std::size_t> (i), *v)) : v, continues);
            };
            field.onRefused = refused;
            static constexpr std::array components { " x", " y", " z" };
            field.setTitle ((label().length() > 1 ? label() : spokenName (*port.sheet)) + (port.width == 3 ? components[static_cast<std::size_t> (i)] : ""));
            addAndMakeVisible (field);
        }
        if (! port.isChoice()) return;
        for (std::size_t i = 0; i < port.sheet->choices.size(); ++i)
            choice.addItem (juce::String (std::string (port.sheet->choices[i])), static_cast<int> (i) + 1);
        choice.onChange = [this] { change (Json (std::string (port.sheet->choices[static_cast<std::size_t> (choice.getSelectedId() - 1)])), false); };
        choice.setTooltip (getTooltip());
        addAndMakeVisible (choice);
    }

    void refresh (const graph::Node*) override
    {
        const auto* node = find (document, patch, node_name);
        if (node == nullptr) return;
        auto now = paramNow (document.graph(), patch, *node, port);
        current = std::move (now.value);
        if (const auto* in = findPatch (document.graph(), patch.name); in != nullptr && port.width == 1)
            sheet = sheetInUse (document.graph(), *in, *node, port, current, catalogue);
        drivers.clear();
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
            drivers.push_back (driverName (document.graph(), patch, node_name, port, numbers.size() > 1 ? static_cast<int> (i) : -1));
        }
        setIsSet (now.is_set && (numbers.empty() || std::ranges::any_of (drivers, &std::string::empty)));
        showDepths (*node);
        note (now.control ? filled (TRANS ("set by %1"), now.control->name) : juce::String());
        refreshLive();
        if (port.isChoice())
        {
            const auto at = std::ranges::find (port.sheet->choices, current.is_string() ? current.get<std::string>() : std::string());
            choice.setSelectedId (static_cast<int> (at - port.sheet->choices.begin()) + 1, juce::dontSendNotification);
        }
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
            numbers[i]->show (componentOf (i));
            numbers[i]->setBold (isSet());
        }
    }

    void refreshLive() override
    {
        if (std::ranges::all_of (drivers, &std::string::empty) && ! was_driven) return;
        const auto values = live ? live (node_name + '.' + port.id) : std::vector<double> {};
        for (std::size_t i = 0; i < numbers.size(); ++i)
            numbers[i]->setDriver (drivers[i], i < values.size() && ! drivers[i].empty() ? std::optional (values[i]) : std::nullopt);
        was_driven = std::ranges::any_of (numbers, [] (const auto& n) { return n->isDriven(); });
    }

    void place (juce::Rectangle<int> area) override
    {
        for (auto& ring : rings)
            ring->setBounds (area.removeFromRight (DepthRing::width));
        choice.setBounds (area);
        for (std::size_t i = 0; i < numbers.size(); ++i)
        {
            const auto cell = area.removeFromLeft (area.getWidth() / static_cast<int> (numbers.size() - i));
            numbers[i]->setBounds (cell.reduced (numbers.size() > 1 ? 1 : 0, 0));
        }
    }

private:
    /// The first wire, or else the control.
    void note (const juce::String& control)
    {
        const auto driver = std::ranges::find_if_not (drivers, &std::string::empty);
        if (driver != drivers.end()) return setNote (filled (TRANS ("from %1"), *driver), themeOf (*this).accent);
        juce::StringArray depths;
        for (const auto& m : modulations)
            depths.add (textOf (m));
        setNote (depths.isEmpty() ? control : depths.joinIntoString (", "), themeOf (*this).accent);
    }

    /// A dial for each wire that adds to the value.
    void showDepths (const graph::Node& node)
    {
        constexpr std::size_t most_rings = 3;
        modulations = modulationsAt (document.graph(), patch.address (node.name + '.' + port.id), catalogue);   // also by wires outside of the patch
        if (modulations.empty()) modulations = modulationsOf (document.graph(), patch.name, node.name, port, catalogue);
        const auto count = std::min (modulations.size(), most_rings);
        const bool has_changed = count != rings.size();
        if (has_changed && depth_field)
        {
            depth_field->onFocusLost = nullptr;   // what is typed is for a dial that may be gone
            depth_field.reset();
        }
        while (rings.size() > count)
            rings.pop_back();
        while (rings.size() < count)
        {
            auto& ring = *rings.emplace_back (std::make_unique<DepthRing>());
            ring.onChange = [this, &ring] (double depth, bool continues) {
                if (auto command = changeDepth (document.graph(), ring.shown(), depth))
                    document.perform (std::move (*command), continues ? graph::Step::joined : graph::Step::own);
            };
            ring.onEnd = [this, &ring] (bool continues) {
                // Later, because this deletes the dial.
                juce::MessageManager::callAsync ([safe = SafePointer (this), m = ring.shown(), continues] {
                    if (safe != nullptr) safe->document.perform (removeModulation (m), continues ? graph::Step::joined : graph::Step::own);
                });
            };
            ring.onType = [this, &ring] (const juce::String& begun) { typeDepth (ring, begun); };
            ring.onHint = refused;
            addAndMakeVisible (ring);
        }
        for (std::size_t i = 0; i < count; ++i)
            rings[i]->show (modulations[i], siOf (current, sheet), sheet, label().length() > 1 ? label() : spokenName (*port.sheet));
        if (has_changed) resized();
    }

    /// Opens a field for a depth, over the value. It closes with the keyboard focus, which goes back to the ring after Return.
    void typeDepth (DepthRing& ring, const juce::String& begun)
    {
        depth_field = std::make_unique<TextField>();
        auto& field = *depth_field;
        field.setTitle (ring.getTitle());
        field.show (sizeOf (ring.shown()).trimCharactersAtStart (fromUtf8 ("\xc2\xb1+")));
        field.onApply = [this, safe = SafePointer (&ring)] (const juce::String& text) {
            if (safe == nullptr) return;
            const auto depth = readDepth (text.trim().toStdString(), safe->shown(), sheet);
            auto command = depth ? changeDepth (document.graph(), safe->shown(), *depth) : std::nullopt;
            if (command) document.perform (std::move (*command));
            if (! depth && refused) refused (messageText (depth.error()));
        };
        field.onReturnKey = [&field, safe = SafePointer (&ring)] {
            field.apply();
            if (safe != nullptr) takeFocus (*safe);
        };
        field.onFocusLost = [this] {
            depth_field->apply();
            juce::MessageManager::callAsync ([safe = SafePointer (this)] {
                if (safe != nullptr && safe->depth_field && ! safe->depth_field->hasKeyboardFocus (true)) safe->depth_field.reset();
            });
        };
        addAndMakeVisible (field);
        field.setBounds (ring.getBounds().withX (numbers.front()->getX()).withRight (ring.getX()));
        takeFocus (field);
        field.selectAll();
        if (begun.isNotEmpty()) field.insertTextAtCaret (begun);
    }

    void change (const std::optional<Json>& value, bool continues)
    {
        const auto* node = find (document, patch, node_name);
        if (node == nullptr) return;
        if (auto command = changeParam (document.graph(), patch, *node, port, value))
        {
            document.perform (std::move (*command), continues ? graph::Step::joined : graph::Step::own);
            return;
        }
        refresh (nullptr);
        if (refused) refused (outOfRangeText (document.graph(), patch, *node, port));
    }

    Json componentOf (std::size_t i) const
    {
        if (port.width != 3) return current;
        return current.is_array() && i < current.size() ? Json (current[i]) : Json (port.sheet->initial[i]);
    }

    Json withComponent (std::size_t i, const Json& v) const
    {
        auto all = Json::array();
        for (std::size_t k = 0; k < 3; ++k)
            all.push_back (k == i ? v : componentOf (k));
        return all;
    }

    Document& document;
    const Catalogue& catalogue;
    SeenPatch patch;
    std::string node_name;
    FacePort port;
    PortSheet sheet;   // of the port, with the usual range that follows from the wires
    Refusal refused;
    LiveValues live;
    Json current;
    std::vector<std::string> drivers;   // of the numbers: the outputs whose wires set them
    bool was_driven = false;
    std::vector<Modulation> modulations;
    std::vector<std::unique_ptr<DepthRing>> rings;
    std::unique_ptr<TextField> depth_field;   // while a depth is being typed
    std::vector<std::unique_ptr<NumberField>> numbers;
    juce::ComboBox choice;
};
}   // namespace

std::unique_ptr<Block> paramRow (Document& document, const Catalogue& catalogue, const SeenPatch& patch, const std::string& node, const FacePort& port,
                                 const Refusal& refused, LiveValues live, std::function<void (juce::PopupMenu&)> fillMenu)
{
    auto row = std::make_unique<ParamRow> (document, catalogue, patch, node, port, refused, std::move (live));
    row->onWantsMenu = std::move (fillMenu);
    return row;
}

bool controlBy (Document& document, const SeenPatch& patch, const std::string& name, const FacePort& port, const std::string& control,
                const Catalogue& catalogue)
{
    const auto* node = find (document, patch, name);
    const auto path = patch.address (name + '.' + port.id);
    if (node == nullptr || port.sheet == nullptr || path.empty()) return false;
    auto now = paramNow (document.graph(), patch, *node, port).value;
    const auto shown = readQuantity (now, *port.sheet);
    const auto si = valueInEffect (document.graph(), path, catalogue);
    if (! si) return false;
    if (shown && *si != shown->si()) now = shown->exactly (*si).toJson();
    const auto sheet = sheetInUse (document.graph(), *findPatch (document.graph(), patch.name), *node, port, now, catalogue);
    if (! control.empty())
    {
        auto command = addTarget (document.graph(), control, path, now, sheet);
        return command && document.perform (std::move (*command));
    }
    const auto [low, high] = sweepOf (now, sheet);
    return document.perform (newControlFor (document.graph(), path, low, high, siOf (now, *port.sheet)));
}

void release (Document& document, const SeenPatch& patch, const std::string& name, const FacePort& port, const Catalogue& catalogue)
{
    const auto param = controlOf (document.graph(), patch.address (name + '.' + port.id));
    if (! param) return;
    if (auto command = removeTarget (document.graph(), param->control, param->path, catalogue)) document.perform (std::move (*command));
}

}   // namespace tactus::host
