// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

using namespace tactus;

namespace
{
Json randomJson (int depth)
{
    const auto text = [] { return *rc::gen::string<std::string>(); };
    const int kind = *rc::gen::inRange (0, depth > 0 ? 8 : 6);
    if (kind == 0) return nullptr;
    if (kind == 1) return *rc::gen::arbitrary<bool>();
    if (kind == 2) return *rc::gen::arbitrary<std::int64_t>();
    if (kind == 3) return *rc::gen::arbitrary<std::uint64_t>();
    if (kind == 4) return *rc::gen::suchThat (rc::gen::map<std::uint64_t> ([] (std::uint64_t bits) { return std::bit_cast<double> (bits); }),
                                              [] (double v) { return std::isfinite (v); });
    if (kind == 5) return text();
    auto all = kind == 6 ? Json::array() : Json::object();
    for (int n = *rc::gen::inRange (0, 5); n > 0; --n)
        if (kind == 6)
            all.push_back (randomJson (depth - 1));
        else
            all[text()] = randomJson (depth - 1);
    return all;
}

/// Replaces all text by ASCII characters, so that it is valid UTF-8, as in a file.
Json onlyAscii (Json v)
{
    const auto clean = [] (std::string& text) {
        for (auto& c : text)
            c = static_cast<char> (static_cast<unsigned char> (c) & 0x7Fu);
    };
    if (v.is_string()) clean (v.asString());
    if (v.is_array())
        for (auto& e : v.asArray())
            e = onlyAscii (std::move (e));
    if (! v.is_object()) return v;
    auto all = Json::object();
    for (auto& [key, member] : v.asObject())
    {
        clean (key);
        all[key] = onlyAscii (std::move (member));
    }
    return all;
}

template <typename F>
std::string errorOf (F&& f)
{
    try
    {
        f();
        return {};
    }
    catch (const JsonError& e)
    {
        return e.what();
    }
}
}   // namespace

TEST_CASE ("Json: braces make an object if each element is a pair that begins with a string, otherwise an array", "[json]")
{
    CHECK (Json { { "gain", 0.5 }, { "modes", { 1, 2, 3 } } }.dump() == R"({"gain":0.5,"modes":[1,2,3]})");
    CHECK (Json { "a", "b", "c" }.dump() == R"(["a","b","c"])");
    CHECK (Json { { 1, 2 }, { 3, 4 } }.dump() == "[[1,2],[3,4]]");
    CHECK (Json { { "a", 1 }, "b" }.dump() == R"([["a",1],"b"])");
    CHECK (Json::array ({ { "a", 1 } }).dump() == R"([["a",1]])");
    CHECK (Json::object ({ { "a", 1 }, { "a", 2 } }).dump() == R"({"a":1})");
    CHECK (Json (std::map<std::string, double> { { "x", 1.0 }, { "y", 2.5 } }).dump() == R"({"x":1.0,"y":2.5})");
    CHECK (Json (std::vector<int> { 1, 2 }).dump() == "[1,2]");
    CHECK (Json (std::array { "a", "b" }).dump() == R"(["a","b"])");
    CHECK (Json().dump() == "null");
    CHECK (Json (true).dump() == "true");
    CHECK (Json ("text").is_string());
    CHECK (Json (std::string_view ("text")).is_string());
}

TEST_CASE ("Json: numbers of different types are equal if their values are", "[json]")
{
    CHECK (Json (3) == Json (3.0));
    CHECK (Json (3) == Json (3u));
    CHECK (Json (-1) != Json (std::numeric_limits<std::uint64_t>::max()));
    CHECK (Json (std::numeric_limits<double>::quiet_NaN()) != Json (std::numeric_limits<double>::quiet_NaN()));
    CHECK (Json (3) != Json ("3"));
    CHECK (Json (0) != Json (false));
    CHECK (Json (0) != Json (nullptr));
    CHECK (Json (3).is_number_integer());
    CHECK_FALSE (Json (3.0).is_number_integer());
    CHECK (Json { { "a", 1 }, { "b", 2 } } != Json { { "b", 2 }, { "a", 1 } });
}

