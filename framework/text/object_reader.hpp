// SPDX-License-Identifier: MIT
#pragma once

#include "json.hpp"
#include "message.hpp"
#include "quantity.hpp"

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// The allowed range of a number. The message about a number out of range states it.
struct Bounds
{
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool without_min = false;   ///< min itself is not allowed, as for a mass

    static constexpr Bounds positive() { return { .min = 0.0, .without_min = true }; }
    static constexpr Bounds notNegative() { return { .min = 0.0 }; }
};

/// Reads the keys of one JSON object, such as the description of a device, with one call per key. A missing key gives the default;
/// a wrong value gives the default and a message, and reading continues, so that all problems are found. After all known keys
/// have been read, finish() reports the rest.
///
/// Numbers are SI, or strings with a unit, which is checked and converted. Each message id is the prefix followed by kind, unit,
/// out_of_range, missing, unknown_key or more; `where` is a JSON pointer. For files whose keys must keep their order, see
/// OrderedReader.
class ObjectReader
{
public:
    /// `prefix` is the first part of the message ids; it must be a literal.
    ObjectReader (const Json& object, std::string where, Messages&, std::string_view prefix = "device/");

    bool has (std::string_view key) const { return object_here.contains (key); }

    double number (std::string_view key, const Unit&, Bounds, double otherwise);
    int whole (std::string_view key, int min, int max, int otherwise);
    std::string text (std::string_view key);     ///< empty if missing; must not be empty in the file
    const Json& object (std::string_view key);   ///< any value; an empty object if missing
    bool flag (std::string_view key, bool otherwise = false);

    /// A list of x, y and z. The vector is any type that can be constructed from three numbers.
    template <typename Vector>
    Vector vector (std::string_view key, const Unit& unit, const Vector& otherwise)
    {
        std::array<double, 3> v {};
        return readVector (key, unit, v) ? Vector (v[0], v[1], v[2]) : otherwise;
    }

    /// A list; null if missing or not a list. `what` names the entries in the message.
    const Json* list (std::string_view key, std::string_view what);
    std::vector<std::string> texts (std::string_view key);
    std::vector<double> numbers (std::string_view key);   ///< leaves out, and reports, entries that are not finite numbers

    void require (std::string_view key, std::string_view remedy);   ///< reports the key if it is missing
    void ignore (std::string_view key);                             ///< marks a key as known without reading it
    void finish();                                                  ///< reports the keys that are not known, and lists at most 100 of them

    void error (std::string_view key, std::string id, std::string text, std::string remedy);

    std::string pointer (std::string_view key) const;   ///< JSON pointer to a member
    const Json& json() const noexcept { return given; }
    const std::string& where() const noexcept { return here; }
    Messages& messages() noexcept { return all_messages; }

private:
    const Json* find (std::string_view key);
    void add (Message);
    bool measure (const Json&, const std::string& where, const Unit&, double& value);
    bool readVector (std::string_view key, const Unit&, std::array<double, 3>& value);
    std::string messageId (std::string_view what) const { return std::string (prefix).append (what); }

    const Json &given, &object_here;   // object_here: empty if the given value is not an object
    std::string here;
    Messages& all_messages;
    std::string_view prefix;
    std::vector<std::string> known;
    bool is_full = false;   // the message list; the message about this has been added
};

}   // namespace tactus
