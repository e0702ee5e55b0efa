// SPDX-License-Identifier: MIT
#include "known.hpp"
#include "plugin_node.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <bit>
#include <set>
#include <utility>
#include <vector>

namespace tactus::plugin
{

namespace
{
/// [a-z][a-z0-9_]*
bool isName (std::string_view s)
{
    const auto isLetter = [] (char c) { return c >= 'a' && c <= 'z'; };
    return ! s.empty() && isLetter (s.front()) && std::ranges::all_of (s, [&] (char c) { return isLetter (c) || (c >= '0' && c <= '9') || c == '_'; });
}

bool isEmpty (const char* text) noexcept { return text == nullptr || *text == 0; }

bool isQuantity (std::string_view text) noexcept
{
    for (int q = 0; q <= static_cast<int> (Quantity::state); ++q)
        if (name (static_cast<Quantity> (q)) == text) return true;
    return false;
}

std::string faultOf (const tactus_plugin_unit* u, const std::set<std::string_view>& ports)
{
    if (! isWhole (u)) return "a unit is missing or has the wrong size";
    if (u->rule < TACTUS_PLUGIN_UNIT_FIXED || u->rule > TACTUS_PLUGIN_UNIT_PRODUCT) return "a unit has the unknown rule " + std::to_string (u->rule);
    if (u->quantity == nullptr || ! isQuantity (u->quantity)) return "a unit has an unknown quantity";
    if (u->symbol == nullptr || u->a == nullptr || u->b == nullptr) return "a unit lacks its symbol or the names of its ports";
    for (const int e : { u->metre, u->kilogram, u->second })
        if (e < -100 || e > 100) return "a unit has the exponent " + std::to_string (e);
    if (u->rule < TACTUS_PLUGIN_UNIT_SAME) return {};
    for (const auto* port : { u->a, u->b })
        if (*port != 0 && ! ports.contains (port)) return "its unit follows the port " + quote (port) + ", which does not exist";
    return isEmpty (u->a) ? "its unit follows a port, but names none" : "";
}

std::string faultOf (const tactus_plugin_limits* l)
{
    if (! isWhole (l)) return "its limits are missing or have the wrong size";
    return l->hard_min <= l->hard_max && l->usual_min <= l->usual_max ? "" : "the lower end of a range is above its upper end";
}

std::string faultOf (const tactus_plugin_value* v, int kind)
{
    if (! isWhole (v)) return "its default is missing or has the wrong size";
    const bool fits = v->kind == kind || (v->kind == TACTUS_PLUGIN_NUMBER && kind == TACTUS_PLUGIN_INTEGER);
    return fits ? "" : "its default is of a different kind";
}

std::string faultOf (const tactus_plugin_setting* s, const std::set<std::string_view>& ports)
{
    if (! isWhole (s)) return "a setting is missing or has the wrong size";
    if (s->kind < TACTUS_PLUGIN_NUMBER || s->kind > TACTUS_PLUGIN_SURFACE) return "it has the unknown kind " + std::to_string (s->kind);
    if (isEmpty (s->about)) return "it has no description";
    for (auto why : { faultOf (s->unit, ports), faultOf (s->x_unit, ports), faultOf (s->limits), faultOf (s->initial, s->kind) })
        if (! why.empty()) return why;
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < s->field_count; ++i)
    {
        const auto* field = s->fields[i];
        if (! isWhole (field) || field->id == nullptr || ! isName (field->id)) return "a field has the wrong size, or a name that is not valid";
        if (! names.insert (field->id).second) return "it has two fields " + quote (field->id);
        if (auto why = faultOf (field, ports); ! why.empty()) return "field " + quote (field->id) + ": " + why;
    }
    if (s->kind == TACTUS_PLUGIN_RECORD && s->initial->count != s->field_count) return "its default has a different number of fields";
    return {};
}

/// The bytes that a port occupies in its struct; `end` is not included.
struct Place
{
    std::size_t begin, end;

