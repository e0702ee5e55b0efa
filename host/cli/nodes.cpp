// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "report.hpp"
#include "run_options.hpp"

#include <tactus/node/catalogue.hpp>
#include <tactus/node/claims_passive.hpp>
#include <tactus/node/datasheet_json.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <sstream>

namespace tactus::host
{

namespace
{
std::string initialText (const PortSheet& p)
{
    if (! p.choices.empty()) return std::string (p.choices[static_cast<std::size_t> (p.initial[0])]);
    if (p.initial[0] != p.initial[0]) return "unwired";
    if (p.width == 1) return numberText (p.initial[0]);
    return "(" + numberText (p.initial[0]) + ", " + numberText (p.initial[1]) + ", " + numberText (p.initial[2]) + ")";
}

std::string initialText (const SettingValue& v)
{
    if (const auto* number = std::get_if<double> (&v)) return numberText (*number);
    if (const auto* p = std::get_if<Vec3> (&v)) return "(" + numberText (p->x()) + ", " + numberText (p->y()) + ", " + numberText (p->z()) + ")";
    return "";
}

std::string rangeText (const Interval& i)
{
    if (i == Interval {}) return "";
    if (i.max == inf) return "from " + numberText (i.min);
    if (i.min == -inf) return "up to " + numberText (i.max);
    return numberText (i.min) + " … " + numberText (i.max);
}

/// Prints a table whose columns are as wide as their widest cell; the last column is not padded.
void print (const std::vector<std::vector<std::string>>& rows)
{
    std::vector<std::size_t> width;
    const auto letters = [] (const std::string& s) { return static_cast<std::size_t> (std::ranges::count_if (s, [] (char c) { return (c & 0xc0) != 0x80; })); };
    for (const auto& row : rows)
    {
        width.resize (std::max (width.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            width[i] = std::max (width[i], letters (row[i]));
    }
    for (const auto& row : rows)
    {
        std::cout << "  ";
        for (std::size_t i = 0; i < row.size(); ++i)
            std::cout << printable (row[i]) << (i + 1 < row.size() ? std::string (width[i] - letters (row[i]) + 2, ' ') : "\n");
    }
}

void printDatasheet (const NodeType& t)
{
    // A plugin wrote these texts.
    std::cout << t.info.id << ": " << printable (t.info.name) << "\n"
              << printable (t.info.summary) << "\nSource: " << printable (t.info.source) << "\n";
    if (! t.origin.empty()) std::cout << "Plugin: " << printableName (t.origin) << "\n";
    if (claimsPassive (t)) std::cout << "Passive: it generates no energy over any closed path (claimed for its default params)\n";

    const auto section = [] (const char* title, const std::vector<PortSheet>& ports, bool with_default) {
        if (ports.empty()) return;
        std::cout << '\n'
                  << title << '\n';
        std::vector<std::vector<std::string>> rows;
        for (const auto& p : ports)
        {
            std::string about (p.about);
            if (! p.choices.empty())
            {
                about += "; one of";
                for (const auto c : p.choices)
                    about += (c == p.choices.front() ? " " : ", ") + std::string (c);
            }
            if (const auto usual = rangeText (p.limits.usual); ! usual.empty()) about += "; usually " + usual;
            if (! (p.limits.hard == p.limits.usual) && ! rangeText (p.limits.hard).empty()) about += "; only " + rangeText (p.limits.hard);
            if (p.limits.latch) about += "; latched at onset";
            const auto shape = std::string (p.list ? "[…]" : "") + (p.width == 3 ? " (x, y, z)" : "");
            rows.push_back ({ std::string (p.id) + shape, p.choices.empty() ? unitText (p.unit) : "choice" });
            if (with_default) rows.back().push_back (initialText (p));
            rows.back().push_back (about);
        }
        print (rows);
    };
    section ("inputs", t.inputs, true);
    section ("params", t.params, true);
    if (! t.settings.empty())
    {
        std::cout << "\nsettings\n";
        std::vector<std::vector<std::string>> rows;
        for (const auto& s : t.settings)
        {
            std::string about (s.about);
            const auto* lead = s.kind == SettingSheet::Kind::record ? "; with " : "; each with ";
            for (const auto& f : s.fields)
            {
                const auto kind = f.kind == SettingSheet::Kind::number ? unitText (f.unit) : std::string (name (f.kind));
                about += (&f == &s.fields.front() ? lead : ", ") + std::string (f.id) + " (" + kind + ")";
            }
            if (const auto hard = rangeText (s.limits.hard); ! hard.empty()) about += "; only " + hard;
            const bool has_unit = s.kind == SettingSheet::Kind::number || s.kind == SettingSheet::Kind::vector;
            const auto unit = has_unit && unitText (s.unit) != "1" ? ", " + unitText (s.unit) : "";
            rows.push_back ({ std::string (s.id), std::string (name (s.kind)) + unit, initialText (s.initial), about });
        }
        print (rows);
        std::cout << "  For how to write each kind, see docs/graph_file.md, Settings\n";
    }
    section ("outputs", t.outputs, false);
}

std::string familyOf (const NodeType& t) { return std::string (t.info.id.substr (0, t.info.id.find ('.'))); }

std::vector<std::string> wordsOf (std::string_view text)
{
    std::istringstream words { std::string (text) };
    return { std::istream_iterator<std::string> (words), {} };
}

/// Lists node types by family.
void list (const std::function<bool (const NodeType&)>& isWanted)
{
    std::string family;
    std::vector<std::vector<std::string>> rows;
    const auto flush = [&] {
        if (! rows.empty()) std::cout << family << '\n';
        print (rows);
        rows.clear();
    };
    for (const auto& t : catalogue())
    {
        const std::string id (t.info.id), its_family = familyOf (t);
        if (! isWanted (t)) continue;
        if (its_family != family)
        {
            flush();
            family = its_family;
        }
        const auto from = t.origin.empty() ? "" : " (plugin " + printableName (std::filesystem::path (t.origin).filename().string()) + ")";
        rows.push_back ({ id, std::string (t.info.summary) + from });
    }
    flush();
}

void run (const std::string& wanted, bool json)
{
    const auto* type = catalogue().find (wanted);
    const auto isInFamily = [&] (const NodeType& t) { return wanted.empty() || familyOf (t) == wanted; };
    const auto hasKeyword = [&] (const NodeType& t) {
        return std::ranges::count (wordsOf (t.info.keywords), wanted) > 0 || t.info.id.ends_with ('.' + wanted);
    };
    for (const auto& isWanted : { std::function<bool (const NodeType&)> (isInFamily), std::function<bool (const NodeType&)> (hasKeyword) })
    {
        if (type != nullptr || std::ranges::none_of (catalogue(), isWanted)) continue;
        if (! json) return list (isWanted);
        Json all = Json::array();
        for (const auto& t : catalogue())
            if (isWanted (t)) all.push_back (datasheetJson (t));
        std::cout << all.dump (2) << '\n';
        return;
    }
    if (type == nullptr)
    {
        std::vector<std::string> known;
        for (const auto& t : catalogue())
        {
            known.emplace_back (t.info.id);
            known.push_back (familyOf (t));
            std::ranges::copy (wordsOf (t.info.keywords), std::back_inserter (known));
        }
        fail ("node/unknown_type", "there is no node type, family or keyword " + quote (wanted) + didYouMean (wanted, known), "`tactus nodes` lists them all");
    }
    if (json)
        std::cout << datasheetJson (*type).dump (2) << '\n';
    else
        printDatasheet (*type);
}
}   // namespace

void addNodes (const Command& app)
{
    struct Options
    {
        std::string type;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    const auto command = app.add ("nodes", "List the node types of all families or of one, or show the datasheet of a type");
    command.addOption ("type", options->type, "A family (friction), the id of a node type (friction.elasto_plastic), or a word to search for (sine)");
    command.addFlag ("--json", options->json, "Print JSON, for use by programs");
    addPlugins (command);
    command.footer ("Examples:\n"
                    "  tactus nodes\n"
                    "  tactus nodes friction\n"
                    "  tactus nodes deform.plane\n"
                    "  tactus nodes --json | jq '.[].id'");
    command.callback ([options] { run (options->type, options->json); });
}

}   // namespace tactus::host
