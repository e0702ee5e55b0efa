// SPDX-License-Identifier: MIT
// An exported folder as a package, in node: package_in_node.mjs FOLDER. Imports it by its name, loads its module from a file, and makes the mistakes of a
// program, which must be named, not ignored. Prints "ok", or throws.
import assert from 'node:assert';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const folder = resolve (process.argv[2]), { name, files } = JSON.parse (readFileSync (join (folder, 'package.json'), 'utf8'));
const project = mkdtempSync (join (tmpdir(), 'package-')), main = join (project, 'main.mjs');
for (const file of files)
    readFileSync (join (folder, file));   // it is there
mkdirSync (join (project, 'node_modules'));
symlinkSync (folder, join (project, 'node_modules', name));
writeFileSync (main, `
export * as exported from '${name}';
export { compile, Graph } from '${name}/tactus_graph.js';
export const addresses = ['${name}/${name}.wasm', '${name}/worklet'].map (one => import.meta.resolve (one));
`);
const { exported, compile, Graph, addresses } = await import (pathToFileURL (main)).finally (() => rmSync (project, { recursive: true }));
assert.deepStrictEqual (addresses.map (one => readFileSync (new URL (one)).length > 1000), [true, true]);
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
const module = await compile (pathToFileURL (join (folder, `${name}.wasm`)));
assert.throws (() => new Graph (module, { ...about, digest: about.digest + 1 }), /is from another export/);

// Files that are not there.
await assert.rejects (Type.load ('nowhere.wasm'), /"nowhere.wasm" is not a URL; in Node.js, give a file: URL, such as new URL/);
await assert.rejects (Type.load (pathToFileURL (join (folder, 'nowhere.wasm'))), /ENOENT.*nowhere\.wasm/);
console.log ('ok');
