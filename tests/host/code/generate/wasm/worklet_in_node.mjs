// SPDX-License-Identifier: MIT
// The AudioWorklet of an exported folder, in node, as hands use it: worklet_in_node.mjs FOLDER Z…, with the height at which each tool is pressed, in m.
// Prints "ok", or throws.
import assert from 'node:assert';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const folder = resolve (process.argv[2]), pressed = process.argv.slice (3).map (Number);
const { name } = JSON.parse (readFileSync (join (folder, 'package.json'), 'utf8')), at = file => pathToFileURL (join (folder, file));
const { about } = await import (at (`${name}.js`)), module = new WebAssembly.Module (readFileSync (join (folder, `${name}.wasm`)));
const sample_rate = 44100, size = 128, frame = 0.016, blocks_per_frame = Math.round (frame * sample_rate / size), up = 2e-4;

let Processor;
globalThis.sampleRate = sample_rate;
globalThis.AudioWorkletProcessor = class { said = []; port = { postMessage: message => this.said.push (message) }; };
globalThis.registerProcessor = (_, Type) => { Processor = Type; };
await import (at (`${name}_worklet.js`));

/** A page with its worklet. */
class Page
{
    constructor (options = {})
    {
        this.processor = new Processor ({ processorOptions: { module, ...options } });
        this.said = this.processor.said;
    }

    post (data) { this.processor.port.onmessage ({ data }); }

    /** The loudest sample in this time. */
    wait (seconds)
    {
        const channel = new Float32Array (size);
        let most = 0;
        for (let block = 0; block < Math.ceil (seconds * sample_rate / size); ++block)
        {
            this.processor.process ([], [[channel]]);
            most = Math.max (most, ...channel.map (Math.abs));
            assert (! Number.isNaN (channel[0]));
        }
        return most;
    }

    /** A stroke of half a second, with a position for each frame. Returns the loudest sample. */
    stroke ([x, y], z, role)
    {
        let most = 0;
        for (let k = 0; k < 0.5 / frame; ++k)
        {
            this.post ({ position: [x + 1e-3 * Math.sin (k / 3), y + 5e-4 * Math.sin (k / 5), z], role });
            most = Math.max (most, this.wait (frame));
        }
        return most;
    }

    get last() { return this.said.findLast (one => one.stop !== undefined); }

    isFree()
    {
        this.wait (0.06);
        assert.deepStrictEqual ([this.last.stop, this.last.latched], ['none', false]);
    }
}

const force = page => Math.hypot (...page.last.force), z = pressed[0];
const middle = [0.06, -0.04], elsewhere = [-0.05, 0.03];   // as the page has it, with 0.1 mm for each pixel

// It waits for the first place, wherever that is.
{
    const page = new Page();
    assert.strictEqual (page.wait (1), 0);
    assert.strictEqual (page.said.length, 0);
    page.post ({ position: [...middle, up] });
    page.isFree();
    assert (page.stroke (middle, z) > 0);
    page.isFree();
    assert (force (page) > 0);
}

// A leap is no speed, whether the page says that it is one or not. Where it does, the force fades before.
for (const jump of [true, false])
{
    const page = new Page();
    page.post ({ position: [...middle, z] });
    page.wait (0.2);
    assert (force (page) > 0);
    page.post ({ position: [...elsewhere, jump ? up : z], jump });
    const { first, graph } = page.processor, { tick } = graph, ticks = [];
    graph.tick = () =>
    {
        const was_held = first.effort.force.some (value => value !== 0);
        tick();
        ticks.push ({ x: first.reading.position[0], was_held });
    };
    page.wait (0.2);
    graph.tick = tick;
    const moved = ticks.findIndex (({ x }) => x !== middle[0]), there = ticks.findIndex (({ x }) => Math.abs (x - elsewhere[0]) < 1e-9);
    if (jump) assert (moved === there && ! ticks[moved].was_held);
    else assert (there - moved > 0.05 * about.rate_hz);   // 0.13 m, at less than 2 m/s
    page.wait (0.2);
    page.isFree();
    assert (Math.abs (page.processor.first.reading.position[0] - elsewhere[0]) < 1e-9);
    assert (page.stroke (elsewhere, z) > 0);
    page.isFree();
    assert (force (page) > 0);
}

