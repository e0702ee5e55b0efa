// SPDX-License-Identifier: MIT
#include <tactus/plan/prepared_shelf.hpp>

#include <catch2/catch.hpp>

#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace tactus;

namespace
{
std::shared_ptr<const int> number (const std::shared_ptr<const void>& source, const std::string& rest, int value,
                                   PreparedData::Until until = PreparedData::Until::unused)
{
    return prepared<int> (
        &plan::preparedOfAll(), source, [&] { return rest; }, [&] { return std::make_shared<const int> (value); }, until);
}
}   // namespace

TEST_CASE ("prepared data serve others with the same source and the same rest", "[plan][prepared]")
{
    const auto source = std::make_shared<const int> (0), other = std::make_shared<const int> (0);
    const auto first = number (source, "a", 1);
    CHECK (number (source, "a", 2) == first);
    CHECK (*number (source, "b", 3) == 3);
    CHECK (*number (other, "a", 4) == 4);
    CHECK (*number (nullptr, "a", 5) == 5);
    CHECK (*prepared<long> (
               &plan::preparedOfAll(), source, [] { return "a"; }, [] { return std::make_shared<const long> (6); })
           == 6);   // another type
    CHECK (*prepared<int> (
               nullptr, source, [] { return "a"; }, [] { return std::make_shared<const int> (7); })
           == 7);   // without a shelf
    const double zero = 0.0, negative = -0.0;
    CHECK (keyOf ({ &zero, 1 }) != keyOf ({ &negative, 1 }));
}

TEST_CASE ("prepared data go when they are not used, or when their source goes", "[plan][prepared]")
{
    auto source = std::make_shared<const int> (0);
    std::weak_ptr<const int> watched = number (source, "unused", 1);
    CHECK (watched.expired());
    CHECK (*number (source, "unused", 2) == 2);

    watched = number (source, "kept", 3, PreparedData::Until::no_source);
    CHECK_FALSE (watched.expired());
    CHECK (*number (source, "kept", 4, PreparedData::Until::no_source) == 3);
    source.reset();
    CHECK (plan::preparedOfAll().find ({ nullptr, "anything", nullptr }) == nullptr);   // any question sorts out what has no source
    CHECK (watched.expired());

    watched = number (nullptr, "without a source", 5, PreparedData::Until::no_source);
    CHECK (watched.expired());
}

TEST_CASE ("prepared data may be asked for by several threads at once", "[plan][prepared]")
{
    const auto source = std::make_shared<const int> (0);
    std::vector<std::shared_ptr<const int>> found (800);
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < 4; ++t)
            threads.emplace_back ([&, t] {
                for (std::size_t i = t; i < found.size(); i += 4)
                    found[i] = number (source, std::to_string (i % 10), static_cast<int> (i % 10));
            });
    }
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK (*found[i] == static_cast<int> (i % 10));
}
