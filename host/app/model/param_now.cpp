// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_now.hpp"
#include "param_value.hpp"
#include "quantity_text.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/inside.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
std::optional<ControlledParam> controlNow (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port)
{
    const auto address = patch.address (node.name + '.' + port.id);
    return address.empty() ? std::nullopt : controlOf (g, address);
}
}   // namespace

bool drives (const graph::Wire& wire, const FacePort& param)
{
    const auto entry = entryOf (param.id);
    return ! wire.add && wire.enabled.value_or (true) && wire.to.port == baseOf (param.id) && wire.to.index == (entry ? static_cast<int> (*entry) : -1);
}

const graph::Wire* driverOf (const graph::Patch& patch, const std::string& node, const FacePort& param, int component)
{
    const auto isIt = [&] (const graph::Wire& w) {
        return w.to.node == node && (component < 0 || w.to.component < 0 || w.to.component == component) && drives (w, param);
    };
    const auto found = std::ranges::find_if (patch.wires, isIt);
    return found == patch.wires.end() ? nullptr : &*found;
}

juce::String gainText (const Json& gain)
{
    const auto text = gain.is_string() ? gain.asString() : gain.is_number() ? shownQuantity (gain.get<double>(), "1")
                                                                            : gain.dump();
    return juce::String::fromUTF8 (text.c_str());
}

juce::String addedTo (const graph::Patch& patch, const std::string& node, const FacePort& param)
{
    const auto entry = entryOf (param.id);
    juce::StringArray all;
    for (const auto& w : patch.wires)
        if (w.add && w.enabled.value_or (true) && w.to.node == node && w.to.port == baseOf (param.id) && w.to.index == (entry ? static_cast<int> (*entry) : -1))
            all.add ((w.gain.is_null() ? juce::String() : gainText (w.gain) + juce::String::fromUTF8 (" \xc3\x97 ")) + juce::String (graph::toText (w.from)));
    return all.joinIntoString (", ");
}

namespace
{
bool isSet (const graph::Wire& w) { return ! w.add && w.enabled.value_or (true); }

/// A port of an endpoint, such as "gain[2]". Empty for one component of a vector, which is not the whole param.
std::string paramOf (const graph::Endpoint& e)
{
    if (e.component >= 0) return {};
    return e.index < 0 ? e.port : e.port + '[' + std::to_string (e.index) + ']';
}

/// The patches through which a path such as "grain/wave/" leads, from the outside in.
class Way
{
public:
    Way (const graph::Graph& g, std::string rest)
    {
        graph::Inside in { &g, &g.root };
        for (std::string path; in && ! rest.empty();)
        {
            const auto slash = rest.find ('/');
            const auto name = graph::firstNameOf (rest);
            const auto* node = in.patch->find (name);
            if (node == nullptr) in = {};
            if (node == nullptr) break;
            levels.push_back ({ in.patch, path, name });
            in = graph::insideOf (*in.owner, *node);
            path += name + '/';
            rest.erase (0, slash == std::string::npos ? slash : slash + 1);
        }
        end = in.patch;
    }

    /// A patch on the way, its own path, and the node through which one goes on.
    struct Level
    {
        const graph::Patch* patch;
        std::string path, node;
    };

    std::vector<Level> levels;
    const graph::Patch* end = nullptr;   // the patch that the path leads to; null if there is none
};

/// As drivenFromOutside(), for the patch at the end of the way.
std::map<std::string, std::string> setFromOutside (const Way& way)
{
    std::map<std::string, std::string> found;
    if (way.end == nullptr) return found;
    std::map<std::pair<std::string, std::string>, std::string> names;   // by node and port of the patch around: the param inside
    std::string inside;                                                 // the path from there to the patch
    const auto* within = way.end;
    for (auto level = way.levels.rbegin(); level != way.levels.rend(); ++level)
    {
        std::map<std::pair<std::string, std::string>, std::string> outer;
        for (const auto& [name, param] : names)
            outer.emplace (std::pair (level->node + '/' + name.first, name.second), param);
        for (const auto* exposed : { &within->expose.params, &within->expose.inputs })
            for (const auto& [name, to] : *exposed)
            {
                const auto port = paramOf (to);
                if (port.empty()) continue;
                const auto known = names.find ({ to.node, port });
                if (known != names.end())
                    outer.emplace (std::pair (level->node, name), known->second);
                else if (to.node.starts_with (inside))
                    outer.emplace (std::pair (level->node, name), to.node.substr (inside.size()) + '.' + port);
            }
        names = std::move (outer);
        inside = level->node + '/' + inside;
        for (const auto& w : level->patch->wires)
        {
            const auto port = paramOf (w.to);
            if (! isSet (w) || port.empty()) continue;
            const auto from = level->path + graph::toText (w.from);
            if (const auto known = names.find ({ w.to.node, port }); known != names.end()) found.emplace (known->second, from);
            if (w.to.node.starts_with (inside)) found.emplace (w.to.node.substr (inside.size()) + '.' + port, from);
        }
        within = level->patch;
    }
    return found;
}
}   // namespace

