// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a recording of a pen tablet into a trace: evemu_to_trace pen.events --out pen.csv
#include <host/devices/evemu.hpp>
#include <host/devices/fields.hpp>
#include <host/io/csv.hpp>
#include <host/tools/measure_option.hpp>

#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>
#include <iterator>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr int input_at_fault = 1, usage = 2;

std::vector<double> valuesOf (const TraceData::Row& row) { return { row.t, row.position.x(), row.position.y(), row.position.z(), row.pressure }; }

const std::vector<std::string> columns { "t", "x", "y", "z", "pressure" };

bool print (const TraceData& trace)
{
    std::string text;
    for (const auto& column : columns)
        text += (text.empty() ? "" : ",") + column;
    text += '\n';

    for (const auto& row : trace.rows)
    {
        for (const double value : valuesOf (row))
            text += numberText (value) + ',';
        text.back() = '\n';
    }
    std::cout << text << std::flush;
    return static_cast<bool> (std::cout);
}

tl::expected<void, Error> write (const TraceData& trace, const std::string& path)
{
    auto writer = TableWriter::create (path, columns);
    if (! writer) return tl::unexpected (writer.error());

    for (const auto& row : trace.rows)
        if (auto done = writer->row (valuesOf (row)); ! done) return done;
    return writer->commit();
}
}   // namespace

int main (int argc, char** argv)
{
    CLI::App app { "Turns a recording of a pen tablet (evemu) into a trace (t,x,y,z,pressure; SI)." };
    EvemuOptions options;
    std::string in, out;

    app.add_option ("RECORDING", in, "lines E: sec.usec type code value; - for standard input")->required();
    app.add_option ("--out", out, "the trace; standard output without it");
    addMeasure (app, "--pitch", options.pitch, unit::metre, "of a unit of the tablet; otherwise as the recording says, or 0.005 mm");
    addMeasure (app, "--force", options.full_force, unit::newton, "at full pressure, otherwise 3 N");
    addMeasure (app, "--depth", options.full_depth, unit::metre, "under the surface at full pressure, otherwise 2 mm");
    addMeasure (app, "--lift", options.lift, unit::metre, "above the surface while the pen is up, otherwise 5 mm");
    addMeasure (app, "--rate", options.rate_hz, unit::hertz, "of the rows, otherwise 1 kHz");
    app.add_option ("--full-pressure", options.full_pressure, "units at full pressure; otherwise as the recording says, or 2047")->check (CLI::PositiveNumber);

    try
    {
        app.parse (argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit (error) == 0 ? 0 : usage;
    }

    std::ifstream file;
    if (in != "-") file.open (in, std::ios::binary);
    if (! file)
    {
        std::cerr << in << ": cannot be read\n";
        return input_at_fault;
    }
    std::istream& source = in == "-" ? std::cin : file;
    const std::string text { std::istreambuf_iterator<char> (source), {} };

    const auto [trace, messages] = readEvemu (text, options);
    for (const auto& message : messages)
        std::cerr << in << ", " << message.where << ": " << message.text << "; " << message.remedy << " [" << message.id << "]\n";
    if (hasErrors (messages)) return input_at_fault;

    if (out.empty()) return print (trace) ? 0 : input_at_fault;
    if (const auto done = write (trace, out); ! done)
    {
        std::cerr << describe (done.error()) << '\n';
        return input_at_fault;
    }
    return 0;
}
