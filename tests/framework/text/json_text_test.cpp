// SPDX-License-Identifier: MIT
#include <tactus/text/json_text.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <ctime>

using namespace tactus;
using Catch::Matchers::Contains;

namespace
{
/// The only message for this JSON text, as "line:column id text; remedy".
std::string complaint (std::string_view text)
{
    const auto json = readJson (text);
    if (json.messages.size() != 1) return std::to_string (json.messages.size()) + " messages";
    const auto& m = json.messages[0];
    return std::to_string (m.line) + ':' + std::to_string (m.column) + ' ' + m.id + ' ' + m.text + "; " + m.remedy;
}
}   // namespace

TEST_CASE ("every key and element has a line and column")
{
    const auto json = readJson ("{\n  \"a\": [1, {\"ü\": 2, \"b/c\": -1.5e3}, \"x\"],\n\t\"d\": null\n}");
    REQUIRE (json.messages.empty());
    CHECK (json.root["a"][1]["b/c"] == -1500.0);
    CHECK (json.positions.at ("") == (TextPosition { 1, 1 }));
    CHECK (json.positions.at ("/a") == (TextPosition { 2, 3 }));
    CHECK (json.positions.at ("/a/0") == (TextPosition { 2, 9 }));
    CHECK (json.positions.at ("/a/1") == (TextPosition { 2, 12 }));
    CHECK (json.positions.at ("/a/1/ü") == (TextPosition { 2, 13 }));
    CHECK (json.positions.at ("/a/1/b~1c") == (TextPosition { 2, 21 }));
    CHECK (json.positions.at ("/a/2") == (TextPosition { 2, 37 }));
    CHECK (json.positions.at ("/d") == (TextPosition { 3, 2 }));
    CHECK (positionOf (json.positions, "/a/1/ü/deeper/still") == (TextPosition { 2, 13 }));
    CHECK (positionOf (json.positions, "/nowhere") == (TextPosition { 1, 1 }));
}

TEST_CASE ("a syntax error reports the place, what was expected and what was found")
{
    CHECK_THAT (complaint (""), Contains ("1:1 file/syntax the file should begin with {, found the end of the file"));
    CHECK_THAT (complaint ("<graph>"), Contains ("1:1 file/syntax the file should begin with {, found '<'"));
    CHECK_THAT (complaint ("{\n"), Contains ("2:1 file/syntax expected a key in double quotes or a }") && Contains ("cut off"));
    CHECK_THAT (complaint ("{\"a\": 1"), Contains ("1:8 file/syntax a comma or a } should follow the value of 'a'") && Contains ("cut off"));
    CHECK_THAT (complaint ("{\"a\" 1}"), Contains ("1:6 file/syntax a : should follow the key 'a', found '1'"));
    CHECK_THAT (complaint ("{\"a\": }"), Contains ("1:7 file/syntax a value should follow the key 'a', found '}'"));
    CHECK_THAT (complaint ("{\"a\": 1,\n}"), Contains ("2:1 file/syntax a key in double quotes should follow the comma") && Contains ("remove the comma"));
    CHECK_THAT (complaint ("{\"a\": 1 \"b\": 2}"),
                Contains ("1:9 file/syntax a comma or a } should follow the value of 'a', found a string") && Contains ("add the comma"));
    CHECK_THAT (complaint ("{\"a\": [1 2]}"), Contains ("1:10 file/syntax a comma or a ] should follow") && Contains ("add the comma"));
    CHECK_THAT (complaint ("{\"a\": [1}"), Contains ("1:9 file/syntax a comma or a ] should follow") && Contains ("which bracket"));
    CHECK_THAT (complaint ("{\"a\": 1} x"), Contains ("1:10 file/syntax the file should end after its closing bracket, found 'x'"));
    CHECK_THAT (complaint ("{\"a\": NaN}"), Contains ("1:7") && Contains ("found 'NaN'") && Contains ("no NaN"));
    CHECK_THAT (complaint ("{\"a\": -Infinity}"), Contains ("1:7 file/syntax '-Infinity' is not a number"));
    CHECK_THAT (complaint ("{\"a\": 1.}"), Contains ("1:7 file/syntax '1.' is not a number"));
    CHECK_THAT (complaint ("{\"a\": 1e999}"), Contains ("1:7 file/syntax the number '1e999' is too large"));
    CHECK_THAT (complaint ("{'a': 1}"), Contains ("1:2") && Contains ("double quotes"));
    CHECK_THAT (complaint ("{a: 1}"), Contains ("1:2") && Contains ("put the key in double quotes"));
    CHECK_THAT (complaint ("{\"a\": 1 // one\n}"), Contains ("1:9") && Contains ("no comments"));
    CHECK_THAT (complaint ("{\"a\": \"one\n\"}"), Contains ("1:7 file/syntax the string that begins here is not closed on its line"));
    CHECK_THAT (complaint ("{\"a\": \"one"), Contains ("1:7 file/syntax the string that begins here is not closed"));
    CHECK_THAT (complaint ("{\"ü\": \"\\q\"}"), Contains ("1:9 file/syntax a string contains a bad escape"));
    CHECK_THAT (complaint ("{\"a\": \"x\xFFy\"}"), Contains ("1:9 file/syntax a string contains a byte that is not UTF-8"));
    CHECK_THAT (complaint ("{\"a\": \"x\x01\"}"), Contains ("1:9 file/syntax a string contains a control character"));
}

