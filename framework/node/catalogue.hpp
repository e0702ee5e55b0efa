// SPDX-License-Identifier: MIT
#pragma once

/// The catalogue: every node in nodes/, by id, type-erased. The build fills it (catalogue.cmake).

#include "node.hpp"
#include "setting.hpp"
#include <tactus/kit/state_archive.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>

namespace tactus
{

/// A row of the datasheet as graphs and hosts see it.
struct PortSheet
{
    Role role;
    std::string_view id;
    UnitRule unit;
    std::string_view about;
    Limits limits;
    std::span<const std::string_view> choices;
    int width;            ///< components: 1 for a scalar, 3 for a vector
    bool list;            ///< an array port: its length is the setting `inputs`
    std::size_t offset;   ///< offset of the value in its Params or Outputs struct
    double initial[3];    ///< default of each component; for a list, of each entry
};

/// A node type. The functions take the node and its outputs as void*. `sources` holds one pointer per input component, in the
/// order of the datasheet, with the entries of a list one after another. Hooks that the node does not have are null.
///
/// The tick thread calls the plain function pointers directly, even those of a plugin. The other functions are std::function, because
/// those of a plugin translate between C++ and the C interface of plugins. Most of them run only when a graph is read or compiled.
struct NodeType
{
    Info info;
    std::vector<PortSheet> inputs, params, outputs;
    std::vector<SettingSheet> settings;
    std::size_t outputs_size, outputs_align, params_size;
    std::optional<Appearance> appearance {};   ///< empty: the node has no place in a picture of the scene

    std::string origin {};                  ///< the file of the plugin that the type comes from; empty: it is compiled in
    std::shared_ptr<const void> owner {};   ///< keeps the plugin loaded; null: compiled in
    std::string state_layout {};            ///< of a plugin: two versions of a type with the same text here have the same layout in memory

    std::function<std::shared_ptr<void>()> make;
    void* (*paramsOf) (void* node) noexcept;
    void (*initialiseOutputs) (void* outputs) noexcept;
    void (*tick) (void* node, const double* const* sources, void* outputs) noexcept;
    void (*tickStored) (void* node, const void* stored, const double* const* sources, void* outputs) noexcept;   ///< `stored` points to a Params
    void (*peek) (void* node, const double* const* sources, void* outputs) noexcept;
    int (*delay) (const void* node) noexcept;
    std::function<Cost (const void* node)> cost;
    std::function<std::string (const void* node)> problem;
    std::function<std::string (const void* node, const Setup&)> warning;
    std::function<void (void* node, const Setup&)> prepare;
    void (*update) (void* node) noexcept;
    void (*adopt) (void* node, const void* old) noexcept;
    void (*serialize) (void* node, StateArchive&) = nullptr;   ///< null: its state cannot be saved   [tick thread]
    std::function<Claims (const void* node)> claims;
    std::function<void (void* node, const DeviceState&)> announce {};   ///< copies what `bind` needs of a layout; may allocate  [main thread]
    std::function<void (void* node, const DeviceState&)> bind;          ///< allocates nothing  [main or tick thread]
    std::function<std::string (const void* node, const DeviceLayout&)> missing;
    std::function<void (void* node, const DeviceMechanics&)> learn {};   ///< allocates nothing  [main or tick thread]
    std::function<Effort (const void* node)> effort;
    bool stateless = false;   ///< its outputs depend on nothing but its inputs, params and settings

    /// True if a node of this type may adopt a node of another version of the same plugin.
    bool sharesState (const NodeType& then) const { return info.id == then.info.id && ! state_layout.empty() && state_layout == then.state_layout; }
};

/// Binds a node for the first time. [main thread]
inline void bindFirst (const NodeType& type, void* node, const DeviceState& state)
{
    if (type.announce) type.announce (node, state);
    type.bind (node, state);
}

/// The nodes of a program that are not in nodes/. The build defines one object of static storage duration per folder; see
/// tactus_add_nodes in catalogue.cmake.
class NodeLibrary
{
public:
    using Types = std::vector<NodeType> (*)();

