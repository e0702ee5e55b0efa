// SPDX-License-Identifier: MIT
#include "plugin_node.hpp"
#include "answer.hpp"
#include "hook_turn.hpp"
#include "known.hpp"
#include "lending.hpp"
#include "setting_values.hpp"

#include <tactus/kit/opaque_state.hpp>
#include <tactus/node/node_fault.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <deque>
#include <unordered_map>

namespace tactus::plugin
{

namespace
{
/// The data that the functions of a NodeType share. The type and each of its nodes keep it alive, and so keep the plugin loaded.
struct Guest
{
    std::shared_ptr<const void> library;
    std::string file;
    std::uint32_t build;   // tells builds of the plugin apart: only the same one knows what its bytes mean
    tactus_plugin_node hooks {};
    std::deque<std::vector<std::string_view>> choices {};

    [[noreturn]] void failed (const char* hook, const Answer& why) const
    {
        throw NodeFault ("the node '" + std::string (hooks.id) + "' of the plugin " + quotePath (file) + " failed in `" + hook + "`: " + quote (why.text()));
    }

    /// Calls a hook that can fail, and returns the text that it reports.
    template <typename Hook>
    std::string ask (const char* name, Hook&& hook) const
    {
        const Answer answer;
        const auto turn = hookTurn();
        if (hook (answer.report()) != TACTUS_PLUGIN_OK) failed (name, answer);
        return answer.text();
    }
};

/// NodeType::serialize gets no context, and the node is the plugin's own: this table knows whose it is. [with hookTurn]
std::unordered_map<const void*, const Guest*>& guests()
{
    static std::unordered_map<const void*, const Guest*> all;
    return all;
}

void serialize (void* node, StateArchive& archive)
{
    const Answer saved, why;
    const auto turn = hookTurn();
    const auto& g = *guests().at (node);
    std::uint32_t build = g.build;
    archive (build);
    if (build != g.build) return archive.refuse ("comes from another build of the plugin " + quotePath (g.file));
    if (! archive.restores() && (g.hooks.save (node, saved.report()) != TACTUS_PLUGIN_OK || ! saved.isWhole()))
        return archive.refuse ("cannot save its state: " + quote (saved.text()));
    const auto bytes = opaqueState (archive, saved.text());
    if (! archive.restores() || archive.isRefused()) return;
    if (g.hooks.restore (node, bytes.data(), bytes.size(), why.report()) != TACTUS_PLUGIN_OK)
        archive.refuse ("does not take its state: " + quote (why.text()));
}

/// NodeType::make.
struct MakeNode
{
    std::shared_ptr<const Guest> guest;

