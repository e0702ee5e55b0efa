// SPDX-License-Identifier: MIT
#include "run_test.hpp"
#include "graph_snapshot.hpp"
#include "log_lines.hpp"
#include "log_number.hpp"

#include <tactus/file/atomic_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>
#include <utility>

namespace tactus
{

namespace
{
namespace fs = std::filesystem;

const std::string unchanged = "use the file unchanged, as `tactus capture` wrote it";

Message wrongTest (std::string id, const std::string& name, std::uint64_t line, std::string what, std::string remedy = unchanged)
{
    return Message::error (std::move (id), name + ":" + std::to_string (line), std::move (what), std::move (remedy));
}

Result<std::unique_ptr<std::ifstream>> opened (const std::string& path)
{
    const auto refuse = [&] (const std::string& why) { return Message::error ("file/unreadable", path, "cannot be read: " + why, "check the path"); };
    if (const auto why = whyUnreadable (path); ! why.empty()) return refuse (why);
    auto in = std::make_unique<std::ifstream> (path, std::ios::binary);
    if (! *in) return refuse ("the system gave no reason");
    return in;
}

/// Reads a line, which may be as long as a whole file may be. Empty at the end of the file, or if the line has no end.
std::optional<std::string> wholeLine (std::istream& in)
{
    const double longest = budgets().file;
    std::string text;
    for (int c = in.get(); c != std::istream::traits_type::eof() && static_cast<double> (text.size()) <= longest; c = in.get())
    {
        if (c == '\n') return text;
        text += static_cast<char> (c);
    }
    return std::nullopt;
}

/// The tick of a line of a log. It is usually the first member; other lines are parsed as a whole.
std::optional<std::uint64_t> tickOf (const std::string& line)
{
    constexpr std::string_view begin = "{\"tick\":";
    std::uint64_t tick = 0;
    if (line.starts_with (begin))
    {
        const auto [end, error] = std::from_chars (line.data() + begin.size(), line.data() + line.size(), tick);
        if (error == std::errc {} && end != line.data() + line.size() && (*end == ',' || *end == '}')) return tick;
    }
    const auto read = readJson (line);
    if (hasErrors (read.messages) || ! read.root.is_object()) return std::nullopt;
    const auto member = read.root.find ("tick");
    if (member == read.root.end() || ! member->is_number_unsigned()) return std::nullopt;
    return member->get<std::uint64_t>();
}

bool hasGraph (const std::string& line) { return line.find ("\"graph\"") != line.npos; }

/// The first line of a log, for lines that are not packed.
std::string unpackedHead (const std::string& head)
{
    auto read = readJson (head);
    return read.root.is_object() && read.root.erase ("packed") > 0 ? read.root.dump() : head;
}

/// The lines of a log up to a tick, or all of them, with paths relative to another folder, the hash of the first graph, and the tick of the last line.
struct LogPart
{
    std::string text, hash;
    std::uint64_t last = 0;
};

Result<LogPart> partOf (const std::string& log, std::optional<std::uint64_t> until, const fs::path& folder)
{
    auto in = opened (log);
    if (! in) return in.error();
    LogLines lines { std::move (*in) };
    auto head = lines.next();
    LogPart part;
    if (! head) return wrongTest ("log/not_a_log", log, 1, "it has no complete line", "name the file that `tactus play --log` wrote");
    part.text = unpackedHead (*head) + "\n";
    std::uint64_t number = 1;
    for (auto line = lines.next(); line; line = lines.next())
    {
        ++number;
        const auto tick = tickOf (*line);
        if (! tick) return wrongTest ("log/missing", log, number, "the line has no \"tick\"", "use the log unchanged, as `tactus play` wrote it");
        if (until && *tick >= *until) break;
        part.last = *tick;
        if (hasGraph (*line))
        {
            auto read = readJson (*line);
            if (hasErrors (read.messages) || ! read.root.is_object()) return wrongTest ("log/value", log, number, "the line is not JSON", unchanged);
            if (auto graph = read.root.find ("graph"); graph != read.root.end() && graph->is_object())
            {
                if (part.hash.empty()) part.hash = snapshotHash (*graph);
                *graph = movedSnapshot (std::move (*graph), fs::path (log).parent_path(), folder);
                *line = read.root.dump();
            }
        }
        part.text += *line + "\n";
    }
    if (until) part.text += "{\"tick\":" + std::to_string (*until) + ",\"end\":true}\n";
    return part;
}

bool sameBits (double a, double b) noexcept
{
    return std::bit_cast<std::uint64_t> (a) == std::bit_cast<std::uint64_t> (b) || (std::isnan (a) && std::isnan (b));
}

bool readTexts (const Json& from, std::vector<std::string>& to)
{
    if (! from.is_array()) return false;
    for (const auto& text : from)
    {
        if (! text.is_string()) return false;
        to.push_back (text.asString());
    }
    return true;
}

/// Reads the members of the first line. False if one is missing or has the wrong type.
bool takeHead (const Json& root, RunTestHead& head)
{
    const auto member = [&] (const char* key) { return root.value (key, Json()); };
    const auto program = member ("program"), graph = member ("graph"), from = member ("from"), until = member ("until");
    if (! program.is_string() || ! graph.is_string() || ! from.is_number_unsigned() || ! until.is_number_unsigned()) return false;
    head.program = program.asString();
    head.graph = graph.asString();
    head.from = from.get<std::uint64_t>();
    head.until = until.get<std::uint64_t>();
    return readTexts (member ("records"), head.records) && readTexts (member ("ports"), head.ports) && head.until > head.from && ! head.ports.empty();
}

/// Compares the values of one tick.
void compareTick (const std::vector<Tap>& taps, std::span<const double> expected, std::uint64_t tick, std::vector<RunDifference>& by_port)
{
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        const double found = *taps[i].value;
        if (sameBits (found, expected[i])) continue;
        auto& d = by_port[i];
        if (d.ticks++ == 0) d = { taps[i].name, tick, expected[i], found, 1 };
    }
}

Result<> checkNames (const RunTestHead& head, const std::vector<Tap>& taps, const std::string& name)
{
    const bool same = std::ranges::equal (head.ports, taps, {}, {}, &Tap::name);
    if (same) return {};
    for (const auto& port : head.ports)
        if (std::ranges::count (taps, port, &Tap::name) == 0)
            return Message::error ("test/ports", name, "the graph has no port " + port + ", which the test compares", "test a graph that has it");
    return Message::error ("test/ports", name, "the ports of the graph are not those that the test compares", "write the test again with `tactus capture`");
}
}   // namespace

