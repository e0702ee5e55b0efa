// SPDX-License-Identifier: MIT
#pragma once

#include "node.hpp"

#include <memory>
#include <span>
#include <string>
#include <utility>

namespace tactus
{

/// A shelf for data that nodes compute from their settings before they run, such as the smooth surface of a mesh. Plans with the same settings share the
/// data for as long as one of them lives. [any thread but the tick thread]
class PreparedData
{
public:
    /// The name of some data, which must depend on nothing else.
    struct Key
    {
        std::shared_ptr<const void> source {};   ///< an object that they are computed from; may be null
        std::string rest {};                     ///< all else that they depend on
        const void* type = nullptr;              ///< the same address for data of the same type only
    };

    /// The event that ends the life of some data.
    enum class Until
    {
        unused,     ///< no plan uses them any more
        no_source   ///< their source is gone; they must not refer to it
    };

    virtual ~PreparedData() = default;
    virtual std::shared_ptr<const void> find (const Key&) = 0;   ///< null if there are none, or if they are no longer in use
    virtual void keep (const Key&, const std::shared_ptr<const void>&, Until) = 0;
};

/// The data of a type, a source and all else that they depend on, which `rest` returns as the text of a key. `make` computes them, as a shared pointer,
/// unless the shelf has them. Without a shelf, only `make` is called.
template <typename T, typename Rest, typename Make>
std::shared_ptr<const T> prepared (PreparedData* shelf, std::shared_ptr<const void> source, Rest&& rest, Make&& make,
                                   PreparedData::Until until = PreparedData::Until::unused)
{
    static constexpr char type = 0;
    if (shelf == nullptr) return make();
    const PreparedData::Key key { std::move (source), rest(), &type };
    if (auto known = std::static_pointer_cast<const T> (shelf->find (key))) return known;
    std::shared_ptr<const T> made = make();
    shelf->keep (key, made, until);
    return made;
}

/// Numbers as the text of a key: all their bits.
inline std::string keyOf (std::span<const double> numbers)
{
    return { reinterpret_cast<const char*> (numbers.data()), sizeof (double) * numbers.size() };
}

}   // namespace tactus
