// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>

namespace tactus::plan
{

/// A list that gets its size when it is made. Up to `few` elements are inside the list itself, so that they need no extra memory. It
/// cannot be copied or moved, and so may hold atomics.
template <typename T, std::size_t few>
class InlineArray
{
public:
    explicit InlineArray (std::size_t n) : count (n), many (n > few ? std::make_unique<T[]> (n) : nullptr), first (many ? many.get() : own.data()) {}
    InlineArray (const InlineArray&) = delete;
    InlineArray& operator= (const InlineArray&) = delete;

    std::size_t size() const noexcept { return count; }
    bool empty() const noexcept { return count == 0; }
    T& operator[] (std::size_t i) noexcept { return first[i]; }
    const T& operator[] (std::size_t i) const noexcept { return first[i]; }
    T* begin() noexcept { return first; }
    T* end() noexcept { return first + count; }
    const T* begin() const noexcept { return first; }
    const T* end() const noexcept { return first + count; }

private:
    std::size_t count;
    std::array<T, few> own {};
    std::unique_ptr<T[]> many;
    T* first;
};

}   // namespace tactus::plan