Result<> writeRunTest (const std::string& log, const fs::path& test, const Stretch& stretch, const std::vector<std::string>& records,
                       const std::string& program)
{
    if (stretch.names.empty()) return Message::error ("test/no_ports", log, "no port is compared", "name ports to compare, as with --record drag.force");
    const auto part = partOf (log, stretch.until, test.parent_path());
    if (! part) return part.error();
    auto file = AtomicFile::create (test);
    if (! file) return file.error();
    auto& out = file->stream();
    out << Json { { "format", run_test_format },
                  { "version", run_test_version },
                  { "program", program },
                  { "graph", part->hash },
                  { "records", Json (records) },
                  { "ports", Json (stretch.names) },
                  { "from", stretch.from },
                  { "until", stretch.until } }
               .dump()
        << '\n';
    for (std::size_t k = 0; k < stretch.ticks(); ++k)
    {
        for (std::size_t i = 0; i < stretch.names.size(); ++i)
            out << (i == 0 ? '[' : ',') << logNumber (stretch.value (k, i));
        out << "]\n";
    }
    out << part->text;
    if (! out) return file->writeError();
    return file->commit();
}

Result<std::uint64_t> copyRunLog (const std::string& log, const fs::path& to)
{
    const auto all = partOf (log, {}, to.parent_path());
    if (! all) return all.error();
    auto file = AtomicFile::create (to);
    if (! file) return file.error();
    file->stream() << all->text;
    if (! file->stream()) return file->writeError();
    if (auto done = file->commit(); ! done) return done.error();
    return all->last;
}

Result<RunTestHead> readRunTestHead (std::istream& in, const std::string& name)
{
    const auto line = wholeLine (in);
    const auto read = line ? readJson (*line) : JsonText {};
    const auto not_a_test = [&] (const std::string& why) {
        return wrongTest ("test/not_a_test", name, 1, "this is not a test of a run: " + why, "name a file that `tactus capture --test` wrote");
    };
    if (! line) return not_a_test ("it has no complete line");
    if (hasErrors (read.messages) || ! read.root.is_object()) return not_a_test ("its first line is not a JSON object");
    if (read.root.value ("format", Json()) != Json (std::string (run_test_format)))
        return not_a_test ("its first line does not have \"format\": \"" + std::string (run_test_format) + "\"");
    const auto version = read.root.value ("version", Json());
    if (! version.is_number_unsigned() || version.get<std::uint64_t>() < 1)
        return wrongTest ("test/unknown_version", name, 1, "version " + version.dump() + " of the format does not exist");
    if (version.get<std::uint64_t>() > run_test_version)
        return wrongTest ("test/newer_version", name, 1, "the test was written by a newer Tactus", "use that version");
    RunTestHead head;
    if (! takeHead (read.root, head)) return wrongTest ("test/value", name, 1, "a member of the first line is missing or has the wrong type");
    return head;
}