    explicit NodeLibrary (Types) noexcept;
    NodeLibrary (const NodeLibrary&) = delete;
    NodeLibrary& operator= (const NodeLibrary&) = delete;

    /// The types of all libraries that exist so far.
    static std::vector<NodeType> all();

private:
    Types types;
    const NodeLibrary* next;
};

/// All node types, sorted by id. A copy is cheap and shares the types; the types live as long as any copy, and a plan keeps one.
class Catalogue
{
    using Types = std::vector<std::shared_ptr<const NodeType>>;

public:
    class Iterator
    {
    public:
        using iterator_category = std::forward_iterator_tag;
        using value_type = NodeType;
        using difference_type = std::ptrdiff_t;
        using pointer = const NodeType*;
        using reference = const NodeType&;

        Iterator() = default;
        explicit Iterator (Types::const_iterator at) noexcept : here (at) {}

        const NodeType& operator*() const noexcept { return **here; }
        const NodeType* operator->() const noexcept { return here->get(); }
        Iterator& operator++() noexcept
        {
            ++here;
            return *this;
        }
        Iterator operator++ (int) noexcept { return Iterator { here++ }; }
        bool operator== (const Iterator&) const = default;

    private:
        Types::const_iterator here {};
    };

    Catalogue() = default;

    /// Throws std::invalid_argument if two types have the same id: a graph would not say which one it means.
    explicit Catalogue (std::vector<NodeType>, std::vector<NodeType> more = {});

    const NodeType* find (std::string_view id) const noexcept;

    /// This catalogue with these types in addition. A type replaces one of the same id; all other types keep their address, so
    /// their nodes continue when a graph is compiled again.
    Catalogue with (std::vector<NodeType>) const;

    Iterator begin() const noexcept { return types ? Iterator { types->begin() } : Iterator {}; }
    Iterator end() const noexcept { return types ? Iterator { types->end() } : Iterator {}; }

private:
    explicit Catalogue (Types);

    std::shared_ptr<const Types> types;
};

/// The nodes in nodes/, those of all NodeLibrary objects that exist when this is called for the first time, and what
/// extendCatalogue has added. [any thread]
const Catalogue& catalogue();

/// Adds types to catalogue(), or replaces those of the same id, for everything that is compiled from now on. Existing plans and
/// runs keep the types that they use. [main thread, while no other thread uses catalogue()]
void extendCatalogue (std::vector<NodeType>);

//==============================================================================
// Implementation below.

namespace detail
{
template <typename T>
struct Shape
{
    static constexpr int width = 1;
    static constexpr bool list = false;
};
template <>
struct Shape<Vec3>
{
    static constexpr int width = 3;
    static constexpr bool list = false;
};
template <>
struct Shape<List>
{
    static constexpr int width = 1;
    static constexpr bool list = true;
};
template <typename T>
struct Shape<InputList<T>>
{
    static constexpr int width = Shape<T>::width;
    static constexpr bool list = true;
};

template <typename N>
int listSize (const N& node) noexcept
{
    if constexpr (requires { node.settings.inputs; })
        return node.settings.inputs;
    else
        return 0;
}

template <typename N>
struct NodeAdapter
{
    using Inputs = typename N::Inputs;
    using Outputs = typename N::Outputs;

    /// Fills Inputs from the sources, in datasheet order.
    static Inputs gather (const N& node, const double* const* sources) noexcept
    {
        Inputs in;
        const auto load = [&] (const auto& row) {
            using R = std::remove_cvref_t<decltype (row)>;
            if constexpr (R::role == Role::input)
            {
                using T = typename R::Value;
                if constexpr (Shape<T>::list)
                {
                    const int n = listSize (node);
                    in.*row.member = T { sources, n };
                    sources += n * Shape<T>::width;
                }
                else if constexpr (Shape<T>::width == 3)
                {
                    in.*row.member = Vec3 { *sources[0], *sources[1], *sources[2] };
                    sources += 3;
                }
                else
                    in.*row.member = **sources++;
            }
        };
        std::apply ([&] (const auto&... row) { (load (row), ...); },
                    N::ports);
        return in;
    }

