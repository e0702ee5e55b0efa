// SPDX-License-Identifier: MIT
#include "export_graph.hpp"
#include "folder_code.hpp"
#include <host/code/generate/class/class_code.hpp>
#include <host/code/generate/self_test/self_test_code.hpp>
#include <host/code/generate/self_test/self_test_run.hpp>
#include <host/code/generate/sources/adapted_source.hpp>
#include <host/code/generate/sources/plugin_sources.hpp>
#include <host/code/generate/sources/single_precision.hpp>
#include <host/code/generate/sources/sources.hpp>
#include <host/code/generate/targets/arduino_code.hpp>
#include <host/code/generate/targets/c_api_code.hpp>
#include <host/code/generate/targets/fmu_code.hpp>
#include <host/code/generate/targets/wasm_code.hpp>

#include <host/base/platform/atomic_folder.hpp>
#include <tactus/plan/find_param.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/quick_hash.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

/// The words that the class uses for itself, so no node may have them as a name.
const std::set<std::string>& ownWords()
{
    static const std::set<std::string> words { "prepare", "tick", "set", "get", "strike", "halt", "resume", "rearm", "loseTime", "emergencyStop", "rate_hz",
                                               "ticks_per_second", "in", "out", "hit", "hits", "state", "ticks", "lost_s", "parameters", "param", "control",
                                               "position", "turn", "low", "high", "renewAll", "memoryUsed", "memory_size", "max_rate_hz",
                                               "start", "phase", "part", "tactus", "std", "sumOf", "value" };
    return words;
}

/// Finds the headers of nodes that come from plugins, and names everything that cannot be exported.
PluginSources pluginSources (const Plan& plan, Messages& messages)
{
    PluginSources plugins;
    for (const auto& node : plan.flat().nodes)
    {
        const bool is_ours = node.type->origin.empty();
        if (! node.runs() || (is_ours && ! classOf (node.type->info.id).header.empty())) continue;
        auto found = is_ours ? Message::error ("export/plugin", "", "its code is not part of this program", "bypass it, or make a plugin of it")
                             : plugins.add (*node.type);
        if (found) continue;
        auto message = found.error();
        message.text = quote (node.path) + " (" + std::string (node.type->info.id) + ") cannot be exported: " + message.text;
        messages.push_back (std::move (message));
    }
    return plugins;
}

/// Names what has no single-precision export.
void refuseSingle (const ExportOptions& options, Messages& messages)
{
    if (! options.is_single || options.target == ExportTarget::cpp || options.target == ExportTarget::arduino) return;
    messages.push_back (Message::error ("export/float", "", "only the class and the Arduino library can be exported in single precision",
                                        "write --to cpp or --to arduino, or leave out --float"));
}

/// The code of the class in single precision. A number that a float cannot hold is an error.
void makeSingle (ClassFiles& code, Messages& messages)
{
    std::vector<std::string> outside;
    for (auto* text : { &code.header, &code.source, &code.data })
        *text = inSinglePrecision (*text, &outside);
    for (const auto& number : outside)
        messages.push_back (Message::error ("export/float", "", "the graph has the number " + number + ", which is beyond the range of single precision",
                                            "change it, or leave out --float"));
}

std::vector<std::string> limitsOf (const Plan& plan)
{
    std::vector<std::string> all;
    for (const auto& node : plan.flat().nodes)
        for (std::size_t i = 0; node.runs() && i < node.settings.size(); ++i)
            if (node.type->settings[i].id == "search_ticks" && std::get<double> (node.settings[i]) > 0.0)
                all.push_back ("`" + node.path + "` searches its mesh in the background in Tactus. Here it searches within the tick on which the answer is "
                                                 "due, so "
                                                 "that tick takes longer.");
    return all;
}

std::vector<ExportedParameter> parametersOf (PlanNames& wiring)
{
    std::vector<ExportedParameter> all;
    Names enumerators;
    for (std::size_t n = 0; n < wiring.nodes.size(); ++n)
    {
        auto& node = wiring.nodes[n];
        const auto& flat = wiring.flat (node);
        node.parameters = all.size();
        for (std::size_t p = 0; p < flat.type->params.size(); ++p)
        {
            const auto& sheet = flat.type->params[p];
            const auto values = wiring.plan.flat().param (static_cast<int> (node.instance), p);
            for (int k = 0; k < flat.slots (sheet); ++k)
            {
                const auto knob = plan::Knobs::indexOf (*flat.type, p, static_cast<std::size_t> (k));
                auto name = plan::nameOf (wiring.plan, node.instance, knob);
                auto enumerator = enumerators.make (name);
                all.push_back ({ std::move (name), std::move (enumerator), n, &sheet, k, knob, values[static_cast<std::size_t> (k)] });
            }
        }
    }
    return all;
}

