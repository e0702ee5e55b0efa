// SPDX-License-Identifier: MIT
#include "json.hpp"
#include "json_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <ostream>

namespace tactus
{
namespace
{
/// The array index that one part of a pointer names; the size of the array for "-".
std::optional<std::size_t> indexOf (const std::string& part, std::size_t size) noexcept
{
    if (part == "-") return size;
    std::size_t i = 0;
    const auto [end, error] = std::from_chars (part.data(), part.data() + part.size(), i);
    return error == std::errc() && end == part.data() + part.size() ? std::optional (i) : std::nullopt;
}

/// The member or element that one part of a pointer names; null if there is none.
const Json* stepInto (const Json& v, const std::string& part) noexcept
{
    if (v.is_object())
    {
        const auto member = v.find (part);
        return member == v.end() ? nullptr : &*member;
    }
    if (! v.is_array()) return nullptr;
    const auto i = indexOf (part, v.size());
    return i && *i < v.size() ? &v[*i] : nullptr;
}

const Json* follow (const Json& from, const JsonPointer& way) noexcept
{
    const auto* now = &from;
    for (const auto& part : way.parts())
        if (now = stepInto (*now, part); now == nullptr) break;
    return now;
}

/// The number without its fraction, or the nearest one that fits into T; 0 for nan.
template <typename T>
T toInteger (double v) noexcept
{
    constexpr T low = std::numeric_limits<T>::min(), high = std::numeric_limits<T>::max();
    if (std::isnan (v)) return 0;
    if (v <= static_cast<double> (low)) return low;
    return v >= static_cast<double> (high) ? high : static_cast<T> (v);   // as a double, high is rounded up to a power of two
}

const Json::Member* memberOf (const Json::Object& all, std::string_view key) noexcept
{
    const auto at = std::ranges::find (all, key, &Json::Member::first);
    return at == all.end() ? nullptr : &*at;
}
}   // namespace

JsonPointer::JsonPointer (std::string_view text)
{
    if (text.empty()) return;
    if (text.front() != '/') throw JsonError ("a JSON pointer must begin with /: " + std::string (text));
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '/')
            keys.emplace_back();
        else if (text[i] != '~')
            keys.back() += text[i];
        else if (++i == text.size() || (text[i] != '0' && text[i] != '1'))
            throw JsonError ("in a JSON pointer, ~ must be followed by 0 or 1: " + std::string (text));
        else
            keys.back() += text[i] == '0' ? '~' : '/';
}

JsonPointer JsonPointer::parent() const
{
    auto all = *this;
    if (! keys.empty()) all.keys.pop_back();
    return all;
}

Json::Json() noexcept = default;
Json::Json (std::nullptr_t) noexcept {}
Json::Json (const char* v) : content (std::string (v)) {}
Json::Json (std::string_view v) : content (std::string (v)) {}
Json::Json (std::string v) noexcept : content (std::move (v)) {}
Json::Json (Array v) noexcept : content (std::move (v)) {}
Json::Json (Object v) noexcept : content (std::move (v)) {}
Json::Json (const Json&) = default;
Json::Json (Json&&) noexcept = default;
Json& Json::operator= (const Json&) = default;
Json& Json::operator= (Json&&) noexcept = default;
Json::~Json() = default;

Json::Json (std::initializer_list<Json> all)
{
    const auto is_member = [] (const Json& v) { return v.is_array() && v.size() == 2 && v[0].is_string(); };
    *this = std::ranges::all_of (all, is_member) ? object (all) : array (all);
}

Json Json::object() { return Object(); }
Json Json::array() { return Array(); }
Json Json::array (std::initializer_list<Json> all) { return Array (all); }

Json Json::object (std::initializer_list<Json> all)
{
    auto made = object();
    for (const auto& member : all)
        if (const auto& key = member.at (0).asString(); ! made.contains (key)) made.asObject().emplace_back (key, member.at (1));
    return made;
}

