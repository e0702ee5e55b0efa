// SPDX-License-Identifier: MIT
// Converts a recording of a pen tablet to a trace: evemu_to_trace pen.events --out pen.csv
#include "evemu.hpp"
#include "measure_option.hpp"
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/quote.hpp>

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

Result<> write (const TraceData& trace, const std::string& path)
{
    auto writer = TableWriter::create (path, columns);
    if (! writer) return writer.error();

    for (const auto& row : trace.rows)
        if (auto done = writer->row (valuesOf (row)); ! done) return done;
    return writer->commit();
}
}   // namespace

int main (int argc, char** argv)
{
    const Command app { "Converts a recording of a pen tablet (evemu) to a trace (t,x,y,z,pressure; SI)." };
    EvemuOptions options;
    std::string in, out;

    app.addOption ("RECORDING", in, "Output of evemu-record, with lines E: sec.usec type code value; - for standard input").required();
    app.addOption ("--out", out, "Trace file; default: standard output");
    addMeasure (app, "--pitch", options.pitch, unit::metre, "Length of one tablet unit; default: from the recording, else 0.005 mm");
    addMeasure (app, "--force", options.full_force, unit::newton, "Force at full pressure; default: 3 N");
    addMeasure (app, "--depth", options.full_depth, unit::metre, "Depth below the surface at full pressure; default: 2 mm");
    addMeasure (app, "--lift", options.lift, unit::metre, "Height above the surface while the pen is up; default: 5 mm");
    addMeasure (app, "--rate", options.rate_hz, unit::hertz, "Row rate; default: 1 kHz");
    app.addOption ("--full-pressure", options.full_pressure, "Units at full pressure; default: from the recording, else 2047").check (positive());

    if (const auto status = app.parse (argc, argv)) return *status == 0 ? 0 : usage;

    std::ifstream file;
    auto why = in == "-" ? std::string() : whyUnreadable (in);
    if (in != "-" && why.empty()) file.open (in, std::ios::binary);
    if (! file && why.empty()) why = "the system gave no reason";
    if (! why.empty())
    {
        std::cerr << printableName (in) << ": cannot be read: " << why << " [file/unreadable]\n";
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
