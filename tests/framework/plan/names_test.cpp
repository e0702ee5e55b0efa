// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/plan/flat/names.hpp>

#include <catch2/catch.hpp>

#include <map>

using namespace tactus::plan;

TEST_CASE ("names: each name keeps its number, and a name that was not added is not found", "[plan][names]")
{
    tactus::test::property ("numbers are the same as in a map", [] {
        const auto word = rc::gen::container<std::string> (rc::gen::elementOf (std::string ("ab/")));
        const auto added = *rc::gen::container<std::vector<std::string>> (word), asked = *rc::gen::container<std::vector<std::string>> (word);

        Names names;
        std::map<std::string, std::size_t> numbers;
        for (const auto& name : added)
            RC_ASSERT (names.add (name) == numbers.try_emplace (name, numbers.size()).first->second);
        RC_ASSERT (names.size() == numbers.size());
        for (const auto& list : { added, asked })
            for (const auto& name : list)
                RC_ASSERT (names.find (name) == (numbers.contains (name) ? numbers[name] : Names::none));
    });
}

TEST_CASE ("names: thousands of names are distinguished", "[plan][names]")
{
    Names names;
    for (std::size_t i = 0; i < 5000; ++i)
        REQUIRE (names.add ("p" + std::to_string (i)) == i);
    for (std::size_t i = 0; i < 5000; ++i)
        REQUIRE (names.find ("p" + std::to_string (i)) == i);
    CHECK (names.find ("p5000") == Names::none);
}
