// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/file/assets/table.hpp>

#include <tactus/text/number_text.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using readers::readGrid;

namespace
{
void checkGrid (const std::string& text, int rows, int columns, const std::vector<double>& values)
{
    INFO (text);
    const auto grid = readGrid (text, "a.csv");
    INFO ((grid ? "" : describe (grid.error())));
    REQUIRE (grid);
    CHECK (grid->rows == rows);
    CHECK (grid->columns == columns);
    CHECK (grid->values == values);
}

std::string problem (const std::string& text)
{
    const auto grid = readGrid (text, "a.csv");
    return grid ? "" : grid.error().id + " at " + grid.error().where;
}
}   // namespace

TEST_CASE ("tables from spreadsheets, instruments and programs are read", "[file][assets][table]")
{
    const std::vector<double> six { 1, -2.5, 3e-3, 4, 5, 6 };
    checkGrid ("1,-2.5,3e-3\n4,5,6\n", 2, 3, six);
    checkGrid ("\xef\xbb\xbf"
               "1;-2.5; 3e-3;\r\n4;5;6;\r\n",
               2, 3, six);
    checkGrid ("# Channel: Height\n# Width: 3 um\n1\t-2.5\t3e-3\n4\t5\t6", 2, 3, six);
    checkGrid ("% of Matlab\n   1  -2.5 3e-3  \n\n  +4   5  6  \n\n", 2, 3, six);
    checkGrid ("Scan Parameters\nScan Type,Standard Scan\nStylus,Radius: 2.5 \xb5m\n\nx,y,z\n1,-2.5,3e-3,,\n4,5,6,,\n", 2, 3, six);
    checkGrid ("7\n", 1, 1, { 7 });
    checkGrid ("1\n2\n3\n", 3, 1, { 1, 2, 3 });
}

TEST_CASE ("positions and heights become a row of heights if the positions are evenly spaced", "[file][assets][table]")
{
    checkGrid ("Lateral um,Raw Micrometer,\n0.0,-9,,\n0.2,-7,,\n0.3,-6,,\n0.5,1,,\n", 1, 4, { -9, -7, -6, 1 });
    checkGrid ("0 5\n0 6\n0 7\n", 3, 2, { 0, 5, 0, 6, 0, 7 });   // two columns of heights
    CHECK (problem ("x y\n0 1\n1 2\n2 3\n7 4\n") == "table/uneven at a.csv:2");
}

TEST_CASE ("an unreadable table gives an error with a position", "[file][assets][table]")
{
    CHECK (problem ("") == "table/empty at a.csv:0");
    CHECK (problem ("a,b\nc,d\n") == "table/empty at a.csv:2");
    CHECK (problem ("1,2\n3\n") == "table/ragged_row at a.csv:2");
    CHECK (problem ("1,2\n\n3,4 N\n") == "table/not_a_number at a.csv:3");
    CHECK (problem ("1,2\n,,\n") == "table/ragged_row at a.csv:2");
    CHECK (problem ("1,,2\n") == "table/not_a_number at a.csv:1");
    CHECK (problem ("1,nan\n") == "table/not_a_number at a.csv:1");
    CHECK (problem ("1,1e999\n") == "table/not_a_number at a.csv:1");
    CHECK (problem ("1,2\nthree,4\n") == "table/not_a_number at a.csv:2");
    CHECK (problem (std::string ("1\0002\n", 4)) == "table/binary at a.csv:1");

    const auto commas = readGrid ("1;2,5,7\n", "a.csv");
    REQUIRE_FALSE (commas);
    CHECK (commas.error().remedy == "write decimal points instead of commas");
}

TEST_CASE ("numbers written as text are read back bit for bit", "[file][assets][table]")
{
    test::property ("any grid, any separator", [] {
        const int rows = *rc::gen::inRange (1, 6), columns = *rc::gen::inRange (3, 6);
        const auto separator = *rc::gen::element<std::string> (",", ";", "\t", " ", " , ", "; ");
        const auto end = *rc::gen::element<std::string> ("\n", "\r\n", "\r", "\n\n");
        std::vector<double> values;
        std::string text;
        for (int i = 0; i < rows * columns; ++i)
        {
            values.push_back (*rc::gen::arbitrary<double>() * std::pow (10.0, *rc::gen::inRange (-300, 300)));
            if (! isFinite (values.back())) values.back() = 0.0;
            text += numberText (values.back()) + ((i + 1) % columns == 0 ? end : separator);
        }
        const auto grid = readGrid (text, "a.csv");
        RC_ASSERT (grid);
        RC_ASSERT (grid->rows == rows);
        RC_ASSERT (grid->columns == columns);
        RC_ASSERT (grid->values == values);
    });
}

TEST_CASE ("positions that jitter give the heights at even positions", "[file][assets][table]")
{
    std::string text;
    std::vector<double> wanted;
    for (int i = 0; i < 50; ++i)
    {
        const double x = i + (i == 0 || i == 49 ? 0.0 : 0.4 * ((7 * i) % 11 - 5) / 5.0);
        text += numberText (x) + "\t" + numberText (3.0 * x) + "\n";   // a ramp is the same wherever it is read
        wanted.push_back (3.0 * i);
    }
    const auto grid = readGrid (text, "a.csv");
    REQUIRE (grid);
    REQUIRE (grid->values.size() == wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        CHECK (grid->values[i] == Approx (wanted[i]).margin (1e-6));
}

TEST_CASE ("decimal commas where semicolons or tabs separate, and UTF-16, are read", "[file][assets][table]")
{
    checkGrid ("0,5;1,25\n-3;4,0\n", 2, 2, { 0.5, 1.25, -3.0, 4.0 });
    checkGrid ("0,5\t1,25\n-3\t4,0\n", 2, 2, { 0.5, 1.25, -3.0, 4.0 });
    std::string wide = "\xff\xfe";
    for (const char c : std::string ("0,5;1,25\n-3;4\n"))
        (wide += c) += '\0';
    checkGrid (wide, 2, 2, { 0.5, 1.25, -3.0, 4.0 });
}
