// SPDX-License-Identifier: MIT
#pragma once

/// The memory of exported graphs. They take nothing from a heap: constant tables stay where the compiler puts them, and what `prepare`
/// computes lies in a fixed number of bytes within the graph. `tactus export` replaces the containers of the C++ library in the files
/// that it copies by those of this file.

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <map>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

// On an operating system, graphs in several threads can be made and prepared at the same time.
#if defined(__unix__) || defined(__APPLE__) || defined(_WIN32)
#define TACTUS_EXPORTED_THREAD_LOCAL thread_local
#else
#define TACTUS_EXPORTED_THREAD_LOCAL
#endif

namespace tactus::exported
{

/// Bytes that are given out one after another. The last piece can be given back; the others only all together.
class MemoryBlock
{
public:
    MemoryBlock (std::byte* first, std::size_t size) noexcept : begin (first), now (first), end (first + size) {}
    MemoryBlock (const MemoryBlock&) = delete;
    MemoryBlock& operator= (const MemoryBlock&) = delete;

    /// From now on, containers of this thread take their memory from this block.
    void use() noexcept { current = this; }

    void clear() noexcept { now = begin; }
    std::size_t used() const noexcept { return static_cast<std::size_t> (most - begin); }   ///< the most bytes so far

    /// Aborts if there is not enough: see Memory.
    static void* take (std::size_t bytes, std::size_t alignment) noexcept
    {
        if (current == nullptr) std::abort();
        const auto skipped = (alignment - reinterpret_cast<std::size_t> (current->now) % alignment) % alignment;
        if (static_cast<std::size_t> (current->end - current->now) < skipped + bytes) std::abort();
        auto* const place = current->now + skipped;
        current->now = place + bytes;
        current->most = std::max (current->most, current->now);
        return place;
    }

    static void give (void* place, std::size_t bytes) noexcept
    {
        auto* const first = static_cast<std::byte*> (place);
        if (current != nullptr && first >= current->begin && first + bytes == current->now) current->now = first;
    }

    /// Extends the piece that was taken last, if there is room. Returns false for any other piece.
    static bool extend (void* place, std::size_t bytes, std::size_t more) noexcept
    {
        if (current == nullptr || static_cast<std::byte*> (place) + bytes != current->now) return false;
        if (static_cast<std::size_t> (current->end - current->now) < more) return false;
        current->now += more;
        current->most = std::max (current->most, current->now);
        return true;
    }

private:
    static inline constinit TACTUS_EXPORTED_THREAD_LOCAL MemoryBlock* current = nullptr;
    std::byte *const begin, *now, *const end, *most = begin;
};

/// The memory of a graph: what its nodes need when they are made, and what `prepare` computes. `tactus export` has measured how many
/// bytes that is at the rate of the patch.
template <std::size_t bytes>
class Memory
{
public:
    static constexpr std::size_t memory_size = bytes;

    /// The most bytes of memory_size that were used so far.
    std::size_t memoryUsed() const noexcept { return block.used(); }

protected:
    Memory() noexcept { block.use(); }

    /// Puts these nodes into their initial state.
    template <typename... N>
    void renewAll (N&... nodes) noexcept
    {
        block.use();
        (std::destroy_at (&nodes), ...);
        block.clear();
        (std::construct_at (&nodes), ...);
    }

private:
    alignas (std::max_align_t) std::array<std::byte, bytes> own;
    MemoryBlock block { own.data(), bytes };
};

/// Lets containers of the C++ library use the memory of a graph.
template <typename T>
struct Allocator
{
    using value_type = T;

    Allocator() = default;
    template <typename U>
    Allocator (const Allocator<U>&) noexcept
    {
    }

    T* allocate (std::size_t n) noexcept { return static_cast<T*> (MemoryBlock::take (n * sizeof (T), alignof (T))); }
    void deallocate (T* place, std::size_t n) noexcept { MemoryBlock::give (place, n * sizeof (T)); }