    static void tick (void* node, const double* const* sources, void* outputs) noexcept
    {
        N& n = *static_cast<N*> (node);
        if constexpr (Peekable<N>)
            n.tick (gather (n, sources));
        else
            new (outputs) Outputs (n.tick (gather (n, sources)));
    }

    static void tickStored (void* node, const void* stored, const double* const* sources, void* outputs) noexcept
    {
        static_assert (std::is_trivially_copyable_v<typename N::Params>, "stored params are copied as bytes");
        N& n = *static_cast<N*> (node);
        typename N::Params params;
        std::memcpy (&params, stored, sizeof params);
        new (outputs) Outputs (n.tick (gather (n, sources), params));
    }

    static void peek (void* node, const double* const*, void* outputs) noexcept
    {
        new (outputs) Outputs (static_cast<const N*> (node)->peek());
    }

    template <std::size_t row>
    static void set (void* node, const SettingValue& value)
    {
        constexpr auto& r = std::get<row> (N::ports);
        assign (static_cast<N*> (node)->settings.*r.member, value);
    }
};

/// A separate template, because not every node has settings: it is instantiated only for rows that are settings.
template <typename N, typename R>
const auto& settingOf (const N& node, const R& row)
{
    return node.settings.*row.member;
}

template <typename Owner, typename R>
PortSheet portSheet (const Owner& owner, const R& row)
{
    using T = typename R::Value;
    static_assert (std::is_same_v<T, double> || std::is_same_v<T, Vec3> || Shape<T>::list || (std::is_enum_v<T> && R::role == Role::param),
                   "a port is a double, a Vec3, an InputList (inputs) or a List (params, outputs); a choice is an enum");
    static_assert (R::role == Role::input || ! std::is_same_v<T, InputList<double>>, "an InputList is for inputs");
    const auto& value = owner.*row.member;
    PortSheet s {
        .role = R::role,
        .id = row.id,
        .unit = row.unit,
        .about = row.about,
        .limits = row.limits,
        .choices = row.choices,
        .width = Shape<T>::width,
        .list = Shape<T>::list,
        .offset = at (reinterpret_cast<const char*> (&value) - reinterpret_cast<const char*> (&owner)),
        .initial = { 0.0, 0.0, 0.0 },
    };
    if constexpr (std::is_enum_v<T>)
    {
        static_assert (sizeof (T) == sizeof (int), "a choice is an enum of int size");
        s.initial[0] = static_cast<double> (static_cast<int> (value));
    }
    else if constexpr (std::is_same_v<T, Vec3>)
        for (int i = 0; i < 3; ++i)
            s.initial[i] = value[i];
    else if constexpr (std::is_same_v<T, List>)
        s.initial[0] = value[0];
    else if constexpr (Shape<T>::list)
        std::fill_n (s.initial, Shape<T>::width, row.unwired);
    else if constexpr (std::is_same_v<T, double>)
        s.initial[0] = value;
    return s;
}
}   // namespace detail

namespace detail
{
/// Fills in the rows of the datasheet.
template <Node N>
void describePorts (NodeType& t)
{
    const N fresh;
    const typename N::Inputs inputs;
    const typename N::Outputs outputs;
    const auto add = [&]<std::size_t i> (std::integral_constant<std::size_t, i>) {
        constexpr auto& row = std::get<i> (N::ports);
        using R = std::remove_cvref_t<decltype (row)>;
        if constexpr (R::role == Role::input)
            t.inputs.push_back (portSheet (inputs, row));
        else if constexpr (R::role == Role::param)
            t.params.push_back (portSheet (fresh.params, row));
        else if constexpr (R::role == Role::output)
            t.outputs.push_back (portSheet (outputs, row));
        else
        {
            auto s = settingSheet (settingOf (fresh, row));
            s.describe (row.id, row.unit, row.about, row.limits);
            s.x_unit = row.x_unit;
            s.set = &NodeAdapter<N>::template set<i>;
            t.settings.push_back (std::move (s));
        }
    };
    [&]<std::size_t... i> (std::index_sequence<i...>) { (add (std::integral_constant<std::size_t, i> {}), ...); }
    (std::make_index_sequence<std::tuple_size_v<std::remove_cvref_t<decltype (N::ports)>>> {});
}

/// True if each part of the node's appearance is the id of a row.
template <typename N>
constexpr bool namesRows()
{
    if constexpr (Visible<N>)
        for (const auto& part : appearance_parts)
        {
            const auto id = N::appearance.*part.row;
            const bool exists = std::apply ([&] (const auto&... row) { return ((row.id == id) || ...); },
                                            N::ports);
            if (! id.empty() && ! exists) return false;
        }
    return true;
}
}   // namespace detail

/// The catalogue entry of a node. The code that the build generates calls it.
template <Node N>
NodeType describe()
{
#ifndef EIGEN_DONT_VECTORIZE
    static_assert (sizeof (N) == 0, "code that compiles nodes needs the flags of tactus::node_flags; without them, nodes give other bits: see docs/library.md");
#endif
    static_assert (detail::namesRows<N>(), "each part of an appearance names a row of the datasheet");
    static_assert (std::is_trivially_destructible_v<typename N::Outputs>, "each tick overwrites the outputs without calling a destructor");
    using E = detail::NodeAdapter<N>;
    NodeType t {};
    t.info = N::info;
    t.outputs_size = sizeof (typename N::Outputs);
    t.outputs_align = alignof (typename N::Outputs);
    t.params_size = sizeof (typename N::Params);
    detail::describePorts<N> (t);
    if constexpr (Visible<N>) t.appearance = N::appearance;

    t.make = []() -> std::shared_ptr<void> { return std::make_shared<N>(); };
    t.paramsOf = [] (void* n) noexcept -> void* { return &static_cast<N*> (n)->params; };
    t.initialiseOutputs = [] (void* o) noexcept { new (o) typename N::Outputs(); };
    t.tick = &E::tick;
    if constexpr (KnowsStored<N>) t.tickStored = &E::tickStored;
    if constexpr (Peekable<N>) t.peek = &E::peek;
    if constexpr (Delaying<N>) t.delay = [] (const void* n) noexcept { return static_cast<const N*> (n)->delay(); };
    if constexpr (Costly<N>) t.cost = [] (const void* n) { return static_cast<const N*> (n)->cost(); };
    if constexpr (SelfChecking<N>) t.problem = [] (const void* n) { return static_cast<const N*> (n)->problem(); };
    if constexpr (Warning<N>) t.warning = [] (const void* n, const Setup& s) { return static_cast<const N*> (n)->warning (s); };
    if constexpr (Preparable<N>) t.prepare = [] (void* n, const Setup& s) { static_cast<N*> (n)->prepare (s); };
    if constexpr (Updatable<N>) t.update = [] (void* n) noexcept { static_cast<N*> (n)->update(); };
    if constexpr (Adoptable<N>) t.adopt = [] (void* n, const void* o) noexcept { static_cast<N*> (n)->adopt (*static_cast<const N*> (o)); };
    if constexpr (Savable<N>)
        t.serialize = [] (void* n, StateArchive& a) { static_cast<N*> (n)->serialize (a); };
    else if constexpr (Unchanging<N>)
        t.serialize = [] (void*, StateArchive&) {};
    if constexpr (Claiming<N>) t.claims = [] (const void* n) { return static_cast<const N*> (n)->claims(); };
    if constexpr (DeviceBound<N>) t.bind = [] (void* n, const DeviceState& s) { static_cast<N*> (n)->bind (s); };
    if constexpr (NamesDeviceParts<N>) t.missing = [] (const void* n, const DeviceLayout& l) { return static_cast<const N*> (n)->missing (l); };
    if constexpr (LearnsOfDevice<N>) t.learn = [] (void* n, const DeviceMechanics& m) noexcept { static_cast<N*> (n)->learn (m); };
    t.stateless = Stateless<N>;
    if constexpr (Sink<N>) t.effort = [] (const void* n) noexcept { return static_cast<const N*> (n)->effort(); };
    return t;
}

}   // namespace tactus
