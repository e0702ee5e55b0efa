// SPDX-License-Identifier: MIT
#include "instance.hpp"

#include <cstring>

namespace tactus::plan
{

namespace
{
struct KnobPlace
{
    const PortSheet* sheet;
    std::size_t component;
};

KnobPlace placeOf (const NodeType& type, std::size_t knob) noexcept
{
    std::size_t p = 0;
    for (; knob >= Knobs::roomOf (type.params[p]); ++p)
        knob -= Knobs::roomOf (type.params[p]);
    return { &type.params[p], knob };
}
}   // namespace

bool jumps (const NodeType& type, std::size_t knob, double from, double to) noexcept
{
    const auto& sheet = *placeOf (type, knob).sheet;
    return ! sheet.choices.empty() || (sheet.limits.off_at_zero && (from == 0.0 || to == 0.0));
}

void turn (const ParamRef& param, double value) noexcept
{
    if (! isFinite (value)) return;
    auto& knob = param.knobs->all[param.index];
    knob.target.store (param.sheet->limits.hard.clamp (value), std::memory_order_relaxed);
    knob.turns.fetch_add (1, std::memory_order_release);
    param.knobs->board->mark (param.knobs->place);
}

bool takesHits (const PortSheet& input) noexcept
{
    return input.width == 1 && ! input.list && input.unit.kind == UnitRule::Kind::fixed && input.unit.unit.quantity == Quantity::hit;
}

void strike (const HitRef& hit, double speed) noexcept
{
    if (! isFinite (speed) || speed <= 0.0) return;
    hit.knobs->pulses[hit.index].asked.fetch_add (speed, std::memory_order_release);
    hit.knobs->board->mark (hit.knobs->place);
}

double* Instance::param (std::size_t knob) const noexcept
{
    const auto [sheet, component] = placeOf (knobs->type, knob);
    return reinterpret_cast<double*> (static_cast<std::byte*> (knobs->type.paramsOf (node.get())) + sheet->offset) + component;
}

void Instance::write (std::size_t knob, double value) const noexcept
{
    const auto [sheet, component] = placeOf (knobs->type, knob);
    auto* place = static_cast<std::byte*> (knobs->type.paramsOf (node.get())) + sheet->offset;
    if (sheet->choices.empty())
        reinterpret_cast<double*> (place)[component] = value;
    else
    {
        const int chosen = static_cast<int> (value);
        std::memcpy (place, &chosen, sizeof chosen);
    }
}

std::uint64_t newSerial() noexcept
{
    static std::atomic<std::uint64_t> last { 0 };
    return ++last;
}

}   // namespace tactus::plan
