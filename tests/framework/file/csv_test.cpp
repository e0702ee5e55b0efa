// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/file/csv.hpp>

#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

using namespace tactus;
using namespace std::string_literals;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

Table read (std::string_view text)
{
    auto table = readTable (text, "feed.csv");
    INFO ((table ? "" : describe (table.error())));
    REQUIRE (table.has_value());
    return *table;
}

Message errorOf (std::string_view text)
{
    const auto table = readTable (text, "feed.csv");
    REQUIRE_FALSE (table.has_value());
    CHECK_FALSE (table.error().text.empty());
    CHECK_FALSE (table.error().remedy.empty());
    return table.error();
}

bool sameNumber (double a, double b)
{
    return std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b) || (std::isnan (a) && std::isnan (b));
}
}   // namespace

TEST_CASE ("csv: a table has named columns and rows of numbers", "[host][io][csv]")
{
    const auto table = read ("t,drag.position.x\n0,1e-3\n0.00025,-2.5E-3\n");

    CHECK (table.columns == std::vector<std::string> { "t", "drag.position.x" });
    REQUIRE (table.rows() == 2);
    CHECK (table.at (1, *table.column ("drag.position.x")) == -2.5e-3);
    CHECK (table.row (1)[0] == 0.00025);
    CHECK_FALSE (table.column ("drag.position.y").has_value());
}

TEST_CASE ("csv: variants written by spreadsheets and instruments are accepted", "[host][io][csv]")
{
    const auto text = GENERATE (as<std::string> {},
                                "a,b\n1,2\n",
                                "a,b\n1,2",
                                "a,b\r\n1,2\r\n",
                                "a,b\r1,2\r",
                                "\xEF\xBB\xBF"
                                "a,b\n1,2\n",
                                "a,b\n1,2\n\n  \n\r\n\t\n",
                                "  a , b\t\n 1 ,\t2 \n",
                                "\"a\",\"b\"\n\"1\", \"2\" \n",
                                "a,b\n+1,+2.0e0\n");
    const auto table = read (text);

    CHECK (table.columns == std::vector<std::string> { "a", "b" });
    CHECK (table.values == std::vector<double> { 1.0, 2.0 });
}

TEST_CASE ("csv: nan and inf are values in every spelling", "[host][io][csv]")
{
    const auto table = read ("x\nnan\nNaN\nNAN\n-nan\ninf\nInf\nINF\n-inf\n-INF\n+inf\n");

    for (std::size_t row = 0; row < 4; ++row)
        CHECK (std::isnan (table.values[row]));
    for (std::size_t row : { 4u, 5u, 6u, 9u })
        CHECK (table.values[row] == infinity);
    for (std::size_t row : { 7u, 8u })
        CHECK (table.values[row] == -infinity);
}

TEST_CASE ("csv: a quoted column name may contain a comma and quotes", "[host][io][csv]")
{
    CHECK (read ("\"force, \"\"raw\"\"\",b\n1,2\n").columns[0] == "force, \"raw\"");
}

TEST_CASE ("csv: a header alone is a table without rows", "[host][io][csv]")
{
    CHECK (read ("t,x\n").rows() == 0);
    CHECK (read ("t").columns.size() == 1);
}

