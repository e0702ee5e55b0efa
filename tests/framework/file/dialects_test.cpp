// SPDX-License-Identifier: MIT
// Random tables as programs write them. The test knows the numbers, so the reader must give them bit for bit, or an error.
#include <tactus/file/assets/table.hpp>
#include <tactus/file/csv.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <random>
#include <string>
#include <vector>

using namespace tactus;

namespace
{
constexpr int tables = 300;

struct Random
{
    std::mt19937 engine { 1 };

    int below (int n) { return std::uniform_int_distribution { 0, n - 1 }(engine); }
    bool once_in (int n) { return below (n) == 0; }
};

/// A number as text with a point, of random digits.
std::string numberIn (Random& random)
{
    std::string text = random.once_in (3) ? "-" : "";
    text += std::to_string (random.below (1000));
    if (! random.once_in (4))
    {
        text += '.';
        for (int i = 0, n = 1 + random.below (6); i < n; ++i)
            text += static_cast<char> ('0' + random.below (10));
    }
    if (random.once_in (6)) text += "e-" + std::to_string (random.below (9));
    return text;
}

std::string inUtf16 (const std::string& text, bool is_big)
{
    std::string bytes = is_big ? "\xfe\xff" : "\xff\xfe";
    for (const char c : text)
        (is_big ? bytes += '\0' : bytes += c) += is_big ? c : '\0';
    return bytes;
}

struct WrittenTable
{
    std::string bytes {};
    std::vector<double> values {};
    int rows = 0, columns = 0;
};

/// A table with a random separator, decimal sign, ends of lines and encoding.
WrittenTable written (Random& random, bool has_header, bool may_have_spaces)
{
    WrittenTable table { .rows = 2 + random.below (6), .columns = 2 + random.below (4) };
    const char separators[] { ',', ';', '\t', ' ' };
    const char separator = separators[random.below (may_have_spaces ? 4 : 3)];
    const bool has_comma = (separator == ';' || separator == '\t') && random.once_in (2);
    const std::string end = random.once_in (2) ? "\n" : "\r\n";
    std::string text;
    if (has_header)
    {
        for (int c = 0; c < table.columns; ++c)
            text += (c > 0 ? std::string (1, separator) : "") + "c" + std::to_string (c);
        text += end;
    }
    for (int r = 0; r < table.rows; ++r)
        for (int c = 0; c < table.columns; ++c)
        {
            auto number = numberIn (random);
            table.values.push_back (std::strtod (number.c_str(), nullptr));
            if (const auto point = number.find ('.'); has_comma && point != number.npos) number[point] = ',';
            text += number + (c + 1 < table.columns ? std::string (1, separator) : r + 1 < table.rows || random.once_in (2) ? end
                                                                                                                            : "");
        }
    const int encoding = random.below (4);
    table.bytes = encoding == 0 ? text : encoding == 1 ? "\xef\xbb\xbf" + text
                                                       : inUtf16 (text, encoding == 3);
    return table;
}
}   // namespace

TEST_CASE ("tables of 300 dialects have the numbers that were written", "[file][csv]")
{
    Random random;
    for (int i = 0; i < tables; ++i)
    {
        const auto table = written (random, true, false);
        INFO (table.bytes);
        const auto read = readTable (table.bytes, "a.csv");
        INFO ((read ? "" : describe (read.error())));
        REQUIRE (read);
        REQUIRE (read->columns.size() == static_cast<std::size_t> (table.columns));
        REQUIRE (read->values == table.values);
    }
}

TEST_CASE ("maps of 300 dialects have the heights that were written", "[file][assets][table]")
{
    Random random;
    for (int i = 0; i < tables; ++i)
    {
        auto table = written (random, false, true);
        if (table.columns == 2) continue;   // may be positions and heights
        INFO (table.bytes);
        const auto read = readers::readGrid (table.bytes, "a.csv");
        INFO ((read ? "" : describe (read.error())));
        REQUIRE (read);
        REQUIRE (read->rows == table.rows);
        REQUIRE (read->values == table.values);
    }
}
