// SPDX-License-Identifier: GPL-3.0-or-later
// The canvas commands that add nodes and connect ports.
#include "canvas.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/obvious_wires.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/model/value_in_effect.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoint_text.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace tactus::host
{

namespace
{
/// A wire between a port of the selected node and another port, or a new node of a type, or a node that the user is still to choose.
struct WireChoice
{
    PaletteEntry entry;
    Findable searched;
    PortId own, other {};
    std::string type {};
    std::string control {};   // the id of the one whose targets the wire goes to
};

/// The choices that the key W offers for a node: wires to and from what is there, then nodes still to be chosen, then each type of node that fits.
class WireChoices
{
public:
    static constexpr std::array roles { Role::output, Role::input, Role::param };

    using Fits = std::function<bool (const ScenePort& from, const ScenePort& to)>;

    /// `controlAt`: the name of the control that sets a param, as "drag.mu", or empty.
    WireChoices (const Scene& s, const SceneNode& n, Fits f, std::function<std::string (const std::string&)> controlAt)
        : scene (s), node (n), fits (std::move (f)), nameOfControl (std::move (controlAt))
    {
        for (const auto& w : scene.wires())
            wired.insert (w.text);
    }

    /// Wires from and into what is there. Those that only fit one component of a vector come after the others.
    void addWires()
    {
        for (const bool whole : { true, false })
            for (const auto& own : portsOf (node))
                for (const auto& n : scene.nodes())
                    for (const auto& there : portsOf (n))
                        if (n.id != node.id && isOutput (own) != isOutput (there) && (own.port->width == there.port->width) == whole) addWire (own, there);
    }

    void addNewNode (const FacePort& own)
    {
        const auto name = wireText (own, TRANS ("new node").toStdString());
        add ({ { name, {}, TRANS ("Adds a node that fits.").toStdString() }, { {}, name, {}, {} }, idOf (own) });
    }

    /// A new node is found as in the list of all nodes, and by the name of the port and "new", too.
    void addType (const FacePort& own, const PaletteType& t)
    {
        auto searched = t.searched;
        searched.names += ' ' + own.id + ' ' + TRANS ("new").toStdString();
        const auto key = t.entry.type + (own.role == Role::output ? " (" + own.id + ')' : " -> " + own.id);   // an input may have the name of an output
        const auto name = wireText (own, filled (TRANS ("new %1"), t.entry.name).toStdString());
        add ({ { key, name, t.entry.summary }, std::move (searched), idOf (own), {}, t.entry.type });
    }

    /// A knob of the graph, for what it sets inside of a subgraph.
    void addControl (const FacePort& own, const graph::Control& c)
    {
        const auto name = c.name.empty() ? c.id : c.name;
        const auto text = wireText (own, name);
        const auto about = TRANS ("Moves what this control sets around its value.").toStdString();
        add ({ { text, {}, about }, { name, text, {}, about }, idOf (own), {}, {}, c.id });
    }

    std::size_t size() const { return found.size(); }
    std::vector<WireChoice> take() { return std::move (found); }

private:
    static bool isOutput (const ScenePort& p) { return p.port->role == Role::output; }

    static std::vector<ScenePort> portsOf (const SceneNode& n)
    {
        std::vector<ScenePort> all;
        for (const auto role : roles)
            for (const auto& p : n.face->of (role))
                all.push_back ({ &n, &p });
        return all;
    }

    void add (WireChoice c) { found.push_back (std::move (c)); }
    PortId idOf (const FacePort& own) const { return { node.id, own.role, own.id }; }

    std::string wireText (const FacePort& own, const std::string& other) const
    {
        const auto here = node.name + '.' + own.id;
        return own.role == Role::output ? here + " -> " + other : other + " -> " + here;
    }

    void addWire (const ScenePort& own, const ScenePort& there)
    {
        const bool leaves = isOutput (own);
        if (! fits (leaves ? own : there, leaves ? there : own)) return;
        const auto text = wireText (*own.port, there.node->name + '.' + there.port->id);
        if (wired.contains (text)) return;
        const auto& param = leaves ? there : own;
        const auto& about = param.port->about;
        const auto control = param.port->role == Role::param ? nameOfControl (param.node->name + '.' + param.port->id) : std::string();
        add ({ { text, {}, control.empty() ? about : control + ": " + about },
               { there.node->name, text + ' ' + control, {}, about + ' ' + there.node->type },
               idOf (*own.port),
               { there.node->id, there.port->role, there.port->id } });
    }

    const Scene& scene;
    const SceneNode& node;
    Fits fits;
    std::function<std::string (const std::string&)> nameOfControl;
    std::set<std::string, std::less<>> wired;
    std::vector<WireChoice> found;
};
}   // namespace

void CanvasCommands::wireFromSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.size() != 1 || ! canvas.onChoose) return;
    const auto& node = *nodes.front();
    const auto fits = [this] (const ScenePort& from, const ScenePort& to) { return mayJoin (from, to).has_value(); };
    WireChoices made (canvas.scene(), node, fits, [this] (const std::string& param) {
        const auto by = controlOf (document.graph(), canvas.address (param));
        return by ? by->name : std::string();
    });
    made.addWires();
    for (const auto& own : node.face->outputs)
        for (const auto& c : document.graph().controls)
            if (own.width == 1 && std::ranges::any_of (c.to, [] (const auto& t) { return t.path.find ('/') != std::string::npos; })) made.addControl (own, c);
    for (const auto role : WireChoices::roles)
        for (const auto& own : node.face->of (role))
            if (! own.isChoice()) made.addNewNode (own);
    const auto shown_first = made.size();
    for (const auto& type : paletteTypes (document.graph(), canvas.types(), canvas.patch()))
        for (const auto role : WireChoices::roles)
            for (const auto& own : node.face->of (role))
                if (type.fits ({ &own, node.quantityOf (own) })) made.addType (own, type);

    const auto choices = std::make_shared<const std::vector<WireChoice>> (made.take());
    std::vector<Findable> searched, names;   // of all, and of what is shown first, without descriptions
    for (const auto& c : *choices)
        searched.push_back (c.searched);
    for (std::size_t i = 0; i < shown_first; ++i)
        names.push_back ({ searched[i].title, searched[i].names, {}, {} });
    // First the wires to what is there, by name; then new nodes, and wires whose description fits.
    const auto search = [choices, searched = std::move (searched), names = std::move (names)] (const std::string& query) {
        auto order = bestMatches (names, query, false);
        const auto words = juce::StringArray::fromTokens (fromUtf8 (query).toLowerCase(), " .", {});
        const auto isNamed = [&] (const WireChoice& c) { return words.contains (fromUtf8 (c.own.port)); };
        const bool names_port = std::ranges::any_of (*choices, isNamed), is_empty = words.joinIntoString ({}).isEmpty();
        const std::set<std::size_t> known (order.begin(), order.end());
        for (const auto i : is_empty ? std::vector<std::size_t> {} : bestMatches (searched, query))
            if (! known.contains (i) && (i < names.size() || ! names_port || isNamed ((*choices)[i]))) order.push_back (i);
        std::vector<PaletteEntry> found;
        for (const auto i : order)
            found.push_back ((*choices)[i].entry);
        return found;
    };
    canvas.onChoose (filled (TRANS ("Connect %1 with..."), node.name), search, [this, choices] (const std::string& chosen) {
        const auto choice = std::ranges::find (*choices, chosen, [] (const WireChoice& c) { return c.entry.type; });
        const auto own = choice == choices->end() ? ScenePort {} : canvas.scene().findPort (choice->own);
        if (! own) return;
        if (! choice->control.empty()) return joinControl (choice->own, choice->control);
        const bool leaves = own.port->role == Role::output;
        if (const auto other = canvas.scene().findPort (choice->other))
        {
            auto& commands = *this;   // this function is gone once join() asks for a component
            leaves ? join (own, other) : join (other, own);
            return commands.placeAddedNode();
        }
        if (choice->other.node != 0) return;
        constexpr float gap = 3 * Box::grid, wide = 26 * Box::grid;   // of a new node
        const auto box = own.node->bounds();
        const NodeRequest request { leaves ? box.getTopRight().translated (gap, 0.0f) : box.getTopLeft().translated (-gap - wide, 0.0f), choice->own };
        choice->type.empty() ? requestNode (request) : addNodeAt (choice->type, request);
    });
}

