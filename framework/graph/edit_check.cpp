// SPDX-License-Identifier: MIT
#include "edit_check.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace tactus::graph
{

namespace
{
/// Notes the places that an edit writes itself.
struct Written
{
    std::vector<std::string>& places;

    static std::string in (const std::string& patch) { return patch.empty() ? "" : "/graphs/" + patch; }
    void add (const std::string& patch, const std::string& place) const { places.push_back (in (patch) + place); }

    void operator() (const AddNode& c) const { add (c.patch, "/nodes/" + c.node.name); }
    void operator() (const SetParam& c) const { add (c.patch, "/nodes/" + c.node + "/params/" + c.param); }
    void operator() (const SetSetting& c) const { add (c.patch, "/nodes/" + c.node + "/settings/" + c.setting); }
    void operator() (const SetOverride& c) const { add (c.patch, "/nodes/" + c.node + "/overrides"); }
    void operator() (const SetNodeKey& c) const { add (c.patch, "/nodes/" + c.node + '/' + c.key); }
    void operator() (const AddWire& c) const { add (c.patch, "/wires/" + std::to_string (c.wire.id)); }
    void operator() (const ChangeWire& c) const { add (c.patch, "/wires/" + std::to_string (c.wire)); }
    void operator() (const RemoveNode& c) const { add (c.patch, "/nodes/" + c.name); }
    void operator() (const RenameNode& c) const { add (c.patch, "/nodes/" + c.name); }
    void operator() (const ExpandNode& c) const { add (c.patch, "/nodes/" + c.name); }
    void operator() (const CollapseNodes& c) const { add (c.patch, "/nodes/" + c.name); }
    void operator() (const RemoveSubgraph& c) const { add (c.name, ""); }
    void operator() (const RenameSubgraph& c) const { add (c.name, ""); }
    void operator() (const RemoveControl& c) const { add ("", "/controls/" + c.control); }
    void operator() (const SetDevice& c) const { add ("", "/devices/" + c.role); }
    void operator() (const AddControl& c) const { add ("", "/controls/" + c.control.id); }
    void operator() (const ChangeControl& c) const { add ("", "/controls/" + c.to.id); }
    void operator() (const AddSubgraph& c) const { add (c.name, ""); }
    void operator() (const ChangeExpose& c) const { add (c.patch, "/expose"); }
    void operator() (const SetHeader& c) const { add (c.patch, "/rate_hz"); }
    void operator() (const Batch& c) const
    {
        for (const auto& command : c.commands)
            std::visit (*this, command.edit);
    }

    template <typename Other>
    void operator() (const Other&) const
    {
    }
};

bool isWithin (std::string_view place, std::string_view outer)
{
    return place.starts_with (outer) && (place.size() == outer.size() || place[outer.size()] == '/' || outer.ends_with ('/'));
}
}   // namespace

bool mayAddError (const Command& command)
{
    constexpr std::array ruled { "type", "role", "roles", "bypass", "overrides", "count", "every", "times", "hold" };
    if (const auto* c = std::get_if<SetNodeKey> (&command.edit)) return std::ranges::count (ruled, c->key) > 0;
    if (const auto* c = std::get_if<SetHeader> (&command.edit)) return c->rate_hz.has_value();
    if (const auto* c = std::get_if<Batch> (&command.edit)) return std::ranges::any_of (c->commands, mayAddError);
    return ! (std::holds_alternative<RenameNode> (command.edit) || std::holds_alternative<RenameSubgraph> (command.edit)
              || std::holds_alternative<RemoveControl> (command.edit) || std::holds_alternative<SetDevice> (command.edit)
              || std::holds_alternative<ReplaceGraph> (command.edit));
}

std::string placeOf (const Command& command)
{
    std::vector<std::string> places;
    std::visit (Written { places }, command.edit);
    return places.empty() ? std::string() : places.front();
}

const Message* firstAdded (const std::vector<Problem>& before, const std::vector<Problem>& after, std::span<const Command> commands)
{
    std::vector<std::string> written;
    for (const auto& command : commands)
        std::visit (Written { written }, command.edit);
    const auto isOld = [&] (const Problem& p) {
        const bool is_own = std::ranges::any_of (written, [&] (const auto& place) { return isWithin (p.place, place); });
        return std::ranges::any_of (before, [&] (const Problem& b) {
            return b.place == p.place && (! is_own || (b.message.id == p.message.id && b.message.text == p.message.text));
        });
    };
    const auto added = std::ranges::find_if_not (after, isOld);
    return added == after.end() ? nullptr : &added->message;
}

}   // namespace tactus::graph
