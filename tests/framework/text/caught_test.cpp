// SPDX-License-Identifier: MIT
#include <tactus/text/caught.hpp>

#include <catch2/catch.hpp>

#include <new>
#include <stdexcept>
#include <string>
#include <thread>

using namespace tactus;

TEST_CASE ("what a thread throws becomes a message with its place", "[text]")
{
    Result<int> result { 0 };
    std::thread thread ([&] { result = caught ("small.csv", []() -> int { return std::stoi ("99999999999999999999"); }); });
    thread.join();
    REQUIRE_FALSE (result);
    CHECK (result.error().where == "small.csv");
    CHECK (result.error().id == "program/exception");
    CHECK (result.error().text.find ("stoi") != std::string::npos);

    CHECK (caught ("", [] { throw std::bad_alloc(); }).error().text == "the memory ran out");
    CHECK (caught ("", [] { throw 7; }).error().text.find ("unknown") != std::string::npos);
    CHECK (caught ("", [] {}));
    CHECK (*caught ("", [] { return 3; }) == 3);
    const auto refused = caught ("here", []() -> Result<int> { return Message::error ("own/id", "there", "its own error"); });
    REQUIRE_FALSE (refused);
    CHECK (refused.error().id == "own/id");
}
