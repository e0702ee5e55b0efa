// SPDX-License-Identifier: GPL-3.0-or-later
#include "recorder.hpp"
#include "report.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <utility>

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

/// Calls `work` with each file. If `work` fails, the file is closed and its incomplete content is removed.
template <typename File, typename Do>
void giveUpWhere (std::vector<File>& files, std::vector<Message>& failed, Do&& work)
{
    for (std::size_t i = 0; i < files.size();)
        if (auto done = work (files[i]); done)
            ++i;
        else
        {
            failed.push_back (std::move (done.error()));
            files.erase (files.begin() + static_cast<std::ptrdiff_t> (i));
        }
}

bool isWave (const std::string& file) { return std::filesystem::path (file).extension() == ".wav"; }
}   // namespace

Recorder::Recorder (const std::vector<std::string>& files, const std::vector<Tap>& all, double rate, bool to_standard_output, IfKilled if_killed,
                    bool all_samples)
    : rate_hz (rate), taps (all.size()), print (to_standard_output && files.empty())
{
    if (all.empty() && (print || ! files.empty()))
        fail ("record/nothing", "there is nothing to record: the graph has no sink", "name ports with --record, as in --record drag.force");

    std::vector<std::string> columns { "t" };
    for (const auto& tap : all)
        columns.push_back (tap.name);
    row.resize (columns.size());
    held.resize (taps);
    const bool alike = ! all.empty() && std::ranges::all_of (all, [&] (const Tap& tap) { return tap.per_tick == all[0].per_tick; });
    if (alike && (all_samples || std::ranges::any_of (files, isWave))) per_tick = static_cast<std::size_t> (all[0].per_tick);

    for (const auto& file : files)
    {
        if (std::filesystem::path (file).extension() == ".csv")
            tables.push_back (orFail (TableWriter::create (file, columns, if_killed)));
        else if (isWave (file))
            waves.push_back (orFail (WavWriter::create (file, rate_hz * static_cast<double> (per_tick), taps, if_killed)));
        else
            fail (Message::error ("output/kind", file, "the file name does not end in .csv or .wav", "choose a name that ends in .csv or .wav"));
    }
    if (! print) return;
    for (std::size_t i = 0; i < columns.size(); ++i)
        std::cout << (i ? "," : "") << columns[i];
    std::cout << '\n';
}

void Recorder::note (const std::vector<Tap>& all, std::span<double> values) const noexcept
{
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = all[i % taps].sample (static_cast<int> (i / taps), static_cast<int> (per_tick));
}

std::vector<Message> Recorder::frame (std::uint64_t tick, std::span<const double> values)
{
    row[0] = static_cast<double> (tick) / rate_hz;
    std::ranges::copy (values.last (taps), row.begin() + 1);
    std::vector<Message> failed;
    giveUpWhere (tables, failed, [&] (TableWriter& table) { return table.row (row); });
    giveUpWhere (waves, failed, [&] (WavWriter& wave) { return add (wave, tick, values); });
    std::ranges::copy (values.last (taps), held.begin());
    next = tick + 1;
    if (print) printRow (row);
    return failed;
}

Result<> Recorder::add (WavWriter& wave, std::uint64_t tick, std::span<const double> values)
{
    for (auto missing = (tick - next) * per_tick; missing > 0; --missing)
        if (auto written = wave.frame (held); ! written) return written;
    for (std::size_t i = 0; i < per_tick; ++i)
        if (auto written = wave.frame (values.subspan (i * taps, taps)); ! written) return written;
    return {};
}

std::vector<Message> Recorder::flush()
{
    std::vector<Message> failed;
    const auto flushOne = [] (auto& file) { return file.flush(); };
    giveUpWhere (tables, failed, flushOne);
    giveUpWhere (waves, failed, flushOne);
    return failed;
}

std::vector<Message> Recorder::commit()
{
    std::vector<Message> failed;
    const auto commitOne = [] (auto& file) { return file.commit(); };
    giveUpWhere (tables, failed, commitOne);
    giveUpWhere (waves, failed, commitOne);
    if (print && ! std::cout.flush())
        failed.push_back (Message::error ("output/unwritable", "the standard output", "cannot be written",
                                          "check the disk, or the program that the output is piped into"));
    return failed;
}

}   // namespace tactus::host