std::string driverAt (const graph::Graph& g, const std::string& path)
{
    const auto to = graph::parseEndpoint (path);
    if (! to) return {};
    const auto slash = to->node.rfind ('/');
    const auto around = slash == std::string::npos ? std::string() : to->node.substr (0, slash + 1);
    const auto node = to->node.substr (around.size());
    const Way way (g, around);
    if (way.end == nullptr) return {};
    for (const auto& w : way.end->wires)
        if (isSet (w) && w.to.node == node && w.to.port == to->port && w.to.index == to->index
            && (w.to.component < 0 || to->component < 0 || w.to.component == to->component))
            return around + graph::toText (w.from);
    const auto outside = setFromOutside (way);
    const auto found = outside.find (node + '.' + (to->index < 0 ? to->port : to->port + '[' + std::to_string (to->index) + ']'));
    return found == outside.end() ? std::string() : found->second;
}

std::map<std::string, std::string> drivenFromOutside (const graph::Graph& g, const SeenPatch& seen)
{
    return seen.path.empty() ? std::map<std::string, std::string> {} : setFromOutside (Way (g, seen.path));
}

std::string driverName (const graph::Graph& g, const SeenPatch& seen, const std::string& node, const FacePort& param, int component)
{
    const auto* in = findPatch (g, seen.name);
    if (const auto* wire = in == nullptr ? nullptr : driverOf (*in, node, param, component)) return graph::toText (wire->from);
    const auto outside = drivenFromOutside (g, seen);
    const auto found = outside.find (node + '.' + param.id);
    return found == outside.end() ? std::string() : found->second;
}

std::vector<std::string> driversOf (const graph::Graph& g, const graph::Control& control)
{
    std::vector<std::string> drivers;
    for (const auto& t : control.to)
        drivers.push_back (driverAt (g, t.path));
    return drivers;
}

bool isOverridden (const graph::Graph& g, const graph::Control& control)
{
    const auto drivers = driversOf (g, control);
    return ! drivers.empty() && std::ranges::none_of (drivers, &std::string::empty);
}

juce::String overriddenText (const graph::Graph& g, const graph::Control& control)
{
    juce::StringArray lines;
    const auto drivers = driversOf (g, control);
    for (std::size_t i = 0; i < drivers.size(); ++i)
        if (! drivers[i].empty()) lines.add (filled (TRANS ("A wire from %1 sets %2, so this control has no effect on it."), drivers[i], control.to[i].path));
    return lines.joinIntoString ("\n");
}

juce::String drivenText (const std::string& output) { return filled (TRANS ("A wire from %1 sets this value. Delete the wire to set it here"), output); }

Json valueOf (const ControlledParam& controlled, const PortSheet& sheet)
{
    const auto low = readQuantity (controlled.low_text, sheet);
    return low ? low->moved (controlled.value).toJson() : Json (rounded (controlled.value));
}

ParamNow paramNow (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port)
{
    const auto own = writtenValue (node, port);
    ParamNow now { own.is_null() ? initialValue (g, node, port) : own, ! own.is_null(), controlNow (g, patch, node, port) };
    if (! now.control || port.sheet == nullptr) return now;
    now.value = valueOf (*now.control, *port.sheet);
    now.is_set = true;
    return now;
}

std::optional<graph::Command> changeParam (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port,
                                           const std::optional<Json>& value)
{
    const auto control = controlNow (g, patch, node, port);
    if (! control) return graph::SetParam { patch.name, node.name, baseOf (port.id), withValue (node, port, value) };
    const auto wanted = readQuantity (value.value_or (initialValue (g, node, port)), *port.sheet);
    return wanted ? moveControlFor (g, *control, wanted->si()) : std::nullopt;
}

std::string outOfRangeText (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port)
{
    const auto control = controlNow (g, patch, node, port);
    const auto of = control ? filled (TRANS ("the new value of %1 is outside the range of the control %2"), port.id, control->name)
                            : filled (TRANS ("the new value of %1 is outside the range of its control"), port.id);
    return of.toStdString() + "; " + TRANS ("widen that range, or right-click the parameter in the inspector to release it").toStdString();
}

}   // namespace tactus::host
