// SPDX-License-Identifier: MIT
// Ticks every node of the catalogue with inputs that a hand might produce, so that callgrind can count (instructions.py).
//
// With arguments, it ticks the nodes of these plugins instead (tests/plugins/cost.py).
//
// Callgrind counts inside `ticked` and dumps after each `counted`, so its n-th dump belongs to the n-th line printed
// here. The first dump is for a tick that does nothing: the cost of the call itself.

#include <tactus/node/catalogue.hpp>
#include <tactus/plugin/plugin_library.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

using namespace tactus;

extern "C"
{
    // Callgrind finds this function by name, so it must not be inlined.
    [[gnu::noinline]] void ticked (const NodeType&, void* node, const double* const* sources, void* outputs) noexcept;
    [[gnu::noinline]] void counted() noexcept;

    void ticked (const NodeType& type, void* node, const double* const* sources, void* outputs) noexcept
    {
        if (type.peek) type.peek (node, sources, outputs);
        type.tick (node, sources, outputs);
    }

    void counted() noexcept { asm volatile(""); }
}

namespace
{
const Setup setup { 4000.0 };
constexpr int ticks = 4000;   // one second

double swing (double t, double hertz, double phase = 0.0) { return std::sin (2.0 * std::numbers::pi * (hertz * t + phase)); }

/// The position of a hand that strokes back and forth, and presses 2 mm deep three times a second.
Vec3 position (double t) { return { 0.03 * swing (t, 1.0), 0.02 * swing (t, 1.3), 1e-3 - 3e-3 * std::abs (swing (t, 1.5)) }; }

/// A value that a hand or another node might give to this input; it depends on the quantity of the input.
double plausible (const PortSheet& port, int component, double t)
{
    const auto& unit = port.unit.unit;
    const double initial = port.initial[component];
    if (std::isnan (initial)) return initial;   // this input stays unwired

    const double phase = 0.1 * component;
    switch (port.unit.kind == UnitRule::Kind::fixed ? unit.quantity : Quantity::any)
    {
    case Quantity::length:
        return port.width == 3 ? position (t)[component] : -position (t).z();
    case Quantity::angle:
        return 0.5 + 0.4 * swing (t, 1.0, phase);
    case Quantity::speed:
        return 0.2 * swing (t, 1.0, phase);
    case Quantity::force:
        return initial + 0.5 * swing (t, 2.0, phase);
    case Quantity::hit:
        return std::fmod (t, 0.1) < 0.5 * setup.dt_s() ? 0.3 : 0.0;
    case Quantity::gain:
        return initial != 0.0 || port.width == 3 ? initial : swing (t, 2.0, phase);
    default:
        return swing (t, 2.0, phase);
    }
}

int entriesOf (const NodeType& type)
{
    for (const auto& s : type.settings)
        if (s.id == "inputs") return static_cast<int> (std::get<double> (s.initial));
    return 0;
}

struct Input
{
    const PortSheet* port;
    int component;
};

void run (const NodeType& type)
{
    const auto node = type.make();
    if (const auto problem = type.problem ? type.problem (node.get()) : std::string {}; ! problem.empty())
    {
        std::printf ("%s 0 %s\n", std::string (type.info.id).c_str(), problem.c_str());
        counted();
        return;
    }

    DeviceState device;
    if (type.bind) bindFirst (type, node.get(), device);
    if (type.prepare) type.prepare (node.get(), setup);
    if (type.update) type.update (node.get());

    std::vector<Input> inputs;
    for (const auto& port : type.inputs)
        for (int i = 0; i < port.width * (port.list ? entriesOf (type) : 1); ++i)
            inputs.push_back ({ &port, i % port.width });
    std::vector<double> values (inputs.size());
    std::vector<const double*> sources;
    for (const auto& value : values)
        sources.push_back (&value);

    const auto outputs = std::make_unique<std::byte[]> (type.outputs_size);
    type.initialiseOutputs (outputs.get());

    for (int k = 0; k < ticks; ++k)
    {
        const double t = k * setup.dt_s();
        device.reading.position = position (t);
        device.reading.true_position = position (t);
        for (std::size_t i = 0; i < inputs.size(); ++i)
            values[i] = plausible (*inputs[i].port, inputs[i].component, t);
        ticked (type, node.get(), sources.data(), outputs.get());
    }
    std::printf ("%s %d\n", std::string (type.info.id).c_str(), ticks);
    counted();
}

NodeType nothing()
{
    NodeType type {};
    type.info.id = "nothing";
    type.outputs_size = 1;
    type.make = []() -> std::shared_ptr<void> { return std::make_shared<char>(); };
    type.initialiseOutputs = [] (void*) noexcept {};
    type.tick = [] (void*, const double* const*, void*) noexcept {};
    return type;
}
}   // namespace

int main (int argc, char** argv)
{
    run (nothing());
    if (argc == 1)
        for (const auto& type : catalogue())
            run (type);
    for (const auto& type : Catalogue { loadPlugins ({ argv + 1, argv + argc }, Catalogue {}).types })
        run (type);
}
