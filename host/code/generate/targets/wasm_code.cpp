// SPDX-License-Identifier: MIT
#include "wasm_code.hpp"
#include "c_api_code.hpp"

#include <host/code/generate/sources/sources.hpp>
#include <tactus/run/log/run_head.hpp>
#include <tactus/text/json.hpp>

#include <array>
#include <cmath>
#include <sstream>

namespace tactus::host
{

namespace
{
/// Fails to compile if the structs are not what tactus_graph.js takes them for.
std::string layoutChecks (const Exported& e)
{
    std::string text;
    std::size_t inputs = 8 * e.wiring.feed_names.size(), outputs = 0;
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        const auto reading = e.stem + "_" + e.wiring.role_ports[i] + "_reading";
        text += "static_assert (offsetof (" + reading + ", valid) == 64 && offsetof (" + reading + ", buttons) == 68);\n";
        inputs += readingBytes (e.roles[i].layout);
        outputs += effortBytes (e.roles[i].layout);
    }
    for (const auto& tap : e.wiring.plan.taps())
        outputs += 8 * (tap.samples == nullptr ? 1 : static_cast<std::size_t> (tap.per_tick));
    const auto check = [&] (const char* name, std::size_t size) {
        if (size > 0) text += "static_assert (sizeof (" + e.stem + "_" + name + ") == " + std::to_string (size) + ");\n";
    };
    check ("inputs", inputs);
    check ("outputs", outputs);
    return text;
}

std::string wasmSource (const Exported& e, std::uint32_t digest)
{
    std::string more;
    if (! e.parameters.empty())
        more += "EXPORT (set) void wasmSet (int param, double value) { @S@_set (&wasm_graph, static_cast<@S@_param> (param), value); }\n"
                "EXPORT (get) double wasmGet (int param) { return @S@_get (&wasm_graph, static_cast<@S@_param> (param)); }\n";
    if (! e.controls.empty())
        more += "EXPORT (turn) void wasmTurn (int control, double position) { @S@_turn (&wasm_graph, static_cast<@S@_control> (control), position); }\n";
    if (! e.hits.empty())
        more += "EXPORT (strike) void wasmStrike (int hit, double speed) { @S@_strike (&wasm_graph, static_cast<@S@_hit> (hit), speed); }\n";
    if (! e.roles.empty())
        more += R"(
static @S@_limits wasm_limits;

EXPORT (limits) void* wasmLimits() { return &wasm_limits; }
EXPORT (no_limits) void wasmNoLimits() { @S@_no_limits (&wasm_limits); }
EXPORT (tighten) bool wasmTighten (int role) { return @S@_tighten (&wasm_graph, static_cast<@S@_role> (role), &wasm_limits); }
EXPORT (limits_of) void wasmLimitsOf (int role) { @S@_limits_of (&wasm_graph, static_cast<@S@_role> (role), &wasm_limits); }
EXPORT (stop) int wasmStop (int role)
{
    static_assert (static_cast<int> (tactus::Guard::Stop::emergency) == 9);   // tactus_graph.js has their names
    const auto* const asked = roleOf (wasm_graph.all, static_cast<@S@_role> (role));
    return asked == nullptr ? 0 : static_cast<int> (asked->guard.stop());
}
EXPORT (latched) bool wasmIsLatched (int role)
{
    const auto* const asked = roleOf (wasm_graph.all, static_cast<@S@_role> (role));
    return asked != nullptr && asked->guard.isLatched();
}
EXPORT (halt) void wasmHalt() { @S@_halt (&wasm_graph); }
EXPORT (resume) void wasmResume() { @S@_resume (&wasm_graph); }
EXPORT (emergency_stop) void wasmEmergencyStop() { @S@_emergency_stop (&wasm_graph); }
EXPORT (rearm) void wasmRearm() { @S@_rearm (&wasm_graph); }
EXPORT (lose_time) void wasmLoseTime (double seconds) { @S@_lose_time (&wasm_graph, seconds); }
)";
    return filled (R"(// SPDX-License-Identifier: MIT
// The functions of the WebAssembly module. tactus_graph.js calls them.
#include "@S@_c.cpp"

#include <cstddef>

// What the libraries call when they cannot go on. Their own functions print, for which the module would have to import a system.
extern "C" void __abort_message (const char*, ...) { __builtin_trap(); }
extern "C" void __assert_fail (const char*, const char*, int, const char*) { __builtin_trap(); }
void std::__libcpp_verbose_abort (const char*, ...) noexcept { __builtin_trap(); }

@CHECKS@
static @S@ wasm_graph;
static @S@_inputs wasm_inputs;
static @S@_outputs wasm_outputs;

#define EXPORT(name) extern "C" __attribute__ ((export_name (#name)))

EXPORT (inputs) void* wasmInputs()
{
    @S@_init (&wasm_inputs);
    return &wasm_inputs;
}
EXPORT (outputs) void* wasmOutputs() { return &wasm_outputs; }
EXPORT (digest) int wasmDigest() { return @DIGEST@; }   // @S@.js has the same, or is from another export
EXPORT (prepare) bool wasmPrepare (double ticks_per_second) { return @S@_prepare (&wasm_graph, ticks_per_second); }
EXPORT (tick) void wasmTick() { @S@_tick (&wasm_graph, &wasm_inputs, &wasm_outputs); }
@MORE@)",
                   { { "@CHECKS@", layoutChecks (e) },
                     { "@DIGEST@", std::to_string (digest) },
                     { "@MORE@", filled (more, { { "@S@", e.stem } }) },
                     { "@S@", e.stem } });
}

