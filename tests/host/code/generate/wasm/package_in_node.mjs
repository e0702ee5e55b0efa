// SPDX-License-Identifier: MIT
// An exported folder as a package, in node: package_in_node.mjs FOLDER. Imports it by its name, loads its module from a file, and runs its AudioWorklet with
// stand-ins for the classes of a browser. Prints "ok", or throws.
import assert from 'node:assert';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

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
    globalThis.sampleRate = 48000;
    globalThis.AudioWorkletProcessor = class { port = { postMessage: message => said.push (message) }; };
    globalThis.registerProcessor = (name, type) => { registered[name] = type; };
    await import (worklet);
    const processor = new registered[about.name] ({ processorOptions: { module: await compile (wasm), gain: 0.5 } });
    const rate = loaded.about.rate_hz, role = loaded.about.roles[0].member, path = k => [1e-3 * Math.sin (k / 7), 2e-4 * k, 5e-4 - 3e-5 * k];

    // The same motion tick by tick, and its sound.
    const glide = Math.round (0.016 * rate), keeps = Math.exp (-2 * Math.PI * 20 / rate);
    let due = 0, before = 0, sound = 0, left = 0, target = null, ticks = 0, pressed = 0;
    const tick = () =>
    {
        const at = loaded.inputs[role].position;
        if (left > 0)
        {
            for (let i = 0; i < 3; ++i)
                at[i] += (target[i] - at[i]) / left;
            --left;
        }
        loaded.tick();
        const f = loaded.outputs[role].force, now = f[0] + f[1] + f[2];
        sound = now - before + keeps * sound;
        before = now;
        ++ticks;
        pressed += now !== 0 ? 1 : 0;
    };
    const stereo = [new Float32Array (128), new Float32Array (128)];
    for (let block = 0; block < 400; ++block)
    {
        if (block % 6 === 0)
        {
            target = path (block / 6);
            left = block === 0 ? 1 : glide;
            processor.port.onmessage ({ data: { position: target } });
        }
        assert.strictEqual (processor.process ([], [stereo]), true);
        for (let i = 0; i < 128; ++i)
        {
            for (due += rate / 48000; due >= 1; --due)
                tick();
            assert.strictEqual (stereo[0][i], Math.fround (0.5 * sound));
            assert.strictEqual (stereo[1][i], stereo[0][i]);
        }
    }
    assert.ok (pressed > 100 && Math.abs (ticks - 400 * 128 * rate / 48000) <= 1);
    assert.strictEqual (said.length, Math.floor (ticks / Math.round (0.05 * rate)));
    assert.ok (said.some (one => one.level > 0) && said.at (-1).force.length === 3);

    processor.port.onmessage ({ data: { stop: true } });
    for (let block = 0; block < 20; ++block)
        processor.process ([], [stereo]);
    assert.deepStrictEqual (Array.from (processor.effort.force).map (Math.abs), [0, 0, 0]);
    console.log ('ok');
}
finally
{
    rmSync (project, { recursive: true });
}
