// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_log_reader.hpp"
#include "log_number.hpp"

#include <framework/file/json_text.hpp>
#include <framework/file/object_reader.hpp>
#include <framework/in_quotes.hpp>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace tactus::host
{

namespace
{
const std::string as_written = "use the log as `tactus play` wrote it";

/// Reads the members of one line. The first error counts.
class Line
{
public:
    explicit Line (const std::string& text) : json (readJson (text)) { fields.messages = json.messages; }

    void read (Json& object, const std::string& where, const std::vector<KnownKey>& keys)
    {
        Json unknown = Json::object();   // later versions may say more of what a replay can do without
        fields.read (object, where, keys, unknown);
    }

    void wrong (const std::string& where, std::string text) { fields.error ("log/value", where, std::move (text), as_written); }

    void number (const Json& value, const std::string& where, double& to)
    {
        if (const auto v = fromLog (value))
            to = *v;
        else
            wrong (where, "this is not a number, nor \"nan\", \"inf\" or \"-inf\"");
    }

    template <typename Whole>
    void whole (const Json& value, const std::string& where, Whole& to)
    {
        if (value.is_number_unsigned())
            to = value.get<Whole>();
        else
            wrong (where, "this is not a whole number from 0");
    }

    void texts (const Json& list, const std::string& where, std::vector<std::string>& to)
    {
        for (const auto& text : list)
            if (text.is_string())
                to.push_back (text.get<std::string>());
            else
                return wrong (where, "this is not a list of texts");
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
        if (list.size() > static_cast<std::size_t> (Channels::most)) return wrong (where, "there are " + std::to_string (list.size()) + " values, and a device has at most " + std::to_string (Channels::most));
        for (std::size_t i = 0; i < list.size(); ++i)
        {
            double value = 0.0;
            number (list[i], where + "/" + std::to_string (i), value);
            to.set (static_cast<int> (i), value);
        }
    }

    void devices (Json& object, const std::string& where, std::map<std::string, DeviceLayout>& to)
    {
        for (auto& [role, has] : object.get_ref<Json::object_t&>())
        {
            auto& device = to[role];
            const auto names = [this] (std::vector<std::string>& all)
            {
                return [this, &all] (Json& v, const std::string& place)
                { texts (v, place, all); };
            };
            const auto count = [this] (int& n)
            {
                return [this, &n] (Json& v, const std::string& place)
                {
                    whole (v, place, n);
                    if (n < 0 || n > Channels::most) wrong (place, "a device has at most " + std::to_string (Channels::most) + " signals each way");
                };
            };
            const std::vector<KnownKey> keys {
                { "axes", JsonKind::list, names (device.axes) },
                { "efforts", JsonKind::list, names (device.efforts) },
                { "buttons", JsonKind::list, names (device.buttons) },
                { "signal_inputs", JsonKind::any, count (device.signal_inputs) },
                { "signal_outputs", JsonKind::any, count (device.signal_outputs) },
            };
            if (const auto place = where + "/" + pointerPart (role); fields.isKind (has, JsonKind::object, place)) read (has, place, keys);
        }
    }

    void guards (Json& object, const std::string& where, std::map<std::string, GuardLimits>& to)
    {
        for (auto& [role, limits] : object.get_ref<Json::object_t&>())
        {
            auto& guard = to[role];
            std::vector<KnownKey> keys;
            for (const auto& field : guard_fields)
                keys.push_back ({ field.key, JsonKind::any, [this, &guard, value = field.value] (Json& v, const std::string& place)
                                  { number (v, place, guard.*value); } });
            keys.push_back ({ dead_man_buttons, JsonKind::any, [this, &guard] (Json& v, const std::string& place)
                              { whole (v, place, guard.dead_man_buttons); } });
            if (const auto place = where + "/" + pointerPart (role); fields.isKind (limits, JsonKind::object, place)) read (limits, place, keys);
        }
    }

    const Message* problem() const
    {
        const auto first = std::ranges::find (fields.messages, Message::Severity::error, &Message::severity);
        return first != fields.messages.end() ? &*first : nullptr;
    }

    JsonText json;
    ObjectReader fields;
};

/// By line of the log and column in it.
Error toError (const Line& line, const std::string& place)
{
    const auto& m = *line.problem();
    const int column = m.column > 0 ? m.column : positionOf (line.json.positions, m.where).column;
    return { m.id, place + ":" + std::to_string (column), m.text, m.remedy };
}
}   // namespace

std::string RunLogReader::placeOf (int line_number) const { return called + ":" + std::to_string (line_number); }

Error RunLogReader::at (std::string id, std::string what, std::string remedy) const { return { std::move (id), placeOf (number), std::move (what), std::move (remedy) }; }

tl::expected<RunLogReader, Error> RunLogReader::open (const std::string& path)
{
    std::error_code failure;
    errno = 0;
    auto file = std::make_unique<std::ifstream> (path, std::ios::binary);
    if (std::filesystem::is_directory (path, failure)) return tl::unexpected (Error { "file/unreadable", path, "cannot be read: it is a folder", "name the file that `tactus play --log` wrote" });
    if (! *file) return tl::unexpected (Error { "file/unreadable", path, "cannot be read: " + (errno != 0 ? std::generic_category().message (errno) : "the system gives no reason"), "check the path" });
    return open (std::move (file), path);
}

tl::expected<RunLogReader, Error> RunLogReader::open (std::unique_ptr<std::istream> from, std::string name)
{
    RunLogReader reader;
    reader.in = std::move (from);
    reader.called = std::move (name);
    if (auto head = reader.readHead(); ! head) return tl::unexpected (std::move (head.error()));
    return reader;
}

/// A whole line; nothing if there is none, or one that breaks off. Endless ones end too.
std::optional<std::string> RunLogReader::line()
{
    constexpr std::size_t longest = 4 * largest_file;   // a graph, with what it includes
    std::string text;
    for (int c = in->get(); c != std::istream::traits_type::eof() && text.size() < longest; c = in->get())
    {
        if (c == '\n')
        {
            ++number;
            return text;
        }
        text += static_cast<char> (c);
    }
    return std::nullopt;
}

tl::expected<void, Error> RunLogReader::readHead()
{
    const auto text = line();
    number = 1;
    const auto no_log = [&] (const std::string& why)
    { return tl::unexpected (at ("log/not_a_log", "this is no log of a run: " + why, "name the file that `tactus play --log` wrote")); };
    if (! text) return no_log ("there is not one whole line in it");

    Line head { *text };
    if (head.problem()) return no_log (head.problem()->text);
    if (! head.json.root.is_object() || head.json.root.value ("format", Json()) != Json (std::string (run_format))) return no_log ("its first line does not say \"format\": \"" + std::string (run_format) + "\"");
    const auto version = head.json.root.value ("version", Json());
    if (! version.is_number_integer() || version < 1) return tl::unexpected (at ("log/unknown_version", "there never was a version " + version.dump (-1, ' ', false, Json::error_handler_t::replace), as_written));
    if (version > run_version) return tl::unexpected (at ("log/newer_version", "the log was written by a newer Tactus", "replay it with that one"));

    head.read (head.json.root, "", {
                                       { "program", JsonKind::text, [&] (Json& v, const std::string&)
                                         { begin.program = v.get<std::string>(); } },
                                       { "rate_hz", JsonKind::number, [&] (Json& v, const std::string& where)
                                         {
                                             begin.rate_hz = v.get<double>();
                                             if (! (begin.rate_hz >= 1.0 && begin.rate_hz <= 1e6)) head.wrong (where, "a rate is from 1 to 1000000 Hz");
                                         } },
                                       { "sets", JsonKind::list, [&] (Json& v, const std::string& where)
                                         { head.texts (v, where, begin.sets); } },
                                       { "feeds", JsonKind::list, [&] (Json& v, const std::string& where)
                                         { head.texts (v, where, begin.feeds); } },
                                       { "guards", JsonKind::object, [&] (Json& v, const std::string& where)
                                         { head.guards (v, where, begin.guards); } },
                                       { "devices", JsonKind::object, [&] (Json& v, const std::string& where)
                                         { head.devices (v, where, begin.devices); } },
                                   });
    if (head.problem()) return tl::unexpected (toError (head, placeOf (number)));
    if (begin.rate_hz == 0.0) return tl::unexpected (at ("log/missing", "the first line does not say at which rate_hz the ticks came", as_written));
    return {};
}

tl::expected<std::optional<RunTick>, Error> RunLogReader::next()
{
    if (over) return std::nullopt;
    const auto text = line();
    if (! text)
    {
        over = cut_off = true;
        return std::nullopt;
    }
    auto tick = readTick (*text);
    if (! tick) return tl::unexpected (std::move (tick.error()));
    over = tick->last != RunTick::Last::no;
    return std::optional (std::move (*tick));
}

tl::expected<RunTick, Error> RunLogReader::readTick (const std::string& text)
{
    Line line { text };
    RunTick tick;
    tick.line = number;
    std::optional<std::uint64_t> k;
    const auto role = [&] (Json& fields, const std::string& where, const std::string& name_of_role)
    {
        auto& reading = readings.try_emplace (name_of_role, toLogged ({})).first->second;
        std::vector<KnownKey> keys;
        for (const auto& field : reading_fields)
            keys.push_back ({ field.key, JsonKind::any, [&] (Json& value, const std::string& place)
                              { line.numbers (value, place, std::span (reading.numbers).subspan (field.first, field.size)); } });
        for (const auto& field : channel_fields)
            keys.push_back ({ field.key, JsonKind::list, [&, value = field.value] (Json& v, const std::string& place)
                              { line.numbers (v, place, reading.*value); } });
        if (line.fields.isKind (fields, JsonKind::object, where)) line.read (fields, where, keys);
        tick.readings.emplace_back (name_of_role, toReading (reading));
    };
    const std::vector<KnownKey> keys {
        { "tick", JsonKind::any, [&] (Json& v, const std::string& where)
          { line.whole (v, where, k.emplace()); } },
        { "graph", JsonKind::object, [&] (Json& v, const std::string&)
          { tick.graph = std::move (v); } },
        { "guards", JsonKind::object, [&] (Json& v, const std::string& where)
          { line.guards (v, where, tick.guards); } },
        { "devices", JsonKind::object, [&] (Json& v, const std::string& where)
          { line.devices (v, where, tick.devices); } },
        { "kept", JsonKind::list, [&] (Json& v, const std::string& where)
          { line.texts (v, where, tick.kept); } },
        { "turn", JsonKind::object, [&] (Json& v, const std::string& where)
          {
              for (const auto& [param, target] : v.items())
                  line.number (target, where + "/" + pointerPart (param), tick.turns.emplace_back (param, 0.0).second);
          } },
        { "hit", JsonKind::object, [&] (Json& v, const std::string& where)
          {
              for (const auto& [input, speed] : v.items())
                  line.number (speed, where + "/" + pointerPart (input), tick.hits.emplace_back (input, 0.0).second);
          } },
        { "late", JsonKind::list, [&] (Json& v, const std::string& where)
          {
              for (const auto& question : v)
                  line.whole (question, where, tick.late.emplace_back());
              if (! std::ranges::is_sorted (tick.late)) line.wrong (where, "the questions do not come in their order");
          } },
        { "halt", JsonKind::truth, [&] (Json& v, const std::string&)
          { tick.halt = v.get<bool>(); } },
        { "rearm", JsonKind::truth, [&] (Json& v, const std::string&)
          { tick.rearm = v.get<bool>(); } },
        { "emergency", JsonKind::truth, [&] (Json& v, const std::string&)
          { tick.emergency = v.get<bool>(); } },
        { "read", JsonKind::object, [&] (Json& v, const std::string& where)
          {
              for (auto& [name_of_role, fields] : v.get_ref<Json::object_t&>())
                  role (fields, where + "/" + pointerPart (name_of_role), name_of_role);
          } },
        { "feed", JsonKind::list, [&] (Json& v, const std::string& where)
          {
              if (v.size() != begin.feeds.size()) return line.wrong (where, "there are " + std::to_string (v.size()) + " values for the " + std::to_string (begin.feeds.size()) + " feeds of the first line");
              tick.feed.emplace (v.size());
              for (std::size_t i = 0; i < v.size(); ++i)
                  line.number (v[i], where + "/" + std::to_string (i), (*tick.feed)[i]);
          } },
        { "end", JsonKind::truth, [&] (Json& v, const std::string&)
          { if (v.get<bool>()) tick.last = RunTick::Last::end; } },
        { "broken", JsonKind::truth, [&] (Json& v, const std::string&)
          { if (v.get<bool>()) tick.last = RunTick::Last::broken; } },
    };

    if (! line.problem() && line.fields.isKind (line.json.root, JsonKind::object, "")) line.read (line.json.root, "", keys);
    if (line.problem()) return tl::unexpected (toError (line, placeOf (number)));
    if (! k) return tl::unexpected (at ("log/missing", "the line does not say of which tick it is", as_written));
    const bool follows = ! before ? *k == 0 : *k > *before || (*k == 0 && tick.graph);
    if (! follows) return tl::unexpected (at ("log/order", before ? "tick " + std::to_string (*k) + " comes after tick " + std::to_string (*before) : "the first tick is " + std::to_string (*k) + ", and should be 0", as_written));
    constexpr std::uint64_t longest = 10'000'000'000;   // ticks, as of a render
    if (*k > longest) return tl::unexpected (at ("log/order", "tick " + std::to_string (*k) + " is further than a run goes", as_written));
    if (! before && tick.last == RunTick::Last::no && ! tick.graph) return tl::unexpected (at ("log/missing", "tick 0 does not say which graph runs", as_written));
    before = k;
    tick.tick = *k;
    return tick;
}

}   // namespace tactus::host