/// A limit that is infinite has no place in JSON.
Json limit (double value) { return std::isfinite (value) ? Json (value) : Json(); }

Json names (const auto& all)
{
    auto list = Json::array();
    for (const auto& name : all)
        list.push_back (std::string (name));
    return list;
}

Json paramsOf (const Exported& e)
{
    auto all = Json::array();
    for (const auto& p : e.parameters)
    {
        auto param = Json::object ({ { "name", p.name },
                                     { "unit", p.unit },
                                     { "about", std::string (p.sheet->about) },
                                     { "value", limit (p.value) },
                                     { "min", limit (p.sheet->limits.usual.min) },
                                     { "max", limit (p.sheet->limits.usual.max) },
                                     { "hard_min", limit (p.sheet->limits.hard.min) },
                                     { "hard_max", limit (p.sheet->limits.hard.max) } });
        if (! p.sheet->choices.empty()) param["choices"] = names (p.sheet->choices);
        all.push_back (std::move (param));
    }
    return all;
}

Json controlsOf (const Exported& e)
{
    auto all = Json::array();
    for (const auto& c : e.controls)
    {
        auto moves = Json::array();
        for (const auto& to : c.to)
            moves.push_back (e.parameters[to.parameter].name);
        all.push_back (Json::object ({ { "name", c.id }, { "title", c.name.empty() ? c.id : c.name }, { "value", c.value }, { "moves", std::move (moves) } }));
    }
    return all;
}

Json rolesOf (const Exported& e)
{
    auto all = Json::array();
    for (std::size_t i = 0; i < e.roles.size(); ++i)
    {
        const auto& l = e.roles[i].layout;
        all.push_back (Json::object ({ { "name", e.roles[i].name },
                                       { "member", e.wiring.role_ports[i] },
                                       { "axes", names (l.axes) },
                                       { "efforts", names (l.efforts) },
                                       { "signal_inputs", l.signal_inputs },
                                       { "signal_outputs", l.signal_outputs },
                                       { "has_brake", l.brake > 0.0 },
                                       { "mass", l.mechanics.mass },
                                       { "damping", l.mechanics.damping } }));
    }
    return all;
}

Json recordsOf (const Exported& e)
{
    auto all = Json::array();
    for (std::size_t i = 0; i < e.wiring.tap_names.size(); ++i)
    {
        const auto& tap = e.wiring.plan.taps()[i];
        auto record = Json::object ({ { "name", tap.name }, { "member", e.wiring.tap_names[i] }, { "unit", tap.unit } });
        if (tap.samples != nullptr) record["count"] = tap.per_tick;
        all.push_back (std::move (record));
    }
    return all;
}

/// The text that a program can ask the graph for, about the graph itself.
std::string aboutOf (const Exported& e, std::uint32_t digest)
{
    auto feeds = Json::array(), hits = Json::array();
    for (std::size_t i = 0; i < e.wiring.feed_names.size(); ++i)
        feeds.push_back (Json::object ({ { "name", e.wiring.feed_names[i] }, { "member", e.wiring.feed_names[i] }, { "unit", e.feed_units[i] } }));
    for (const auto& hit : e.wiring.hit_names)
        hits.push_back (Json::object ({ { "name", hit } }));
    return Json::object ({ { "name", e.stem },
                           { "title", e.graph.name.empty() ? e.stem : e.graph.name },
                           { "about", e.graph.about },
                           { "rate_hz", e.wiring.plan.rateHz() },
                           { "roles", rolesOf (e) },
                           { "feeds", std::move (feeds) },
                           { "records", recordsOf (e) },
                           { "params", paramsOf (e) },
                           { "controls", controlsOf (e) },
                           { "hits", std::move (hits) },
                           { "limits", names (limitNames()) },
                           { "digest", digest } })
        .dump (2);
}