TEST_CASE ("csv: every error has its own id and place", "[host][io][csv]")
{
    struct Case
    {
        std::string text, id, where;
    };
    const auto c = GENERATE (values<Case> ({
        { "", "csv/empty", "feed.csv" },
        { "\xEF\xBB\xBF \r\n\n", "csv/empty", "feed.csv" },
        { "\n\na,b\n1,2\n", "csv/blank_line", "feed.csv:1:1" },
        { "0,1\n1,2\n", "csv/no_header", "feed.csv:1:1" },
        { "a,,c\n1,2,3\n", "csv/empty_column_name", "feed.csv:1:3" },
        { "a,b,\n1,2,\n", "csv/empty_column_name", "feed.csv:1:5" },
        { "a,b, a\n1,2,3\n", "csv/duplicate_column", "feed.csv:1:6" },
        { "a,b\n1,2\n3,\n", "csv/empty_field", "feed.csv:3:3" },
        { "a,b\n1,\"\"\n", "csv/empty_field", "feed.csv:2:3" },
        { "a,b\n1,2\n1.5 N,2\n", "csv/not_a_number", "feed.csv:3:1" },
        { "a,b\n1,  0x10\n", "csv/not_a_number", "feed.csv:2:5" },
        { "a,b\n1,+-2\n", "csv/not_a_number", "feed.csv:2:3" },
        { "a,b\n1;2,3\n", "csv/not_a_number", "feed.csv:2:1" },
        { "a;b\n1.000,5;2\n", "csv/not_a_number", "feed.csv:2:1" },
        { "a,b\n1,1e999\n", "csv/out_of_range", "feed.csv:2:3" },
        { "a,b\n1\n", "csv/ragged_row", "feed.csv:2:1" },
        { "a,b\n1,2,3\n", "csv/ragged_row", "feed.csv:2:5" },
        { "a,b\n1,2\n\n3,4\n", "csv/blank_line", "feed.csv:3:1" },
        { "a,\"b\n1,2\n", "csv/broken_quote", "feed.csv:1:3" },
        { "\"a\" x,b\n1,2\n", "csv/broken_quote", "feed.csv:1:5" },
        { "a,b\n1,\0"s, "csv/nul_byte", "feed.csv:2:3" },
        { "a,b\n" + std::string (1'000'000, '1') + ",2\n", "csv/line_too_long", "feed.csv:2:524289" },
    }));

    CAPTURE (c.text.substr (0, 40));
    CHECK (errorOf (c.text).id == c.id);
    CHECK (errorOf (c.text).where == c.where);
}

TEST_CASE ("csv: a missing file, a folder and a bad table give different errors", "[host][io][csv]")
{
    const TemporaryFolder folder;

    CHECK (readTable (folder / "none.csv").error().id == "csv/unreadable");
    CHECK (readTable (folder.path()).error().id == "csv/unreadable");
}

TEST_CASE ("csv: no text crashes the reader", "[host][io][csv]")
{
    const auto bytes = [] (const std::string& text) {
        std::ignore = readTable (text, "any");
    };

    const auto almost_tables = [] {
        const auto text = *rc::gen::container<std::string> (rc::gen::elementOf ("a1,,\n\r\" .-+einf\t\0\xEF\xBB\xBF"s));
        if (const auto table = readTable (text, "any"))
            RC_ASSERT (table->values.size() == table->rows() * table->columns.size());
        else
            RC_ASSERT (table.error().id.starts_with ("csv/"));
    };

    test::property ("any bytes", bytes);
    test::property ("almost tables", almost_tables);
}

TEST_CASE ("csv: every number reads back to the same double", "[host][io][csv]")
{
    const TemporaryFolder folder;

    const auto round_trip = [&] (const std::vector<std::pair<std::uint64_t, std::uint64_t>>& bits) {
        const std::vector<std::string> columns { "a", "b, \"quoted\"" };
        auto writer = TableWriter::create (folder / "out.csv", columns);
        RC_ASSERT (writer.has_value());

        std::vector<double> written;
        for (const auto& [a, b] : bits)
        {
            const std::array row { std::bit_cast<double> (a), std::bit_cast<double> (b) };
            RC_ASSERT (writer->row (row).has_value());
            written.insert (written.end(), row.begin(), row.end());
        }
        RC_ASSERT (writer->commit().has_value());

        const auto table = readTable (folder / "out.csv");
        RC_ASSERT (table.has_value());
        RC_ASSERT (table->columns == columns);
        RC_ASSERT (std::ranges::equal (table->values, written, sameNumber));
    };

    test::property ("any bit pattern", round_trip);
}

TEST_CASE ("csv: numbers are written in their shortest form, and lines end in LF", "[host][io][csv]")
{
    const TemporaryFolder folder;
    auto writer = TableWriter::create (folder / "out.csv", std::vector<std::string> { "a", "b", "c", "d" });
    REQUIRE (writer.has_value());

    REQUIRE (writer->row (std::vector { 0.1, -0.0, 5e-324, 1e300 }).has_value());
    REQUIRE (writer->row (std::vector { std::nan (""), -std::nan (""), infinity, -infinity }).has_value());
    REQUIRE (writer->commit().has_value());

    CHECK (folder.textOf ("out.csv") == "a,b,c,d\n0.1,-0,5e-324,1e+300\nnan,nan,inf,-inf\n");
}