    bool operator<(const Place& other) const noexcept { return begin < other.begin; }
};

/// Checks that the rows of one role lie within their struct, without overlap.
class Room
{
public:
    explicit Room (std::size_t s) noexcept : size (s) {}

    std::string take (const tactus_plugin_port& p)
    {
        const std::size_t entry = p.choice_count > 0 ? sizeof (std::int32_t) : sizeof (double);
        const std::size_t bytes = entry * (p.is_list != 0 ? std::size_t { TACTUS_PLUGIN_LIST_CAPACITY } : 1) * static_cast<std::size_t> (p.width);
        if (p.offset % entry != 0) return "its offset is not a multiple of " + std::to_string (entry);
        if (bytes > size || p.offset > size - bytes) return "it lies outside of its struct of " + std::to_string (size) + " bytes";
        const Place place { p.offset, p.offset + bytes };
        for (const auto& other : taken)
            if (place.begin < other.end && other.begin < place.end) return "it overlaps another row";
        taken.push_back (place);
        return {};
    }

private:
    std::size_t size;
    std::vector<Place> taken;
};

class NodeCheck
{
public:
    explicit NodeCheck (const tactus_plugin_node& n) : node (n), params (n.params_size), outputs (n.outputs_size) { copyKnown (known, &n); }

    std::string fault()
    {
        using Check = NodeCheck;
        for (auto step : { &Check::head, &Check::hooks, &Check::collectPorts, &Check::checkPorts, &Check::checkSettings, &Check::appearance })
            if (auto why = (this->*step)(); ! why.empty()) return why;
        return {};
    }

private:
    std::string head()
    {
        const std::string_view id = node.id != nullptr ? node.id : "";
        const auto dot = id.find ('.');
        if (dot == std::string_view::npos || ! isName (id.substr (0, dot)) || ! isName (id.substr (dot + 1)))
            return "its id must be family.name, with lower-case letters, digits and _";
        if (isEmpty (node.name) || isEmpty (node.summary) || isEmpty (node.source)) return "it lacks a name, a summary or a source";
        if (node.outputs_align == 0 || ! std::has_single_bit (node.outputs_align) || node.outputs_align > alignof (std::max_align_t))
            return "its outputs have the alignment " + std::to_string (node.outputs_align);
        return {};
    }

    std::string hooks()
    {
        const std::pair<const char*, bool> needed[] { { "create", node.create != nullptr },
                                                      { "destroy", node.destroy != nullptr },
                                                      { "set", node.set != nullptr },
                                                      { "params", node.params != nullptr },
                                                      { "initialise_outputs", node.initialise_outputs != nullptr },
                                                      { "tick", node.tick != nullptr } };
        for (const auto& [name, is_there] : needed)
            if (! is_there) return "it lacks the function " + quote (name) + ", which every node has";
        if ((node.announce == nullptr) != (node.bind == nullptr))
            return "it has " + std::string (node.announce != nullptr ? "announce, but no bind" : "bind, but no announce");
        if ((known.save == nullptr) != (known.restore == nullptr))
            return "it has " + std::string (known.save ? "save, but no restore" : "restore, but no save");
        if (node.announce == nullptr && (node.missing || node.effort))
            return "it has " + std::string (node.missing != nullptr ? "missing" : "effort") + ", but no bind";
        return {};
    }

    std::string collectPorts()
    {
        for (std::size_t i = 0; i < node.port_count; ++i)
        {
            const auto* p = node.ports[i];
            if (! isWhole (p)) return "row " + std::to_string (i + 1) + " of its ports is missing or has the wrong size";
            if (p->id == nullptr || ! isName (p->id)) return "row " + std::to_string (i + 1) + " of its ports has no valid name";
            auto& names = p->role == TACTUS_PLUGIN_OUTPUT ? out_names : in_names;
            if (! names.insert (p->id).second) return "it has two ports " + quote (p->id);
            all_names.insert (p->id);
            has_list = has_list || p->is_list != 0;
        }
        return {};
    }

