// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

namespace tactus::test
{

namespace
{
std::string pathOf (const std::string& name)
{
    const auto folder = std::filesystem::path (TACTUS_SOURCE_DIR) / "build" / "figures";
    std::filesystem::create_directories (folder);
    return (folder / (name + ".csv")).string();
}

Record render (const std::string& graph, const std::string& out, const std::vector<std::string>& options, const std::string& command = "render")
{
    std::vector<std::string> arguments { command, TACTUS_SOURCE_DIR "/docs/figures/" + graph + ".json", "--out", out };
    arguments.insert (arguments.end(), options.begin(), options.end());
    const auto ran = runTactus (arguments);
    INFO (ran.err);
    REQUIRE (ran.status == 0);

    auto table = readTable (std::filesystem::path (out));
    REQUIRE (table);
    return Record { *std::move (table) };
}
}   // namespace

Record::Record (Table recorded) : table (std::move (recorded)) {}

std::size_t Record::index (const std::string& column) const
{
    const auto found = table.column (column);
    if (! found) FAIL ("there is no recorded column " << column);
    return *found;
}

std::vector<double> Record::operator[] (const std::string& column) const
{
    const auto i = index (column);
    std::vector<double> all;
    for (std::size_t r = 0; r < table.rows(); ++r)
        all.push_back (table.at (r, i));
    return all;
}

Record renderFigure (const std::string& graph, const std::string& name, const std::vector<std::string>& options)
{
    return render (graph, pathOf (name), options);
}

Record analyseFigure (const std::string& command, const std::string& name, const std::vector<std::string>& options)
{
    return render (name, pathOf (name), options, command);
}

Record renderOnce (const std::string& graph, const std::vector<std::string>& options)
{
    const Scratch scratch;
    return render (graph, scratch.path ("out.csv"), options);
}

void writeFigure (const std::string& name, const std::vector<std::string>& columns, const Columns& rows)
{
    auto writer = TableWriter::create (pathOf (name), columns);
    REQUIRE (writer);
    for (const auto& row : rows)
        REQUIRE (writer->row (row));
    REQUIRE (writer->commit());
}

}   // namespace tactus::test