    template <typename U>
    bool operator== (const Allocator<U>&) const noexcept
    {
        return true;
    }
};

template <typename T, typename... A>
std::shared_ptr<T> makeShared (A&&... arguments)
{
    return std::allocate_shared<T> (Allocator<std::remove_const_t<T>> {}, std::forward<A> (arguments)...);
}

template <typename Key, typename T>
using Map = std::map<Key, T, std::less<Key>, Allocator<std::pair<const Key, T>>>;

/// A std::vector in the memory of a graph, or over constant data. Copies are in the memory of the graph; a move copies nothing.
template <typename T>
class Vector
{
public:
    using value_type = T;
    using size_type = std::size_t;
    using difference_type = std::ptrdiff_t;
    using reference = T&;
    using const_reference = const T&;
    using iterator = T*;
    using const_iterator = const T*;

    constexpr Vector() noexcept = default;
    explicit Vector (std::size_t n)
    {
        if (n == 0) return;
        first = Allocator<T> {}.allocate (room = n);
        for (; count < n; ++count)
            std::construct_at (first + count);
    }
    Vector (std::size_t n, const T& value) { assign (n, value); }
#if defined(__GNUC__) && ! defined(__clang__) && __GNUC__ >= 12
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdangling-pointer"   // a false warning from GCC 12 where a list is the default of a member
#endif
    Vector (std::initializer_list<T> values) : Vector (values.begin(), values.end())
    {
    }
#if defined(__GNUC__) && ! defined(__clang__) && __GNUC__ >= 12
#pragma GCC diagnostic pop
#endif

    template <std::forward_iterator I>
    Vector (I from, I to)
    {
        reserve (static_cast<std::size_t> (std::distance (from, to)));
        for (; from != to; ++from)
            push_back (*from);
    }

    Vector (const Vector& other) : Vector (other.begin(), other.end()) {}
    constexpr Vector (Vector&& other) noexcept
        : first (std::exchange (other.first, nullptr)), count (std::exchange (other.count, 0)), room (std::exchange (other.room, 0))
    {
    }

    constexpr ~Vector()
    {
        if (room > 0) release();
    }

    Vector& operator= (const Vector& other)
    {
        if (this == &other) return *this;
        clear();
        reserve (other.size());
        for (const auto& value : other)
            push_back (value);
        return *this;
    }

    Vector& operator= (Vector&& other) noexcept
    {
        if (this == &other) return *this;
        if (room > 0) release();
        first = std::exchange (other.first, nullptr);
        count = std::exchange (other.count, 0);
        room = std::exchange (other.room, 0);
        return *this;
    }

    /// A vector over constant data, which must not be changed.
    static constexpr Vector over (const T* values, std::size_t n) noexcept
    {
        Vector all;
        all.first = const_cast<T*> (values);
        all.count = n;
        return all;
    }

    constexpr bool empty() const noexcept { return count == 0; }
    constexpr std::size_t size() const noexcept { return count; }
    constexpr T* data() noexcept { return first; }
    constexpr const T* data() const noexcept { return first; }
    constexpr T* begin() noexcept { return first; }
    constexpr T* end() noexcept { return first + count; }
    constexpr const T* begin() const noexcept { return first; }
    constexpr const T* end() const noexcept { return first + count; }
    std::reverse_iterator<T*> rbegin() noexcept { return std::reverse_iterator<T*> (end()); }
    std::reverse_iterator<T*> rend() noexcept { return std::reverse_iterator<T*> (begin()); }
    constexpr T& operator[] (std::size_t i) noexcept { return first[i]; }
    constexpr const T& operator[] (std::size_t i) const noexcept { return first[i]; }
    constexpr T& front() noexcept { return first[0]; }
    constexpr const T& front() const noexcept { return first[0]; }
    constexpr T& back() noexcept { return first[count - 1]; }
    constexpr const T& back() const noexcept { return first[count - 1]; }

    bool operator== (const Vector& other) const { return std::equal (begin(), end(), other.begin(), other.end()); }

    void push_back (const T& value) { emplace_back (value); }
    void push_back (T&& value) { emplace_back (std::move (value)); }

    template <typename... A>
    T& emplace_back (A&&... arguments)
    {
        T value = T (std::forward<A> (arguments)...);   // first, because it may be one of these values
        if (count == room) reserve (std::max<std::size_t> (1, 2 * room));
        return *std::construct_at (first + count++, std::move (value));
    }

    void pop_back() noexcept { std::destroy_at (first + --count); }

    void clear() noexcept
    {
        if (room == 0)
            first = nullptr;
        else
            std::destroy_n (first, count);
        count = 0;
    }

