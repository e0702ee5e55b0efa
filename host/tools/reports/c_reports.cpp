// SPDX-License-Identifier: MIT
// The C API of examinations (tactus_live.h).
#include "check_report.hpp"
#include "connected_devices.hpp"
#include "conversion.hpp"
#include "limits_report.hpp"
#include "refusal.hpp"

#include <tactus/tactus_live.h>

#include <framework/capi/handles.hpp>
#include <host/base/command_line/command.hpp>
#include <host/devices/live/decoding_assets.hpp>
#include <host/tools/fitting/fit_options.hpp>
#include <host/tools/fitting/recording_file.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/json_writer.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>

using namespace tactus::host;
using tactus::Json;
using tactus::Message;
using tactus::capi::add;
using tactus::capi::copied;
using tactus::capi::failed;
using tactus::capi::guarded;
using tactus::capi::misuse;

namespace
{
std::atomic<std::uint64_t> interruptions = 0;

/// An option of a function, and what reads it.
struct Option
{
    const char* name;
    std::function<void (const Json&)> read;
};

[[noreturn]] void refuseOption (const std::string& name, const std::string& text, const std::string& remedy)
{
    refuse (Message::error ("api/option", name, text, remedy));
}

Option number (const char* name, double& to, double least, double most)
{
    return { name, [name, &to, least, most] (const Json& v) {
                if (v.is_number()) to = v.get<double>();
                if (! v.is_number() || ! (to >= least && to <= most))
                    refuseOption (name, v.dump() + " does not fit", "give a number from " + Json (least).dump() + " to " + Json (most).dump());
            } };
}

Option text (const char* name, std::string& to)
{
    return { name, [name, &to] (const Json& v) {
                if (! v.is_string()) refuseOption (name, v.dump() + " is not a text", "give a text");
                to = v.asString();
            } };
}

Option truth (const char* name, bool& to)
{
    return { name, [name, &to] (const Json& v) {
                if (! v.is_boolean()) refuseOption (name, v.dump() + " is neither true nor false", "give true or false");
                to = v.get<bool>();
            } };
}

/// The options that check and limits share.
std::vector<Option> shared (CheckedGraph::Options& to, double& duration_s)
{
    return { { "devices", [&to] (const Json& v) {
                  const auto is_text = [] (const Json& each) { return each.is_string(); };
                  if (! v.is_array() || ! std::ranges::all_of (v.asArray(), is_text))
                      refuseOption ("devices", "this is not a list of texts", "give [\"ROLE=PROFILE\"]");
                  to.devices = v.get<std::vector<std::string>>();
              } },
             { "set", [&to] (const Json& v) {
                  if (! v.is_object()) refuseOption ("set", "this is not an object", "give {\"NODE.PARAM\": VALUE}");
                  for (const auto& [name, value] : v.items())
                      to.overrides.push_back ({ name, value });
              } },
             number ("rate", to.rate_hz, 10.0, 1e5),
             number ("duration", duration_s, 1e-3, 60.0) };
}

void read (const char* given, const std::vector<Option>& options)
{
    if (given == nullptr) return;
    const auto json = Json::tryParse (given);
    if (! json || ! json->is_object()) refuseOption ("options", "this is not a JSON object", "give an object, or NULL");
    for (const auto& [key, value] : json->items())
    {
        const auto option = std::ranges::find_if (options, [&name = key] (const Option& o) { return o.name == name; });
        if (option != options.end())
        {
            option->read (value);
            continue;
        }
        std::vector<std::string> known;
        for (const auto& o : options)
            known.emplace_back (o.name);
        refuseOption (key, "there is no such option", tactus::suggestion (key, known));
    }
}

/// Runs an examination, and returns its text for C. NULL, with the reasons in `messages`, if it refuses.
template <typename F>
char* examined (tactus_messages* messages, F&& f)
{
    return guarded<char*> (messages, nullptr, [&]() -> char* {
        try
        {
            return copied (f());
        }
        catch (Refusal& why)
        {
            add (messages, std::move (why.messages));
        }
        catch (const UsageError& why)
        {
            failed (messages, Message::error ("api/option", "", why.what(), "correct the option"));
        }
        return nullptr;
    });
}

tactus::LoadedGraph graphOf (const tactus_graph& g)
{
    tactus::LoadedGraph loaded;
    loaded.graph = g.history.graph();
    return loaded;
}

Json toJson (const tactus::FitPicture& picture)
{
    const auto list = [] (const std::vector<double>& values) {
        Json all = Json::array();
        for (const double v : values)
            all.push_back (std::isfinite (v) ? Json (v) : Json());
        return all;
    };
    Json curves = Json::array();
    for (const auto& c : picture.curves)
        curves.push_back ({ { "label", c.label }, { "recorded", c.is_recorded }, { "x", list (c.x) }, { "y", list (c.y) } });
    return { { "x", picture.x_name }, { "x_unit", picture.x_unit }, { "y", picture.y_name }, { "y_unit", picture.y_unit }, { "curves", std::move (curves) } };
}

FitKind kindOf (const std::string& id)
{
    std::vector<std::string> ids;
    for (const auto& info : fitKinds())
    {
        if (info.id == id) return info.kind;
        ids.push_back (info.id);
    }
    refuseOption ("kind", "there is no fit of kind " + tactus::quote (id), tactus::suggestion (id, ids));
}

/// The columns of the caller, or those of a file.
tactus::Table tableOf (const std::string& recording, const tactus_columns* columns)
{
    if (columns == nullptr) return orRefuse (readRecordingOrWav (recording));
    tactus::Table table;
    table.columns = tactus::capi::list (columns->names, columns->count);
    table.values.assign (columns->values, columns->values + columns->rows * columns->count);
    return table;
}
}   // namespace

