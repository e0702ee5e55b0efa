// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// A list whose copies share what they have in common. After a small edit, the new plan is a copy of the previous one with a few changes,
/// so copying must be cheap: a copy takes one pointer for each chunk, and a change copies only the chunk that it is in. Elements do not
/// move when others are added.
template <typename T>
class Chunks
{
    static constexpr std::size_t bits = 6, chunk = std::size_t { 1 } << bits, within = chunk - 1;
    using Chunk = std::array<T, chunk>;

    template <typename List>
    class Walk
    {
    public:
        using iterator_category = std::random_access_iterator_tag;
        using value_type = T;
        using difference_type = std::ptrdiff_t;
        using reference = const T&;
        using pointer = const T*;

        Walk() = default;
        Walk (const List& l, difference_type i) noexcept : list (&l), index (i) {}

        reference operator*() const noexcept { return (*list)[static_cast<std::size_t> (index)]; }
        pointer operator->() const noexcept { return &**this; }
        reference operator[] (difference_type n) const noexcept { return *(*this + n); }
        Walk& operator+= (difference_type n) noexcept
        {
            index += n;
            return *this;
        }
        Walk& operator-= (difference_type n) noexcept { return *this += -n; }
        Walk& operator++() noexcept { return *this += 1; }
        Walk& operator--() noexcept { return *this -= 1; }
        Walk operator++ (int) noexcept { return std::exchange (*this, *this + 1); }
        Walk operator-- (int) noexcept { return std::exchange (*this, *this - 1); }
        friend Walk operator+ (Walk a, difference_type n) noexcept { return a += n; }
        friend Walk operator+ (difference_type n, Walk a) noexcept { return a += n; }
        friend Walk operator- (Walk a, difference_type n) noexcept { return a -= n; }
        friend difference_type operator- (const Walk& a, const Walk& b) noexcept { return a.index - b.index; }
        bool operator== (const Walk& other) const noexcept { return index == other.index; }
        auto operator<=> (const Walk& other) const noexcept { return index <=> other.index; }

    private:
        const List* list = nullptr;
        difference_type index = 0;
    };

public:
    using value_type = T;
    using const_iterator = Walk<Chunks>;

    std::size_t size() const noexcept { return count; }
    bool empty() const noexcept { return count == 0; }
    void reserve (std::size_t n) { all.reserve ((n + within) >> bits); }

    const T& operator[] (std::size_t i) const noexcept { return (*all[i >> bits])[i & within]; }
    const T& back() const noexcept { return (*this)[count - 1]; }
    const_iterator begin() const noexcept { return { *this, 0 }; }
    const_iterator end() const noexcept { return { *this, static_cast<std::ptrdiff_t> (count) }; }

    /// An element to change. If its chunk is shared, this list copies the chunk first.
    T& change (std::size_t i)
    {
        auto& mine = all[i >> bits];
        if (mine.use_count() > 1) mine = std::make_shared<Chunk> (*mine);
        return (*mine)[i & within];
    }

    /// Adds a new element at the end, initialised as by T {}.
    T& add()
    {
        if (count == all.size() << bits) all.push_back (newChunk());
        return change (count++);
    }

    T& add (T item) { return add() = std::move (item); }

    /// Removes the last element.
    void drop()
    {
        change (count - 1) = T {};
        if ((--count & within) == 0) all.pop_back();
    }

    /// Adds default-constructed elements, or removes the last ones.
    void resize (std::size_t n)
    {
        reserve (n);
        while (count > n)
            drop();
        for (; all.size() << bits < n;)
            all.push_back (newChunk());
        count = n;
    }

private:
    /// With elements initialised as by T {}. If T has a constructor, there is no need to fill the chunk with zeros first.
    static std::shared_ptr<Chunk> newChunk()
    {
        if constexpr (std::is_trivially_default_constructible_v<T>)
            return std::make_shared<Chunk>();
        else
            return std::make_shared_for_overwrite<Chunk>();
    }

    std::vector<std::shared_ptr<Chunk>> all;
    std::size_t count = 0;
};

}   // namespace tactus::plan
