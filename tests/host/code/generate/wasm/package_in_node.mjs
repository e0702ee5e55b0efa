// SPDX-License-Identifier: MIT
// An exported folder as a package, in node: package_in_node.mjs FOLDER. Imports it by its name, loads its module from a file, and runs its AudioWorklet with
// stand-ins for the classes of a browser. Prints "ok", or throws.
import assert from 'node:assert';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { blocks, gain, positionAt, sample_rate, size, soundOf } from './shared.mjs';

const folder = resolve (process.argv[2]), about = JSON.parse (readFileSync (join (folder, 'package.json'), 'utf8'));
const project = mkdtempSync (join (tmpdir(), 'package-'));
try
{
    mkdirSync (join (project, 'node_modules'));
    symlinkSync (folder, join (project, 'node_modules', about.name));
    for (const file of about.files)
        readFileSync (join (folder, file));   // it is there
    writeFileSync (join (project, 'main.mjs'), `
export * as graph from '${about.name}';
export { compile } from '${about.name}/tactus_graph.js';
export const wasm = import.meta.resolve ('${about.name}/${about.name}.wasm'), worklet = import.meta.resolve ('${about.name}/worklet');
`);
    const { graph, compile, wasm, worklet } = await import (pathToFileURL (join (project, 'main.mjs')));
    const Type = Object.values (graph).find (one => typeof one === 'function');
    const loaded = await Type.load();   // from a file
    assert.strictEqual (loaded.about.name, about.name);

    const said = [], registered = {};
    globalThis.sampleRate = sample_rate;
    globalThis.AudioWorkletProcessor = class { port = { postMessage: message => said.push (message) }; };
    globalThis.registerProcessor = (name, type) => { registered[name] = type; };
    await import (worklet);
    const processor = new registered[about.name] ({ processorOptions: { module: await compile (wasm), gain } });
    const { samples, ticks } = soundOf (loaded), rate = loaded.about.rate_hz, stereo = [new Float32Array (size), new Float32Array (size)];
    for (let block = 0; block < blocks; ++block)
    {
        const position = positionAt (block);
        if (position !== undefined) processor.port.onmessage ({ data: { position } });
        assert.strictEqual (processor.process ([], [stereo]), true);
        for (const channel of stereo)
            assert.deepStrictEqual (channel, samples.slice (block * size, (block + 1) * size));
    }
    assert.ok (Math.abs (ticks - blocks * size * rate / sample_rate) <= 1);
    assert.strictEqual (said.length, Math.floor (ticks / Math.round (0.05 * rate)));
    assert.ok (said.some (one => one.level > 0) && said.at (-1).force.length === 3);

    processor.port.onmessage ({ data: { stop: true } });
    for (let block = 0; block < 20; ++block)
        processor.process ([], [stereo]);
    assert.deepStrictEqual (Array.from (processor.first.effort.force).map (Math.abs), [0, 0, 0]);
    console.log ('ok');
}
finally
{
    rmSync (project, { recursive: true });
}
