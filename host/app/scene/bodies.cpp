// SPDX-License-Identifier: GPL-3.0-or-later
#include "bodies.hpp"

#include <algorithm>

namespace tactus::host::scene
{

namespace
{
/// The tools that the values of the nodes come from. Each wire is followed once, whatever the number of bodies.
class Sources
{
public:
    explicit Sources (const plan::Flat& f) : flat (f), into (at (f.nodeCount())), out_of (at (f.nodeCount()))
    {
        for (std::size_t i = 0; i < flat.wires.size(); ++i)
            if (const auto& w = flat.wires[i]; w.from)
            {
                into[at (w.to.node)].push_back (&w);
                out_of[at (w.from->node)].push_back (&w);
            }
        by_any_path = spread ([] (const plan::FlatWire&) { return true; });
        by_vectors = spread ([this] (const plan::FlatWire& w) { return isVector (w); });
    }

    /// The role of the nearest tool that a node follows by any path; empty if it follows none.
    std::string roleOf (int node) const { return roleAmong (by_any_path, node); }

    /// The role of the tool whose position reaches this input by whole vectors; empty if none does.
    std::string roleAt (int node, std::string_view input) const
    {
        for (const auto* w : into[at (node)])
            if (isVector (*w) && flat.sheet (w->to).id == input)
                if (auto role = roleAmong (by_vectors, w->from->node); ! role.empty()) return role;
        return {};
    }

private:
    static constexpr int none = -1;

    /// True if the wire carries a position or another whole vector to an input.
    bool isVector (const plan::FlatWire& w) const
    {
        return w.to.role == Role::input && w.to.component < 0 && w.from->component < 0 && flat.sheet (*w.from).width == 3;
    }

    /// For each node, the nearest node with a role from which such wires lead to it.
    template <typename Follows>
    std::vector<int> spread (const Follows& follows) const
    {
        std::vector<int> source (at (flat.nodeCount()), none), reached;
        for (int i = 0; i < flat.nodeCount(); ++i)
            if (! flat.node (i).role.empty())
            {
                source[at (i)] = i;
                reached.push_back (i);
            }
        for (std::size_t i = 0; i < reached.size(); ++i)   // grows meanwhile
            for (const auto* w : out_of[at (reached[i])])
            {
                if (source[at (w->to.node)] != none || ! follows (*w)) continue;
                source[at (w->to.node)] = source[at (reached[i])];
                reached.push_back (w->to.node);
            }
        return source;
    }

    std::string roleAmong (const std::vector<int>& source, int node) const
    {
        const int from = source[at (node)];
        return from == none ? std::string {} : flat.node (from).role;
    }

