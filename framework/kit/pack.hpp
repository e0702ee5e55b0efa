// SPDX-License-Identifier: MIT
#pragma once

#include "lanes.hpp"
#include "list.hpp"
#include "math/lane.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <tuple>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

/// Several doubles that take the place of one in a node that is a template over its scalar. Every operation gives the same bits in each
/// lane as with a single double.
///
/// A file that includes this is compiled for one kind of processor (nodes/CMakeLists.txt), and code for another kind must not call its
/// functions. So each function here has the width in its type, and the linker cannot mix them up: 2 is for any processor, 4 for AVX2, 8 for
/// AVX-512.
namespace tactus
{

#define TACTUS_INLINE __attribute__ ((always_inline)) inline

/// The vectors of the compiler.
template <int W>
struct VectorTypes;

#define TACTUS_VECTOR_TYPES(W)                                             \
    template <>                                                            \
    struct VectorTypes<W>                                                  \
    {                                                                      \
        typedef double Doubles __attribute__ ((vector_size (8 * W)));      \
        typedef std::int64_t Bits __attribute__ ((vector_size (8 * W)));   \
        typedef std::uint64_t Words __attribute__ ((vector_size (8 * W))); \
    };
TACTUS_VECTOR_TYPES (2)
TACTUS_VECTOR_TYPES (4)
TACTUS_VECTOR_TYPES (8)
#undef TACTUS_VECTOR_TYPES

/// A bool for each lane.
template <int W>
struct Mask
{
    using Bits = typename VectorTypes<W>::Bits;   // 0 or -1 in each lane

    Bits bits {};

    friend TACTUS_INLINE Mask operator&& (Mask a, Mask b) noexcept { return { a.bits & b.bits }; }
    friend TACTUS_INLINE Mask operator|| (Mask a, Mask b) noexcept { return { a.bits | b.bits }; }
    friend TACTUS_INLINE Mask operator& (Mask a, Mask b) noexcept { return { a.bits & b.bits }; }
    friend TACTUS_INLINE Mask operator| (Mask a, Mask b) noexcept { return { a.bits | b.bits }; }
    friend TACTUS_INLINE Mask operator!(Mask a) noexcept { return { ~a.bits }; }
};

/// A double for each lane.
template <int W>
struct Pack
{
    using Doubles = typename VectorTypes<W>::Doubles;
    static constexpr int width = W;

    Doubles v {};

    Pack() = default;
    TACTUS_INLINE Pack (Doubles d) noexcept : v (d) {}
    TACTUS_INLINE Pack (double x) noexcept : v (x - Doubles {}) {}   // minus, because 0 + -0 is not -0

    static TACTUS_INLINE Pack load (const double* from) noexcept
    {
        Pack p;
        std::memcpy (&p.v, from, sizeof p.v);
        return p;
    }

    TACTUS_INLINE double operator[] (std::size_t lane) const noexcept { return v[lane]; }

    friend TACTUS_INLINE Pack operator+ (Pack a, Pack b) noexcept { return a.v + b.v; }
    friend TACTUS_INLINE Pack operator- (Pack a, Pack b) noexcept { return a.v - b.v; }
    friend TACTUS_INLINE Pack operator* (Pack a, Pack b) noexcept { return a.v * b.v; }
    friend TACTUS_INLINE Pack operator/ (Pack a, Pack b) noexcept { return a.v / b.v; }
    friend TACTUS_INLINE Pack operator- (Pack a) noexcept { return -a.v; }
    TACTUS_INLINE Pack& operator+= (Pack b) noexcept { return *this = *this + b; }
    TACTUS_INLINE Pack& operator-= (Pack b) noexcept { return *this = *this - b; }
    TACTUS_INLINE Pack& operator*= (Pack b) noexcept { return *this = *this * b; }
    TACTUS_INLINE Pack& operator/= (Pack b) noexcept { return *this = *this / b; }

    friend TACTUS_INLINE Mask<W> operator<(Pack a, Pack b) noexcept { return { a.v < b.v }; }
    friend TACTUS_INLINE Mask<W> operator<= (Pack a, Pack b) noexcept { return { a.v <= b.v }; }
    friend TACTUS_INLINE Mask<W> operator> (Pack a, Pack b) noexcept { return { a.v > b.v }; }
    friend TACTUS_INLINE Mask<W> operator>= (Pack a, Pack b) noexcept { return { a.v >= b.v }; }
    friend TACTUS_INLINE Mask<W> operator== (Pack a, Pack b) noexcept { return { a.v == b.v }; }
    friend TACTUS_INLINE Mask<W> operator!= (Pack a, Pack b) noexcept { return { a.v != b.v }; }

    /// An enum for each lane, as ChoiceOf<Pack, E>.
    template <typename E>
    struct Choice
    {
        using Enum = E;

        typename Mask<W>::Bits numbers {};

        Choice() = default;
        TACTUS_INLINE Choice (E e) noexcept : numbers (typename Mask<W>::Bits {} + static_cast<std::int64_t> (e)) {}