Json Json::parse (std::string_view text)
{
    auto read = readJson (text);
    if (read.messages.empty()) return std::move (read.root);
    const auto& m = read.messages.front();
    throw JsonError ("line " + std::to_string (m.line) + ", column " + std::to_string (m.column) + ": " + m.text);
}

std::optional<Json> Json::tryParse (std::string_view text)
{
    auto read = readJson (text);
    return read.messages.empty() ? std::optional (std::move (read.root)) : std::nullopt;
}

const char* Json::type_name() const noexcept
{
    if (is_null()) return "null";
    if (is_boolean()) return "boolean";
    if (is_number()) return "number";
    if (is_string()) return "string";
    return is_array() ? "array" : "object";
}

void Json::isNot (const char* wanted) const { throw JsonError (std::string ("a JSON value is of type ") + type_name() + ", not " + wanted); }

std::size_t Json::size() const noexcept
{
    if (const auto* all = std::get_if<Array> (&content)) return all->size();
    if (const auto* all = std::get_if<Object> (&content)) return all->size();
    return is_null() ? 0 : 1;
}

double Json::asDouble() const
{
    if (const auto* v = std::get_if<double> (&content)) return *v;
    if (const auto* v = std::get_if<std::int64_t> (&content)) return static_cast<double> (*v);
    if (const auto* v = std::get_if<std::uint64_t> (&content)) return static_cast<double> (*v);
    isNot ("a number");
}

bool Json::asBool() const
{
    if (const auto* v = std::get_if<bool> (&content)) return *v;
    isNot ("a boolean");
}

std::int64_t Json::asSigned() const
{
    if (const auto* v = std::get_if<std::int64_t> (&content)) return *v;
    if (const auto* v = std::get_if<std::uint64_t> (&content))
        return static_cast<std::int64_t> (std::min (*v, static_cast<std::uint64_t> (std::numeric_limits<std::int64_t>::max())));
    return toInteger<std::int64_t> (asDouble());
}

std::uint64_t Json::asUnsigned() const
{
    if (const auto* v = std::get_if<std::uint64_t> (&content)) return *v;
    if (const auto* v = std::get_if<std::int64_t> (&content)) return *v > 0 ? static_cast<std::uint64_t> (*v) : 0;
    return toInteger<std::uint64_t> (asDouble());
}

const std::string& Json::asString() const
{
    if (const auto* v = std::get_if<std::string> (&content)) return *v;
    isNot ("a string");
}

const Json::Array& Json::asArray() const
{
    if (const auto* v = std::get_if<Array> (&content)) return *v;
    isNot ("an array");
}

const Json::Object& Json::asObject() const
{
    if (const auto* v = std::get_if<Object> (&content)) return *v;
    isNot ("an object");
}

Json Json::flatten() const
{
    Object all;
    const auto add = [&all] (const auto& self, const std::string& path, const Json& v) -> void {
        if (! v.is_structured() || v.empty()) return (void)all.emplace_back (path, v);
        for (auto at = v.begin(); at != v.end(); ++at)
            self (self, path + '/' + (v.is_object() ? pointerPart (at.key()) : std::to_string (at - v.begin())), *at);
    };
    add (add, "", *this);
    return all;
}

std::string& Json::asString() { return const_cast<std::string&> (std::as_const (*this).asString()); }
Json::Array& Json::asArray() { return const_cast<Array&> (std::as_const (*this).asArray()); }
Json::Object& Json::asObject() { return const_cast<Object&> (std::as_const (*this).asObject()); }

bool Json::contains (std::string_view key) const noexcept { return find (key) != end(); }
bool Json::contains (const JsonPointer& way) const noexcept { return follow (*this, way) != nullptr; }

const Json& Json::at (std::string_view key) const
{
    if (const auto* member = memberOf (asObject(), key)) return member->second;
    throw JsonError ("there is no member '" + std::string (key) + "'");
}

const Json& Json::at (std::size_t index) const
{
    if (const auto& all = asArray(); index < all.size()) return all[index];
    throw JsonError ("there is no element " + std::to_string (index));
}

const Json& Json::at (const JsonPointer& way) const
{
    if (const auto* found = follow (*this, way)) return *found;
    throw JsonError ("nothing is at this JSON pointer");
}

