// SPDX-License-Identifier: MIT
// A stand-in for the part of RapidCheck that the tests use, because Debian has RapidCheck only for Linux. Its random inputs are others, from
// std::mt19937_64, and it does not look for simpler inputs with which a property fails. RC_PARAMS takes seed, max_success and max_size as there. Without a
// seed, it is 1; a property that fails names its seed and its number.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace rc
{
/// The source of the inputs of the property that runs now.
struct Case
{
    std::mt19937_64 random;
    int size = 100;   // of 100: numbers and containers grow with it, as in RapidCheck
    std::ostringstream log;

    std::uint64_t below (std::uint64_t count) { return count == 0 ? 0 : std::uniform_int_distribution<std::uint64_t> (0, count - 1) (random); }
    static Case& now()
    {
        thread_local Case running;
        return running;
    }
};

struct Failed
{
    std::string why;
};
struct Discarded
{
};

template <typename T>
class Gen
{
public:
    using Value = T;

    template <typename Draw>
    requires std::is_invocable_r_v<T, const Draw&>
    Gen (Draw d) : draw (std::move (d))
    {
    }
    T operator*() const { return draw(); }

private:
    std::function<T()> draw;
};

template <typename T>
struct Arbitrary
{
    static_assert (std::is_arithmetic_v<T>, "the stand-in for RapidCheck draws no values of this type");
    static T draw()
    {
        auto& now = Case::now();
        if constexpr (std::is_same_v<T, bool>)
            return now.below (2) == 1;
        else if constexpr (std::is_floating_point_v<T>)
            return static_cast<T> (std::uniform_real_distribution<double> (-1.0, 1.0) (now.random) * std::pow (1.1, now.size));
        else
        {
            const int bits = std::max (1, static_cast<int> (8 * sizeof (T)) * now.size / 100);
            const auto drawn = bits >= 64 ? now.random() : now.below (std::uint64_t { 1 } << bits);
            if constexpr (std::is_signed_v<T>)
                if (bits < static_cast<int> (8 * sizeof (T)) && now.below (2) == 1) return static_cast<T> (-static_cast<T> (drawn));
            return static_cast<T> (drawn);
        }
    }
};

template <>
struct Arbitrary<std::string>
{
    static std::string draw()
    {
        std::string drawn (Case::now().below (static_cast<std::uint64_t> (Case::now().size) + 1), ' ');
        for (auto& c : drawn)
            c = static_cast<char> (Arbitrary<unsigned char>::draw());
        return drawn;
    }
};

template <typename T>
struct Arbitrary<std::vector<T>>
{
    static std::vector<T> draw()
    {
        std::vector<T> drawn;
        for (auto left = Case::now().below (static_cast<std::uint64_t> (Case::now().size) + 1); left > 0; --left)
            drawn.push_back (Arbitrary<T>::draw());
        return drawn;
    }
};

template <typename A, typename B>
struct Arbitrary<std::pair<A, B>>
{
    static std::pair<A, B> draw()
    {
        auto a = Arbitrary<A>::draw();
        return { std::move (a), Arbitrary<B>::draw() };
    }
};

namespace gen
{
template <typename T>
Gen<T> arbitrary()
{
    return { [] { return Arbitrary<T>::draw(); } };
}

template <typename T>
Gen<T> just (T value)
{
    return { [=] { return value; } };
}

template <typename T>
Gen<T> inRange (T min, T max)
{
    return { [=] {
        auto& now = Case::now();
        const auto most = static_cast<std::uint64_t> (max) - static_cast<std::uint64_t> (min) - 1;
        const auto scaled = static_cast<std::uint64_t> (std::llround (static_cast<double> (most) * now.size / 100.0));
        return static_cast<T> (static_cast<std::uint64_t> (min) + now.below (std::min (most, scaled) + 1));
    } };
}

template <typename C>
Gen<typename C::value_type> elementOf (C all)
{
    return { [all = std::move (all)] { return *std::next (all.begin(), static_cast<std::ptrdiff_t> (Case::now().below (all.size()))); } };
}

template <typename T, typename... More>
Gen<T> element (T first, More... more)
{
    return elementOf (std::vector<T> { std::move (first), T (std::move (more))... });
}

template <typename C, typename T>
Gen<C> container (std::size_t count, Gen<T> of)
{
    return { [=] {
        C all;
        for (std::size_t i = 0; i < count; ++i)
            all.insert (all.end(), *of);
        return all;
    } };
}

template <typename C, typename T>
Gen<C> container (Gen<T> of)
{
    return { [=] { return *container<C> (Case::now().below (static_cast<std::uint64_t> (Case::now().size) + 1), of); } };
}

template <typename C>
Gen<C> string()
{
    return container<C> (Gen<char> { [] { return static_cast<char> (1 + Case::now().below (127)); } });
}

template <typename T, typename Change>
auto map (Gen<T> from, Change change)
{
    using Out = std::decay_t<std::invoke_result_t<Change, T>>;
    return Gen<Out> { [=] { return change (*from); } };
}

template <typename T, typename Change>
auto map (Change change)
{
    return map (arbitrary<T>(), change);
}

template <typename... T>
Gen<std::tuple<T...>> tuple (Gen<T>... parts)
{
    return { [=] { return std::tuple<T...> { *parts... }; } };
}

template <typename A, typename B>
Gen<std::pair<A, B>> pair (Gen<A> a, Gen<B> b)
{
    return { [=] {
        auto first = *a;
        return std::pair<A, B> { std::move (first), *b };
    } };
}

template <typename Make, typename... T>
auto apply (Make make, Gen<T>... parts)
{
    return map (tuple (parts...), [=] (const std::tuple<T...>& t) { return std::apply (make, t); });
}

template <typename T>
Gen<T> weightedOneOf (std::vector<std::pair<std::size_t, Gen<T>>> ways)
{
    return { [=] {
        std::uint64_t sum = 0;
        for (const auto& way : ways)
            sum += way.first;
        auto at = Case::now().below (sum);
        for (const auto& way : ways)
        {
            if (at < way.first) return *way.second;
            at -= way.first;
        }
        return *ways.back().second;
    } };
}

template <typename T, typename... More>
Gen<T> oneOf (Gen<T> first, More... more)
{
    return weightedOneOf<T> ({ { 1, first }, { 1, Gen<T> (more) }... });
}

template <typename T, typename Holds>
Gen<T> suchThat (Gen<T> from, Holds holds)
{
    return { [=] {
        for (int i = 0; i < 1000; ++i)
            if (auto value = *from; holds (value)) return value;
        throw Discarded {};
    } };
}
}   // namespace gen

/// A value of RC_PARAMS, such as seed=7.
inline std::uint64_t parameter (const std::string& name, std::uint64_t usual)
{
    const char* text = std::getenv ("RC_PARAMS");
    std::istringstream words (text != nullptr ? text : "");
    for (std::string word; words >> word;)
        if (word.starts_with (name + "=")) return std::strtoull (word.c_str() + name.size() + 1, nullptr, 10);
    return usual;
}

/// Runs a property with random inputs. Returns why it fails; empty if it holds.
inline std::string whyNot (const std::function<void()>& body)
{
    const auto seed = parameter ("seed", 1), count = parameter ("max_success", 100), largest = parameter ("max_size", 100);
    auto& now = Case::now();
    const auto size_before = now.size;
    std::string why;
    std::uint64_t discarded = 0, in_turn = 0;   // the latter makes inputs larger, as in RapidCheck: the smallest may all be discarded
    for (std::uint64_t done = 0, number = 0; done < count && why.empty(); ++number)
    {
        std::seed_seq seeds { seed, number };
        now.random.seed (seeds);
        now.size = static_cast<int> (count > 1 ? std::min (largest, largest * done / (count - 1) + in_turn / 10) : largest);
        now.log.str ({});
        try
        {
            body();
            ++done;
            in_turn = 0;
        }
        catch (const Discarded&)
        {
            ++in_turn;
            if (++discarded > 10 * count) why = "gave up: too many inputs are discarded";
        }
        catch (const Failed& failed)
        {
            why = failed.why + "\n" + now.log.str();
        }
        catch (const std::exception& thrown)
        {
            why = std::string (thrown.what()) + "\n" + now.log.str();
        }
        if (! why.empty()) why += "\nwith RC_PARAMS=seed=" + std::to_string (seed) + ", input " + std::to_string (number) + ", by the stand-in for RapidCheck";
    }
    now.size = size_before;
    return why;
}

template <typename Body>
bool check (const std::string& name, Body body)
{
    const auto why = whyNot (body);
    if (! why.empty()) std::cerr << name << ": " << why << '\n';
    return why.empty();
}

template <typename Body>
requires std::is_invocable_v<Body>
bool check (Body body)
{
    return check ("", body);
}

/// Collects what a failed property says, in the forms RC_LOG() << … and RC_LOG (text).
inline std::ostream& log() { return Case::now().log; }
inline void log (const std::string& text) { Case::now().log << text << '\n'; }

inline void require (bool holds, const char* text)
{
    if (! holds) throw Failed { text };
}

inline void presume (bool holds)
{
    if (! holds) throw Discarded {};
}

[[noreturn]] inline void fail (const std::string& why) { throw Failed { why }; }
}   // namespace rc

#define RC_STAND_IN_TEXT_(x) #x
#define RC_STAND_IN_TEXT(x) RC_STAND_IN_TEXT_ (x)
#define RC_STAND_IN_PLACE __FILE__ ":" RC_STAND_IN_TEXT (__LINE__) ": "
#define RC_ASSERT(...) ::rc::require (static_cast<bool> (__VA_ARGS__), RC_STAND_IN_PLACE #__VA_ARGS__)
#define RC_ASSERT_FALSE(...) ::rc::require (! static_cast<bool> (__VA_ARGS__), RC_STAND_IN_PLACE "not " #__VA_ARGS__)
#define RC_PRE(...) ::rc::presume (static_cast<bool> (__VA_ARGS__))
#define RC_DISCARD(...) \
    throw ::rc::Discarded {}
#define RC_FAIL(...) ::rc::fail (std::string (__VA_ARGS__))
#define RC_LOG(...) ::rc::log (__VA_ARGS__)
#define RC_TAG(...) static_cast<void> (__VA_ARGS__)