        friend TACTUS_INLINE Mask<W> operator== (Choice a, Choice b) noexcept { return { a.numbers == b.numbers }; }
        friend TACTUS_INLINE Mask<W> operator!= (Choice a, Choice b) noexcept { return { a.numbers != b.numbers }; }
        friend TACTUS_INLINE Choice select (Mask<W> where, Choice yes, Choice no) noexcept
        {
            yes.numbers = where.bits ? yes.numbers : no.numbers;
            return yes;
        }
    };
};

/// Plain numbers are accepted, too.
template <int W>
TACTUS_INLINE Pack<W> select (Mask<W> where, std::type_identity_t<Pack<W>> yes, std::type_identity_t<Pack<W>> no) noexcept
{
    return where.bits ? yes.v : no.v;
}

/// The same for comparisons of words, as in the elementary functions.
template <int W>
TACTUS_INLINE Pack<W> select (typename Mask<W>::Bits where, Pack<W> yes, Pack<W> no) noexcept
{
    return where ? yes.v : no.v;
}

template <int W>
TACTUS_INLINE Mask<W> select (Mask<W> where, Mask<W> yes, Mask<W> no) noexcept
{
    return { (where.bits & yes.bits) | (~where.bits & no.bits) };
}

template <typename V>
TACTUS_INLINE Vector<V> select (MaskOf<V> where, const Vector<V>& yes, const Vector<V>& no) noexcept
{
    return { select (where, yes.x(), no.x()), select (where, yes.y(), no.y()), select (where, yes.z(), no.z()) };
}

// clang-format 14 breaks requirements badly.
// clang-format off
template <typename S>
concept ListsMembers = requires (S s) { s.members(); };

template <typename S, int W>
concept OfPacks = std::is_aggregate_v<S> && ! ListsMembers<S> && sizeof (S) % sizeof (Pack<W>) == 0;
// clang-format on

/// Chooses between two structs that consist of packs.
template <int W, OfPacks<W> S>
TACTUS_INLINE S select (Mask<W> where, const S& yes, const S& no) noexcept
{
    S chosen = yes;
    auto* to = reinterpret_cast<Pack<W>*> (&chosen);
    const auto* other = reinterpret_cast<const Pack<W>*> (&no);
    for (std::size_t i = 0; i < sizeof (S) / sizeof (Pack<W>); ++i)
        to[i] = select (where, to[i], other[i]);
    return chosen;
}

/// Chooses between two structs that list their members.
template <int W, ListsMembers S>
TACTUS_INLINE S select (Mask<W> where, const S& yes, const S& no) noexcept
{
    S chosen = yes;
    const auto put = [where] (auto& to, const auto& other) { to = select (where, to, other); };
    const auto to = chosen.members();
    const auto other = no.members();
    [&]<std::size_t... i> (std::index_sequence<i...>) { (put (std::get<i> (to), std::get<i> (other)), ...); }
    (std::make_index_sequence<std::tuple_size_v<decltype (to)>> {});
    return chosen;
}

//==============================================================================
// The functions of <lanes.hpp>, <math/lane.hpp> and <vec3.hpp> for packs.

template <int W>
TACTUS_INLINE bool any (Mask<W> mask) noexcept
{
#if defined(__AVX512F__)
    if constexpr (W == 8) return _mm512_test_epi64_mask (reinterpret_cast<__m512i> (mask.bits), reinterpret_cast<__m512i> (mask.bits)) != 0;
#endif
#if defined(__AVX__)
    if constexpr (W == 4) return _mm256_movemask_pd (reinterpret_cast<__m256d> (mask.bits)) != 0;
#endif
#if defined(__SSE2__)
    if constexpr (W == 2) return _mm_movemask_pd (reinterpret_cast<__m128d> (mask.bits)) != 0;
#endif
    std::int64_t found = 0;
    for (std::size_t i = 0; i < W; ++i)
        found |= mask.bits[i];
    return found != 0;
}

template <int W>
TACTUS_INLINE bool none (Mask<W> mask) noexcept
{
    return ! any (mask);
}

template <int W>
TACTUS_INLINE bool every (Mask<W> mask) noexcept
{
    return ! any (! mask);
}

template <int W>
TACTUS_INLINE bool isSet (const Mask<W>& mask, std::size_t i) noexcept
{
    return mask.bits[i] != 0;
}

template <int W>
TACTUS_INLINE void setLane (Pack<W>& x, std::size_t i, double to) noexcept
{
    x.v[i] = to;
}

template <int W>
TACTUS_INLINE Pack<W> magnitude (Pack<W> x) noexcept
{
    return math::magnitude (x);
}

template <int W>
TACTUS_INLINE Pack<W> sqrt (Pack<W> x) noexcept
{
#if defined(__AVX512F__)
    if constexpr (W == 8) return typename Pack<W>::Doubles (_mm512_sqrt_pd (x.v));
#endif
#if defined(__AVX__)
    if constexpr (W == 4) return typename Pack<W>::Doubles (_mm256_sqrt_pd (x.v));
#endif
#if defined(__SSE2__)
    if constexpr (W == 2) return typename Pack<W>::Doubles (_mm_sqrt_pd (x.v));
#endif
    for (std::size_t i = 0; i < W; ++i)
        x.v[i] = __builtin_sqrt (x.v[i]);
    return x;
}

template <int W>
TACTUS_INLINE Mask<W> isFinite (Pack<W> x) noexcept
{
    return x - x == 0.0;
}

/// Checks all three components at once: an infinity or NaN among them makes the sum NaN.
template <int W>
TACTUS_INLINE Mask<W> isFinite (const Vector<Pack<W>>& v) noexcept
{
    return (v.x() - v.x()) + (v.y() - v.y()) + (v.z() - v.z()) == 0.0;
}

#undef TACTUS_INLINE
}   // namespace tactus

template <int W>
struct tactus::math::Word<tactus::Pack<W>>
{
    using type = typename tactus::VectorTypes<W>::Words;
};

/// Eigen unrolls sums by these costs, and the order of terms depends on it, so they are those of double.
template <int W>
struct Eigen::NumTraits<tactus::Pack<W>> : Eigen::GenericNumTraits<double>
{
    using Real = tactus::Pack<W>;
    using NonInteger = Real;
    using Nested = Real;
    using Literal = Real;
};