void CanvasCommands::exposeFromSelection()
{
    const auto nodes = selectedNodes();
    if (nodes.empty() || canvas.breadcrumbs().empty() || ! canvas.onChoose) return;
    const auto& node = *nodes.back();
    std::vector<PaletteEntry> entries;
    std::vector<PortId> ports;
    for (const auto role : { Role::input, Role::param, Role::output })
        for (const auto& p : node.face->of (role))
        {
            entries.push_back ({ node.name + '.' + p.id, {}, p.about });
            ports.push_back ({ node.id, role, p.id });
        }
    canvas.onChoose (TRANS ("Expose or hide port"), searchIn (entries), [this, entries, ports] (const std::string& chosen) {
        const auto entry = std::ranges::find (entries, chosen, &PaletteEntry::type);
        if (entry == entries.end() || canvas.breadcrumbs().empty()) return;
        const auto found = canvas.scene().findPort (ports[static_cast<std::size_t> (entry - entries.begin())]);
        if (found) perform (toggleExposed (document.graph(), canvas.patch(), found.node->name, *found.port));
    });
}

/// Wires run from left to right, so what is not wired yet gets into a row, as far as the view shows it: a hand or another source at the left.
juce::Point<float> CanvasCommands::placeFor (const std::string& type, const NodeRequest& request) const
{
    const auto below = freePlace (canvas.scene(), request.at);
    if (request.start || request.wire != 0) return below;
    const auto* sheet = canvas.types().find (type);
    const bool is_source = sheet != nullptr && sheet->inputs.empty() && ! sheet->outputs.empty();
    const auto beside = placeInRow (canvas.scene(), request.at, is_source);
    const auto window = canvas.getLocalBounds().toFloat();
    if (beside == request.at) return beside;
    if (! canvas.isFitted()) return window.contains (canvas.view().toPixels (beside)) ? beside : below;
    const auto all = canvas.scene().bounds();
    const auto wider = all.getUnion (juce::Rectangle<float> (240.0f, 96.0f).withPosition (beside));
    if (wider.getWidth() * View::readable < 0.8f * window.getWidth()) return beside;
    return freePlace (canvas.scene(), { all.getX(), request.at.y });   // the next row, because labels could not be read in a longer one
}

