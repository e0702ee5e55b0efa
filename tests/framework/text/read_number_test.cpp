// SPDX-License-Identifier: MIT
#include <tactus/file/csv.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/read_number.hpp>
#include <tactus/text/units.hpp>

#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

using namespace tactus;

namespace
{
Result<Table> tableOf (const std::string& number)
{
    const TemporaryFolder folder;
    folder.write ("t.csv", "x,y\n1," + number + "\n");
    return readTable (folder / "t.csv");
}
}   // namespace

TEST_CASE ("a number in a file, however small, is the nearest double, in all kinds of files", "[text][numbers]")
{
    const std::pair<const char*, double> numbers[] { { "1e-310", 1e-310 },
                                                     { "4.9406564584124654e-324", 5e-324 },
                                                     { "-2.2250738585072011e-308", -2.2250738585072011e-308 },
                                                     { "1.7976931348623157e308", std::numeric_limits<double>::max() } };
    for (const auto& [text, value] : numbers)
    {
        CAPTURE (text);
        CHECK (wholeNumber (text) == value);
        const auto table = tableOf (text);
        REQUIRE (table);
        CHECK (table->at (0, 1) == value);
        const auto measure = parseMeasure (text);
        REQUIRE (measure);
        CHECK (measure->value == value);
        const auto json = readJson (text);
        CHECK_FALSE (hasErrors (json.messages));
        CHECK (json.root == Json (value));
    }
}

TEST_CASE ("a number that no double can hold is an error with its place", "[text][numbers]")
{
    const std::string numbers[] { "1e309", "-1e99999999999999999999", "1" + std::string (400, '0'), "0.01e311" };
    for (const auto& text : numbers)
    {
        CAPTURE (text);
        CHECK_FALSE (wholeNumber (text));
        const auto read = readNumber (text);
        CHECK (read.size == text.size());
        CHECK_FALSE (read.is_in_range);
        const auto table = tableOf (text);
        REQUIRE_FALSE (table);
        CHECK (table.error().id == "csv/out_of_range");
        CHECK (table.error().where.ends_with ("t.csv:2:3"));
        CHECK_FALSE (parseMeasure (text + " N"));
        const auto json = readJson ("[1, " + text + "]");
        REQUIRE (hasErrors (json.messages));
        CHECK (json.messages[0].line == 1);
    }
}

TEST_CASE ("a number below the smallest double is 0, with its sign", "[text][numbers]")
{
    const auto zeros = std::string (400, '0');
    const std::string numbers[] { "1e-400", "2e-324", "1e-99999999999999999999", "0." + zeros + "1", "0." + zeros + "1e20" };
    for (const auto& text : numbers)
    {
        CAPTURE (text);
        CHECK (wholeNumber (text) == 0.0);
        CHECK (std::signbit (*wholeNumber ("-" + text)));
        const auto table = tableOf (text);
        REQUIRE (table);
        CHECK (table->at (0, 1) == 0.0);
        CHECK (readJson (text).root == Json (0.0));
    }
    CHECK (parseMeasure ("1e-320 um")->value == 0.0);
}

TEST_CASE ("a number is read up to what does not belong to it, and nothing else counts as one", "[text][numbers]")
{
    CHECK (readNumber ("0.4 mm").size == 3);
    CHECK (readNumber ("+3").value == 3.0);
    CHECK (readNumber ("0x10").size == 1);
    for (const auto* text : { "", "+", "-", "x", "+-1", "++1", " 1", ".", "e5" })
    {
        CAPTURE (text);
        CHECK (readNumber (text).size == 0);
        CHECK_FALSE (wholeNumber (text));
    }
    for (const auto* text : { "1 ", "1,5", "1e5x", "0x10" })
        CHECK_FALSE (wholeNumber (text));
    CHECK (std::isnan (*wholeNumber ("nan")));
    CHECK (wholeNumber ("-inf") == -std::numeric_limits<double>::infinity());
}