// Presses everywhere, and a pointer that is thrown about.
{
    const page = new Page();
    for (let k = 0; k < 60; ++k)
    {
        const [x, y] = [0.06 * Math.sin (13 * k), 0.04 * Math.sin (7 * k)];
        if (k % 3 === 0) page.post ({ position: [x, y, up], jump: true });
        page.post ({ position: [x, y, k % 3 === 1 ? up : z] });
        page.wait (frame * (1 + k % 4));
        assert (! page.last?.latched);
    }
}

// A person ends a stop, and the page knows of it.
{
    const page = new Page();
    page.post ({ position: [...middle, z] });
    page.wait (0.2);
    page.post ({ stop: true, position: [NaN, 0, 0] });
    page.wait (0.2);
    assert.deepStrictEqual ([page.last.stop, page.last.latched, force (page)], ['emergency', true, 0]);
    page.post ({ position: [...elsewhere, up], jump: true });
    page.post ({ position: [...elsewhere, z] });
    page.wait (0.5);
    assert.deepStrictEqual ([page.last.latched, force (page)], [true, 0]);   // a leap ends no stop
    page.post ({ rearm: true });
    page.wait (0.5);
    page.isFree();
    assert (force (page) > 0);
}

// A message without a place or a name changes nothing.
{
    const page = new Page();
    page.post ({ position: [...middle, z] });
    page.wait (0.2);
    const before = force (page), bad = [[{ position: [NaN, 0, 0] }, /position: \[NaN, 0, 0\]: NaN is not a finite number/],
                                        [{ position: [0, 0] }, /three/],
                                        [{ position: 7 }, /three/], [{ rotation: ['a', 0, 0] }, /"a" is not a finite number/],
                                        [{ position: [0, 0, 0], role: 'pen' }, /there is no role "pen"; there are: /],
                                        [{ turn: { none: 1 } }, /no control "none"/], [{ set: { none: 1 } }, /no parameter "none"/],
                                        [{ strike: { none: 1 } }, /there is no hit "none"; there are/],
                                        [{ positon: [0, 0, 0] }, /no message "positon"; there are: position/]];
    for (const [message, why] of bad)
    {
        page.said.length = 0;
        page.post (message);
        assert.match (page.said[0].refused, why);
        assert.strictEqual (page.said.length, 1);
    }
    page.wait (0.2);
    page.isFree();
    assert (before > 0 && Math.abs (force (page) - before) < 1e-3 * before);
}

for (const [options, why] of [[{ role: 'pen' }, /there is no role "pen"; there are: /], [{ sound: 'none' }, /there is no recorded port "none"; there are: /],
                              [{ gain: 'loud' }, /processorOptions.gain: "loud" is not a finite number/],
                              [{ module: undefined }, /processorOptions.module is missing/]])
    assert.throws (() => new Page (options), why);
for (const sound of [about.records[0].name, about.records[0].member])
{
    const page = new Page ({ sound });
    page.post ({ position: [...middle, z] });
    page.wait (0.1);
    page.post ({ position: [...elsewhere, up], jump: true });
    page.post ({ position: [...elsewhere, z] });
    assert (Number.isFinite (page.stroke (elsewhere, z)));
}

// Each tool is moved by itself, and is not there before it has a place.
{
    const page = new Page();
    about.roles.forEach ((role, i) =>
    {
        assert.strictEqual (page.processor.graph.inputs[role.member].valid, false);
        page.post ({ position: [...middle, pressed[i]], role: role.name });
        page.wait (0.2);
        page.isFree();
        assert (page.processor.graph.outputs[role.member].force.some (value => value !== 0), role.name);
    });
}

// Once it has ended, the browser may forget it.
{
    const { processor } = new Page(), go = () => processor.process ([], [[new Float32Array (size)]]);
    assert.strictEqual (go(), true);
    processor.port.onmessage ({ data: { end: true } });
    assert.strictEqual (go(), false);
}
console.log ('ok');