/// A new source of a param begins near the value that the param has. Before the wire, so that the param never gets another one.
void CanvasCommands::addValues (const SceneNode& driven, const FacePort& param, const SceneNode& source, graph::Command& joined) const
{
    const auto* node = patchShown().find (driven.name);
    if (node == nullptr || param.sheet == nullptr || param.width != 1) return;
    auto& commands = std::get<graph::Batch> (joined.edit).commands;
    for (auto& [id, value] : valuesOfSource (*source.face, paramNow (document.graph(), canvas.seen(), *node, param).value, *param.sheet))
        commands.insert (commands.begin(), graph::SetParam { canvas.patch(), source.name, id, std::move (value) });
}

/// The size of a node is known once it is there: moves it to where it covers no other one. A node that is dropped from an input ends at the pointer.
void CanvasCommands::moveClear (graph::Id made, const NodeRequest& request)
{
    const auto* node = canvas.scene().find (made);
    if (node == nullptr) return;
    auto box = node->bounds();
    const bool is_source = request.start && request.start->role != Role::output;
    if (is_source) box.setPosition ((juce::Point<float> (request.at.x - box.getWidth(), request.at.y) / Box::grid).roundToInt().toFloat() * Box::grid);
    if (const auto to = freePlace (canvas.scene(), box, made); to != node->at)
        perform (placeNodes (document.graph(), canvas.patch(), { { made, to } }), graph::Step::joined);
}

/// The node that was added last, after its first wire: moves it to where this wire is short, unless the user chose its place with the pointer and the
/// wire runs to the right.
void CanvasCommands::placeAddedNode()
{
    const auto* node = canvas.scene().find (added.node);
    if (node == nullptr || node->at != added.at) return;
    const auto index = static_cast<int> (node - canvas.scene().nodes().data());
    const auto& wires = canvas.scene().wires();
    const auto touches = [&] (const SceneWire& w) { return w.start == index || w.end == index; };
    const auto wire = std::ranges::find_if (wires, touches);
    if (std::ranges::count_if (wires, touches) != 1 || (added.is_chosen && wire->from.x < wire->to.x)) return;
    auto then = graphWithPlaces();
    if (! graph::apply (then, graph::SetNodeKey { canvas.patch(), node->name, "ui" })) return;
    const auto scene = canvas.sceneOf (then);
    const auto* moved = scene->find (added.node);
    if (moved == nullptr || moved->at == node->at) return;
    perform (placeNodes (document.graph(), canvas.patch(), { { added.node, moved->at } }), graph::Step::joined);
    canvas.bringIntoView (moved->bounds());
}

