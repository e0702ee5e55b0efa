// SPDX-License-Identifier: MIT
#include "own_nodes.hpp"

#include <pybind11/stl.h>

#include <tactus/kit/opaque_state.hpp>
#include <tactus/text/units.hpp>

#include <array>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

namespace tactus::python
{

namespace
{
constexpr std::size_t component_size = sizeof (double);

/// A row of the datasheet; owns the text that its PortSheet points to. A choice is stored as an int in the space of a double.
struct OwnPort
{
    OwnPort (Role role, const py::dict& from);

    PortSheet sheet (std::size_t first_component) const;

    Role role;
    std::string id, symbol, about;
    int width;
    Unit unit {};
    Limits limits {};
    std::vector<std::string> choices;
    std::vector<std::string_view> choice_views {};
    std::vector<double> initial;
};

Quantity quantityOf (const std::string& text)
{
    for (int q = 0; q <= static_cast<int> (Quantity::state); ++q)
        if (name (static_cast<Quantity> (q)) == text) return static_cast<Quantity> (q);
    fail (Message::error ("node/quantity", "", "'" + text + "' is not a quantity", "use one of the quantities that tactus.nodes() shows, or leave it out"));
}

Dimension dimensionOf (const std::string& symbol, const std::string& port)
{
    if (symbol == "1") return {};
    const auto one = parseMeasure ("1 " + symbol);
    if (! one || one->value != 1.0)
        fail (Message::error ("node/unit", port, "'" + symbol + "' is not an SI unit", "use a unit without a prefix, such as m, N/m, 1/s, or 1 for a ratio"));
    return one->dimension;
}

Interval intervalOf (const py::handle& pair)
{
    const auto limits = pair.cast<std::pair<double, double>>();
    return { limits.first, limits.second };
}

OwnPort::OwnPort (Role r, const py::dict& from)
    : role (r), id (from["id"].cast<std::string>()), symbol (from["unit"].cast<std::string>()), about (from["about"].cast<std::string>()),
      width (from["width"].cast<int>()), choices (from["choices"].cast<std::vector<std::string>>()), initial (from["default"].cast<std::vector<double>>())
{
    unit.quantity = quantityOf (from["quantity"].cast<std::string>());
    unit.dimension = dimensionOf (symbol, id);
    limits = { .hard = intervalOf (from["hard"]), .usual = intervalOf (from["usual"]), .latch = false };
}

PortSheet OwnPort::sheet (std::size_t first_component) const
{
    auto u = unit;
    u.symbol = symbol;
    PortSheet s { .role = role,
                  .id = id,
                  .unit = u,
                  .about = about,
                  .limits = limits,
                  .choices = choice_views,
                  .width = width,
                  .list = false,
                  .offset = first_component * component_size,
                  .initial = { 0.0, 0.0, 0.0 } };
    std::copy_n (initial.begin(), std::min<std::size_t> (initial.size(), 3), s.initial);
    return s;
}

std::vector<OwnPort> portsOf (Role role, const py::handle& list)
{
    std::vector<OwnPort> all;
    for (const auto& from : list.cast<py::list>())
        all.emplace_back (role, from.cast<py::dict>());
    for (auto& port : all)   // only now: while the vector grows, the strings move
        port.choice_views.assign (port.choices.begin(), port.choices.end());
    return all;
}

std::size_t components (const std::vector<OwnPort>& ports)
{
    std::size_t count = 0;
    for (const auto& p : ports)
        count += at (p.width);
    return count;
}

std::vector<PortSheet> sheetsOf (const std::vector<OwnPort>& ports)
{
    std::vector<PortSheet> all;
    std::size_t next = 0;
    for (const auto& p : ports)
    {
        all.push_back (p.sheet (next));
        next += at (p.width);
    }
    return all;
}
}   // namespace

//==============================================================================
/// A node type written in Python. The functions of a NodeType that make a node and initialise its outputs get no context, so they
/// cannot tell which Python type is meant. Each type therefore takes one of a fixed number of slots, and each slot has its own functions.
struct OwnType
{
    OwnType (OwnNodes&, const py::dict&);
    ~OwnType();
    OwnType (const OwnType&) = delete;
    OwnType& operator= (const OwnType&) = delete;

    NodeType describe() const;

    OwnNodes& all;
    std::string id, name, summary, source;
    std::vector<OwnPort> inputs, params, outputs;
    py::object factory;   // makes the Python side of one node
    std::size_t slot;
};

namespace
{
constexpr std::size_t slot_count = 256;
std::mutex slot_lock;
std::array<OwnType*, slot_count> slots {};

std::size_t takeSlot (OwnType& type)
{
    const std::scoped_lock lock (slot_lock);
    const auto place = std::ranges::find (slots, nullptr);
    if (place == slots.end())
        fail (Message::error ("node/too_many", type.id, "more than " + std::to_string (slot_count) + " node types in Python are in use at the same time",
                              "delete engines that you no longer use"));
    *place = &type;
    return static_cast<std::size_t> (place - slots.begin());
}

/// One node. Its params are stored as in any node, and its state is in Python. Calls into Python take the GIL.
struct OwnNode
{
    explicit OwnNode (const OwnType& t) : type (t), params (components (t.params)), values (components (t.inputs) + params.size())
    {
        std::size_t next = 0;
        for (const auto& p : type.params)
            for (const double v : p.initial)
                if (p.choices.empty())
                    params[next++] = v;
                else
                    new (&params[next++]) int (static_cast<int> (v));
        guarded ([&] { python = type.factory(); });
    }

