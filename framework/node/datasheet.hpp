// SPDX-License-Identifier: MIT
#pragma once

/// The datasheet of a node: a constexpr tuple with one row per member of its Inputs, Params, Settings and Outputs.
///
///     static constexpr std::tuple ports {
///         input (&Inputs::position, "position", unit::metre, "tool position"),
///         param (&Params::mu, "mu", unit::gain, "friction coefficient", { .hard = { 0, inf }, .usual = { 0, 2 } }),
///         choice (&Params::adhesion, "adhesion", adhesion_names, "how the contact sticks"),
///         setting (&Settings::inputs, "inputs", unit::count, "number of inputs", { .hard = { 1, list_capacity } }),
///         output (&Outputs::force, "force", unit::newton, "force on the tool"),
///     };

#include <tactus/text/quantity.hpp>

#include <tactus/kit/curve.hpp>
#include <tactus/kit/geometry/surface.hpp>
#include <tactus/kit/law.hpp>
#include <tactus/kit/list.hpp>

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tactus
{

inline constexpr double inf = std::numeric_limits<double>::infinity();

/// The title block of a node's datasheet.
struct Info
{
    std::string_view id;        ///< used in graph files, so it never changes
    std::string_view name;      ///< as the host shows it
    std::string_view summary;   ///< one sentence
    std::string_view source;    ///< where the equations come from

    /// Other words that people search for, such as the names of the same thing in other programs: "sine oscillator".
    std::string_view keywords {};
};

struct Interval
{
    double min = -inf, max = inf;

    constexpr bool contains (double v) const noexcept { return v >= min && v <= max; }
    constexpr double clamp (double v) const noexcept
    {
        if (v < min) return min;
        return v > max ? max : v;
    }
    constexpr bool operator== (const Interval&) const = default;
};

/// Outside `hard` the model has no meaning: such a value is an error in a file and is clamped on a wire. `usual` is the range of
/// a slider; values outside it are fine. A latched parameter is read at contact onset, or on the hit, and keeps that value until
/// the contact, or the response to the hit, ends. `off_at_zero`: 0 means that there is no limit, so a knob goes from and to 0 without a
/// ramp through small values, and the node fades.
struct Limits
{
    Interval hard {};
    Interval usual = hard;
    bool latch = false;
    bool off_at_zero = false;
};

/// The unit of a port: a fixed one, or for generic nodes one that follows from the wires.
struct UnitRule
{
    enum class Kind
    {
        fixed,    ///< always `unit`
        open,     ///< the unit of the wire; the same for all entries of an array port
        each,     ///< the unit of the wire; each entry of an array port has its own
        same,     ///< the unit of port `a`, times `unit`
        product   ///< the product of ports `a` and `b`; of all entries of `a` if `b` is empty
    };

    Kind kind = Kind::fixed;
    Unit unit;
    std::string_view a, b;
    bool adds_up = false;   ///< several wires of any unit may end at this input

    constexpr UnitRule() = default;
    constexpr UnitRule (Unit fixed) : unit (fixed) {}
    constexpr UnitRule (Kind k, Unit u = unit::count, std::string_view a_ = {}, std::string_view b_ = {}, bool adds = false)
        : kind (k), unit (u), a (a_), b (b_), adds_up (adds)
    {
    }
};

inline constexpr UnitRule any_unit { UnitRule::Kind::open };
inline constexpr UnitRule any_unit_adding { UnitRule::Kind::open, unit::count, {}, {}, true };   ///< several wires add up
inline constexpr UnitRule each_its_unit { UnitRule::Kind::each };
constexpr UnitRule sameAs (std::string_view port) { return { UnitRule::Kind::same, unit::count, port }; }
constexpr UnitRule sameAs (std::string_view port, Unit times) { return { UnitRule::Kind::same, times, port }; }
constexpr UnitRule productOf (std::string_view a, std::string_view b = {}) { return { UnitRule::Kind::product, unit::count, a, b }; }

enum class Role
{
    input,
    param,
    setting,
    output
};

/// One row of a datasheet: the member that holds the value, and everything a person or a host needs to know about it.
template <Role role_, typename Owner_, typename T>
struct Row
{
    static constexpr Role role = role_;
    using Owner = Owner_;
    using Value = T;

    T Owner::*member;
    std::string_view id;
    UnitRule unit;
    std::string_view about;
    Limits limits {};
    std::span<const std::string_view> choices {};   ///< the names of a choice, in the order of its enum
    UnitRule x_unit = unit::count;                  ///< unit of the argument, if the value is a curve or a law
    double unwired = 0.0;                           ///< the value of an unwired entry of an InputList
};

template <typename O, typename T>
constexpr Row<Role::input, O, T> input (T O::*m, std::string_view id, UnitRule u, std::string_view about)
{
    return { m, id, u, about };
}

/// An array of inputs. It holds no values, so the row gives the value of an unwired entry.
template <typename O, typename T>
constexpr Row<Role::input, O, InputList<T>> input (InputList<T> O::*m, std::string_view id, UnitRule u, std::string_view about, double unwired)
{
    return { m, id, u, about, {}, {}, unit::count, unwired };
}

template <typename O, typename T>
constexpr Row<Role::param, O, T> param (T O::*m, std::string_view id, UnitRule u, std::string_view about, Limits l = {})
{
    return { m, id, u, about, l };
}

/// A parameter with named alternatives. T is an enum of int size, 0 … n-1 in the order of the names.
/// A node with a contact adopts a new choice only while the contact is open.
template <typename O, typename T>
requires std::is_enum_v<T> || requires { typename T::Enum; }
constexpr Row<Role::param, O, T> choice (T O::*m, std::string_view id, std::span<const std::string_view> names, std::string_view about)
{
    return { m, id, unit::count, about, {}, names };
}

/// A setting shapes the node and is fixed while it runs. Its type is one of a closed set; see framework/node/setting.hpp.
template <typename O, typename T>
constexpr Row<Role::setting, O, T> setting (T O::*m, std::string_view id, UnitRule u, std::string_view about, Limits l = {})
{
    return { m, id, u, about, l };
}

/// A setting that is a Curve or a Law, with the unit of its argument.
template <typename O, typename T>
constexpr Row<Role::setting, O, T> setting (T O::*m, std::string_view id, UnitRule x, UnitRule y, std::string_view about)
{
    return { m, id, y, about, {}, {}, x };
}

template <typename O, typename T>
constexpr Row<Role::output, O, T> output (T O::*m, std::string_view id, UnitRule u, std::string_view about)
{
    return { m, id, u, about };
}

/// One member of a record. A record is a struct with a table of these: `static constexpr std::tuple fields`. See Row.
template <typename Record, typename T>
struct Field
{
    T Record::*member;
    std::string_view id;
    Unit unit;
    std::string_view about;
    Limits limits {};
};

template <typename R, typename T>
constexpr Field<R, T> field (T R::*m, std::string_view id, Unit u, std::string_view about, Limits l = {})
{
    return { m, id, u, about, l };
}

//==============================================================================
// Implementation below.

namespace detail
{
struct Anything
{
    template <typename T>
    operator T() const;
};

template <typename T, std::size_t... I>
constexpr bool initialisableFrom (std::index_sequence<I...>)
{
    return requires { T { (void (I), Anything {})... }; };
}

template <typename T, std::size_t N = 24>
constexpr std::size_t memberCount()
{
    if constexpr (N == 0)
        return 0;
    else if constexpr (initialisableFrom<T> (std::make_index_sequence<N> {}))
        return N;
    else
        return memberCount<T, N - 1>();
}

template <Role role, typename... R>
constexpr std::size_t rowCount (const std::tuple<R...>&)
{
    return (std::size_t (R::role == role) + ... + 0u);
}

struct NoSettings
{
};

template <typename N>
struct SettingsOf
{
    using Type = NoSettings;
};
template <typename N>
requires requires { typename N::Settings; }
struct SettingsOf<N>
{
    using Type = typename N::Settings;
};
}   // namespace detail

}   // namespace tactus
