// SPDX-License-Identifier: MIT
#include "rig.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <stdexcept>

namespace tactus::examine
{

namespace
{
constexpr std::size_t guard = 64;   // bytes after the outputs, which the node must not write
constexpr std::byte untouched { 0xa5 };

[[noreturn]] void missing (const std::string& owner, std::string_view id) { throw std::invalid_argument (owner + " has no " + quote (id)); }

template <typename Sheets>
auto& named (std::string_view id, Sheets& sheets)
{
    const auto at = std::ranges::find (sheets, id, [] (const auto& s) { return s.id; });
    if (at == sheets.end()) missing ("the node", id);
    return *at;
}

const NodeType& typeNamed (std::string_view id)
{
    const auto* type = catalogue().find (id);
    if (type == nullptr) missing ("the catalogue", id);
    return *type;
}

std::size_t firstOf (std::string_view id, const std::vector<Rig::Component>& components, int index)
{
    const auto at = std::ranges::find_if (components, [&] (const auto& c) { return c.port->id == id && c.index == index; });
    if (at == components.end()) missing ("the node", std::string (id) + "[" + std::to_string (index) + "]");
    return static_cast<std::size_t> (at - components.begin());
}
}   // namespace

namespace
{
std::shared_ptr<void> made (const NodeType& type)
{
    Stage::enter ("create");
    return type.make();
}
}   // namespace

Rig::Rig (const NodeType& type, double rate_hz) : sheet (type), setup { rate_hz }, node (made (type)), results (new std::byte[type.outputs_size + guard])
{
    std::fill_n (results.get() + type.outputs_size, guard, untouched);
    type.initialiseOutputs (results.get());
    for (const auto& s : type.settings)
        if (s.id == "inputs") list_size = static_cast<int> (std::get<double> (s.initial));
}

Rig::Rig (std::string_view type_id, double rate_hz) : Rig (typeNamed (type_id), rate_hz) {}

Rig& Rig::set (std::string_view id, const SettingValue& value)
{
    Stage::enter ("set");
    named (id, sheet.settings).set (node.get(), value);
    if (id == "inputs") list_size = static_cast<int> (std::get<double> (value));
    return *this;
}

Rig& Rig::param (std::string_view id, double value, int index)
{
    const auto& port = named (id, sheet.params);
    if (! port.choices.empty()) missing ("the choice " + quote (id), "number");
    paramAt (port, index) = value;
    moved();
    return *this;
}

Rig& Rig::choose (std::string_view id, std::string_view alternative)
{
    const auto& port = named (id, sheet.params);
    const auto at = std::ranges::find (port.choices, alternative);
    if (at == port.choices.end()) missing ("the choice " + quote (id), alternative);
    const int value = static_cast<int> (at - port.choices.begin());
    std::copy_n (reinterpret_cast<const std::byte*> (&value), sizeof value, static_cast<std::byte*> (sheet.paramsOf (node.get())) + port.offset);
    moved();
    return *this;
}

std::string Rig::problem() const
{
    Stage::enter ("problem");
    return sheet.problem ? sheet.problem (node.get()) : std::string {};
}

void Rig::prepare()
{
    if (sheet.bind)
    {
        Stage::enter ("bind");
        bindFirst (sheet, node.get(), *device);
    }
    if (sheet.prepare)
    {
        Stage::enter ("prepare");
        sheet.prepare (node.get(), setup);
    }
    moved();

    const auto list = [this] (const std::vector<PortSheet>& ports) {
        std::vector<Component> all;
        for (const auto& p : ports)
            for (int i = 0; i < p.width * (p.list ? list_size : 1); ++i)
                all.push_back ({ &p, i });
        return all;
    };
    inputs = list (sheet.inputs);
    outputs = list (sheet.outputs);

    in.clear();
    for (const auto& c : inputs)
        in.push_back (c.port->initial[c.index % c.port->width]);
    sources.clear();
    for (const auto& value : in)
        sources.push_back (&value);
}

void Rig::wire()
{
    const auto* params = static_cast<const std::byte*> (sheet.paramsOf (node.get()));
    stored.assign (params, params + sheet.params_size);
}

void Rig::adopt (const Rig& old)
{
    if (! sheet.adopt) return;
    Stage::enter ("adopt");
    sheet.adopt (node.get(), old.node.get());
}

Rig& Rig::input (std::string_view id, double value, int index)
{
    in[firstOf (id, inputs, index)] = value;
    return *this;
}

Rig& Rig::input (std::string_view id, const Vec3& value)
{
    for (int i = 0; i < 3; ++i)
        input (id, value[i], i);
    return *this;
}

void Rig::tick() noexcept
{
    if (params_moved && sheet.update)
    {
        Stage::enter ("update");
        sheet.update (node.get());
    }
    params_moved = false;
    if (sheet.peek)
    {
        Stage::enter ("peek");
        sheet.peek (node.get(), sources.data(), results.get());
    }
    Stage::enter ("tick");
    if (sheet.tickStored && ! stored.empty())
        sheet.tickStored (node.get(), stored.data(), sources.data(), results.get());
    else
        sheet.tick (node.get(), sources.data(), results.get());
}

double Rig::out (std::string_view id, int index) const { return out (firstOf (id, outputs, index)); }

Vec3 Rig::vector (std::string_view id) const { return { out (id, 0), out (id, 1), out (id, 2) }; }

Claims Rig::claims() const
{
    Stage::enter ("claims");
    return sheet.claims ? sheet.claims (node.get()) : Claims {};
}

Effort Rig::effort() const noexcept
{
    if (! sheet.effort) return {};
    Stage::enter ("effort");
    return sheet.effort (node.get());
}

double Rig::out (std::size_t output) const noexcept
{
    const auto& c = outputs[output];
    return reinterpret_cast<const double*> (results.get() + c.port->offset)[c.index];
}

bool Rig::wroteTooFar() const noexcept
{
    return std::any_of (results.get() + sheet.outputs_size, results.get() + sheet.outputs_size + guard, [] (std::byte b) { return b != untouched; });
}

std::vector<double> Rig::outs() const
{
    std::vector<double> all;
    for (std::size_t i = 0; i < outputs.size(); ++i)
        all.push_back (out (i));
    return all;
}

double& Rig::paramAt (const PortSheet& port, int index) noexcept
{
    return reinterpret_cast<double*> (static_cast<std::byte*> (sheet.paramsOf (node.get())) + port.offset)[index];
}

}   // namespace tactus::examine