/// By knob: the target of each knob that was turned since `turns` was read.
std::vector<std::optional<double>> targets (const PlanNames& wiring, const std::vector<ExportedParameter>& parameters, const Plan& turned,
                                            const std::vector<std::uint32_t>& before)
{
    std::vector<std::optional<double>> all (parameters.size());
    for (std::size_t i = 0; i < parameters.size(); ++i)
    {
        const auto& knob = turned.instances()[wiring.nodes[parameters[i].node].instance].knobs->all[parameters[i].knob];
        if (knob.turns != before[i]) all[i] = knob.target.load();
    }
    return all;
}

/// Finds out what a control does by turning it on another plan of the same graph, first as it is, then with its two ends swapped: at 0 a
/// parameter gets exactly the first of its two values.
std::vector<ExportedControl> controlsOf (const graph::Graph& graph, const PlanNames& wiring, const std::vector<ExportedParameter>& parameters,
                                         const std::shared_ptr<Plan>& same)
{
    std::vector<ExportedControl> all;
    Names enumerators;
    Engine engine { same };
    auto reversed = graph;
    for (auto& control : reversed.controls)
        for (auto& to : control.to)
            std::swap (to.low, to.high);
    for (const auto& control : graph.controls)
    {
        auto& made = all.emplace_back();
        made.id = control.id;
        made.enumerator = enumerators.make (control.id);
        made.name = control.name;
        made.value = control.value;
        std::vector<std::optional<double>> ends[2];
        for (int end = 0; end < 2; ++end)
        {
            std::vector<std::uint32_t> turns;
            for (const auto& p : parameters)
                turns.push_back (same->instances()[wiring.nodes[p.node].instance].knobs->all[p.knob].turns);
            (void)turnControl (engine, end == 0 ? graph : reversed, control.id, 0.0);
            ends[end] = targets (wiring, parameters, *same, turns);
        }
        for (std::size_t i = 0; i < parameters.size(); ++i)
            if (ends[0][i] && ends[1][i]) made.to.push_back ({ i, *ends[0][i], *ends[1][i] });
    }
    return all;
}

/// Finds the units of parameters and feeds. Those of generic nodes follow from the wires, so a plan with these ports as records is asked.
void findUnits (Exported& e, const CompileOptions& options)
{
    auto asks = options;
    asks.records = options.feeds;
    for (auto& p : e.parameters)
        if (p.sheet->unit.kind == UnitRule::Kind::fixed)
            p.unit = p.sheet->unit.unit.symbol;
        else
            asks.records.push_back (p.name);
    std::map<std::string, std::string> units;
    if (const auto made = compile (e.graph, catalogue(), asks); made.plan)
        for (const auto& tap : made.plan->taps())
            units.emplace (tap.name, tap.unit);
    for (auto& p : e.parameters)
        if (const auto found = units.find (p.name); found != units.end()) p.unit = found->second;
    for (const auto& feed : options.feeds)
        e.feed_units.push_back (units[feed]);
}

std::string stemOf (const std::string& file)
{
    auto stem = identifier (fs::path (file).stem().string());
    for (auto& c : stem)
        c = c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c;
    return Names().make (stem);
}

std::vector<ExportedRole> rolesOf (const Run& run)
{
    std::vector<ExportedRole> all;
    for (const auto& use : run.engine().newest().roles())
    {
        auto& role = all.emplace_back();
        role.name = use.name;
        for (const auto& [name, opened] : run.devices())
            if (name == use.name) role = { name, opened.limits, opened.device->layout() };
    }
    return all;
}

/// The files around the class, for this target. They may change what is there already.
void addTarget (ExportedFolder& folder, const Exported& e, ExportTarget target)
{
    auto& files = folder.files;
    if (target == ExportTarget::c_api || target == ExportTarget::wasm)
    {
        auto c = cFiles (e);
        files.emplace_back (e.stem + ".h", std::move (c.header));
        files.emplace_back (e.stem + "_c.cpp", std::move (c.source));
        if (target == ExportTarget::c_api) files.emplace_back (e.stem + "_example.c", std::move (c.example));
    }
    if (target == ExportTarget::wasm)
    {
        std::string all;
        for (const auto& [path, text] : files)
            all += path + "\n" + text;
        for (auto& file : wasmFiles (e, quickHash (all) >> 1u))
            files.push_back (std::move (file));
        std::ranges::find (files, "Makefile", &std::pair<std::string, std::string>::first)->second += wasmMake (e);
    }
    if (target == ExportTarget::fmu)
    {
        auto fmu = fmuFiles (e);
        files.emplace_back ("modelDescription.xml", std::move (fmu.description));
        files.emplace_back (e.stem + "_fmu.cpp", std::move (fmu.source));
        files.emplace_back ("fmi2.h", fmiHeader());
        std::ranges::find (files, "Makefile", &std::pair<std::string, std::string>::first)->second += fmu.make;
    }
    if (target != ExportTarget::arduino) return;
    std::erase_if (files, [] (const auto& file) { return file.first == "Makefile" || file.first == "CMakeLists.txt"; });
    for (auto& [path, text] : files)
        if (path.ends_with (".hpp") || path.ends_with (".cpp") || path.starts_with ("plugins/")) path = "src/" + path;
    for (auto& file : arduinoFiles (e))
        files.push_back (std::move (file));
}