std::string script (const Exported& e, std::uint32_t digest)
{
    return filled (R"(// SPDX-License-Identifier: MIT
// Written by `@PROGRAM@ export` from @FILE@. README.md says how to use it.
import { Graph, compile } from './tactus_graph.js';
import { Player } from './tactus_page.js';

export const about = @ABOUT@;

const files = { module: new URL ('@S@.wasm', import.meta.url), worklet: new URL ('@S@_worklet.js', import.meta.url) };

export class @C@ extends Graph
{
    constructor (module) { super (module, about); }

    static async load (address = files.module) { return new @C@ (await compile (address)); }

    static play (element, options) { return new Player (about.name, files, element, options); }
}
)",
                   { { "@ABOUT@", aboutOf (e, digest) },
                     { "@C@", e.class_name },
                     { "@FILE@", comment (e.file) },
                     { "@PROGRAM@", e.program },
                     { "@S@", e.stem } });
}

/// Names as a type: 'drag.mu' | 'drag.d_max'.
std::string oneOf (const std::vector<std::string>& all)
{
    std::vector<std::string> quoted;
    for (const auto& name : all)
        quoted.push_back (Json (name).dump());
    return quoted.empty() ? "never" : listText (quoted, " | ");
}

std::string types (const Exported& e)
{
    std::string inputs, outputs;
    std::vector<std::string> params, controls, roles;
    for (const auto& port : e.wiring.role_ports)
    {
        inputs += "    readonly " + port + ": Reading;\n";
        outputs += "    readonly " + port + ": Effort;\n";
    }
    for (const auto& feed : e.wiring.feed_names)
        inputs += "    " + feed + ": number;\n";
    for (std::size_t i = 0; i < e.wiring.tap_names.size(); ++i)
        outputs += "    readonly " + e.wiring.tap_names[i] + (e.wiring.plan.taps()[i].samples == nullptr ? ": number;\n" : ": Float64Array;\n");
    for (const auto& p : e.parameters)
        params.push_back (p.name);
    for (const auto& c : e.controls)
        controls.push_back (c.id);
    for (const auto& role : e.roles)
        roles.push_back (role.name);
    return filled (R"(// SPDX-License-Identifier: MIT
import { About, Effort, Graph, Reading } from './tactus_graph.js';
import { PlayOptions, Player } from './tactus_page.js';

export interface Inputs
{
@INPUTS@}
export interface Outputs
{
@OUTPUTS@}
export type Param = @PARAMS@;
export type Control = @CONTROLS@;
export type Hit = @HITS@;
export type Role = @ROLES@;

export const about: About;

export class @C@ extends Graph<Inputs, Outputs, Param, Control, Hit, Role>
{
    constructor (module: WebAssembly.Module);
    static load (address?: string | URL): Promise<@C@>;
    static play (element: Element, options?: PlayOptions): Player;
}
)",
                   { { "@INPUTS@", inputs },
                     { "@OUTPUTS@", outputs },
                     { "@PARAMS@", oneOf (params) },
                     { "@CONTROLS@", oneOf (controls) },
                     { "@HITS@", oneOf (e.wiring.hit_names) },
                     { "@ROLES@", oneOf (roles) },
                     { "@C@", e.class_name } });
}

/// The files that are the same for all graphs.
constexpr std::array shared_files { "tactus_graph.js", "tactus_graph.d.ts", "tactus_node.js", "tactus_page.js", "tactus_page.d.ts", "tactus_worklet.d.ts" };

/// The package.json of the folder, for npm, bundlers and Node.js. Only with the condition `node` do they get files that import modules of Node.js.
std::string package (const Exported& e)
{
    const std::string stem = "./" + e.stem;
    const auto entry = [] (const std::string& types, const std::string& file, const std::string& in_node = {}) {
        auto all = Json::object ({ { "types", types } });
        if (! in_node.empty()) all["node"] = in_node;
        all["default"] = file;
        return all;
    };
    auto files = Json::array();
    for (const auto* end : { ".js", "_node.js", ".d.ts", ".wasm", "_worklet.js", "_worklet.d.ts" })
        files.push_back (e.stem + end);
    for (const auto* name : shared_files)
        files.push_back (name);
    return Json::object ({ { "name", e.stem },
                           { "version", "1.0.0" },
                           { "description", e.graph.about.empty() ? e.graph.name : e.graph.about },
                           { "license", "MIT" },
                           { "type", "module" },
                           { "engines", Json::object ({ { "node", ">=18" } }) },
                           { "types", stem + ".d.ts" },
                           { "exports", Json::object ({ { ".", entry (stem + ".d.ts", stem + ".js", stem + "_node.js") },
                                                        { "./tactus_graph.js", entry ("./tactus_graph.d.ts", "./tactus_graph.js", "./tactus_node.js") },
                                                        { "./tactus_page.js", entry ("./tactus_page.d.ts", "./tactus_page.js") },
                                                        { "./worklet", entry (stem + "_worklet.d.ts", stem + "_worklet.js") },
                                                        { stem + ".wasm", stem + ".wasm" } }) },
                           { "files", std::move (files) } })
               .dump (2)
           + "\n";
}