char* tactus_check (const tactus_graph* graph, const char* options, tactus_messages* messages)
{
    if (graph == nullptr)
    {
        misuse ("the graph is NULL");
        return nullptr;
    }
    return examined (messages, [&] {
        CheckedGraph::Options of_graph;
        CheckOptions how;
        auto known = shared (of_graph, how.duration_s);
        known.push_back (truth ("sweep", how.sweep));
        known.push_back (number ("speed", how.judge.speed, 1e-6, 1e3));
        known.push_back (number ("alpha", how.judge.factors.alpha, 1e-3, 1e6));
        known.push_back (number ("beta", how.judge.factors.beta, 1e-3, 1e6));
        known.push_back (number ("gamma", how.judge.factors.gamma, 1e-3, 1e6));
        read (options, known);
        DecodingAssets assets { {} };
        CheckedGraph checked { graphOf (*graph), "", assets, of_graph };
        const auto json = CheckReport (checked, how).json();
        add (messages, checked.takeWarnings());
        return tactus::writeJson (json);
    });
}

char* tactus_limits (const tactus_graph* graph, const char* options, tactus_messages* messages)
{
    if (graph == nullptr)
    {
        misuse ("the graph is NULL");
        return nullptr;
    }
    return examined (messages, [&] {
        CheckedGraph::Options of_graph;
        LimitsOptions how;
        double steps = 0.0;
        auto known = shared (of_graph, how.duration_s);
        known.push_back (text ("role", how.role));
        known.push_back (text ("x", how.x));
        known.push_back (text ("y", how.y));
        known.push_back (number ("steps", steps, 2.0, 400.0));
        read (options, known);
        how.checkOn = [begun = interruptions.load()] {
            if (interruptions != begun) refuse (Message::error ("api/interrupted", "", "the search was interrupted", "call the function again"));
        };
        DecodingAssets assets { {} };
        CheckedGraph checked { graphOf (*graph), "", assets, of_graph };
        if (steps > 0.0) how.steps = static_cast<int> (steps);
        const LimitsReport report { checked, how };
        add (messages, checked.takeWarnings());
        return tactus::writeJson (steps > 0.0 ? report.jsonWithRows() : report.json());
    });
}

void tactus_limits_interrupt (void) { ++interruptions; }

char* tactus_fit (const char* kind, const char* recording, const tactus_columns* columns, const char* options, tactus_messages* messages)
{
    const bool has_columns = columns != nullptr && columns->names != nullptr && columns->values != nullptr;
    if (kind == nullptr || (recording == nullptr && columns == nullptr) || (columns != nullptr && ! has_columns))
    {
        misuse ("the kind, the recording or its columns are NULL");
        return nullptr;
    }
    return examined (messages, [&] {
        const auto which = kindOf (kind);
        const auto name = recording != nullptr ? std::string (recording) : std::string ("the recording");
        const auto given = Json::tryParse (options != nullptr ? options : "{}");
        if (! given || ! given->is_object()) refuseOption ("options", "this is not a JSON object", "give an object, or NULL");
        const auto settings = orRefuse (readFitSettings (which, *given));
        auto made = orRefuse (fitRecording (which, tableOf (name, columns), name, settings));
        DecodingAssets assets { {} };
        orRefuse (checkFitted (made, name, assets));
        add (messages, std::move (made.warnings));
        auto json = jsonOf (made, name, "");
        json["details"] = made.details;
        json["snippets"] = made.snippets;
        json["graph"] = tactus::writeGraph (made.preset);
        json["picture"] = toJson (made.report.picture);
        return json.dump (2);
    });
}

char* tactus_convert (const char* in, const char* out, const char* options, tactus_messages* messages)
{
    if (in == nullptr || out == nullptr)
    {
        misuse ("a file is NULL");
        return nullptr;
    }
    return examined (messages, [&] {
        ConversionOptions how { .in = in, .out = out };
        std::vector known { text ("calibration", how.calibration), number ("rate", how.rate_hz, 1.0, 1e6) };
        known.push_back (truth ("split", how.split));
        const std::pair<const char*, double EvemuOptions::*> pen[] {
            { "pitch", &EvemuOptions::pitch },
            { "force", &EvemuOptions::full_force },
            { "depth", &EvemuOptions::full_depth },
            { "lift", &EvemuOptions::lift },
            { "full-pressure", &EvemuOptions::full_pressure },
        };
        for (const auto& [name, member] : pen)
            known.push_back ({ name, [&how, name = name, member = member] (const Json& v) {
                                  number (name, how.pen.*member, 1e-12, 1e12).read (v);
                                  how.pen_option = name;
                              } });
        read (options, known);
        return convert (how).json().dump (2);
    });
}

char* tactus_devices (tactus_messages* messages)
{
    return examined (messages, [&] {
        auto profiles = hid::loadProfileLibrary();
        add (messages, std::move (profiles.messages));
        return listedJson (profiles).dump (2);
    });
}
