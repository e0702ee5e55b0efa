// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <iterator>
#include <optional>
#include <ranges>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace tactus
{

/// Thrown if a value does not have the requested type or lacks a member, or if text is not JSON.
struct JsonError : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// The path to a value inside another one, as in "/roles/stylus/guard" (RFC 6901).
class JsonPointer
{
public:
    JsonPointer() = default;
    explicit JsonPointer (std::string_view text);

    const std::vector<std::string>& parts() const noexcept { return keys; }
    JsonPointer parent() const;

private:
    std::vector<std::string> keys;
};

inline constexpr int deepest_nesting = 64;   ///< deepest allowed nesting of objects and arrays

class Json;

namespace json
{
using Array = std::vector<Json>;
using Object = std::vector<std::pair<std::string, Json>>;

template <typename T>
concept Count = std::unsigned_integral<T> && ! std::same_as<T, bool>;

template <typename T, typename... Others>
concept IsOneOf = (std::same_as<T, Others> || ...);

/// A range that is neither a value itself nor text.
template <typename R>
concept Range = std::ranges::input_range<R> && ! std::convertible_to<R, std::string_view> && ! IsOneOf<R, Json, Array, Object>;

template <typename R>
concept List = Range<R> && std::constructible_from<Json, std::ranges::range_reference_t<R>>;

/// A range of pairs that begin with a string.
template <typename R>
concept Map = Range<R> && requires (std::ranges::range_reference_t<R> member)
{
    std::string (member.first);
    member.second;
};
}   // namespace json

/// A JSON value. Objects keep the order of the file, so a file that is read and written again gives a small diff.
///
/// Numbers are integers or doubles, as written: 3 is an integer, 3.0 is not, and the two compare equal. A braced list in which
/// every element is a pair that begins with a string is an object; any other braced list is an array:
///
///     Json { { "gain", 0.5 }, { "modes", { 1, 2, 3 } } }
///
/// A function that needs a different type throws JsonError, unless it says otherwise.
///
/// Why it is our own: docs/decisions/own_json.md.
class Json
{
public:
    using Array = json::Array;
    using Object = json::Object;
    using Member = Object::value_type;

    Json() noexcept;
    Json (std::nullptr_t) noexcept;
    template <std::same_as<bool> T>
    Json (T v) noexcept : content (v)
    {
    }
    template <std::signed_integral T>
    Json (T v) noexcept : content (static_cast<std::int64_t> (v))
    {
    }
    template <json::Count T>
    Json (T v) noexcept : content (static_cast<std::uint64_t> (v))
    {
    }
    template <std::floating_point T>
    Json (T v) noexcept : content (static_cast<double> (v))
    {
    }
    Json (const char*);
    Json (std::string_view);
    Json (std::string) noexcept;
    Json (Array) noexcept;
    Json (Object) noexcept;
    Json (std::initializer_list<Json>);

    /// An array of a range's elements; an object if the elements are pairs of a string and a value, as in a std::map.
    template <json::List R>
    Json (const R& list);
    template <json::Map R>
    Json (const R& map);

    Json (const Json&);
    Json (Json&&) noexcept;
    Json& operator= (const Json&);
    Json& operator= (Json&&) noexcept;
    ~Json();

    static Json object();
    static Json object (std::initializer_list<Json>);
    static Json array();
    static Json array (std::initializer_list<Json>);

    /// Parses JSON text. Throws JsonError if it is not JSON or is nested too deeply. For files use readJson, which reports where
    /// the error is.
    static Json parse (std::string_view text);
    static std::optional<Json> tryParse (std::string_view text);

    /// Writes one line, or several if an indent is given. Bytes that are not UTF-8 become U+FFFD.
    std::string dump (int indent = -1) const;

    //==============================================================================
    bool is_null() const noexcept { return content.index() == null_index; }
    bool is_boolean() const noexcept { return std::holds_alternative<bool> (content); }
    bool is_number_unsigned() const noexcept { return std::holds_alternative<std::uint64_t> (content); }
    bool is_number_integer() const noexcept { return is_number_unsigned() || std::holds_alternative<std::int64_t> (content); }
    bool is_number_float() const noexcept { return std::holds_alternative<double> (content); }
    bool is_number() const noexcept { return is_number_integer() || is_number_float(); }
    bool is_string() const noexcept { return std::holds_alternative<std::string> (content); }
    bool is_array() const noexcept { return std::holds_alternative<Array> (content); }
    bool is_object() const noexcept { return std::holds_alternative<Object> (content); }
    bool is_structured() const noexcept { return is_array() || is_object(); }

    /// "null", "boolean", "number", "string", "array" or "object".
    const char* type_name() const noexcept;

    /// Number of elements or members; 0 for null, 1 for any other value.
    std::size_t size() const noexcept;
    bool empty() const noexcept { return size() == 0; }

    /// The value as a bool, a number, a string, or a std::vector of these. Numbers convert to each other; an integer gets the
    /// nearest 64-bit number that it can hold, without a fraction.
    template <typename T>
    T get() const;

    const std::string& asString() const;
    std::string& asString();
    const Array& asArray() const;
    Array& asArray();
    const Object& asObject() const;
    Object& asObject();

    //==============================================================================
    bool contains (std::string_view key) const noexcept;
    bool contains (const JsonPointer&) const noexcept;

    const Json& at (std::string_view key) const;
    Json& at (std::string_view key);
    const Json& at (std::size_t index) const;
    Json& at (std::size_t index);
    const Json& at (const JsonPointer&) const;
    Json& at (const JsonPointer&);

    /// Appends a missing member; null becomes an object. The const versions throw if the member is missing.
    Json& operator[] (std::string_view key);
    Json& operator[] (const char* key) { return (*this)[std::string_view (key)]; }
    const Json& operator[] (std::string_view key) const { return at (key); }
    const Json& operator[] (const char* key) const { return at (std::string_view (key)); }
    template <std::integral I>
    Json& operator[] (I index)
    {
        return at (static_cast<std::size_t> (index));
    }
    template <std::integral I>
    const Json& operator[] (I index) const
    {
        return at (static_cast<std::size_t> (index));
    }
    Json& operator[] (const JsonPointer&);

    /// The member as a T, or `fallback` if there is none.
    template <typename T>
    T value (std::string_view key, const T& fallback) const;
    std::string value (std::string_view key, const char* fallback) const { return value (key, std::string (fallback)); }

    Json& front() { return at (0); }
    const Json& front() const { return at (0); }
    Json& back() { return at (size() - 1); }
    const Json& back() const { return at (size() - 1); }

    /// Null becomes an array.
    void push_back (Json);
    template <typename... Args>
    Json& emplace_back (Args&&... args)
    {
        push_back (Json (std::forward<Args> (args)...));
        return back();
    }

    /// An object of all leaf values, keyed by JSON pointer: { "/roles/stylus": "sim" }.
    Json flatten() const;

    /// Copies all members of another object into this one, over members with the same key.
    void update (const Json& other);
    std::size_t erase (std::string_view key);
    void erase (std::size_t index);
    void clear() noexcept;

    //==============================================================================
    /// Iterates over the elements of an array, the values of an object's members, or a scalar itself.
    template <bool is_const>
    class Iterator
    {
    public:
        using Owner = std::conditional_t<is_const, const Json, Json>;
        using value_type = Json;
        using difference_type = std::ptrdiff_t;
        using reference = Owner&;
        using pointer = Owner*;
        using iterator_category = std::random_access_iterator_tag;

        Iterator() = default;
        Iterator (Owner& o, std::size_t i) noexcept : owner (&o), at (static_cast<difference_type> (i)) {}
        operator Iterator<true>() const noexcept
            requires (! is_const)
        {
            return { *owner, static_cast<std::size_t> (at) };
        }

        reference operator*() const noexcept { return owner->element (static_cast<std::size_t> (at)); }
        pointer operator->() const noexcept { return &**this; }
        reference operator[] (difference_type n) const noexcept { return *(*this + n); }
        reference value() const noexcept { return **this; }
        const std::string& key() const { return owner->keyOf (static_cast<std::size_t> (at)); }

        Iterator& operator++() noexcept { return ++at, *this; }
        Iterator operator++ (int) noexcept { return std::exchange (*this, *this + 1); }
        Iterator& operator--() noexcept { return --at, *this; }
        Iterator operator-- (int) noexcept { return std::exchange (*this, *this - 1); }
        Iterator& operator+= (difference_type n) noexcept { return at += n, *this; }
        Iterator& operator-= (difference_type n) noexcept { return at -= n, *this; }
        friend Iterator operator+ (Iterator i, difference_type n) noexcept { return i += n; }
        friend Iterator operator+ (difference_type n, Iterator i) noexcept { return i += n; }
        friend Iterator operator- (Iterator i, difference_type n) noexcept { return i -= n; }
        friend difference_type operator- (const Iterator& a, const Iterator& b) noexcept { return a.at - b.at; }
        friend bool operator== (const Iterator& a, const Iterator& b) noexcept { return a.at == b.at; }
        friend auto operator<=> (const Iterator& a, const Iterator& b) noexcept { return a.at <=> b.at; }

    private:
        friend class Json;
        Owner* owner = nullptr;
        difference_type at = 0;
    };
    using iterator = Iterator<false>;
    using const_iterator = Iterator<true>;
    using value_type = Json;

    iterator begin() noexcept { return { *this, 0 }; }
    iterator end() noexcept { return { *this, size() }; }
    const_iterator begin() const noexcept { return { *this, 0 }; }
    const_iterator end() const noexcept { return { *this, size() }; }

    /// The member; end() if there is none, or if this is not an object.
    iterator find (std::string_view key) noexcept;
    const_iterator find (std::string_view key) const noexcept;
    iterator erase (const_iterator);

    /// The members of an object as pairs of key and value. Empty for anything else.
    const Object& items() const noexcept;

    /// Objects are equal if they have equal members in the same order.
    friend bool operator== (const Json&, const Json&) noexcept;
    friend std::ostream& operator<< (std::ostream&, const Json&);

private:
    static constexpr std::size_t null_index = 0;

    double asDouble() const;
    bool asBool() const;
    std::int64_t asSigned() const;
    std::uint64_t asUnsigned() const;
    Json& element (std::size_t) noexcept;
    const Json& element (std::size_t) const noexcept;
    const std::string& keyOf (std::size_t) const;
    [[noreturn]] void isNot (const char* wanted) const;

    std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object> content;
};

//==============================================================================
// Implementation below.

template <json::List R>
Json::Json (const R& list) : content (Array())
{
    for (auto&& v : list)
        std::get<Array> (content).push_back (Json (v));
}

template <json::Map R>
Json::Json (const R& map) : content (Object())
{
    for (auto&& [key, v] : map)
        std::get<Object> (content).emplace_back (key, Json (v));
}

template <typename T>
T Json::get() const
{
    if constexpr (std::same_as<T, Json>)
        return *this;
    else if constexpr (std::same_as<T, bool>)
        return asBool();
    else if constexpr (std::floating_point<T>)
        return static_cast<T> (asDouble());
    else if constexpr (std::signed_integral<T>)
        return static_cast<T> (asSigned());
    else if constexpr (std::unsigned_integral<T>)
        return static_cast<T> (asUnsigned());
    else if constexpr (std::constructible_from<T, const std::string&> && ! std::ranges::view<T>)
        return T (asString());
    else if constexpr (requires { typename T::mapped_type; })
    {
        T all;
        for (const auto& [key, v] : asObject())
            all.emplace (key, v.template get<typename T::mapped_type>());
        return all;
    }
    else if constexpr (requires (T all) { all.push_back (all.front()); })
    {
        T all;
        for (const auto& v : asArray())
            all.push_back (v.template get<typename T::value_type>());
        return all;
    }
    else
    {
        T all {};   // an array of fixed size
        if (asArray().size() != all.size()) isNot ("an array of a different size");
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = at (i).template get<typename T::value_type>();
        return all;
    }
}

template <typename T>
T Json::value (std::string_view key, const T& fallback) const
{
    if (! is_object()) isNot ("an object");
    const auto member = find (key);
    return member == end() ? fallback : member->get<T>();
}

}   // namespace tactus
