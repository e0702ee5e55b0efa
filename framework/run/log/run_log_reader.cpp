// SPDX-License-Identifier: MIT
#include "run_log_reader.hpp"
#include "log_number.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/ordered_reader.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace tactus
{

namespace
{
const std::string as_written = "use the log unchanged, as `tactus play` wrote it";

/// Reads the members of one line. The first error is reported.
class Line
{
public:
    explicit Line (const std::string& text) : json (readJson (text)) { fields.messages = json.messages; }

    void read (Json& object, const std::string& where, const std::vector<KnownKey>& keys)
    {
        Json unknown = Json::object();   // later versions may add data that a replay does not need
        fields.read (object, where, keys, unknown);
    }

    void wrong (const std::string& where, std::string text) { fields.error ("log/value", where, std::move (text), as_written); }

    void number (const Json& value, const std::string& where, double& to)
    {
        if (const auto v = fromLog (value))
            to = *v;
        else
            wrong (where, "this is not a number, \"nan\", \"inf\" or \"-inf\"");
    }

    template <typename Whole>
    void whole (const Json& value, const std::string& where, Whole& to)
    {
        if (value.is_number_unsigned())
            to = value.get<Whole>();
        else
            wrong (where, "this is not a whole number of at least 0");
    }

    void texts (const Json& list, const std::string& where, std::vector<std::string>& to)
    {
        for (const auto& text : list)
            if (text.is_string())
                to.push_back (text.get<std::string>());
            else
                return wrong (where, "this is not a list of strings");
    }

    void numbers (const Json& value, const std::string& where, std::span<double> to)
    {
        if (to.size() == 1) return number (value, where, to.front());
        if (! value.is_array() || value.size() != to.size()) return wrong (where, "this is not a list of " + std::to_string (to.size()) + " numbers");
        for (std::size_t i = 0; i < to.size(); ++i)
            number (value[i], where + "/" + std::to_string (i), to[i]);
    }

    void numbers (const Json& list, const std::string& where, Channels& to)
    {
        to.clear();
        if (list.size() > static_cast<std::size_t> (Channels::most))
            return wrong (where, "there are " + std::to_string (list.size()) + " values, but a device has at most " + std::to_string (Channels::most));
        for (std::size_t i = 0; i < list.size(); ++i)
        {
            double value = 0.0;
            number (list[i], where + "/" + std::to_string (i), value);
            to.set (static_cast<int> (i), value);
        }
    }

    void devices (Json& object, const std::string& where, std::map<std::string, DeviceLayout>& to)
    {
        for (auto& [role, has] : object.asObject())
        {
            auto& device = to[role];
            const auto names = [this] (std::vector<std::string>& all) {
                return [this, &all] (Json& v, const std::string& place) { texts (v, place, all); };
            };
            const auto count = [this] (int& n) {
                return [this, &n] (Json& v, const std::string& place) {
                    whole (v, place, n);
                    if (n < 0 || n > Channels::most) wrong (place, "a device has at most " + std::to_string (Channels::most) + " signals in each direction");
                };
            };
            const std::vector<KnownKey> keys {
                { "axes", JsonKind::list, names (device.axes) },
                { "efforts", JsonKind::list, names (device.efforts) },
                { "buttons", JsonKind::list, names (device.buttons) },
                { "signal_inputs", JsonKind::any, count (device.signal_inputs) },
                { "signal_outputs", JsonKind::any, count (device.signal_outputs) },
                { "mass", JsonKind::any, [this, &device] (Json& v, const std::string& place) { number (v, place, device.mechanics.mass); } },
                { "damping", JsonKind::any, [this, &device] (Json& v, const std::string& place) { number (v, place, device.mechanics.damping); } },
                { "brake", JsonKind::any, [this, &device] (Json& v, const std::string& place) { number (v, place, device.brake); } },
            };
            if (const auto place = where + "/" + pointerPart (role); fields.isKind (has, JsonKind::object, place)) read (has, place, keys);
        }
    }

    void guards (Json& object, const std::string& where, std::map<std::string, GuardLimits>& to)
    {
        for (auto& [role, limits] : object.asObject())
        {
            auto& guard = to[role];
            std::vector<KnownKey> keys;
            for (const auto& field : guard_fields)
                keys.push_back ({ field.key, JsonKind::any,
                                  [this, &guard, value = field.value] (Json& v, const std::string& place) { number (v, place, guard.*value); } });
            keys.push_back ({ dead_man_buttons, JsonKind::any,
                              [this, &guard] (Json& v, const std::string& place) { whole (v, place, guard.dead_man_buttons); } });
            if (const auto place = where + "/" + pointerPart (role); fields.isKind (limits, JsonKind::object, place)) read (limits, place, keys);
        }
    }

    void reading (Json& object, const std::string& where, LoggedReading& to)
    {
        std::vector<KnownKey> keys;
        for (const auto& field : reading_fields)
        {
            const auto part = std::span (to.numbers).subspan (field.first, field.size);
            keys.push_back ({ field.key, JsonKind::any, [this, part] (Json& v, const std::string& place) { numbers (v, place, part); } });
        }
        for (const auto& field : channel_fields)
            keys.push_back ({ field.key, JsonKind::list, [&, value = field.value] (Json& v, const std::string& place) { numbers (v, place, to.*value); } });
        if (fields.isKind (object, JsonKind::object, where)) read (object, where, keys);
    }

    const Message* problem() const
    {
        const auto first = std::ranges::find (fields.messages, Message::Severity::error, &Message::severity);
        return first != fields.messages.end() ? &*first : nullptr;
    }

    JsonText json;
    OrderedReader fields;
};

/// The first problem in a line, located by the line in the log and the column in the line.
Message toError (const Line& line, const std::string& place)
{
    const auto& m = *line.problem();
    const int column = m.column > 0 ? m.column : positionOf (line.json.positions, m.where).column;
    return Message::error (m.id, place + ":" + std::to_string (column), m.text, m.remedy);
}
}   // namespace

std::string RunLogReader::placeOf (int line_number) const { return called + ":" + std::to_string (line_number); }

Message RunLogReader::at (std::string id, std::string what, std::string remedy) const
{
    return Message::error (std::move (id), placeOf (number), std::move (what), std::move (remedy));
}

Result<RunLogReader> RunLogReader::open (const std::string& path)
{
    if (const auto why = whyUnreadable (path); ! why.empty())
        return Message::error ("file/unreadable", path, "cannot be read: " + why, "name the file that `tactus play --log` wrote");
    errno = 0;
    auto file = std::make_unique<std::ifstream> (path, std::ios::binary);
    if (! *file)
        return Message::error ("file/unreadable", path,
                               "cannot be read: " + (errno != 0 ? std::generic_category().message (errno) : "the system gave no reason"), "check the path");
    return open (std::move (file), path);
}

Result<RunLogReader> RunLogReader::open (std::unique_ptr<std::istream> from, std::string name, int lines_before)
{
    RunLogReader reader;
    reader.number = lines_before;
    reader.in = LogLines (std::move (from));
    reader.called = std::move (name);
    if (auto head = reader.readHead(); ! head) return head.error();
    return reader;
}

std::optional<std::string> RunLogReader::line()
{
    auto text = in.next();
    if (text) ++number;
    return text;
}

Result<> RunLogReader::readHead()
{
    const int before_head = number;
    const auto text = line();
    number = before_head + 1;
    const auto no_log = [&] (const std::string& why) {
        const auto what = "this is not a run log: " + why;
        return at ("log/not_a_log", what, "name the file that `tactus play --log` wrote");
    };
    if (! text) return no_log ("it has no complete line");

    Line head { *text };
    if (head.problem()) return no_log (head.problem()->text);
    if (! head.json.root.is_object() || head.json.root.value ("format", Json()) != Json (std::string (run_format)))
        return no_log ("its first line does not have \"format\": \"" + std::string (run_format) + "\"");
    const auto version = head.json.root.value ("version", Json());
    if (! version.is_number_integer() || version.get<std::int64_t>() < 1)
        return at ("log/unknown_version", "version " + version.dump() + " of the log format does not exist", as_written);
    if (version.get<std::int64_t>() > run_version) return at ("log/newer_version", "the log was written by a newer Tactus", "replay it with that version");

    head.read (head.json.root, "", {
                                       { "program", JsonKind::text, [&] (Json& v, const std::string&) { begin.program = v.get<std::string>(); } },
                                       { "functions", JsonKind::any, [&] (Json& v, const std::string& where) { head.whole (v, where, begin.functions); } },
                                       { "rate_hz", JsonKind::number, [&] (Json& v, const std::string& where) {
                                            begin.rate_hz = v.get<double>();
                                            if (! (begin.rate_hz >= 1.0 && begin.rate_hz <= 1e6)) head.wrong (where, "the rate must be from 1 to 1000000 Hz");
                                        } },
                                       { "clocks", JsonKind::object, [&] (Json& v, const std::string&) { begin.clocks = std::move (v); } },
                                       { "sets", JsonKind::list, [&] (Json& v, const std::string& where) { head.texts (v, where, begin.sets); } },
                                       { "feeds", JsonKind::list, [&] (Json& v, const std::string& where) { head.texts (v, where, begin.feeds); } },
                                       { "guards", JsonKind::object, [&] (Json& v, const std::string& where) { head.guards (v, where, begin.guards); } },
                                       { "devices", JsonKind::object, [&] (Json& v, const std::string& where) { head.devices (v, where, begin.devices); } },
                                   });
    if (head.problem()) return toError (head, placeOf (number));
    if (begin.rate_hz == 0.0) return at ("log/missing", "the first line has no rate_hz", as_written);
    return {};
}

Result<std::optional<RunTick>> RunLogReader::next()
{
    if (over) return std::nullopt;
    const auto text = line();
    if (! text && in.isDamaged())
    {
        ++number;
        return at ("log/value", "the line is not packed as it should be", as_written);
    }
    if (! text)
    {
        over = cut_off = true;
        return std::nullopt;
    }
    auto tick = readTick (*text);
    if (! tick) return tick.error();
    over = tick->last != RunTick::Last::no;
    return std::optional (std::move (*tick));
}

// This function is long because it is one table: for each key of a line, what is read from its value.
Result<RunTick> RunLogReader::readTick (const std::string& text)
{
    Line line { text };
    RunTick tick;
    tick.line = number;
    std::optional<std::uint64_t> k;
    const auto time = [&] (Json& v, const std::string& where, double period) {
        line.number (v, where, tick.passed_s.emplace());
        if (! (*tick.passed_s >= 0.0 && *tick.passed_s <= 1e9)) line.wrong (where, "the time must be from 0 to 1e9 s");
        *tick.passed_s += period;
    };
    const std::vector<KnownKey> keys {
        { "tick", JsonKind::any, [&] (Json& v, const std::string& where) { line.whole (v, where, k.emplace()); } },
        { "graph", JsonKind::object, [&] (Json& v, const std::string&) { tick.graph = std::move (v); } },
        { "guards", JsonKind::object, [&] (Json& v, const std::string& where) { line.guards (v, where, tick.guards); } },
        { "devices", JsonKind::object, [&] (Json& v, const std::string& where) { line.devices (v, where, tick.devices); } },
        { "tightened", JsonKind::object, [&] (Json& v, const std::string& where) { line.guards (v, where, tick.tightened); } },
        { "kept", JsonKind::list, [&] (Json& v, const std::string& where) { line.texts (v, where, tick.kept); } },
        { "turn", JsonKind::object, [&] (Json& v, const std::string& where) {
             for (const auto& [param, target] : v.items())
                 line.number (target, where + "/" + pointerPart (param), tick.turns.emplace_back (param, 0.0).second);
         } },
        { "hit", JsonKind::object, [&] (Json& v, const std::string& where) {
             for (const auto& [input, speed] : v.items())
                 line.number (speed, where + "/" + pointerPart (input), tick.hits.emplace_back (input, 0.0).second);
         } },
        { "late", JsonKind::list, [&] (Json& v, const std::string& where) {
             for (const auto& question : v)
                 line.whole (question, where, tick.late.emplace_back());
             if (! std::ranges::is_sorted (tick.late)) line.wrong (where, "the queries are not in order");
         } },
        { "passed", JsonKind::any, [&] (Json& v, const std::string& where) { time (v, where, 0.0); } },
        { "lost", JsonKind::any, [&] (Json& v, const std::string& where) { time (v, where, 1.0 / begin.rate_hz); } },   // until version 5: on top of the period
        { "halt", JsonKind::truth, [&] (Json& v, const std::string&) { tick.halt = v.get<bool>(); } },
        { "rearm", JsonKind::truth, [&] (Json& v, const std::string&) { tick.rearm = v.get<bool>(); } },
        { "emergency", JsonKind::truth, [&] (Json& v, const std::string&) { tick.emergency = v.get<bool>(); } },
        { "read", JsonKind::object, [&] (Json& v, const std::string& where) {
             for (auto& [name_of_role, fields] : v.asObject())
             {
                 auto& reading = readings.try_emplace (name_of_role, toLogged ({})).first->second;
                 line.reading (fields, where + "/" + pointerPart (name_of_role), reading);
                 tick.readings.emplace_back (name_of_role, toReading (reading));
             }
         } },
        { "feed", JsonKind::list, [&] (Json& v, const std::string& where) {
             if (v.size() != begin.feeds.size())
                 return line.wrong (where, "there are " + std::to_string (v.size()) + " values, but the first line names " + std::to_string (begin.feeds.size())
                                               + " feeds");
             tick.feed.emplace (v.size());
             for (std::size_t i = 0; i < v.size(); ++i)
                 line.number (v[i], where + "/" + std::to_string (i), (*tick.feed)[i]);
         } },
        { "clocks", JsonKind::object, [&] (Json& v, const std::string&) { begin.clocks = std::move (v); } },   // where earlier programs wrote them
        { "end", JsonKind::truth, [&] (Json& v, const std::string&) { if (v.get<bool>()) tick.last = RunTick::Last::end; } },
        { "broken", JsonKind::truth, [&] (Json& v, const std::string&) { if (v.get<bool>()) tick.last = RunTick::Last::broken; } },
    };

    if (! line.problem() && line.fields.isKind (line.json.root, JsonKind::object, "")) line.read (line.json.root, "", keys);
    if (line.problem()) return toError (line, placeOf (number));
    if (auto placed = place (tick, k); ! placed) return placed.error();
    return tick;
}

/// Sets the number of a tick, which must be larger than the previous one, except that tick 0 may appear again with a different graph.
Result<> RunLogReader::place (RunTick& tick, std::optional<std::uint64_t> k)
{
    if (! k) return at ("log/missing", "the line has no \"tick\"", as_written);
    const bool follows = ! before ? *k == 0 : *k > *before || (*k == 0 && tick.graph);
    if (! follows)
        return at ("log/order",
                   before ? "tick " + std::to_string (*k) + " comes after tick " + std::to_string (*before)
                          : "the first tick is " + std::to_string (*k) + ", but it must be 0",
                   as_written);
    constexpr std::uint64_t longest = 10'000'000'000;   // in ticks, the limit of a render
    if (*k > longest) return at ("log/order", "tick " + std::to_string (*k) + " is beyond the longest possible run", as_written);
    if (! before && tick.last == RunTick::Last::no && ! tick.graph) return at ("log/missing", "tick 0 has no graph", as_written);
    before = k;
    tick.tick = *k;
    return {};
}

}   // namespace tactus
