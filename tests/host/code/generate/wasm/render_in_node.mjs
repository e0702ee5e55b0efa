// SPDX-License-Identifier: MIT
// node render_in_node.mjs GRAPH.js TRACE.csv [NAME=VALUE...]: moves all roles of an exported graph as the trace says, and prints what it records, as
// `tactus render` does. Then it checks the stops and limits of the guard.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import assert from 'node:assert';
import { render } from './shared.mjs';

const [script, trace, ...sets] = process.argv.slice (2);
const exported = await import (pathToFileURL (script));
const Exported = Object.values (exported).find (one => typeof one === 'function'), { about } = exported;
const module = new WebAssembly.Module (readFileSync (script.replace (/\.js$/, '.wasm')));
assert.deepEqual (WebAssembly.Module.imports (module), []);
const graph = new Exported (module);
process.stdout.write (render (graph, readFileSync (trace, 'utf8'), sets).join ('\n') + '\n');

const efforts = () => about.roles.flatMap (role => [...graph.outputs[role.member].force]);
const role = about.roles[0].name;
assert.throws (() => graph.set ('nothing', 1), /there is no parameter "nothing"/);
assert.equal (graph.tighten (role, { max_force: 1e-3 }), false);   // after the first tick
assert.equal (graph.stop (role), 'none');
assert (! graph.isLatched (role));
graph.emergencyStop();
for (let k = 0; k < about.rate_hz; ++k)
    graph.tick();
assert.equal (graph.stop (role), 'emergency');
assert (graph.isLatched (role));
assert (efforts().every (value => value === 0));
assert (graph.prepare (about.rate_hz));
assert (! graph.prepare (2 * about.rate_hz));
const most = graph.limitsOf (role).max_force;
assert (graph.tighten (role, { max_force: most / 2 }) && graph.tighten (role, { max_force: 2 * most }));
assert.equal (graph.limitsOf (role).max_force, most / 2);