Json& Json::at (std::string_view key) { return const_cast<Json&> (std::as_const (*this).at (key)); }
Json& Json::at (std::size_t index) { return const_cast<Json&> (std::as_const (*this).at (index)); }
Json& Json::at (const JsonPointer& way) { return const_cast<Json&> (std::as_const (*this).at (way)); }

Json& Json::operator[] (std::string_view key)
{
    if (is_null()) content = Object();
    auto& all = asObject();
    if (const auto* member = memberOf (all, key)) return const_cast<Json&> (member->second);
    return all.emplace_back (std::string (key), Json()).second;
}

Json& Json::operator[] (const JsonPointer& way)
{
    auto* now = this;
    for (const auto& part : way.parts())
    {
        if (now->is_null() && indexOf (part, 0) == std::size_t { 0 }) now->content = Array();
        if (! now->is_array())
            now = &(*now)[part];
        else
        {
            const auto i = indexOf (part, now->size());
            if (! i || *i > now->size()) throw JsonError ("there is no element '" + part + "'");
            if (*i == now->size()) now->push_back (nullptr);
            now = &now->at (*i);
        }
    }
    return *now;
}

void Json::push_back (Json v)
{
    if (is_null()) content = Array();
    asArray().push_back (std::move (v));
}

void Json::update (const Json& other)
{
    for (const auto& [key, v] : other.asObject())
        (*this)[key] = v;
}

std::size_t Json::erase (std::string_view key)
{
    return std::erase_if (asObject(), [&] (const Member& m) { return m.first == key; });
}

void Json::erase (std::size_t index)
{
    at (index);   // throws if there is no such element
    auto& all = asArray();
    all.erase (all.begin() + static_cast<std::ptrdiff_t> (index));
}

Json::iterator Json::erase (const_iterator i)
{
    if (auto* all = std::get_if<Object> (&content))
        all->erase (all->begin() + i.at);
    else
        asArray().erase (asArray().begin() + i.at);
    return { *this, static_cast<std::size_t> (i.at) };
}

void Json::clear() noexcept
{
    if (auto* all = std::get_if<Array> (&content))
        all->clear();
    else if (auto* members = std::get_if<Object> (&content))
        members->clear();
    else
        content = nullptr;
}

Json::const_iterator Json::find (std::string_view key) const noexcept
{
    const auto* all = std::get_if<Object> (&content);
    const auto* member = all != nullptr ? memberOf (*all, key) : nullptr;
    return { *this, member != nullptr ? static_cast<std::size_t> (member - all->data()) : size() };
}

Json::iterator Json::find (std::string_view key) noexcept
{
    const auto found = std::as_const (*this).find (key);
    return { *this, static_cast<std::size_t> (found.at) };
}

const Json::Object& Json::items() const noexcept
{
    static const Object none;
    return is_object() ? std::get<Object> (content) : none;
}

Json& Json::element (std::size_t i) noexcept { return const_cast<Json&> (std::as_const (*this).element (i)); }

const Json& Json::element (std::size_t i) const noexcept
{
    if (const auto* all = std::get_if<Array> (&content)) return (*all)[i];
    if (const auto* all = std::get_if<Object> (&content)) return (*all)[i].second;
    return *this;
}

const std::string& Json::keyOf (std::size_t i) const { return asObject().at (i).first; }

bool operator== (const Json& a, const Json& b) noexcept
{
    if (a.is_number() && b.is_number())
    {
        if (a.is_number_float() || b.is_number_float()) return a.asDouble() == b.asDouble();
        const bool a_fits = ! a.is_number_unsigned(), b_fits = ! b.is_number_unsigned();
        if (a_fits == b_fits) return a.content == b.content;
        return std::cmp_equal (a_fits ? a.asSigned() : b.asSigned(), a_fits ? b.asUnsigned() : a.asUnsigned());
    }
    return a.content == b.content;
}

std::ostream& operator<< (std::ostream& out, const Json& v) { return out << v.dump(); }

}   // namespace tactus