TEST_CASE ("Json: an integer gets the nearest number that it can hold, without a fraction", "[json]")
{
    CHECK (Json (-2.9).get<int>() == -2);
    CHECK (Json (1e300).get<std::int64_t>() == std::numeric_limits<std::int64_t>::max());
    CHECK (Json (-1e300).get<std::int64_t>() == std::numeric_limits<std::int64_t>::min());
    CHECK (Json (1e300).get<std::uint64_t>() == std::numeric_limits<std::uint64_t>::max());
    CHECK (Json (-5.0).get<std::uint64_t>() == 0);
    CHECK (Json (-5).get<std::uint64_t>() == 0);
    CHECK (Json (std::numeric_limits<std::uint64_t>::max()).get<std::int64_t>() == std::numeric_limits<std::int64_t>::max());
    CHECK (Json (std::numeric_limits<double>::quiet_NaN()).get<std::int64_t>() == 0);
    CHECK (Json (std::numeric_limits<double>::infinity()).get<std::int64_t>() == std::numeric_limits<std::int64_t>::max());
}

TEST_CASE ("Json: an object keeps the order of its members", "[json]")
{
    auto v = Json::parse (R"({"z": 1, "a": 2, "m": 3})");
    v["b"] = 4;
    v["a"] = 5;
    CHECK (v.dump() == R"({"z":1,"a":5,"m":3,"b":4})");
    CHECK (v.erase ("a") == 1);
    CHECK (v.erase ("a") == 0);
    v.erase (v.find ("z"));
    CHECK (v.dump() == R"({"m":3,"b":4})");
    v.update ({ { "m", 6 }, { "c", 7 } });
    CHECK (v.dump() == R"({"m":6,"b":4,"c":7})");

    std::string keys;
    for (const auto& [key, value] : v.items())
        keys += key + std::to_string (value.get<int>());
    CHECK (keys == "m6b4c7");
    CHECK (Json (3).items().empty());
}

TEST_CASE ("Json: get() makes bools, numbers, strings, and lists and maps of them", "[json]")
{
    CHECK (Json (2).get<double>() == 2.0);
    CHECK (Json ({ 1, 2.5 }).get<std::vector<double>>() == std::vector { 1.0, 2.5 });
    CHECK (Json ({ 1, 2, 3 }).get<std::array<double, 3>>() == std::array { 1.0, 2.0, 3.0 });
    CHECK (Json { { "a", "x" } }.get<std::map<std::string, std::string>>() == std::map<std::string, std::string> { { "a", "x" } });
    CHECK (Json { { "a", 1 } }.value ("a", 7) == 1);
    CHECK (Json { { "a", 1 } }.value ("b", 7) == 7);
    CHECK (Json { { "a", "x" } }.value ("b", "none") == "none");
}

TEST_CASE ("Json: what does not fit throws an error that names both types, or the missing member", "[json]")
{
    CHECK (errorOf ([] { (void)Json ("text").get<double>(); }) == "a JSON value is of type string, not a number");
    CHECK (errorOf ([] { (void)Json (1).get<bool>(); }) == "a JSON value is of type number, not a boolean");
    CHECK (errorOf ([] { (void)Json (1).get<std::string>(); }) == "a JSON value is of type number, not a string");
    CHECK (errorOf ([] { (void)Json (1).asArray(); }) == "a JSON value is of type number, not an array");
    CHECK (errorOf ([] { (void)Json (nullptr).asObject(); }) == "a JSON value is of type null, not an object");
    CHECK (errorOf ([] { (void)Json ({ 1, 2 }).get<std::array<double, 3>>(); }) == "a JSON value is of type array, not an array of a different size");
    CHECK (errorOf ([] { (void)Json { { "a", 1 } }.at ("b"); }) == "there is no member 'b'");
    CHECK (errorOf ([] { (void)Json ({ 1 }).at (1); }) == "there is no element 1");
    CHECK (errorOf ([] { Json ({ 1 }).erase (std::size_t { 1 }); }) == "there is no element 1");
    CHECK (errorOf ([] { Json ("x").push_back (1); }) == "a JSON value is of type string, not an array");
    CHECK (errorOf ([] { Json (1)["a"] = 2; }) == "a JSON value is of type number, not an object");
    CHECK (errorOf ([] { (void)Json (1).value ("a", 2); }) == "a JSON value is of type number, not an object");
}