Result<std::vector<double>> readExpected (std::istream& in, const RunTestHead& head, const std::string& name)
{
    const double numbers = static_cast<double> (head.until - head.from) * static_cast<double> (head.ports.size());
    if (numbers > budgets().numbers)
    {
        auto over = overBudget ("test/too_large", &Budgets::numbers, "the test", numbers, "capture a shorter stretch");
        over.where = name;
        return over;
    }
    std::vector<double> values;
    for (std::uint64_t k = 0; k < head.until - head.from; ++k)
    {
        const auto line = wholeLine (in);
        if (! line) return wrongTest ("test/cut_off", name, k + 2, "the file is cut off");
        const auto read = readJson (*line);
        if (hasErrors (read.messages) || ! read.root.is_array() || read.root.size() != head.ports.size())
            return wrongTest ("test/value", name, k + 2, "this is not a list of " + std::to_string (head.ports.size()) + " values");
        for (const auto& value : read.root)
        {
            const auto number = fromLog (value);
            if (! number) return wrongTest ("test/value", name, k + 2, "a value is not a number, \"nan\", \"inf\" or \"-inf\"");
            values.push_back (*number);
        }
    }
    return values;
}

namespace
{
/// Checks that the log begins with the graph that the test names. Reads a part of the log, and seeks back.
Result<> checkGraph (std::istream& in, const RunTestHead& head, const std::string& name)
{
    const auto begin = in.tellg();
    static_cast<void> (wholeLine (in));
    const auto first = wholeLine (in);
    in.clear();
    in.seekg (begin);
    const auto read = first ? readJson (*first) : JsonText {};
    const auto graph = read.root.is_object() ? read.root.value ("graph", Json()) : Json();
    if (graph.is_object() && snapshotHash (graph) == head.graph) return {};
    return Message::error ("test/graph_changed", name, "its graph is not the one that gave the expected values",
                           "use the file unchanged, or give --graph to test another graph");
}

/// Plays the run and compares every tick of the stretch.
Result<> comparePlayed (Replay& replay, const RunTestHead& head, const std::vector<double>& expected, RunTestResult& result)
{
    std::vector<RunDifference> by_port (head.ports.size());
    for (std::uint64_t tick = 0; tick < head.until; ++tick)
    {
        const auto played = replay.tick();
        std::ranges::move (replay.takeWarnings(), std::back_inserter (result.warnings));
        if (! played) return played.error();
        if (! *played)
        {
            result.ended = tick;
            break;
        }
        if (tick >= head.from)
            compareTick (replay.run().engine().plan().taps(), std::span (expected).subspan ((tick - head.from) * head.ports.size(), head.ports.size()), tick,
                         by_port);
    }
    std::ranges::copy_if (by_port, std::back_inserter (result.differences), [] (const RunDifference& d) { return d.ticks > 0; });
    std::ranges::stable_sort (result.differences, {}, &RunDifference::tick);
    return {};
}
}   // namespace

Result<RunTestResult> playRunTest (const std::string& test, const RunTestOptions& options)
{
    auto in = opened (test);
    if (! in) return in.error();
    const auto head = readRunTestHead (**in, test);
    if (! head) return head.error();
    const auto expected = readExpected (**in, *head, test);
    if (! expected) return expected.error();
    if (options.graph == nullptr)
        if (auto same = checkGraph (**in, *head, test); ! same) return same.error();
    const auto lines = static_cast<int> (head->until - head->from) + 1;
    auto log = RunLogReader::open (std::move (*in), test, lines);
    if (! log) return log.error();
    auto replay =
        Replay::open (std::move (*log),
                      { .graph = options.graph, .records = head->records, .assets = options.assets, .services = options.services, .program = options.program });
    if (! replay) return replay.error();
    if (auto names = checkNames (*head, (*replay)->run().engine().plan().taps(), test); ! names) return names.error();
    RunTestResult result { .graph = (*replay)->name(), .ticks = head->until - head->from, .rate_hz = (*replay)->rate(), .ports = head->ports.size() };
    if (auto played = comparePlayed (**replay, *head, *expected, result); ! played) return played.error();
    return result;
}

}   // namespace tactus