void CanvasCommands::addModulator (const std::string& node, const std::string& param, const std::string& type)
{
    const auto& nodes = canvas.scene().nodes();
    const auto driven = std::ranges::find (nodes, node, &SceneNode::name);
    if (driven == nodes.end()) return;
    if (const auto to = canvas.scene().findPort ({ driven->id, Role::param, param })) addModulatorAt (to, type, graph::Step::own);
}

void CanvasCommands::addModulatorAt (const ScenePort& to, const std::string& type, graph::Step step, double depth, bool has_more_targets)
{
    constexpr float gap = 3 * Box::grid;
    const PortId param { to.node->id, Role::param, to.port->id };
    const NodeRequest request { to.node->bounds().getTopLeft().translated (-gap, 0.0f), param, 0, true, step == graph::Step::joined, depth, has_more_targets };
    type.empty() ? requestNode (request) : addNodeAt (type, request);
}

void CanvasCommands::addNodeAt (const std::string& type, const NodeRequest& request)
{
    graph::Id made = 0;
    const auto at = placeFor (type, request);
    if (! perform (addNode (document.graph(), canvas.patch(), type, at, made), request.is_joined ? graph::Step::joined : graph::Step::own)) return;
    moveClear (made, request);
    const auto* put = canvas.scene().find (made);
    const auto pointer = canvas.getMouseXYRelative();
    added = { made, pointer, put == nullptr ? at : put->at, at == request.at && canvas.getLocalBounds().contains (pointer) };
    canvas.show (canvas.patch(), made);
    canvas.endEdit();   // undoing the edit brings back the view from before
    if (request.wire != 0)
    {
        if (auto command = insertInto (document.graph(), canvas.patch(), canvas.scene(), request.wire, made))
            perform (std::move (*command), graph::Step::joined);
        return;
    }
    const auto* node = canvas.scene().find (made);
    const auto other = request.start ? canvas.scene().findPort (*request.start) : ScenePort {};
    if (! other || node == nullptr) return;

    const bool is_output = other.port->role == Role::output;
    for (const auto& p : is_output ? node->face->inputs : node->face->outputs)
    {
        const ScenePort own { node, &p };
        const auto &from = is_output ? other : own, &to = is_output ? own : other;
        if (from.port->width != to.port->width || ! (request.modulates ? mayJoin (from, to) : checkWireByComponent (from.end(), to.end()))) continue;
        const bool has_more = is_output && (other.port->id == "position" || other.port->id == "resistance");
        const auto name = node->name;
        auto joined = connect (document.graph(), canvas.patch(), { *from.node, *from.port }, { *to.node, *to.port });
        if (request.modulates)
            modulate ({ *from.node, *from.port }, { *to.node, *to.port }, joined, request.depth);
        else if (to.port->role == Role::param)
            addValues (*to.node, *to.port, *from.node, joined);
        perform (std::move (joined), graph::Step::joined);
        if (request.modulates && ! request.has_more_targets) wireInputsOf (name);
        if (has_more)
            if (auto wires = wiring::obviousWires (document.graph(), canvas.patch(), name, canvas.types()); ! wires.commands.empty())
                perform (std::move (wires), graph::Step::joined);
        return;
    }
}

/// Wires what a new modulator reads, such as the hand, or the contact that opens the gate of an envelope. What it moves does not drive it, which would be
/// a loop.
void CanvasCommands::wireInputsOf (const std::string& name)
{
    const auto* node = patchShown().find (name);
    const auto* type = node == nullptr ? nullptr : canvas.types().find (node->type);
    if (type == nullptr) return;
    graph::Batch inputs { NEEDS_TRANS ("connect"), {} };
    wiring::wireInputs (*type, name, document.graph(), canvas.patch(), wiring::downstreamOf (patchShown(), name), canvas.types(), inputs);
    if (! inputs.commands.empty()) perform (std::move (inputs), graph::Step::joined);
}

