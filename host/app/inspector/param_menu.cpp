// SPDX-License-Identifier: GPL-3.0-or-later
// The menu of a parameter: the same on the canvas and in the inspector.
#include "inspector.hpp"
#include "modulator_menu.hpp"

#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The usual and the allowed range of a param, and that of the control that drives it.
juce::String rangeText (const FacePort& port, const ParamNow& now)
{
    auto lines = juce::StringArray::fromLines (tooltipOf (*port.sheet));
    if (now.control)
    {
        const auto symbol = port.sheet->unit.kind == UnitRule::Kind::fixed ? port.sheet->unit.unit.symbol : std::string_view();
        lines.add (filled (TRANS ("%1: %2 to %3"), now.control->name, shownQuantity (now.control->low, symbol), shownQuantity (now.control->high, symbol)));
    }
    return fromUtf8 (readableName (port)) + ": " + lines.joinIntoString ("  ");
}
}   // namespace

void Inspector::onParam (const ParamPlace& at, const std::function<void (const graph::Node&, const FacePort&)>& f)
{
    const auto* in = findPatch (document.graph(), at.patch.name);
    const auto* node = in == nullptr ? nullptr : in->find (at.node);
    if (node == nullptr) return;
    const auto face = faceOf (document.graph(), *in, *node, catalogue);
    if (const auto* port = face.find (Role::param, at.port); port != nullptr && port->sheet != nullptr) f (*node, *port);
}

void Inspector::assign (const graph::Node& node, const FacePort& port, const std::string& control)
{
    if (controlBy (document, patch, node.name, port, control, catalogue) || ! onNotice) return;
    onNotice (filled (TRANS ("%1 has no single value: the instances of this subgraph differ, and a control would make them equal."), port.id));
}

void Inspector::fillParamMenu (juce::PopupMenu& menu, const std::string& node_name, const std::string& port_id)
{
    const ParamPlace at { patch, node_name, port_id };
    using Act = std::function<void (Inspector&, const graph::Node&, const FacePort&)>;
    const auto item = [&] (const juce::String& text, const Act& act, bool can = true) {
        menu.addItem (text, can, false, [safe = SafePointer (this), at, act] {   // called later, when the node may be gone
            if (safe != nullptr) safe->onParam (at, [&] (const auto& node, const auto& port) { act (*safe, node, port); });
        });
    };
    onParam (at, [&] (const graph::Node& node, const FacePort& port) {
        const auto now = paramNow (document.graph(), patch, node, port);
        menu.addSectionHeader (fromUtf8 (node.name + '.' + port.id));
        if (! patch.address (port.id).empty() && port.width == 1 && ! port.isChoice())
        {
            if (now.control)
                item (filled (TRANS ("Release from %1"), now.control->name), [] (Inspector& i, const auto& n, const auto& p) {
                    release (i.document, i.patch, n.name, p, i.catalogue);
                });
            else
            {
                item (TRANS ("New control"), [] (Inspector& i, const auto& n, const auto& p) {
                    i.assign (n, p, {});
                    if (const auto made = controlOf (i.document.graph(), i.patch.address (n.name + '.' + p.id))) i.nameControl (made->control);
                });
                for (const auto& c : document.graph().controls)
                    item (filled (TRANS ("Assign to %1"), c.name.empty() ? c.id : c.name), [id = c.id] (Inspector& i, const auto& n, const auto& p) {
                        i.assign (n, p, id);
                    });
            }
            if (onModulate)
            {
                auto by = modulatorMenu (catalogue, [safe = SafePointer (this), at] (const std::string& type) {
                    if (safe != nullptr) safe->onModulate (at.node, at.port, type);
                });
                by.addItem (TRANS ("Another node..."), [safe = SafePointer (this), at] {
                    if (safe != nullptr) safe->onModulate (at.node, at.port, {});
                });
                menu.addSubMenu (TRANS ("Modulate by"), by);
            }
            menu.addSeparator();
        }
        if (! patch.name.empty())
        {
            const auto& in = *findPatch (document.graph(), patch.name);
            const auto face = faceOf (document.graph(), in, node, catalogue);
            const auto isThis = [&] (const auto& e) {
                const auto* end = e.second.node == node.name ? face.endOf (e.second) : nullptr;
                return end != nullptr && end->id == port.id;
            };
            item (std::ranges::any_of (in.expose.params, isThis) ? TRANS ("Hide outside the subgraph") : TRANS ("Expose outside the subgraph"),
                  [] (Inspector& i, const auto& n, const auto& p) { i.document.perform (toggleExposed (i.document.graph(), i.patch.name, n.name, p)); });
        }
        item (
            TRANS ("Reset to default"), [] (Inspector& i, const auto& n, const auto& p) {
            auto command = changeParam (i.document.graph(), i.patch, n, p, std::nullopt);
            if (command)
                i.document.perform (std::move (*command));
            else if (i.onNotice)
                i.onNotice (juce::String (outOfRangeText (i.document.graph(), i.patch, n, p))); },
            now.is_set);
        item (TRANS ("Show range"), [] (Inspector& i, const auto& n, const auto& p) {
            if (i.onNotice) i.onNotice (rangeText (p, paramNow (i.document.graph(), i.patch, n, p)));
        });
    });
}

/// After the menu is gone, which gives the keyboard back to what had it before.
void Inspector::nameControl (const std::string& id)
{
    juce::MessageManager::callAsync ([safe = SafePointer (this), id] {
        if (safe != nullptr) safe->strip.rename (id);
    });
}

}   // namespace tactus::host