    std::string checkPorts()
    {
        for (std::size_t i = 0; i < node.port_count; ++i)
            if (auto why = portFault (*node.ports[i]); ! why.empty()) return quote (node.ports[i]->id) + ": " + why;
        return {};
    }

    std::string portFault (const tactus_plugin_port& p)
    {
        if (p.role != TACTUS_PLUGIN_INPUT && p.role != TACTUS_PLUGIN_PARAM && p.role != TACTUS_PLUGIN_OUTPUT)
            return "it has the unknown role " + std::to_string (p.role);
        if (isEmpty (p.about)) return "it has no description";
        if (p.width != 1 && p.width != 3) return "it has " + std::to_string (p.width) + " components; there are 1 or 3";
        if (p.is_list != 0 && p.width != 1 && p.role != TACTUS_PLUGIN_INPUT) return "only inputs may be lists of vectors";
        for (auto why : { faultOf (p.unit, all_names), faultOf (p.limits) })
            if (! why.empty()) return why;
        if (p.choice_count > 0 && p.role != TACTUS_PLUGIN_PARAM) return "only a param may be a choice";
        for (std::size_t c = 0; c < p.choice_count; ++c)
            if (isEmpty (p.choices[c])) return "an alternative has no name";
        if (p.choice_count > 0 && ! (p.initial[0] >= 0.0 && p.initial[0] < static_cast<double> (p.choice_count)))
            return "its default is not one of the alternatives";
        if (p.role == TACTUS_PLUGIN_PARAM) return params.take (p);
        return p.role == TACTUS_PLUGIN_OUTPUT ? outputs.take (p) : std::string {};
    }

    std::string checkSettings()
    {
        bool has_length = false;
        for (std::size_t i = 0; i < node.setting_count; ++i)
        {
            const auto* s = node.settings[i];
            if (! isWhole (s) || s->id == nullptr || ! isName (s->id))
                return "row " + std::to_string (i + 1) + " of its settings has the wrong size, or a name that is not valid";
            if (! in_names.insert (s->id).second) return "it has two rows " + quote (s->id);
            if (auto why = faultOf (s, all_names); ! why.empty()) return quote (s->id) + ": " + why;
            const auto& range = *s->limits;
            if (std::string_view (s->id) == "inputs")
                has_length = s->kind == TACTUS_PLUGIN_INTEGER && range.hard_min >= 1.0 && range.hard_max <= TACTUS_PLUGIN_LIST_CAPACITY;
        }
        return has_list && ! has_length ? "it has a list, and so needs a whole number `inputs` from 1 to 64 among its settings" : "";
    }

    /// An unknown kind or part is fine: a later version may know it.
    std::string appearance()
    {
        const auto* a = known.appearance;
        if (a == nullptr) return {};
        if (! isWhole (a) || a->kind == nullptr || (a->part_count > 0 && (a->parts == nullptr || a->rows == nullptr)))
            return "its appearance has the wrong size, or lacks its kind, parts or rows";
        for (std::size_t i = 0; i < a->part_count; ++i)
        {
            if (isEmpty (a->parts[i]) || isEmpty (a->rows[i])) return "a part of its appearance has no name or no row";
            if (! in_names.contains (a->rows[i]) && ! out_names.contains (a->rows[i]))
                return quote (a->parts[i]) + " of its appearance is the row " + quote (a->rows[i]) + ", which does not exist";
        }
        return {};
    }

    const tactus_plugin_node& node;
    tactus_plugin_node known {};   // with the members of later versions
    Room params, outputs;
    std::set<std::string_view> in_names, out_names, all_names;
    bool has_list = false;
};
}   // namespace

std::string faultOf (const tactus_plugin_node* given)
{
    if (! isWhole (given)) return "its description is missing or has the wrong size";
    return NodeCheck { *given }.fault();
}

}   // namespace tactus::plugin
