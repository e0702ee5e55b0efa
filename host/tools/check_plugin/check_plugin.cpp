// SPDX-License-Identifier: MIT
#include "check_plugin.hpp"
#include "apart.hpp"
#include "check_driver.hpp"
#include "finding.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <tactus/examine/examination.hpp>
#include <tactus/examine/stage.hpp>
#include <tactus/plugin/plugin_library.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace tactus::check_plugin
{

namespace
{
using examine::Stage;

/// Makes text from a plugin valid UTF-8, because it becomes part of JSON.
std::string textOf (const std::string& text) { return printable (text); }

Json jsonOf (const Message& m) { return { { "id", m.id }, { "text", textOf (m.text + "; " + m.remedy) } }; }

/// The same for a device driver.
std::string describeDriver (const std::filesystem::path& file, Json answer)
{
    answer["is_driver"] = true;
    const auto driver = host::DeviceDriver::load (file);
    if (driver)
    {
        answer["name"] = (*driver)->name();
        answer["version"] = (*driver)->version();
    }
    else
        answer["messages"].push_back (jsonOf (driver.error()));
    Stage::enter ("unloading");
    return answer.dump();
}

/// Loads the plugin, and returns a description of it as JSON. Runs in a separate process.
std::string describe (const std::filesystem::path& file)
{
    Json answer { { "messages", Json::array() }, { "nodes", Json::array() } };
    Stage::enter ("loading");
    if (const auto object = SharedObject::load (file); object && (*object)->find ("tactus_device_entry") != nullptr)
        return describeDriver (file, std::move (answer));
    const auto library = PluginLibrary::load (file);
    if (library)
    {
        answer["name"] = textOf ((*library)->name());
        answer["version"] = textOf ((*library)->version());
    }
    Stage::enter ("reading its datasheets");
    const auto loaded = loadPlugins ({ file }, Catalogue {});
    for (const auto& m : loaded.messages)
        answer["messages"].push_back (jsonOf (m));
    for (const auto& type : loaded.types)
        answer["nodes"].push_back (std::string (type.info.id));
    Stage::enter ("unloading");
    return answer.dump();
}

/// Loads the plugin and examines one of its nodes. Runs in a separate process, so each result is that of a freshly loaded plugin.
template <typename Ask>
std::string askNode (const std::filesystem::path& file, const std::string& id, Ask&& ask)
{
    Stage::enter ("loading");
    const auto loaded = loadPlugins ({ file }, Catalogue {});
    const auto type = std::ranges::find (loaded.types, id, [] (const NodeType& t) { return std::string (t.info.id); });
    if (type == loaded.types.end()) return "the plugin has no node " + quote (id) + " when it is loaded again";
    try
    {
        return ask (*type);
    }
    catch (const std::exception& e)
    {
        return textOf (e.what());
    }
}

std::string examineNode (const NodeType& type, const examine::Examination& examination, const Options& options)
{
    if (auto reason = examination.skipped (type); ! reason.empty()) return skip_mark + reason;
    const int trials = examination.random ? examine::trialsAt (options.level) : 1;
    for (unsigned k = 0; k < static_cast<unsigned> (trials); ++k)
    {
        std::string fault;
        try
        {
            fault = examination.fault (type, options.seed + k);
        }
        catch (const std::exception& e)
        {
            fault = textOf (e.what());
        }
        if (! fault.empty()) return fault + (examination.random ? " (seed " + std::to_string (options.seed + k) + ")" : "");
    }
    return {};
}

Budget budgetOf (const Options& options, const std::string& node)
{
    constexpr int calls = 24;   // so many calls may take their whole time
    return { .cpu_seconds = calls * options.cpu_seconds, .call_seconds = options.cpu_seconds, .of = node };
}

/// Runs the node in two processes with the same seed: its outputs must depend neither on when the plugin was loaded nor on chance.
Finding runsFinding (const Options& options, const std::string& id)
{
    const auto print = [&] {
        return runApart (budgetOf (options, id), [&] {
            return askNode (options.file, id, [&] (const NodeType& type) { return std::to_string (examine::fingerprint (type, options.seed)); });
        });
    };
    auto first = print(), second = print();
    if (first.done && second.done) first.answer = first.answer == second.answer ? "" : "two processes give different bits for the same inputs";
    return finding ("runs", "two processes give the same bits", first);
}

CheckedNode checkNode (const Options& options, const std::string& id)
{
    CheckedNode node { .id = id };
    std::string endless;
    for (const auto& examination : examine::examinations())
    {
        if (examination.level > options.level) continue;
        Finding f { std::string (examination.id), std::string (examination.promise), Verdict::skipped, endless };
        if (endless.empty())
        {
            const auto ending = runApart (budgetOf (options, id), [&] {
                return askNode (options.file, id, [&] (const NodeType& type) { return examineNode (type, examination, options); });
            });
            f = finding (f.id, f.promise, ending);
            if (ending.endless) endless = "the node did not finish in `" + f.id + "`";
        }
        node.findings.push_back (std::move (f));
    }
    if (! endless.empty()) return node;
    node.findings.push_back (runsFinding (options, id));
    const auto timed = runApart (budgetOf (options, id), [&] {
        return askNode (options.file, id, [] (const NodeType& type) { return std::to_string (examine::tickTime (type)); });
    });
    if (timed.done) node.tick_ns = readNumber (timed.answer).value;
    return node;
}
}   // namespace

Finding finding (std::string id, std::string promise, const ProcessResult& ending)
{
    Finding f { .id = std::move (id), .promise = std::move (promise) };
    if (! ending.done)
        f.why = ending.why;
    else if (ending.answer.starts_with (skip_mark))
    {
        f.verdict = Verdict::skipped;
        f.why = ending.answer.substr (1);
        return f;
    }
    else
        f.why = ending.answer;
    f.verdict = f.why.empty() ? Verdict::pass : Verdict::fail;
    return f;
}

int Report::failures() const
{
    const auto isFailure = [] (const Finding& f) { return f.verdict == Verdict::fail; };
    auto n = std::ranges::count_if (findings, isFailure);
    for (const auto& node : nodes)
        n += std::ranges::count_if (node.findings, isFailure);
    return static_cast<int> (n);
}

Report checkPlugin (const Options& options)
{
    Report report { .options = options };
    const auto ending = runApart ({ options.cpu_seconds, options.cpu_seconds }, [&] { return describe (options.file); });
    Finding load { "load", "the plugin loads, and its datasheets are complete" };
    if (! ending.done)
    {
        load.verdict = Verdict::fail;
        load.why = ending.why;
        report.findings.push_back (std::move (load));
        return report;
    }
    const auto parsed = Json::tryParse (ending.answer);
    if (! parsed) throw std::runtime_error ("the description of the plugin is longer than 1 MB");
    const auto& answer = *parsed;
    report.name = answer.value ("name", "");
    report.version = answer.value ("version", "");
    for (const auto& m : answer["messages"])
        report.findings.push_back ({ load.id, load.promise, Verdict::fail, m["text"].get<std::string>() + " [" + m["id"].get<std::string>() + "]" });
    if (answer.contains ("is_driver"))
    {
        report.is_driver = true;
        load.promise = "the driver loads, and its interface is complete";
        for (auto& f : report.findings)
            f.promise = load.promise;
        if (! report.findings.empty()) return report;
        report.findings.push_back (std::move (load));
        std::ranges::move (checkDriver (options), std::back_inserter (report.findings));
        return report;
    }
    if (report.findings.empty()) report.findings.push_back (load);
    for (const auto& id : answer["nodes"])
    {
        report.nodes.push_back (checkNode (options, id.get<std::string>()));
        if (catalogue().find (report.nodes.back().id) != nullptr)
            report.notes.push_back (quote (report.nodes.back().id) + " is also a node of Tactus, which refuses that of the plugin: choose another id");
    }
    if (report.nodes.empty() && report.failures() == 0)
        report.findings.push_back ({ "nodes", "it contains a node", Verdict::fail, "it contains none" });
    return report;
}

}   // namespace tactus::check_plugin