/// A modulator that is wired to a param adds to its value and to what other modulators add. Its depth is the gain of the wire. A param that a wire sets
/// already has no such value.
void CanvasCommands::modulate (const Plug& from, const Plug& to, graph::Command& joined, double wanted) const
{
    auto& commands = std::get<graph::Batch> (joined.edit).commands;
    const auto *source = patchShown().find (from.node.name), *driven = patchShown().find (to.node.name);
    if (to.port.role != Role::param || to.port.width != 1 || to.port.sheet == nullptr || to.port.isChoice()) return;
    if (source == nullptr || driven == nullptr) return;
    const auto replaced = [&] (const graph::Command& c) -> const graph::Wire* {
        const auto* removal = std::get_if<graph::RemoveWire> (&c.edit);
        const auto& wires = patchShown().wires;
        const auto at = removal == nullptr ? wires.end() : std::ranges::find (wires, removal->wire, &graph::Wire::id);
        return at == wires.end() ? nullptr : &*at;
    };
    if (std::ranges::any_of (commands, [&] (const auto& c) { return replaced (c) != nullptr && ! replaced (c)->add; })) return;
    const auto now = paramNow (document.graph(), canvas.seen(), *driven, to.port).value;
    const auto& unit = to.port.sheet->unit;
    const auto symbol = unit.kind == UnitRule::Kind::fixed
                            ? std::string (unit.unit.symbol)
                            : unitInEffect (document.graph(), canvas.address (to.node.name + '.' + to.port.id), canvas.types());
    const auto depth = depthOf (*source, *from.node.face, from.node.quantityOf (from.port), now, *to.port.sheet, symbol, wanted);
    if (! depth) return;
    auto& wire = std::get<graph::AddWire> (commands.back().edit).wire;
    wire.add = true;
    wire.gain = *depth;
    std::erase_if (commands, [&] (const auto& c) { return replaced (c) != nullptr && replaced (c)->from != wire.from; });
    const auto from_text = graph::toText (wire.from), to_text = graph::toText (wire.to);
    canvas.hint (filled (TRANS ("%1 moves %2 around its value, by %3 for each unit. Select the wire to set this depth."), from_text, to_text,
                         gainText (*depth)));
}

void CanvasCommands::connectNew (const Plug& from, const Plug& to, graph::Step step, double depth)
{
    auto command = connect (document.graph(), canvas.patch(), from, to);
    modulate (from, to, command, depth);
    perform (std::move (command), step);
}

/// One step, also if it moves a wire. Where nothing would change, no step.
void CanvasCommands::connectInPlaceOf (graph::Id replaced, const Plug& from, const Plug& to)
{
    if (replaced == 0) return connectNew (from, to, graph::Step::own);
    const graph::RemoveWire removal { canvas.patch(), replaced };
    auto without = document.graph();
    const auto back = graph::apply (without, removal);
    const auto* was = back ? std::get_if<graph::AddWire> (&back->edit) : nullptr;
    if (was == nullptr) return;
    auto command = connect (without, canvas.patch(), from, to);
    auto& commands = std::get<graph::Batch> (command.edit).commands;
    const auto& now = std::get<graph::AddWire> (commands.back().edit).wire;
    if (commands.size() == 1 && now.from == was->wire.from && now.to == was->wire.to) return;
    commands.insert (commands.begin(), removal);
    perform (graph::Batch { NEEDS_TRANS ("re-plug wire"), std::move (commands) });
}

Result<> CanvasCommands::mayJoin (const ScenePort& from, const ScenePort& to, graph::Id replaced) const
{
    auto checked = checkWireByComponent (from.end(), to.end());
    const bool is_envelope = from.node->type == "signal.envelope";
    const bool is_modulator = from.port->role == Role::output && (from.end().quantity == Quantity::speed || is_envelope) && from.port->width == 1;
    if (checked || ! is_modulator || replaced != 0 || to.port->role != Role::param || to.port->width != 1 || to.port->isChoice()) return checked;
    for (const auto& w : patchShown().wires)
        if (! w.add && w.to.node == to.node->name && to.node->face->endOf (w.to) == to.port) return checked;
    return {};
}

juce::String CanvasCommands::eachTarget (const std::string& control, graph::Step& step,
                                         const std::function<juce::String (const PortId&, double depth)>& act)
{
    constexpr double part_of_range = 0.1;
    const auto* found = findControl (document.graph(), control);
    if (found == nullptr) return {};
    const auto set = *found;
    auto here = canvas.address ("x");   // "wood/x" in the subgraph `wood`
    if (! here.empty()) here.pop_back();
    std::optional<juce::String> why;
    for (const auto& t : set.to)
    {
        graph::Batch exposed { NEEDS_TRANS ("connect"), {} };
        const auto through = t.path.starts_with (here) ? paramThrough (document.graph(), canvas.patch(), t.path.substr (here.size()), exposed) : std::nullopt;
        if (! through) continue;
        const auto& nodes = canvas.scene().nodes();
        const auto node = std::ranges::find (nodes, through->node, &SceneNode::name);
        if (node == nodes.end()) continue;
        const PortId port { node->id, Role::param, through->param };
        if (! exposed.commands.empty() && ! perform (std::move (exposed), std::exchange (step, graph::Step::joined))) continue;
        const auto param = controlOf (document.graph(), t.path);
        const auto said = act (port, param ? part_of_range * (param->high - param->low) : 0.0);
        if (! why || said.isNotEmpty()) why = said;
    }
    return why.value_or (filled (TRANS ("%1 sets nothing in this patch"), set.name.empty() ? control : set.name));
}

