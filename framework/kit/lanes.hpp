// SPDX-License-Identifier: MIT
#pragma once

#include "fine.hpp"
#include "vec3.hpp"

#include <type_traits>

/// For nodes that can compute several instances at once (docs/lanes.md). Such a node is a template over its scalar V: double, or a Pack of 2,
/// 4 or 8 doubles, one for each instance (<pack.hpp>). A comparison of scalars gives a bool, or a mask with a bool for each instance;
/// select() takes the place of `?:`, and where() that of `if`. With double, these functions are plain C++, and cost nothing.
namespace tactus
{

/// True for double, false for packs.
template <typename V>
inline constexpr bool is_single = std::is_same_v<V, double>;

template <typename V>
using Vector = Eigen::Matrix<V, 3, 1>;

/// Fine and Position of a single instance, for positions and what follows from them.
template <typename V>
using FineOf = std::conditional_t<is_single<V>, Fine, V>;
template <typename V>
using PositionOf = std::conditional_t<is_single<V>, Position, Vector<V>>;

/// The type of the result of a comparison of two V.
template <typename V>
using MaskOf = decltype (V {} < V {});

namespace detail
{
template <typename V, typename E>
struct ChoiceIn
{
    using Type = typename V::template Choice<E>;
};
template <typename E>
struct ChoiceIn<double, E>
{
    using Type = E;
};
struct Nothing
{
};
}   // namespace detail

/// A param that is a choice: an enum, or one enum for each instance.
template <typename V, typename E>
using ChoiceOf = typename detail::ChoiceIn<V, E>::Type;

/// A member that a node has only when it computes a single instance, such as settings that allocate memory.
template <typename V, typename T>
using OnlySingle = std::conditional_t<is_single<V>, T, detail::Nothing>;

template <typename T>
inline T select (bool where, const T& yes, const T& no) noexcept
{
    if (where) return yes;   // with ?:, GCC chooses between two addresses, so both values have to be in memory
    return no;
}

/// For `where (mask, to) = value`, which sets `to` in those instances where the mask is true.
template <typename M, typename T>
struct Where
{
    const M mask;
    T& to;

    void operator= (const T& value) noexcept
    {
        if constexpr (std::is_same_v<M, bool>)
        {
            if (mask) to = value;
        }
        else
            to = select (mask, value, to);
    }
};

template <typename M, typename T>
inline Where<M, T> where (M mask, T& to) noexcept
{
    return { mask, to };
}

inline bool any (bool mask) noexcept { return mask; }
inline bool none (bool mask) noexcept { return ! mask; }
inline bool every (bool mask) noexcept { return mask; }

/// std::max: `a` if both are equal or one is not a number.
template <typename V>
inline V larger (V a, V b) noexcept
{
    return select (a < b, b, a);
}

/// std::min: `a` if both are equal or one is not a number.
template <typename V>
inline V smaller (V a, V b) noexcept
{
    return select (b < a, b, a);
}

/// std::clamp.
template <typename V>
inline V clamped (V v, V low, V high) noexcept
{
    return select (v < low, low, select (high < v, high, v));
}

template <typename V>
inline auto isEqual (const Vector<V>& a, const Vector<V>& b) noexcept
{
    return a.x() == b.x() && a.y() == b.y() && a.z() == b.z();
}

template <typename V>
inline auto isZero (const Vector<V>& v) noexcept
{
    return v.x() == 0.0 && v.y() == 0.0 && v.z() == 0.0;
}

/// The largest magnitude of a component. The components must be numbers.
template <typename V>
inline V largest (const Vector<V>& v) noexcept
{
    if constexpr (is_single<V>)
        return v.cwiseAbs().maxCoeff();
    else
        return larger (larger (magnitude (v.x()), magnitude (v.y())), magnitude (v.z()));
}

/// Scales to length 1, like Eigen's normalized(). A vector whose square is 0 stays as it is.
template <typename V>
inline Vector<V> normalized (const Vector<V>& v) noexcept
{
    const V square = v.squaredNorm();
    const auto has_length = square > 0.0;
    if (none (has_length)) return v;
    using std::sqrt;
    return select (has_length, Vector<V> { v / sqrt (square) }, v);
}

/// Like direction() of <vec3.hpp>.
template <typename V>
inline Vector<V> directionOf (const Vector<V>& v) noexcept
{
    const V most = largest (v);
    const auto has_length = most > 0.0;
    if (none (has_length)) return Vector<V>::Zero();
    return select (has_length, normalized (Vector<V> { v / most }), Vector<V> { Vector<V>::Zero() });
}

}   // namespace tactus
