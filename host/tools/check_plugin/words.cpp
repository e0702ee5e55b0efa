// SPDX-License-Identifier: MIT
#include "check_plugin.hpp"

#include <tactus/tactus_device.h>
#include <tactus/text/quote.hpp>

#include <cmath>
#include <cstdio>

namespace tactus::check_plugin
{

namespace
{
const char* word (Verdict v) noexcept
{
    if (v == Verdict::pass) return "PASS";
    return v == Verdict::fail ? "FAIL" : "SKIPPED";
}

int abiOf (const Report& report) noexcept { return report.is_driver ? TACTUS_DEVICE_ABI : TACTUS_PLUGIN_ABI; }

std::string lineOf (const Finding& f)
{
    char head[64];
    std::snprintf (head, sizeof head, "  %-8s %-13s ", word (f.verdict), f.id.c_str());
    return head + f.promise + (f.why.empty() ? "" : ": " + f.why) + "\n";
}

Json jsonOf (const Finding& f)
{
    Json json { { "id", f.id }, { "promise", f.promise }, { "result", word (f.verdict) } };
    if (! f.why.empty()) json["why"] = f.why;
    return json;
}
}   // namespace

std::string textOf (const Report& report)
{
    const auto& options = report.options;
    std::string text = printableName (options.file.string()) + "\n";
    const std::string kind = report.is_driver ? "driver" : "plugin";
    if (! report.name.empty() || ! report.version.empty()) text += "  " + kind + " " + quote (report.name) + ", version " + quote (report.version) + "\n";
    text += "  checked by Tactus " TACTUS_VERSION ", " + kind + " interface " + std::to_string (abiOf (report)) + ", level " + std::to_string (options.level)
            + ", seed " + std::to_string (options.seed) + "\n\n";
    for (const auto& f : report.findings)
        text += lineOf (f);
    for (const auto& node : report.nodes)
    {
        text += "\n" + node.id;
        if (node.tick_ns > 0.0) text += "   " + std::to_string (std::lround (node.tick_ns)) + " ns per tick here";
        text += "\n";
        for (const auto& f : node.findings)
            text += lineOf (f);
    }
    for (const auto& note : report.notes)
        text += "\nnote: " + note + "\n";
    const int failures = report.failures();
    text += failures == 0 ? "\nall passed\n" : "\n" + std::to_string (failures) + " failed\n";
    return text;
}

Json jsonOf (const Report& report)
{
    Json json { { "plugin", report.options.file.string() },
                { "name", report.name },
                { "version", report.version },
                { "tactus", TACTUS_VERSION },
                { "kind", report.is_driver ? "driver" : "nodes" },
                { "abi", abiOf (report) },
                { "level", report.options.level },
                { "seed", report.options.seed },
                { "failed", report.failures() },
                { "examinations", Json::array() },
                { "nodes", Json::array() },
                { "notes", report.notes } };
    for (const auto& f : report.findings)
        json["examinations"].push_back (jsonOf (f));
    for (const auto& node : report.nodes)
    {
        Json one { { "id", node.id }, { "ns_per_tick", node.tick_ns }, { "examinations", Json::array() } };
        for (const auto& f : node.findings)
            one["examinations"].push_back (jsonOf (f));
        json["nodes"].push_back (std::move (one));
    }
    return json;
}

}   // namespace tactus::check_plugin
