// SPDX-License-Identifier: MIT
#include "varied.hpp"
#include "refusal.hpp"

#include <host/base/command_line/command.hpp>
#include <tactus/check/stretches.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <optional>
#include <string_view>

namespace tactus::host
{

Varied readVaried (const std::string& option, const std::string& text, const Plan& plan, std::vector<std::string>& params)
{
    const auto equals = text.find ('='), colon = text.find (':', equals == text.npos ? 0 : equals);
    Varied v { .name = text.substr (0, equals) };
    const auto number = [&] (std::size_t from, std::size_t to) { return wholeNumber (std::string_view (text).substr (from, to - from)); };
    const auto from = colon == text.npos || equals == text.npos ? std::nullopt : number (equals + 1, colon),
               to = from ? number (colon + 1, text.size()) : std::nullopt;
    if (! from || ! to || ! (*from < *to))
        throw UsageError (option,
                          quote (text) + " is not a range in SI units, such as stiffness=0:5000, damping=0:20, rate=500:8000 or wall.stiffness=100:5000");
    v.from = *from;
    v.to = *to;
    const auto isNatural = [&] (Varied::What what, const char* unit, double least) {
        v.what = what;
        v.unit = unit;
        if (! (v.from >= least && v.to <= 1e9)) throw UsageError (option, quote (text) + " must be between " + numberText (least) + " and 1e9 " + unit);
        return v;
    };
    if (v.name == "stiffness") return isNatural (Varied::What::stiffness, "N/m", 0.0);
    if (v.name == "damping") return isNatural (Varied::What::damping, "N*s/m", 0.0);
    if (v.name == "rate")
    {
        if (v.to > 1e5) throw UsageError (option, "the rate must be at most 1e5 Hz");
        return isNatural (Varied::What::rate, "Hz", 10.0);
    }

    v.what = Varied::What::param;
    const auto dot = v.name.rfind ('.');
    const auto path = v.name.substr (0, dot), id = dot == v.name.npos ? std::string() : v.name.substr (dot + 1);
    const auto& nodes = plan.flat().nodes;
    const auto node = std::ranges::find (nodes, path, &plan::FlatNode::path);
    if (node == nodes.end())
    {
        std::vector<std::string> paths { "stiffness", "damping", "rate" };
        for (const auto& n : nodes)
            paths.push_back (n.path);
        refuse (Message::error ("limits/axis", option + " " + text, "the graph has no node " + quote (path) + didYouMean (path, paths),
                                "name stiffness, damping, rate or NODE.PARAM of a node of the graph"));
    }
    const auto row = std::ranges::find (node->type->params, id, &PortSheet::id);
    if (row == node->type->params.end() || row->width != 1)
    {
        std::vector<std::string> ids;
        for (const auto& p : node->type->params)
            if (p.width == 1) ids.emplace_back (p.id);
        refuse (Message::error ("limits/axis", option + " " + text, quote (path) + " has no param " + quote (id) + " that is a number" + didYouMean (id, ids),
                                "`tactus nodes " + std::string (node->type->info.id) + "` lists them"));
    }
    v.unit = row->unit.kind == UnitRule::Kind::fixed ? std::string (row->unit.unit.symbol) : "";
    v.now = check::valueInFile (plan, static_cast<std::size_t> (node - nodes.begin()), id, 0.0);
    v.param = params.size();
    params.push_back (v.name);
    return v;
}

}   // namespace tactus::host