TEST_CASE ("csv: an unfinished table leaves nothing behind", "[host][io][csv]")
{
    const TemporaryFolder folder;
    {
        auto writer = TableWriter::create (folder / "out.csv", std::vector<std::string> { "a" });
        REQUIRE (writer.has_value());
        REQUIRE (writer->row (std::vector { 1.0 }).has_value());
    }
    CHECK (folder.isEmpty());
}

TEST_CASE ("csv: a header that cannot be read back is not written", "[host][io][csv]")
{
    const TemporaryFolder folder;
    const auto create = [&] (std::vector<std::string> columns) { return TableWriter::create (folder / "out.csv", columns).error().id; };

    CHECK (create ({}) == "csv/empty");
    CHECK (create ({ "", "a" }) == "csv/empty_column_name");
    CHECK (create ({ "a", "a" }) == "csv/duplicate_column");
    CHECK (create ({ "a\n1" }) == "csv/column_name");
    CHECK (create ({ " a" }) == "csv/column_name");
    CHECK (create ({ "1", "2" }) == "csv/no_header");
    CHECK (folder.isEmpty());
}

TEST_CASE ("csv: a row of the wrong width is refused", "[host][io][csv]")
{
    const TemporaryFolder folder;
    auto writer = TableWriter::create (folder / "out.csv", std::vector<std::string> { "a", "b" });
    REQUIRE (writer.has_value());

    CHECK (writer->row (std::vector { 1.0 }).error().id == "csv/ragged_row");
}

TEST_CASE ("csv: a full disk is an error, not a short table", "[host][io][csv]")
{
    if (! std::filesystem::exists ("/dev/full"))
        return;

    auto writer = TableWriter::create ("/dev/full", std::vector<std::string> { "a" });
    REQUIRE (writer.has_value());
    auto written = writer->row (std::vector { 1.0 });
    for (int row = 0; row < 100'000 && written; ++row)
        written = writer->row (std::vector { 1.0 });

    REQUIRE_FALSE (written.has_value());
    CHECK (written.error().id == "output/unwritable");
    CHECK_THAT (written.error().text, Catch::Contains ("the disk is full") && Catch::Contains ("No space left"));
}

TEST_CASE ("csv: rows are in the file once flushed, and the file never ends within a row", "[host][io][csv]")
{
    const TemporaryFolder folder;
    auto writer = TableWriter::create (folder / "out.csv", std::vector<std::string> { "a", "b" }, IfKilled::kept);
    REQUIRE (writer.has_value());
    for (int k = 0; k < 20'000; ++k)
    {
        REQUIRE (writer->row (std::vector { 1.0 * k, 1.0 / 3.0 }).has_value());
        if (k % 100 != 0) continue;
        const auto text = folder.textOf ("out.partial.csv");
        REQUIRE ((text.empty() || text.ends_with (",0.3333333333333333\n")));
    }
    REQUIRE (writer->flush().has_value());
    const auto table = readTable (folder / "out.partial.csv");
    REQUIRE (table.has_value());
    CHECK (table->rows() == 20'000);
    CHECK (table->at (19'999, 0) == 19'999.0);
}

TEST_CASE ("tables of spreadsheets are read: semicolons and tabs, decimal commas, UTF-16", "[file][csv]")
{
    const auto wide = [] (std::string_view text, bool is_big, bool has_mark) {
        std::string bytes = has_mark ? (is_big ? "\xfe\xff" : "\xff\xfe") : "";
        for (const char c : text)
        {
            if (is_big) bytes += '\0';
            bytes += c;
            if (! is_big) bytes += '\0';
        }
        return bytes;
    };
    const std::string plain = "t,x\n0.5,-1.25\n1.5,2e-3\n";
    const auto wanted = readTable (plain, "a.csv");
    REQUIRE (wanted);
    const std::string semicolons = "t;x\r\n0,5;-1,25\r\n1,5;2e-3\r\n", tabs = "t\tx\n0,5\t-1,25\n1,5\t0,002\n";
    for (const auto& text : { semicolons, tabs, std::string ("\"t\";\"x\"\n0.5;-1.25\n1.5;\"0,002\"\n"), wide (semicolons, false, true),
                              wide (plain, true, true), wide (tabs, false, false), wide (plain, true, false) })
    {
        const auto table = readTable (text, "a.csv");
        INFO ((table ? "" : describe (table.error())));
        REQUIRE (table);
        CHECK (table->columns == wanted->columns);
        CHECK (table->values == wanted->values);
    }
}
