// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/json.hpp>
#include <framework/list.hpp>
#include <framework/message.hpp>
#include <framework/number_text.hpp>
#include <framework/quantity.hpp>

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// What a number may be. The sentences of Fields are made from it.
struct Bounds
{
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool without_min = false;   ///< the smallest value itself is not allowed, as for a mass

    static constexpr Bounds positive() { return { .min = 0.0, .without_min = true }; }
    static constexpr Bounds notNegative() { return { .min = 0.0 }; }
};

/// Reads the fields of one object in a description, one call a field, and keeps a message for whatever is wrong with
/// each. A field that is wrong or not there gives the value it would have without being written, so that reading goes
/// on and finds the rest. Once all known fields have been asked for, finish() names the ones nobody asked for.
///
/// Numbers are SI, or text with a unit that is checked and converted. Ids: device/kind, device/unit,
/// device/out_of_range, device/missing, device/unknown_key; `where` is a JSON pointer.
class Fields
{
public:
    Fields (const Json& what, std::string where, Messages&);

    bool has (std::string_view key) const;
    double number (std::string_view key, const Unit&, Bounds, double otherwise);
    int whole (std::string_view key, int min, int max, int otherwise);
    Vec3 vector (std::string_view key, const Unit&, const Vec3& otherwise);
    std::string text (std::string_view key);     ///< empty if it is not there
    const Json& object (std::string_view key);   ///< an empty object if it is not there

    void require (std::string_view key, std::string_view remedy);
    void ignore (std::string_view key);
    void finish();

    void error (std::string_view key, std::string id, std::string text, std::string remedy);

private:
    const Json* find (std::string_view key);
    bool measure (const Json&, const std::string& pointer, const Unit&, double& value);

    const Json& fields;
    std::string here;
    Messages& messages;
    std::vector<std::string> known;
};

/// "did you mean 'damping'?", or the whole list where nothing is near.
std::string suggestion (std::string_view name, std::span<const std::string> names);

}   // namespace tactus::host
