// SPDX-License-Identifier: MIT
#pragma once

#include "at.hpp"

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tactus
{

/// The bytes of a state, while it is saved or restored. A class that has state lists its members once, and both directions use the list:
///
///     void serialize (auto& archive) { archive (past, dissipated); }
///
/// A member is a number, an enum, a vector or matrix of Eigen, a complex number, an array, an optional, a std::vector whose size does not change while
/// the graph runs, a plain struct of these, or a class with a function serialize of its own. Anything else does not compile: a pointer is not state.
///
/// Nothing that was read is trusted with an address: a std::vector keeps its size, and index() keeps an index in its range. What does not fit is
/// refused, and the rest is then left as it is.
class StateArchive
{
public:
    explicit StateArchive (std::vector<std::byte>& bytes) noexcept : to (&bytes) {}       ///< saves: adds to the end
    explicit StateArchive (std::span<const std::byte> bytes) noexcept : from (bytes) {}   ///< restores

    bool restores() const noexcept { return to == nullptr; }

    template <typename... T>
    void operator() (T&... members)
    {
        (visit (members), ...);
    }

    /// An index that must stay in its range, from `lowest`.
    template <typename I>
    void index (I& i, std::size_t size, I lowest = 0)
    {
        I read = i;
        visit (read);
        if (! (read >= lowest && (read < I {} || static_cast<std::size_t> (read) < size))) return refuse ("has an index that is out of range");
        i = read;
    }

    /// A number that must be the same when the state is restored, such as a size.
    void expect (std::uint64_t number)
    {
        std::uint64_t read = number;
        raw (&read, sizeof read);
        if (read != number) refuse ("has another size");
    }

    /// Names what comes next, for refusals: its kind, such as "node", and its name, which must outlive the archive.
    void enter (std::string_view kind_, std::string_view name_) noexcept
    {
        kind = kind_;
        name = name_;
    }

    /// The state cannot be saved, or cannot be restored here. The first reason counts. It follows the name: "the node 'drag' " …
    void refuse (std::string_view why)
    {
        if (reason.empty()) reason = "the " + std::string (kind) + (name.empty() ? "" : " '" + std::string (name) + "'") + " " + std::string (why);
    }

    bool isRefused() const noexcept { return ! reason.empty(); }
    const std::string& refusal() const noexcept { return reason; }

    /// True once all bytes have been read.
    bool isAtEnd() const noexcept { return from.empty(); }

private:
    struct Anything
    {
        template <typename T>
        operator T() const;   // never called: it only counts the members of a struct
    };

    template <typename T, typename... Before>
    static consteval std::size_t fieldCount()
    {
        if constexpr (requires { T { Before {}..., Anything {} }; })
            return fieldCount<T, Before..., Anything>();
        else
            return sizeof...(Before);
    }

    template <typename T>
    void visit (T& value)
    {
        if constexpr (requires { value.serialize (*this); })
            value.serialize (*this);
        else if constexpr (std::is_same_v<T, bool>)
        {
            auto byte = static_cast<std::uint8_t> (value);
            raw (&byte, 1);
            if (byte > 1) return refuse ("has a flag that is neither true nor false");
            value = byte == 1;
        }
        else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
            raw (&value, sizeof value);
        else if constexpr (requires { value.vec(); value.w(); })
            visit (value.coeffs());   // a quaternion
        else if constexpr (requires { T::SizeAtCompileTime; value.data(); })
        {
            static_assert (int { T::SizeAtCompileTime } > 0, "a matrix has a fixed size");
            raw (value.data(), sizeof (typename T::Scalar) * static_cast<std::size_t> (int { T::SizeAtCompileTime }));
        }
        else
            visitCompound (value);
    }

    template <typename T>
    void visit (std::complex<T>& value)
    {
        T parts[] { value.real(), value.imag() };
        raw (parts, sizeof parts);
        value = { parts[0], parts[1] };
    }

    template <typename T, std::size_t n>
    void visit (std::array<T, n>& all)
    {
        visitAll (all.data(), n);
    }

    template <typename T, std::size_t n>
    void visit (T (&all)[n])
    {
        visitAll (all, n);
    }

    template <typename T>
    void visit (std::vector<T>& all)
    {
        expect (all.size());
        if (! isRefused()) visitAll (all.data(), all.size());
    }

    template <typename T>
    void visit (std::optional<T>& value)
    {
        bool has = value.has_value();
        visit (has);
        if (restores() && ! isRefused() && has != value.has_value()) has ? void (value.emplace()) : value.reset();
        if (value) visit (*value);
    }

    template <typename T>
    void visitAll (T* all, std::size_t n)
    {
        if constexpr (std::is_arithmetic_v<T> && ! std::is_same_v<T, bool>)
            raw (all, n * sizeof (T));
        else
            for (std::size_t i = 0; i < n; ++i)
                visit (all[i]);
    }

    template <typename T>
    void visitCompound (T& value)
    {
        static_assert (std::is_aggregate_v<T>, "a class that is not a plain struct lists its state in a function serialize (auto& archive)");
        constexpr auto count = fieldCount<T>();
        static_assert (count >= 1 && count <= 20, "list the members in a function serialize (auto& archive)");
#define TACTUS_FIELDS(n, ...)         \
    if constexpr (count == n)         \
    {                                 \
        auto& [__VA_ARGS__] = value;  \
        return (*this) (__VA_ARGS__); \
    }
        TACTUS_FIELDS (1, a)
        TACTUS_FIELDS (2, a, b)
        TACTUS_FIELDS (3, a, b, c)
        TACTUS_FIELDS (4, a, b, c, d)
        TACTUS_FIELDS (5, a, b, c, d, e)
        TACTUS_FIELDS (6, a, b, c, d, e, f)
        TACTUS_FIELDS (7, a, b, c, d, e, f, g)
        TACTUS_FIELDS (8, a, b, c, d, e, f, g, h)
        TACTUS_FIELDS (9, a, b, c, d, e, f, g, h, i)
        TACTUS_FIELDS (10, a, b, c, d, e, f, g, h, i, j)
        TACTUS_FIELDS (11, a, b, c, d, e, f, g, h, i, j, k)
        TACTUS_FIELDS (12, a, b, c, d, e, f, g, h, i, j, k, l)
        TACTUS_FIELDS (13, a, b, c, d, e, f, g, h, i, j, k, l, m)
        TACTUS_FIELDS (14, a, b, c, d, e, f, g, h, i, j, k, l, m, n_)
        TACTUS_FIELDS (15, a, b, c, d, e, f, g, h, i, j, k, l, m, n_, o)
        TACTUS_FIELDS (16, a, b, c, d, e, f, g, h, i, j, k, l, m, n_, o, p)
        TACTUS_FIELDS (17, a, b, c, d, e, f, g, h, i, j, k, l, m, n_, o, p, q)
        TACTUS_FIELDS (18, a, b, c, d, e, f, g, h, i, j, k, l, m, n_, o, p, q, r)
        TACTUS_FIELDS (19, a, b, c, d, e, f, g, h, i, j, k, l, m, n_, o, p, q, r, s)
        TACTUS_FIELDS (20, a, b, c, d, e, f, g, h, i, j, k, l, m, n_, o, p, q, r, s, t)
#undef TACTUS_FIELDS
    }

    void raw (void* value, std::size_t size)
    {
        if (to != nullptr)
        {
            const auto* bytes = static_cast<const std::byte*> (value);
            to->insert (to->end(), bytes, bytes + size);
            return;
        }
        if (isRefused()) return;
        if (from.size() < size) return refuse ("needs more bytes than there are");
        if (size > 0) std::memcpy (value, from.data(), size);
        from = from.subspan (size);
    }

    std::vector<std::byte>* to = nullptr;   // null: it restores
    std::span<const std::byte> from {};     // what has not been read yet
    std::string_view kind = "state", name {};
    std::string reason;
};

}   // namespace tactus