    const plan::Flat& flat;
    std::vector<std::vector<const plan::FlatWire*>> into, out_of;   // by node
    std::vector<int> by_any_path, by_vectors;                       // by node: a node with a role
};

const SettingValue* settingOf (const plan::FlatNode& n, std::string_view id)
{
    for (std::size_t i = 0; i < n.type->settings.size() && i < n.settings.size(); ++i)
        if (n.type->settings[i].id == id) return &n.settings[i];
    return nullptr;
}

Relief reliefOf (const plan::FlatNode& n, std::string_view id)
{
    Relief r;
    const auto sheet = std::ranges::find (n.type->settings, id, &SettingSheet::id);
    const auto* value = settingOf (n, id);
    const auto* fields = value != nullptr ? std::get_if<Values> (value) : nullptr;
    if (fields == nullptr) return r;
    double height = 0.0;
    for (std::size_t i = 0; i < fields->size() && i < sheet->fields.size(); ++i)
    {
        const auto& field = (*fields)[i];
        if (const auto* image = std::get_if<Image> (&field); image != nullptr && image->grid)
        {
            r.grid = image->grid;
            r.is_picture = true;
        }
        if (const auto* table = std::get_if<Sheet> (&field); table != nullptr && table->grid && ! r.grid) r.grid = table->grid;
        if (const auto* number = std::get_if<double> (&field))
        {
            if (sheet->fields[i].id == "pitch") r.pitch = *number;
            if (sheet->fields[i].id == "height") height = *number;
        }
    }
    const double usual = r.is_picture ? 1e-4 : 1.0;   // as texture.height_map
    r.height = height == 0.0 ? usual : height;
    return r;
}

std::optional<Vec3> fixedValue (const plan::Flat& flat, int number, std::string_view row)
{
    const auto& n = flat.node (number);
    for (std::size_t p = 0; p < n.type->params.size(); ++p)
        if (n.type->params[p].id == row)
        {
            const auto v = flat.param (number, p);
            return v.size() >= 3 ? Vec3 (v[0], v[1], v[2]) : Vec3 (v.empty() ? 0.0 : v[0], 0.0, 0.0);
        }
    const auto* value = settingOf (n, row);
    if (value == nullptr) return std::nullopt;
    if (const auto* one = std::get_if<double> (value)) return Vec3 (*one, 0.0, 0.0);
    if (const auto* v = std::get_if<Vec3> (value)) return *v;
    return std::nullopt;
}

bool isPort (const NodeType& type, std::string_view row)
{
    const auto has = [&] (const std::vector<PortSheet>& rows) { return std::ranges::find (rows, row, &PortSheet::id) != rows.end(); };
    return has (type.inputs) || has (type.outputs);
}

Body bodyOf (const plan::Flat& flat, int number, const Sources& sources)
{
    const auto& n = flat.node (number);
    const auto& looks = *n.type->appearance;
    Body body { .kind = looks.kind, .path = n.path };
    if (! looks.tool.empty()) body.role = sources.roleAt (number, looks.tool);
    body.is_placed = ! body.role.empty();
    if (body.role.empty()) body.role = sources.roleOf (number);
    for (std::size_t i = 0; i < appearance_parts.size(); ++i)
    {
        const auto row = looks.*appearance_parts[i].row;
        if (row.empty()) continue;
        if (isPort (*n.type, row)) body.ports[i] = n.path + '.' + std::string (row);
        body.fixed[i] = fixedValue (flat, number, row);
    }
    if (const auto* value = settingOf (n, looks.surface))
        if (const auto* surface = std::get_if<std::shared_ptr<const Surface>> (value)) body.surface = *surface;
    if (const auto* value = settingOf (n, looks.radius))
        if (const auto* radii = std::get_if<std::vector<double>> (value)) body.radii = *radii;
    if (! looks.map.empty()) body.relief = reliefOf (n, looks.map);
    return body;
}
}   // namespace

std::vector<Body> bodiesOf (const Plan& plan)
{
    const auto& flat = plan.flat();
    const Sources sources (flat);
    std::vector<Body> bodies;
    for (int i = 0; i < flat.nodeCount(); ++i)
        if (const auto& n = flat.node (i); n.runs() && n.type->appearance) bodies.push_back (bodyOf (flat, i, sources));
    return bodies;
}

std::vector<std::string> portsOf (const std::vector<Body>& bodies, std::size_t most)
{
    constexpr auto number = [] (std::string_view Appearance::*row) { return partNumber (row); };
    constexpr std::array order { number (&Appearance::depth), number (&Appearance::crack), number (&Appearance::angle), number (&Appearance::touch),
                                 number (&Appearance::stretch), number (&Appearance::tool), number (&Appearance::rotation), number (&Appearance::normal),
                                 number (&Appearance::choice) };
    std::vector<std::string> wanted;
    std::size_t components = 0;
    for (const auto part : order)
        for (const auto& body : bodies)
        {
            if (body.ports[part].empty()) continue;
            const bool is_texture = body.kind == Appearance::Kind::ridges || body.kind == Appearance::Kind::relief;
            const bool is_solid = body.kind == Appearance::Kind::body, is_round = is_solid && ! body.radii.empty();
            if (part == number (&Appearance::tool) && ! (is_texture && body.is_placed) && ! is_round) continue;   // all others are where the tool is
            if (part == number (&Appearance::normal) && body.kind != Appearance::Kind::contact && ! is_solid) continue;
            if (part == number (&Appearance::choice) && body.radii.size() < 2) continue;
            if (components + appearance_parts[part].width > most) continue;
            components += appearance_parts[part].width;
            wanted.push_back (body.ports[part]);
        }
    return wanted;
}

std::vector<PartValues> liveOf (const std::vector<Body>& bodies, const std::function<std::optional<double> (const std::string&)>& valueOf)
{
    std::vector<PartValues> all;
    for (const auto& body : bodies)
    {
        auto& live = all.emplace_back();
        for (std::size_t part = 0; part < body.ports.size(); ++part)
        {
            if (body.ports[part].empty()) continue;
            const bool is_vector = isVector (part);
            const auto component = [&] (const char* which) { return valueOf (body.ports[part] + which); };
            const auto x = component (is_vector ? ".x" : ""), y = is_vector ? component (".y") : 0.0, z = is_vector ? component (".z") : 0.0;
            if (x && y && z && isFinite (Vec3 (*x, *y, *z))) live[part] = Vec3 (*x, *y, *z);
        }
    }
    return all;
}

}   // namespace tactus::host::scene
