// SPDX-License-Identifier: MIT
#pragma once

/// Type-erased settings: the closed set of kinds that files, editors and generated code know.
///
///     member of Settings                kind       in a file
///     double, int, std::uint64_t        number     0.4, "0.4 mm"
///     std::string                       text       "in[0] * 2"
///     Vec3                              vector     [0, 0, 1]
///     std::vector<double>               numbers    [1, -0.9]
///     Curve                             curve      [[x…], [y…]]
///     Law                               law        {"power": [k, n]}
///     a struct with fields              record     {"rate": 8000, …}
///     std::vector of these              records    [{…}, …]
///     std::shared_ptr<const Signal>     signal     "tap.wav"
///     Image, Sheet                      image      "bark.png"; table "scan.csv"
///     std::shared_ptr<const Surface>    surface    {"mesh": "liver.obj", "curves": …, "mu": …}

#include "datasheet.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace tactus
{

struct SettingValue;
using Values = std::vector<SettingValue>;   ///< the values of a record, in the order of its fields
using Records = std::vector<Values>;

// clang-format off
struct SettingValue : std::variant<double, std::string, Vec3, std::vector<double>, Curve, Law, Values, Records,
                                   std::shared_ptr<const Signal>, Image, Sheet, std::shared_ptr<const Surface>>
// clang-format on
{
    using variant::variant;

    // Each visits all alternatives: a second of compile time in every source that did it inline.
    SettingValue() noexcept;
    SettingValue (const SettingValue&);
    SettingValue (SettingValue&&) noexcept;
    SettingValue& operator= (const SettingValue&);
    SettingValue& operator= (SettingValue&&) noexcept;
    ~SettingValue();
};

/// A row of the datasheet for a setting, or a field of a record.
struct SettingSheet
{
    enum class Kind
    {
        number,
        integer,
        text,
        vector,
        numbers,
        curve,
        law,
        record,
        records,
        signal,
        image,
        table,
        surface
    };

    Kind kind;
    std::string_view id;
    UnitRule unit;     ///< unit of the number, or of the curve's or law's value
    UnitRule x_unit;   ///< unit of the curve's or law's argument
    std::string_view about;
    Limits limits;
    std::vector<SettingSheet> fields;   ///< fields of the record, or of each of the records
    SettingValue initial;
    std::function<void (void* node, const SettingValue&)> set;   ///< takes the alternative of `kind`, integers as double; null for a field

    void describe (std::string_view id_, UnitRule unit_, std::string_view about_, Limits limits_) noexcept
    {
        id = id_;
        unit = unit_;
        about = about_;
        limits = limits_;
    }
};

constexpr std::string_view name (SettingSheet::Kind k) noexcept
{
    constexpr std::string_view names[] = { "number", "whole number", "text", "vector", "numbers", "curve", "law",
                                           "record", "records", "signal", "image", "table", "surface" };
    return names[static_cast<int> (k)];
}

//==============================================================================
// Implementation below.

namespace detail
{
template <typename T>
concept IsRecord = requires
{
    T::fields;
};

template <typename T>
concept IsRecords = requires
{
    requires IsRecord<typename T::value_type>;
};

/// Assigns a value to its member.
template <typename T>
void assign (T& target, const SettingValue& value)
{
    if constexpr (std::is_arithmetic_v<T>)
        target = static_cast<T> (std::get<double> (value));
    else if constexpr (IsRecord<T>)
    {
        std::size_t i = 0;
        const auto& record = std::get<Values> (value);
        std::apply ([&] (const auto&... f) { (assign (target.*f.member, record[i++]), ...); },
                    T::fields);
    }
    else if constexpr (IsRecords<T>)
    {
        target.clear();
        for (const auto& record : std::get<Records> (value))
            assign (target.emplace_back(), SettingValue { record });
    }
    else
        target = std::get<T> (value);
}

/// The value of a member, type-erased.
template <typename T>
SettingValue valueOf (const T& member)
{
    if constexpr (std::is_arithmetic_v<T>)
        return static_cast<double> (member);
    else if constexpr (IsRecord<T>)
        return std::apply ([&] (const auto&... f) { return Values { valueOf (member.*f.member)... }; },
                           T::fields);
    else if constexpr (IsRecords<T>)
    {
        Records all;
        for (const auto& record : member)
            all.push_back (std::get<Values> (valueOf (record)));
        return all;
    }
    else
        return member;
}

template <typename T>
constexpr SettingSheet::Kind kindOf()
{
    using Kind = SettingSheet::Kind;
    if constexpr (std::is_integral_v<T>) return Kind::integer;
    if constexpr (std::is_floating_point_v<T>) return Kind::number;
    if constexpr (std::is_same_v<T, std::string>) return Kind::text;
    if constexpr (std::is_same_v<T, Vec3>) return Kind::vector;
    if constexpr (std::is_same_v<T, std::vector<double>>) return Kind::numbers;
    if constexpr (std::is_same_v<T, Curve>) return Kind::curve;
    if constexpr (std::is_same_v<T, Law>) return Kind::law;
    if constexpr (IsRecord<T>) return Kind::record;
    if constexpr (IsRecords<T>) return Kind::records;
    if constexpr (std::is_same_v<T, std::shared_ptr<const Signal>>) return Kind::signal;
    if constexpr (std::is_same_v<T, Image>) return Kind::image;
    if constexpr (std::is_same_v<T, Sheet>) return Kind::table;
    if constexpr (std::is_same_v<T, std::shared_ptr<const Surface>>) return Kind::surface;
}

template <typename T>
SettingSheet settingSheet (const T& initial);

template <typename R>
std::vector<SettingSheet> fieldSheets (const R& fresh)
{
    std::vector<SettingSheet> all;
    const auto add = [&] (const auto& f) {
        auto s = settingSheet (fresh.*f.member);
        s.describe (f.id, f.unit, f.about, f.limits);
        all.push_back (std::move (s));
    };
    std::apply ([&] (const auto&... f) { (add (f), ...); },
                R::fields);
    return all;
}

template <typename T>
SettingSheet settingSheet (const T& initial)
{
    SettingSheet s {};
    s.kind = kindOf<T>();
    s.initial = valueOf (initial);
    if constexpr (IsRecord<T>) s.fields = fieldSheets (initial);
    if constexpr (IsRecords<T>) s.fields = fieldSheets (typename T::value_type {});
    return s;
}
}   // namespace detail

}   // namespace tactus