std::string inNode (const Exported& e)
{
    return filled (R"(// SPDX-License-Identifier: MIT
// @S@.js for Node.js, where load() reads the module from its file.
import './tactus_node.js';

export * from './@S@.js';
)",
                   { { "@S@", e.stem } });
}

std::string workletTypes()
{
    return R"(// SPDX-License-Identifier: MIT
export type { FromWorklet, Options, ToWorklet } from './tactus_worklet.js';
)";
}

std::string shared (const std::string& name) { return std::string (findSource ("host/code/generate/targets/" + name)->text); }

/// A script without its imports and exports, as a part of another script.
std::string part (const std::string& name)
{
    std::istringstream lines (shared (name));
    std::string text, line;
    while (std::getline (lines, line))
        if (! line.starts_with ("import ") && ! line.starts_with ("// SPDX")) text += line.substr (line.starts_with ("export ") ? 7 : 0) + "\n";
    return text;
}

/// One file, because bundlers copy a script that a page gives to addModule() as it is, without what it imports.
std::string worklet (const Exported& e, std::uint32_t digest)
{
    return filled (R"(// SPDX-License-Identifier: MIT
// The processor '@S@' for an AudioWorkletNode.
const about = @ABOUT@;

@GRAPH@
@WORKLET@
register ('@S@', class extends Graph { constructor (module) { super (module, about); } });
)",
                   { { "@ABOUT@", aboutOf (e, digest) },
                     { "@GRAPH@", part ("tactus_graph.js") },
                     { "@WORKLET@", part ("tactus_worklet.js") },
                     { "@S@", e.stem } });
}
}   // namespace

std::vector<std::pair<std::string, std::string>> wasmFiles (const Exported& e, std::uint32_t digest)
{
    std::vector<std::pair<std::string, std::string>> files { { e.stem + "_wasm.cpp", wasmSource (e, digest) },
                                                             { e.stem + ".js", script (e, digest) },
                                                             { e.stem + "_node.js", inNode (e) },
                                                             { e.stem + ".d.ts", types (e) },
                                                             { e.stem + "_worklet.js", worklet (e, digest) },
                                                             { e.stem + "_worklet.d.ts", workletTypes() },
                                                             { "package.json", package (e) },
                                                             { "index.html", filled (shared ("index.html"), { { "@S@", e.stem }, { "@C@", e.class_name } }) } };
    for (const auto* name : shared_files)
        files.emplace_back (name, shared (name));
    return files;
}

std::string wasmMake (const Exported& e)
{
    return filled (R"(
# make wasm: builds @S@.wasm (Debian: libeigen3-dev clang-22 lld-22 libc++-22-dev-wasm32 libclang-rt-22-dev-wasm32 wasi-libc).
# make wasm_test: builds the self-test for WebAssembly, and runs it in node.
WASM_CXX ?= clang++-22
WASM_CXXFLAGS ?= -O2
WASM_FLAGS = --target=wasm32-wasi -Wno-deprecated -std=c++20 -I. -isystem $(EIGEN) -ffp-contract=off -fno-math-errno -fno-trapping-math \
    -fno-exceptions -fno-rtti -fno-threadsafe-statics $(WASM_CXXFLAGS) -Wl,--strip-all,--gc-sections,--stack-first,-z,stack-size=262144

wasm: @S@.wasm

@S@.wasm: @S@_wasm.cpp @S@_c.cpp $(sources)
	$(WASM_CXX) $(WASM_FLAGS) -mexec-model=reactor -o $@ @S@_wasm.cpp $(sources)

@S@_self_test.wasm: @S@_self_test.cpp $(sources)
	$(WASM_CXX) $(WASM_FLAGS) -o $@ $^

wasm_test: @S@_self_test.wasm
	@node --no-warnings -e 'const wasi = new (require ("wasi").WASI) ({ version: "preview1", args: ["self_test"], returnOnExit: true }), module = new WebAssembly.Module (require ("fs").readFileSync ("$<")); process.exitCode = wasi.start (new WebAssembly.Instance (module, { wasi_snapshot_preview1: wasi.wasiImport }));'

.PHONY: wasm wasm_test
)",
                   { { "@S@", e.stem } });
}

}   // namespace tactus::host
