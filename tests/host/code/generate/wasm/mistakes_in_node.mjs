// SPDX-License-Identifier: MIT
// Mistakes of a program that uses an exported graph in node are named, not ignored: mistakes_in_node.mjs FOLDER. Prints "ok", or throws.
import assert from 'node:assert';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const folder = resolve (process.argv[2]), { name } = JSON.parse (readFileSync (join (folder, 'package.json'), 'utf8'));
const at = file => pathToFileURL (join (folder, file)), exported = await import (at (`${name}_node.js`));
const Type = Object.values (exported).find (one => typeof one === 'function'), { about } = exported, graph = await Type.load();
const wait = () => { for (let k = 0; k < about.rate_hz; ++k) graph.tick(); };
const [role] = about.roles, [control] = about.controls, param = about.params.find (one => control.moves.includes (one.name));
const { position } = graph.inputs[role.member];

// A position that is assigned is copied: the tool stays in the memory of the graph.
graph.inputs[role.member].position = [1e-3, 2e-3, -3e-4];
assert.deepStrictEqual ([...position], [1e-3, 2e-3, -3e-4]);
assert.strictEqual (graph.inputs[role.member].position, position);
assert.throws (() => { graph.inputs[role.member].position = [0, 0]; }, /"position" takes 3 numbers, not \[0, 0\]/);
assert.throws (() => { graph.inputs[role.member].position = undefined; }, TypeError);
assert.throws (() => { graph.inputs[role.member].positon = [0, 0, 0]; }, TypeError);
assert.throws (() => { graph.inputs[role.member] = {}; }, TypeError);
assert.throws (() => { graph.outputs[role.member].force = [0, 0, 0]; }, TypeError);
wait();
assert (graph.outputs[role.member].force[2] > 0);

// Numbers are clamped, and must be some.
const turned = to => { graph.turn (control.name, to); wait(); return graph.get (param.name); };
const low = turned (0), high = turned (1);
assert.notStrictEqual (low, high);
assert.strictEqual (turned (-3), low);
assert.strictEqual (turned (7), high);
assert.throws (() => graph.turn (control.name, NaN),
               { name: 'RangeError', message: `turn ('${control.name}'): NaN is not a finite number; give one from 0 to 1` });
assert.throws (() => graph.turn (control.name, '0.5'), { name: 'TypeError', message: /"0.5" is not a finite number/ });
for (const one of about.params)
{
    assert (one.hard_min === null || one.min === null || one.hard_min <= one.min);
    assert (one.hard_max === null || one.max === null || one.hard_max >= one.max);
    assert.throws (() => graph.set (one.name, 'abc'), TypeError);
    assert.throws (() => graph.set (one.name, Infinity), RangeError);
    for (const [value, most] of [[1e300, one.hard_max], [-1e300, one.hard_min]])
    {
        if (most === null) continue;
        graph.set (one.name, value);
        assert.strictEqual (graph.get (one.name), most);
    }
}
assert (about.params.some (one => one.hard_max !== one.max));
assert.throws (() => graph.strike (about.hits[0]?.name ?? 'none', NaN),
               about.hits.length > 0 ? /NaN is not a finite number/ : /there is no hit "none"; there are none$/);

// A module of another export.
const other = new Uint8Array (readFileSync (join (folder, `${name}.wasm`)));
const { Graph } = await import (at ('tactus_graph.js'));
assert.throws (() => new Graph (new WebAssembly.Module (other), { ...about, digest: about.digest + 1 }), /is from another export/);

// Files that are not there.
await assert.rejects (Type.load ('nowhere.wasm'), /"nowhere.wasm" is not a URL; in Node.js, give a file: URL, such as new URL/);
await assert.rejects (Type.load (at ('nowhere.wasm')), /ENOENT.*nowhere\.wasm/);
console.log ('ok');