void addFiles (ExportedFolder& folder, const Exported& e, const PluginSources& plugins, const ClassFiles& code, ExportTarget target)
{
    std::set<std::string> used { "tactus/run/generated/exported_graph.hpp", "tactus/run/generated/exported_memory.hpp" };
    if (! code.data.empty()) used.insert ("tactus/kit/geometry/surface.hpp");
    for (const auto& node : e.wiring.nodes)
        used.insert (node.header);
    for (const auto& [path, text] : plugins.files())
        for (auto& included : includesOf ({ path, text }))
            used.insert (std::move (included));
    const auto sources = e.is_single ? inSinglePrecision (withIncludes (used)) : withIncludes (used);
    auto compiled = sources;
    if (target == ExportTarget::c_api) compiled.insert (e.stem + "_c.cpp");
    auto& files = folder.files;
    files = { { e.stem + ".hpp", code.header },
              { e.stem + ".cpp", code.source },
              { "CMakeLists.txt", cmakeFile (e, compiled) },
              { "Makefile", makeFile (e, compiled) },
              { "README.md", readmeFile (e, target, limitsOf (e.wiring.plan)) },
              { "LICENSE", std::string (findSource ("LICENSES/MIT.txt")->text) } };
    if (! code.data.empty()) files.emplace_back (e.stem + "_data.hpp", code.data);
    for (const auto& path : sources)
        files.emplace_back (path, e.is_single ? adaptedSingle (path) : adapted (*findSource (path)));
    for (const auto& [path, text] : plugins.files())
        files.emplace_back (path, e.is_single ? adaptedSingle ({ path, text }) : adapted ({ path, text }));
    addTarget (folder, e, target);
}

constexpr const char* manifest = "tactus_export.txt";
}   // namespace

ExportedFolder exportGraph (const graph::Graph& graph, const ExportOptions& options)
{
    ExportedFolder folder;
    Run tried { catalogue(), options.compile, options.open ? options.open : simulatedDevices() };
    folder.messages = tried.load (graph);
    if (hasErrors (folder.messages)) return folder;
    refuseSingle (options, folder.messages);
    const auto plugins = pluginSources (tried.engine().plan(), folder.messages);
    if (options.target == ExportTarget::arduino && tried.engine().plan().roles().empty())
        folder.messages.push_back (Message::error ("export/role", "", "an Arduino library drives a device, but the graph has none", "write --to cpp"));
    tried.openDevices (graph, folder.messages);
    if (hasErrors (folder.messages)) return folder;

    Run run { catalogue(), options.compile, repeatedDevices (tried) };
    (void)run.load (graph);   // as before, so it has the same messages
    Messages known;
    run.openDevices (graph, known);
    const auto& plan = run.engine().plan();

    PlanNames wiring { plan, options.compile.feeds, ownWords(), plugins.classes() };
    Exported e { .graph = graph,
                 .wiring = wiring,
                 .file = options.file,
                 .stem = stemOf (options.file),
                 .class_name = {},
                 .program = options.program,
                 .is_single = options.is_single,
                 .has_makefile = options.target != ExportTarget::arduino,
                 .has_plugins = ! plugins.files().empty(),
                 .parameters = parametersOf (wiring),
                 .controls = {},
                 .hits = {},
                 .roles = {} };
    e.class_name = className (e.stem);
    if (const auto same = compile (graph, catalogue(), options.compile); same.plan) e.controls = controlsOf (graph, wiring, e.parameters, same.plan);
    Names hits;
    for (const auto& name : wiring.hit_names)
        e.hits.push_back (hits.make (name));

    findUnits (e, options.compile);
    e.roles = rolesOf (run);
    e.memory = memoryOf (wiring);
    auto code = classFiles (e);   // before the run, because it moves the values
    if (e.is_single) makeSingle (code, folder.messages);
    if (hasErrors (folder.messages)) return folder;
    addFiles (folder, e, plugins, code, options.target);
    auto self_test = selfTestFiles (e, selfTestOf (run, e));
    const std::string place = options.target == ExportTarget::arduino ? "extras/" : "";
    folder.files.emplace_back (place + e.stem + "_self_test.cpp", std::move (self_test.source));
    folder.files.emplace_back (place + e.stem + "_self_test_data.hpp", std::move (self_test.data));
    folder.stem = e.stem;
    folder.class_name = e.class_name;
    return folder;
}

Result<> canWriteFolder (const fs::path& path) { return AtomicFolder::check (path, manifest); }

Result<> writeFolder (const ExportedFolder& folder, const fs::path& path)
{
    auto made = AtomicFolder::create (path, manifest);
    if (! made) return std::move (made).error();
    std::string list;
    for (const auto& [name, text] : folder.files)
    {
        if (auto written = made->write (name, text); ! written) return written;
        list += name + "\n";
    }
    if (auto written = made->write (manifest, list); ! written) return written;
    if (auto kept = made->keepOthers(); ! kept) return kept;
    return made->commit();
}

}   // namespace tactus::host