TEST_CASE ("a duplicate key is reported with both places")
{
    const auto json = readJson ("{ \"a\": { \"mu\": 1,\n  \"mu\": 2 } }");
    REQUIRE (json.messages.size() == 1);
    CHECK (json.messages[0].id == "file/duplicate_key");
    CHECK (json.messages[0].where == "/a/mu");
    CHECK (json.messages[0].line == 2);
    CHECK (json.messages[0].column == 3);
    CHECK_THAT (json.messages[0].text, Contains ("first at line 1, column 10"));
}

TEST_CASE ("a duplicate key is found in objects of any size")
{
    std::string members;
    for (int n = 1; n < 300; ++n)
    {
        members += (n > 1 ? ", \"k" : "\"k") + std::to_string (n) + "\": " + std::to_string (n);
        const auto json = readJson ("{ " + members + " }");
        REQUIRE (json.messages.empty());
        REQUIRE (json.root.size() == static_cast<std::size_t> (n));
        REQUIRE (json.root["k" + std::to_string (n)] == n);
        for (const int twin : { 1, (n + 1) / 2, n })
        {
            const auto again = readJson ("{ " + members + ", \"k" + std::to_string (twin) + "\": 0, \"more\": 1 }");
            REQUIRE (again.messages.size() == 1);
            REQUIRE (again.messages[0].where == "/k" + std::to_string (twin));
        }
    }
}

TEST_CASE ("nesting and size are limited, and the limits are detected quickly")
{
    CHECK_THAT (complaint (std::string (10'000'000, '[')), Contains ("1:65 file/too_deep"));
    CHECK_THAT (complaint (std::string (64, '[') + std::string (64, ']')), Contains ("0 messages"));
    CHECK_THAT (complaint (std::string (static_cast<std::size_t> (budgets().file) + 1, ' ')), Contains ("file/too_large"));

    // Ten times as many members take about ten times as much of the processor, and a hundred times as much if anything is quadratic.
    const auto read = [] (std::size_t members) {
        std::string many = "{";
        for (std::size_t i = 0; i < members; ++i)
            many += "\"k" + std::to_string (i) + "\":0,";
        const auto begin = std::clock();
        CHECK (readJson (many + "\"end\":0}").root.size() == members + 1);
        return static_cast<double> (std::clock() - begin);
    };
    double few = 1e300, many = 1e300;
    for (int turn = 0; turn < 3; ++turn)   // the shortest of three, in turn: other programs disturb both in the same way
    {
        few = std::min (few, read (20'000));
        many = std::min (many, read (200'000));
    }
    CHECK (many < 40.0 * few);
}

TEST_CASE ("a byte order mark is not part of the first line")
{
    const auto json = readJson ("\xEF\xBB\xBF{ \"a\": 1 }");
    CHECK (json.messages.empty());
    CHECK (json.positions.at ("/a") == (TextPosition { 1, 3 }));
}