    void resize (std::size_t n)
    {
        if (n > room) reserve (n);
        for (; count < n; ++count)
            std::construct_at (first + count);
        for (; count > n; --count)
            std::destroy_at (first + count - 1);
    }

    void assign (std::size_t n, const T& value)
    {
        const T same = value;
        clear();
        reserve (n);
        for (; count < n; ++count)
            std::construct_at (first + count, same);
    }

    template <std::forward_iterator I>
    void assign (I from, I to)
    {
        *this = Vector (from, to);
    }

    iterator erase (const_iterator from, const_iterator to) noexcept
    {
        auto* const place = first + (from - first);
        std::move (first + (to - first), end(), place);
        for (auto n = to - from; n > 0; --n)
            pop_back();
        return place;
    }

    void reserve (std::size_t n)
    {
        if (n <= room) return;
        if (room > 0 && MemoryBlock::extend (first, room * sizeof (T), (n - room) * sizeof (T)))
        {
            room = n;
            return;
        }
        auto* const place = Allocator<T> {}.allocate (n);
        for (std::size_t i = 0; i < count; ++i)
            if (room > 0)
                std::construct_at (place + i, std::move (first[i]));
            else
                std::construct_at (place + i, std::as_const (first[i]));
        if (room > 0)
        {
            std::destroy_n (first, count);
            Allocator<T> {}.deallocate (first, room);
        }
        first = place;
        room = n;
    }

private:
    T* first = nullptr;
    std::size_t count = 0, room = 0;   // no room: empty, or constant data

    void release() noexcept
    {
        std::destroy_n (first, count);
        Allocator<T> {}.deallocate (first, room);
    }
};

/// A constant array as a vector.
template <typename T, std::size_t n>
constexpr Vector<T> over (const T (&values)[n]) noexcept
{
    return Vector<T>::over (values, n);
}

/// Points or matrices whose numbers are a constant array, one component after another.
template <typename T, std::size_t n>
Vector<T> groupsOver (const double (&numbers)[n]) noexcept
{
    static_assert (sizeof (T) % sizeof (double) == 0 && alignof (T) == alignof (double));
    return Vector<T>::over (reinterpret_cast<const T*> (numbers), n * sizeof (double) / sizeof (T));
}

/// A pointer to constant data, which needs no memory.
template <typename T>
std::shared_ptr<const T> pointerTo (const T& constant) noexcept
{
    return { std::shared_ptr<const T> {}, &constant };
}

/// A std::function in the memory of a graph.
template <typename Signature>
class Function;

template <typename R, typename... A>
class Function<R (A...)>
{
public:
    Function() = default;

    template <typename F>
    requires (! std::is_same_v<std::remove_cvref_t<F>, Function> && std::is_invocable_r_v<R, const std::remove_cvref_t<F>&, A...>)
        Function (F&& f) : held (makeShared<const std::remove_cvref_t<F>> (std::forward<F> (f))), call (&callOf<std::remove_cvref_t<F>>)
    {
    }

    explicit operator bool() const noexcept { return call != nullptr; }
    R operator() (A... arguments) const { return call (held.get(), std::forward<A> (arguments)...); }

private:
    std::shared_ptr<const void> held;
    R (*call)
    (const void*, A...) = nullptr;

    template <typename F>
    static R callOf (const void* f, A... arguments)
    {
        return (*static_cast<const F*> (f)) (std::forward<A> (arguments)...);
    }
};

/// Names of axes or buttons. The texts must stay valid, as string literals do.
class NameList
{
public:
    static constexpr std::size_t most = 32;

    constexpr NameList() noexcept = default;
    constexpr NameList (std::initializer_list<std::string_view> names) noexcept : count (std::min (names.size(), most))
    {
        std::copy_n (names.begin(), count, all.begin());
    }

    constexpr std::size_t size() const noexcept { return count; }
    constexpr bool empty() const noexcept { return count == 0; }
    constexpr std::string_view operator[] (std::size_t i) const noexcept { return all[i]; }
    constexpr const std::string_view* begin() const noexcept { return all.data(); }
    constexpr const std::string_view* end() const noexcept { return all.data() + count; }
    bool operator== (const NameList& other) const noexcept { return std::equal (begin(), end(), other.begin(), other.end()); }

private:
    std::array<std::string_view, most> all {};
    std::size_t count = 0;
};

}   // namespace tactus::exported
