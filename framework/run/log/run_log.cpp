// SPDX-License-Identifier: MIT
#include "run_log.hpp"
#include "log_number.hpp"

#include <tactus/file/atomic_file.hpp>
#include <tactus/plan/find_hit.hpp>
#include <tactus/plan/find_param.hpp>
#include <tactus/text/ownership.hpp>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <span>
#include <system_error>

namespace tactus
{

namespace
{
/// One second of data, plus room for turning many parameters at the same time; at most 64 MB.
std::size_t roomFor (const RunHead& head)
{
    constexpr double spare = 65536.0, most = 8388608.0;
    auto words = 2.0 + static_cast<double> (head.guards.size() * (reading_size + 1) + head.feeds.size());
    for (const auto& [role, device] : head.devices)
        words += static_cast<double> (device.axes.size()) + device.signal_inputs;
    return static_cast<std::size_t> (std::min (most, words * std::ceil (head.rate_hz) + spare));
}

std::string textOf (const Json& value) { return value.dump(); }

Json toJson (const std::map<std::string, GuardLimits>& guards)
{
    auto json = Json::object();
    for (const auto& [role, limits] : guards)
        for (const auto& [key, value] : guard_fields)
            json[role][std::string (key)] = toLog (limits.*value);
    for (const auto& [role, limits] : guards)
        json[role][std::string (dead_man_buttons)] = limits.dead_man_buttons;
    return json;
}

/// Leaves out devices of which nothing is known: no axes, efforts, buttons, signals or brake, no mass and no damping of the tool.
Json toJson (const std::map<std::string, DeviceLayout>& devices)
{
    auto json = Json::object();
    for (const auto& [role, has] : devices)
        if (has != DeviceLayout {})
            json[role] = { { "axes", has.axes },
                           { "efforts", has.efforts },
                           { "buttons", has.buttons },
                           { "signal_inputs", has.signal_inputs },
                           { "signal_outputs", has.signal_outputs },
                           { "mass", toLog (has.mechanics.mass) },
                           { "damping", toLog (has.mechanics.damping) },
                           { "brake", toLog (has.brake) } };
    return json;
}

std::string headLine (const RunHead& head, const std::optional<Json>& clocks, bool is_packed)
{
    Json json { { "format", run_format },
                { "version", run_version },
                { "program", head.program },
                { "functions", head.functions },
                { "rate_hz", head.rate_hz },
                { "sets", head.sets },
                { "feeds", head.feeds },
                { "guards", toJson (head.guards) },
                { "devices", toJson (head.devices) } };
    if (clocks) json["clocks"] = *clocks;
    if (is_packed) json["packed"] = true;
    return json.dump() + "\n";
}

bool same (std::span<const double> a, std::span<const double> b) noexcept
{
    return a.size() == b.size() && (a.empty() || std::memcmp (a.data(), b.data(), a.size_bytes()) == 0);
}
}   // namespace

RunLog::RunLog (const std::filesystem::path& p, const RunHead& h)
    : path (p), place (p.parent_path()), head (h), out (openDirectly (p)), packer (p.extension() == packed_log ? std::make_unique<LogPacker>() : nullptr),
      taken (roomFor (h))
{
}

Result<std::unique_ptr<RunLog>> RunLog::create (const std::filesystem::path& path, const RunHead& head)
{
    if (const auto who = whoElseLinks (path); ! who.empty())
        return Message::error ("output/unwritable", path.string(), "cannot be written: " + who, "choose another file");
    if (std::error_code ignored; path.extension() == packed_log && std::filesystem::exists (path, ignored))
        return Message::error ("output/exists", path.string(), "exists, and a packed log is never replaced", "choose another file");
    errno = 0;
    std::unique_ptr<RunLog> log { new RunLog (path, head) };
    if (auto problem = written (log->out && log->out->good(), path); ! problem) return problem.error();
    log->whole = static_cast<std::uintmax_t> (log->out->tellp());
    return log;
}

Result<> RunLog::written (bool good, const std::filesystem::path& path)
{
    if (good) return {};
    const auto reason = errno != 0 ? std::generic_category().message (errno) : "the system gave no reason";
    return Message::error ("output/unwritable", path.string(), "cannot be written: " + reason, "choose another file, create its folder, or free some space");
}

void RunLog::expect (std::shared_ptr<const Plan> plan, const Json& snapshot, const std::map<std::string, GuardLimits>& joining,
                     const std::map<std::string, DeviceLayout>& devices)
{
    expected.push_back ({ std::move (plan), textOf (snapshot) });
    joined.insert (joining.begin(), joining.end());
    joined_devices.insert (devices.begin(), devices.end());
}

Result<> RunLog::drain()
{
    if (! out) return {};
    while (taken.words().size() > 0)
        take();
    out->flush();
    auto result = written (out->good(), path);
    if (result)
        whole = static_cast<std::uintmax_t> (out->tellp());
    else
    {
        std::error_code ignored;
        out.reset();
        std::filesystem::resize_file (path, whole, ignored);
    }
    return result;
}

void RunLog::take()
{
    auto& words = taken.words();
    const auto number = [&] { return std::bit_cast<double> (words.pop()); };
    const auto begin = words.pop();
    const auto of = static_cast<std::size_t> (begin >> 8u);
    switch (static_cast<RunJournal::Kind> (begin & 0xffu))
    {
    case RunJournal::Kind::took:
        takeOver (words.pop());
        break;
    case RunJournal::Kind::turned:
    {
        const auto knob = static_cast<std::size_t> (words.pop());
        turns += (turns.empty() ? "" : ",") + textOf (plan::nameOf (*expected.front().plan, of, knob)) + ":" + logNumber (number());
        break;
    }
    case RunJournal::Kind::outdone:
        kept += (kept.empty() ? "" : ",") + textOf (plan::nameOf (*expected.front().plan, of, static_cast<std::size_t> (words.pop())));
        break;
    case RunJournal::Kind::struck:
    {
        const auto input = static_cast<std::size_t> (words.pop());
        hits += (hits.empty() ? "" : ",") + textOf (plan::nameOfHit (*expected.front().plan, of, input)) + ":" + logNumber (number());
        break;
    }
    case RunJournal::Kind::late:
        late += (late.empty() ? "" : ",") + std::to_string (words.pop());
        break;
    case RunJournal::Kind::passed:
        line.passed = number();
        break;
    case RunJournal::Kind::halted:
        add ("halt", "true");
        break;
    case RunJournal::Kind::resumed:
        add ("halt", "false");
        break;
    case RunJournal::Kind::emergency:
        add ("emergency", "true");
        break;
    case RunJournal::Kind::rearmed:
        add ("rearm", "true");
        break;
    case RunJournal::Kind::tightened:
        takeTightened (of);
        break;
    case RunJournal::Kind::ticked:
        takeTick (of, static_cast<std::size_t> (words.pop()));
    }
}

/// Drops earlier plans, and logs what changes with the new one.
void RunLog::takeOver (std::uint64_t serial)
{
    while (expected.front().plan->serial() != serial)
        expected.pop_front();
    if (expected.front().graph == graph) return;   // the same graph, recompiled for a probe
    graph = expected.front().graph;
    if (line.rest.find (R"("graph":)") != std::string::npos) endLine();   // before the first tick, another graph may replace the first one
    add ("graph", graph);

    std::map<std::string, GuardLimits> guards;
    for (const auto& role : expected.front().plan->roles())
        if (auto joining = joined.extract (role.name)) guards.insert (std::move (joining));
    if (! guards.empty()) add ("guards", textOf (toJson (guards)));

    std::map<std::string, DeviceLayout> devices;
    for (const auto& role : expected.front().plan->roles())
        if (auto joining = joined_devices.extract (role.name)) devices.insert (std::move (joining));
    if (const auto has = toJson (devices); ! has.empty()) add ("devices", textOf (has));
}

/// The replay needs the plan with which the limits took effect, even if its graph is that of the plan before: an edit that was undone
/// before it ran may have tightened them.
void RunLog::takeTightened (std::size_t role)
{
    auto& words = taken.words();
    auto& limits = tightened[expected.front().plan->roles()[role].name];
    for (const auto& field : guard_fields)
        limits.*field.value = std::bit_cast<double> (words.pop());
    limits.dead_man_buttons = words.pop();
    if (line.rest.find (R"("graph":)") == std::string::npos) add ("graph", graph);
}

LoggedReading RunLog::takeReading()
{
    auto& words = taken.words();
    const auto number = [&] { return std::bit_cast<double> (words.pop()); };
    LoggedReading reading;
    std::ranges::generate (reading.numbers, number);
    const auto sizes = words.pop();
    for (int i = 0; i < static_cast<int> (sizes & 0xffu); ++i)
        reading.axes.set (i, number());
    for (int i = 0; i < static_cast<int> (sizes >> 8u & 0xffu); ++i)
        reading.signals.set (i, number());
    return reading;
}

void RunLog::takeTick (std::size_t roles, std::size_t feeds)
{
    auto& words = taken.words();
    const auto number = [&] { return std::bit_cast<double> (words.pop()); };

    if (! tightened.empty()) add ("tightened", textOf (toJson (tightened)));
    tightened.clear();
    if (! kept.empty()) add ("kept", "[" + kept + "]");
    if (! turns.empty()) add ("turn", "{" + turns + "}");
    if (! hits.empty()) add ("hit", "{" + hits + "}");
    if (! late.empty()) add ("late", "[" + late + "]");
    kept.clear();
    turns.clear();
    hits.clear();
    late.clear();

    for (std::size_t r = 0; r < roles; ++r)
    {
        const auto reading = takeReading();
        const auto& role = expected.front().plan->roles()[r].name;
        auto& before = readings.try_emplace (role, toLogged ({})).first->second;
        std::uint32_t changed = 0, bit = 1;
        for (const auto& [key, first, size] : reading_fields)
        {
            if (! same (std::span (reading.numbers).subspan (first, size), std::span (before.numbers).subspan (first, size))) changed |= bit;
            bit <<= 1u;
        }
        for (const auto& [key, value] : channel_fields)
        {
            if (! same (valuesOf (reading.*value), valuesOf (before.*value))) changed |= bit;
            bit <<= 1u;
        }
        if (changed != 0) line.read.push_back ({ role, changed, reading });
        before = reading;
    }

    std::vector<double> values (feeds);
    std::ranges::generate (values, number);
    if (! same (values, feed)) line.feed = values;
    feed = std::move (values);

    if (! has_begun) beginFile (first_tick ? first_tick() : std::nullopt);
    if (! line.isEmpty()) endLine();
    ++now;
}

void RunLog::add (std::string_view key, std::string_view value)
{
    line.rest += ",\"";
    line.rest += key;
    line.rest += "\":";
    line.rest += value;
}

void RunLog::beginFile (const std::optional<Json>& clocks)
{
    *out << headLine (head, clocks, packer != nullptr) << held;
    held.clear();
    has_begun = true;
}

void RunLog::endLine()
{
    line.tick = now;
    const auto text = packer ? packer->pack (line) : textOf (line) + "\n";
    if (has_begun)
        *out << text;
    else
        held += text;
    line = {};
}

Result<> RunLog::finish()
{
    if (auto problem = drain(); ! problem || ! out) return problem;
    if (! has_begun) beginFile (std::nullopt);
    add (brokenAt() ? "broken" : "end", "true");
    endLine();
    return written (closed (out), path);
}

}   // namespace tactus