/// Names all params that an output moves, if there are several.
void CanvasCommands::hintTargets (const PortId& source) const
{
    const auto from = canvas.scene().findPort (source);
    juce::StringArray targets;
    for (const auto& w : patchShown().wires)
        if (from && w.add && w.from.node == from.node->name && from.node->face->startOf (w.from) == from.port) targets.add (graph::toText (w.to));
    if (targets.size() < 2) return;
    const auto output = from.node->name + '.' + from.port->id;
    canvas.hint (filled (TRANS ("%1 moves %2 around their values. Select a wire to set its depth."), output, targets.joinIntoString (", ")));
}

void CanvasCommands::joinControl (const PortId& start, const std::string& control)
{
    auto step = graph::Step::own;
    const auto why = eachTarget (control, step, [&] (const PortId& target, double depth) -> juce::String {
        const auto from = canvas.scene().findPort (start), to = canvas.scene().findPort (target);
        if (! from || ! to) return {};
        if (const auto may = mayJoin (from, to); ! may || from.port->width != to.port->width)
            return fromUtf8 (to.node->name + '.' + to.port->id) + ": " + (may ? TRANS ("A vector cannot drive a number") : fromUtf8 (may.error().text));
        connectNew ({ *from.node, *from.port }, { *to.node, *to.port }, std::exchange (step, graph::Step::joined), depth);
        return {};
    });
    hintTargets (start);
    if (why.isNotEmpty()) canvas.notice (why);
}

void CanvasCommands::addModulatorOf (const std::string& control, const std::string& type)
{
    auto step = graph::Step::own;
    std::optional<PortId> source;   // the output of the new node
    const auto why = eachTarget (control, step, [&] (const PortId& target, double depth) -> juce::String {
        const auto from = source ? canvas.scene().findPort (*source) : ScenePort {};
        const auto to = canvas.scene().findPort (target);
        if (from && to) connectNew ({ *from.node, *from.port }, { *to.node, *to.port }, graph::Step::joined, depth);
        if (source || ! to) return {};
        addModulatorAt (to, type, std::exchange (step, graph::Step::joined), depth, ! type.empty());
        for (const auto& w : patchShown().wires)
            if (const auto* made = canvas.scene().find (added.node); made != nullptr && w.from.node == made->name)
                if (const auto* output = made->face->startOf (w.from)) source = PortId { made->id, Role::output, output->id };
        return {};
    });
    if (const auto from = source ? canvas.scene().findPort (*source) : ScenePort {}) wireInputsOf (from.node->name);
    if (source) hintTargets (*source);
    if (why.isNotEmpty()) canvas.notice (why);
}

void CanvasCommands::join (const ScenePort& from, const ScenePort& to, graph::Id replaced)
{
    if (from.port->width == to.port->width) return connectInPlaceOf (replaced, { *from.node, *from.port }, { *to.node, *to.port });
    if (! canvas.onChoose) return;
    const bool of_output = from.port->width == 3;
    const auto& vector = of_output ? from : to;
    constexpr std::array axes { ".x", ".y", ".z" };
    std::vector<PaletteEntry> entries;
    for (const auto* axis : axes)
        entries.push_back ({ vector.node->name + '.' + vector.port->id + axis,
                             {},
                             (of_output ? TRANS ("Send this component") : TRANS ("Feed this component")).toStdString() });
    const PortId out { from.node->id, Role::output, from.port->id }, in { to.node->id, to.port->role, to.port->id };
    canvas.onChoose (TRANS ("Which component?"), searchIn (entries), [this, out, in, entries, of_output, replaced] (const std::string& chosen) {
        const auto component = static_cast<int> (std::ranges::find (entries, chosen, &PaletteEntry::type) - entries.begin());
        const auto a = canvas.scene().findPort (out), b = canvas.scene().findPort (in);
        if (component >= 3 || ! a || ! b) return;
        const int of_a = of_output ? component : -1, of_b = of_output ? -1 : component;
        connectInPlaceOf (replaced, { *a.node, *a.port, of_a }, { *b.node, *b.port, of_b });
    });
}

}   // namespace tactus::host