    std::shared_ptr<void> operator()() const
    {
        const Answer why;
        void* node = nullptr;
        {
            const auto turn = hookTurn();
            node = guest->hooks.create (why.report());
            if (node != nullptr) guests()[node] = guest.get();
        }
        if (node == nullptr) guest->failed ("create", why);
        return std::shared_ptr<void> (node, [g = guest] (void* n) {
            const auto turn = hookTurn();
            guests().erase (n);
            g->hooks.destroy (n);
        });
    }
};

UnitRule readUnit (const tactus_plugin_unit& u)
{
    Unit unit;
    for (int q = 0; q <= static_cast<int> (Quantity::state); ++q)
        if (name (static_cast<Quantity> (q)) == u.quantity) unit.quantity = static_cast<Quantity> (q);
    unit.dimension = { exponent (u.metre), exponent (u.kilogram), exponent (u.second) };
    unit.symbol = u.symbol;
    return { static_cast<UnitRule::Kind> (u.rule), unit, u.a, u.b, u.adds_up != 0 };
}

Limits readLimits (const tactus_plugin_limits& l)
{
    return { .hard = { l.hard_min, l.hard_max }, .usual = { l.usual_min, l.usual_max }, .latch = l.latch != 0 };
}

PortSheet readPort (const tactus_plugin_port& p, Guest& guest)
{
    auto& choices = guest.choices.emplace_back (p.choices, p.choices + p.choice_count);
    return { .role = static_cast<Role> (p.role),
             .id = p.id,
             .unit = readUnit (*p.unit),
             .about = p.about,
             .limits = readLimits (*p.limits),
             .choices = choices,
             .width = p.width,
             .list = p.is_list != 0,
             .offset = p.offset,
             .initial = { p.initial[0], p.initial[1], p.initial[2] } };
}

SettingSheet readSetting (const tactus_plugin_setting& s)
{
    SettingSheet sheet {};
    sheet.kind = static_cast<SettingSheet::Kind> (s.kind);
    sheet.describe (s.id, readUnit (*s.unit), s.about, readLimits (*s.limits));
    sheet.x_unit = readUnit (*s.x_unit);
    for (std::size_t i = 0; i < s.field_count; ++i)
        sheet.fields.push_back (readSetting (*s.fields[i]));
    sheet.initial = readValue (*s.initial, Keep::no);
    return sheet;
}

/// Empty if this host does not know the kind.
std::optional<Appearance> readAppearance (const tactus_plugin_appearance& a)
{
    const auto kind = std::ranges::find (appearance_kinds, std::string_view (a.kind));
    if (kind == appearance_kinds.end()) return std::nullopt;
    Appearance read { .kind = static_cast<Appearance::Kind> (kind - appearance_kinds.begin()) };
    for (std::size_t i = 0; i < a.part_count; ++i)
        for (const auto& part : appearance_parts)
            if (part.name == a.parts[i]) read.*part.row = a.rows[i];
    return read;
}

void readSheet (NodeType& t, Guest& guest)
{
    const auto& c = guest.hooks;
    t.info = { .id = c.id, .name = c.name, .summary = c.summary, .source = c.source };
    for (std::size_t i = 0; i < c.port_count; ++i)
    {
        auto port = readPort (*c.ports[i], guest);
        auto& outputs_or_params = port.role == Role::output ? t.outputs : t.params;
        (port.role == Role::input ? t.inputs : outputs_or_params).push_back (port);
    }
    for (std::size_t i = 0; i < c.setting_count; ++i)
    {
        t.settings.push_back (readSetting (*c.settings[i]));
        t.settings.back().set = [g = &guest, i] (void* node, const SettingValue& value) {
            ValueWriter shown;
            g->ask ("set", [&] (auto* r) { return g->hooks.set (node, i, shown (value), r); });
        };
    }
    if (c.appearance != nullptr) t.appearance = readAppearance (*c.appearance);
    t.outputs_size = c.outputs_size;
    t.outputs_align = c.outputs_align;
    t.params_size = c.params_size;
}

/// The functions of the type hold a plain pointer to the guest, because the type and each of its nodes keep the guest alive.
void addQuestions (NodeType& t, const Guest* g)
{
    if (g->hooks.cost)
        t.cost = [g] (const void* n) {
            tactus_plugin_cost cost { sizeof cost, 0.0, 0.0 };
            g->ask ("cost", [&] (auto* r) { return g->hooks.cost (n, &cost, r); });
            return Cost { .work = cost.work, .memory = cost.memory };
        };
    if (g->hooks.problem)
        t.problem = [g] (const void* n) { return g->ask ("problem", [&] (auto* r) { return g->hooks.problem (n, r); }); };
    if (g->hooks.warning)
        t.warning = [g] (const void* n, const Setup& s) {
            const CSetup setup { s };
            return g->ask ("warning", [&] (auto* r) { return g->hooks.warning (n, setup.get(), r); });
        };
    if (g->hooks.prepare)
        t.prepare = [g] (void* n, const Setup& s) {
            const CSetup setup { s };
            g->ask ("prepare", [&] (auto* r) { return g->hooks.prepare (n, setup.get(), r); });
        };
    if (g->hooks.claims)
        t.claims = [g] (const void* n) {
            tactus_plugin_claims c { sizeof c, 0, 0.0, 0.0, 0.0, inf };
            g->ask ("claims", [&] (auto* r) { return g->hooks.claims (n, &c, r); });
            return Claims { c.passive != 0, c.stiffness, c.damping, c.spatial_frequency, c.amplitude };
        };
}

void addDevice (NodeType& t, const Guest* g)
{
    if (g->hooks.learn)
        t.learn = [learn = g->hooks.learn] (void* n, const DeviceMechanics& m) {
            const tactus_plugin_mechanics shown { sizeof shown, m.mass, m.damping };
            const auto turn = hookTurn();
            learn (n, &shown);
        };
    if (! g->hooks.bind) return;
    t.announce = [g] (void* n, const DeviceState& state) {
        const ShownDevice device { state };
        g->ask ("announce", [&] (auto* r) { return g->hooks.announce (n, device.get(), r); });
    };
    t.bind = [bind = g->hooks.bind] (void* n, const DeviceState&) { bind (n); };
    if (g->hooks.missing)
        t.missing = [g] (const void* n, const DeviceLayout& l) {
            const CLayout layout { l };
            return g->ask ("missing", [&] (auto* r) { return g->hooks.missing (n, layout.get(), r); });
        };
    if (g->hooks.effort)
        t.effort = [ask = g->hooks.effort] (const void* n) {
            tactus_plugin_effort e;   // not zeroed: the node fills the channels in use
            e.size = sizeof e;
            e.axis_count = e.signal_count = 0;
            std::fill_n (e.force, 3, 0.0);
            std::fill_n (e.torque, 3, 0.0);
            e.brake = 0.0;
            ask (n, &e);
            return readEffort (e);
        };
}
}   // namespace

Result<NodeType> readNode (const tactus_plugin_node* given, const std::string& file, std::shared_ptr<const void> library, std::uint32_t build,
                           std::string state_layout)
{
    if (auto fault = faultOf (given); ! fault.empty())
    {
        const std::string id = isWhole (given) && given->id != nullptr ? quote (given->id) : "a node without a name";
        return Message::error ("plugin/bad_node", file, id + " is refused: " + fault,
                               "ask the author of the plugin; <tactus/plugin/node_plugin.hpp> gets this right");
    }
    const auto guest = std::make_shared<Guest> (Guest { std::move (library), file, build });
    copyKnown (guest->hooks, given);
    const auto& c = guest->hooks;

    NodeType t {};
    t.origin = file;
    t.owner = guest;
    t.state_layout = std::move (state_layout);
    readSheet (t, *guest);
    t.make = MakeNode { guest };
    t.paramsOf = c.params;
    t.initialiseOutputs = c.initialise_outputs;
    t.tick = c.tick;
    t.tickStored = c.tick_stored;
    t.peek = c.peek;
    t.delay = c.delay;
    t.update = c.update;
    t.adopt = c.adopt;
    addQuestions (t, guest.get());
    if (c.save) t.serialize = &serialize;
    addDevice (t, guest.get());
    return t;
}

}   // namespace tactus::plugin