TEST_CASE ("Json: pointers read, write and escape as RFC 6901 says", "[json]")
{
    Json v { { "a/b", { 1, { { "m~n", 2 } } } }, { "", 3 } };
    CHECK (v.at (JsonPointer ("/a~1b/1/m~0n")) == 2);
    CHECK (v.at (JsonPointer ("/")) == 3);
    CHECK (&v.at (JsonPointer ("")) == &v);
    CHECK (v.contains (JsonPointer ("/a~1b/0")));
    for (const auto* none : { "/a~1b/2", "/a~1b/-", "/a~1b/x", "/a~1b/0/0", "/none" })
    {
        CAPTURE (none);
        CHECK_FALSE (v.contains (JsonPointer (none)));
        CHECK (errorOf ([&] { (void)std::as_const (v).at (JsonPointer (none)); }) == "nothing is at this JSON pointer");
    }
    CHECK (JsonPointer ("/a/b").parent().parts() == std::vector<std::string> { "a" });
    CHECK (JsonPointer ("").parent().parts().empty());
    CHECK_FALSE (errorOf ([] { JsonPointer ("a"); }).empty());
    CHECK_FALSE (errorOf ([] { JsonPointer ("/~2"); }).empty());
    CHECK_FALSE (errorOf ([] { JsonPointer ("/~"); }).empty());

    Json made;
    made[JsonPointer ("/list/0/x")] = 1;
    made[JsonPointer ("/list/-")] = 2;
    made[JsonPointer ("/list/0/y")] = 3;
    CHECK (made.dump() == R"({"list":[{"x":1,"y":3},2]})");
    CHECK (errorOf ([&] { made[JsonPointer ("/list/5")] = 1; }) == "there is no element '5'");
}

TEST_CASE ("Json: iterators visit elements, the values of members, or a scalar itself", "[json]")
{
    const auto sum = [] (const Json& v) {
        int total = 0;
        for (const auto& e : v)
            total += e.get<int>();
        return total;
    };
    CHECK (sum ({ 1, 2, 3 }) == 6);
    CHECK (sum ({ { "a", 1 }, { "b", 2 } }) == 3);
    CHECK (sum (7) == 7);
    CHECK (sum (nullptr) == 0);

    Json list { 3, 1, 2 };
    std::ranges::sort (list.asArray(), {}, [] (const Json& v) { return v.get<int>(); });
    CHECK (list.dump() == "[1,2,3]");
    const auto two = std::find (list.begin(), list.end(), Json (2));
    CHECK (two - list.begin() == 1);
    list.erase (two);
    CHECK (list.dump() == "[1,3]");
    CHECK (list.back() == 3);
    CHECK (list.front() == 1);
    const Json object { { "k", 5 } };
    CHECK (object.begin().key() == "k");
    CHECK (object.find ("none") == object.end());
}

TEST_CASE ("Json: text that is nested too deeply, or is not JSON, is refused", "[json]")
{
    const auto nested = [] (int depth) { return std::string (static_cast<std::size_t> (depth), '[') + std::string (static_cast<std::size_t> (depth), ']'); };
    CHECK (Json::tryParse (nested (deepest_nesting)));
    CHECK_FALSE (Json::tryParse (nested (deepest_nesting + 1)));
    for (const auto* text : { "", "{", "[1,]", "nul", "1 2", "{\"a\"}", "\"\\x\"" })
    {
        CAPTURE (text);
        CHECK_FALSE (Json::tryParse (text));
        CHECK_FALSE (errorOf ([&] { (void)Json::parse (text); }).empty());
    }
}

TEST_CASE ("Json: text that is not UTF-8 is written with replacement characters", "[json]")
{
    CHECK (Json ("a\xFF").dump() == "\"a\xEF\xBF\xBD\"");
    std::ostringstream out;
    out << Json { { "a", 1 } };
    CHECK (out.str() == R"({"a":1})");
    CHECK (Json { { "a", { 1 } } }.dump (2) == "{\n  \"a\": [\n    1\n  ]\n}");
}

TEST_CASE ("Json: any value that is written reads back as itself", "[json]")
{
    test::property ("written and read", [] {
        const auto v = onlyAscii (randomJson (4));
        RC_ASSERT (Json::parse (v.dump()) == v);
        RC_ASSERT (Json::parse (v.dump (4)) == v);
    });
    test::property ("a copy is equal and independent", [] {
        const auto v = randomJson (3);
        auto copy = v;
        RC_ASSERT (copy == v);
        copy = Json { v, 1 };
        RC_ASSERT (copy[0] == v);
        copy = Json (copy[0]);   // a part replaces the whole
        RC_ASSERT (copy == v);
    });
    test::property ("flattened, each leaf is where its pointer says", [] {
        const auto v = randomJson (4);
        const auto flat = v.flatten();
        for (const auto& [pointer, leaf] : flat.items())
        {
            RC_ASSERT (v.at (JsonPointer (pointer)) == leaf);
            RC_ASSERT (! leaf.is_structured() || leaf.empty());
        }
    });
}