    ~OwnNode()
    {
        const py::gil_scoped_acquire gil;
        python = {};
    }

    OwnNode (const OwnNode&) = delete;
    OwnNode& operator= (const OwnNode&) = delete;

    template <typename F>
    void guarded (F&& f) noexcept
    {
        const py::gil_scoped_acquire gil;
        if (type.all.haveFailed()) return;
        try
        {
            f();
        }
        catch (...)
        {
            type.all.noteFailure();
        }
    }

    void prepare (double rate_hz)
    {
        guarded ([&] { python.attr ("prepare") (rate_hz); });
    }

    /// Fills `values`: the components of the inputs, then those of the params, in the order of the datasheet.
    void gather (const double* const* sources) noexcept
    {
        const auto input_count = values.size() - params.size();
        for (std::size_t i = 0; i < input_count; ++i)
            values[i] = *sources[i];
        std::size_t next = 0;
        for (const auto& p : type.params)
            for (int i = 0; i < p.width; ++i, ++next)
                values[input_count + next] = p.choices.empty() ? params[next] : *reinterpret_cast<const int*> (&params[next]);
    }

    void tick (const double* const* sources, double* outputs) noexcept
    {
        gather (sources);
        std::fill_n (outputs, components (type.outputs), 0.0);
        guarded ([&] {
            py::tuple all (values.size());
            for (std::size_t i = 0; i < values.size(); ++i)
                all[i] = values[i];
            const auto results = python.attr ("tick") (all).cast<std::vector<double>>();
            std::copy_n (results.begin(), std::min (results.size(), components (type.outputs)), outputs);
        });
    }

    /// The state, as bytes that only the Python side reads.
    void serialize (StateArchive& archive)
    {
        const py::gil_scoped_acquire gil;
        if (type.all.haveFailed()) return archive.refuse ("has raised an exception, which ended its run");
        try
        {
            const auto bytes = opaqueState (archive, archive.restores() ? "" : python.attr ("save")().cast<std::string>());
            if (archive.restores() && ! archive.isRefused()) python.attr ("restore") (py::bytes (bytes));
        }
        catch (const py::error_already_set& why)
        {
            archive.refuse (py::str (why.value()).cast<std::string>());
        }
    }

    const OwnType& type;
    std::vector<double> params, values;
    py::object python;
};

struct SlotFunctions
{
    std::shared_ptr<void> (*make)();
    void (*initialise) (void*) noexcept;
};

template <std::size_t... i>
constexpr std::array<SlotFunctions, slot_count> slotFunctions (std::index_sequence<i...>)
{
    return { SlotFunctions { []() -> std::shared_ptr<void> { return std::make_shared<OwnNode> (*slots[i]); },
                             [] (void* outputs) noexcept { std::fill_n (static_cast<double*> (outputs), components (slots[i]->outputs), 0.0); } }... };
}

constexpr auto slot_functions = slotFunctions (std::make_index_sequence<slot_count> {});
}   // namespace

OwnType::OwnType (OwnNodes& owner, const py::dict& from)
    : all (owner), id (from["id"].cast<std::string>()), name (from["name"].cast<std::string>()), summary (from["summary"].cast<std::string>()),
      source (from["source"].cast<std::string>()), inputs (portsOf (Role::input, from["inputs"])), params (portsOf (Role::param, from["params"])),
      outputs (portsOf (Role::output, from["outputs"])), factory (from["factory"]), slot (takeSlot (*this))
{
}

OwnType::~OwnType()
{
    const std::scoped_lock lock (slot_lock);
    slots[slot] = nullptr;
}

NodeType OwnType::describe() const
{
    NodeType t {};
    t.info = { .id = id, .name = name, .summary = summary, .source = source };
    t.inputs = sheetsOf (inputs);
    t.params = sheetsOf (params);
    t.outputs = sheetsOf (outputs);
    t.outputs_size = std::max<std::size_t> (components (outputs), 1) * component_size;
    t.outputs_align = alignof (double);
    t.params_size = components (params) * component_size;
    t.make = slot_functions[slot].make;
    t.initialiseOutputs = slot_functions[slot].initialise;
    t.paramsOf = [] (void* node) noexcept -> void* { return static_cast<OwnNode*> (node)->params.data(); };
    t.prepare = [] (void* node, const Setup& setup) { static_cast<OwnNode*> (node)->prepare (setup.rate_hz); };
    t.serialize = [] (void* node, StateArchive& archive) { static_cast<OwnNode*> (node)->serialize (archive); };
    t.tick = [] (void* node, const double* const* sources, void* to) noexcept {
        static_cast<OwnNode*> (node)->tick (sources, static_cast<double*> (to));
    };
    return t;
}

//==============================================================================
OwnNodes::OwnNodes (const py::list& descriptions)
{
    std::vector<NodeType> described;
    for (const auto& from : descriptions)
    {
        types.push_back (std::make_unique<OwnType> (*this, from.cast<py::dict>()));
        if (tactus::catalogue().find (types.back()->id) != nullptr)
            fail (Message::error ("node/id_taken", types.back()->id, "Tactus already has a node with this id", "give your node another id"));
        described.push_back (types.back()->describe());
    }
    if (described.empty()) return;
    const auto& base = tactus::catalogue();
    own.emplace (std::vector<NodeType> (base.begin(), base.end()), std::move (described));
}

OwnNodes::~OwnNodes() = default;

void OwnNodes::raiseFailure()
{
    if (auto why = std::exchange (failure, nullptr)) std::rethrow_exception (why);
}

}   // namespace tactus::python
