// SPDX-License-Identifier: MIT
#include "edit_check.hpp"

#include <algorithm>
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

std::vector<std::string> placesOf (const Command& command)
{
    std::vector<std::string> places;
    std::visit (Written { places }, command.edit);
    return places;
}

const Message* firstAdded (const std::vector<Problem>& before, const std::vector<Problem>& after, const Command& command)
{
    const auto written = placesOf (command);
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
