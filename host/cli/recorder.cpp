// SPDX-License-Identifier: GPL-3.0-or-later
#include "recorder.hpp"
#include "report.hpp"

#include <framework/number_text.hpp>

#include <filesystem>
#include <iostream>

namespace tactus::host
{

namespace
{
void printRow (std::span<const double> values)
{
    std::string line;
    for (const double v : values)
    {
        if (! line.empty()) line += ',';
        line += numberText (v);
    }
    std::cout << line << '\n';
}
}   // namespace

Recorder::Recorder (const std::vector<std::string>& files, const std::vector<Tap>& taps, double rate, bool to_standard_output) : rate_hz (rate), print (to_standard_output && files.empty())
{
    if (taps.empty() && (print || ! files.empty()))
        fail ("record/nothing", "there is nothing to record: the graph has no sink", "name ports with --record, as in --record drag.force");

    std::vector<std::string> columns { "t" };
    for (const auto& tap : taps)
        columns.push_back (tap.name);
    row.resize (columns.size());

    for (const auto& file : files)
    {
        const auto kind = std::filesystem::path (file).extension();
        if (kind == ".csv")
            tables.push_back (orFail (TableWriter::create (file, columns)));
        else if (kind == ".wav")
            waves.push_back (orFail (WavWriter::create (file, rate_hz, taps.size())));
        else
            fail ({ "output/kind", file, "the ending says neither CSV nor WAV", "name it .csv or .wav" });
    }
    if (! print) return;
    for (std::size_t i = 0; i < columns.size(); ++i)
        std::cout << (i ? "," : "") << columns[i];
    std::cout << '\n';
}

void Recorder::frame (std::span<const double> values)
{
    row[0] = static_cast<double> (ticks++) / rate_hz;
    std::ranges::copy (values, row.begin() + 1);
    for (auto& table : tables)
        orFail (table.row (row));
    for (auto& wave : waves)
        orFail (wave.frame (values));
    if (print) printRow (row);
}

void Recorder::commit()
{
    for (auto& table : tables)
        orFail (table.commit());
    for (auto& wave : waves)
        orFail (wave.commit());
    if (print && ! std::cout.flush()) fail ("output/unwritable", "the standard output could not be written", "check the disk, or the program it is piped into");
}

}   // namespace tactus::host
