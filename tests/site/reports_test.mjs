// SPDX-License-Identifier: MIT
// node reports_test.mjs SITE: the module reports.wasm gives what the samples of the profiles demand, refuses what a page cannot drive, and survives noise.
import assert from 'node:assert';
import { readdirSync, readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const site = process.argv[2], { Reports } = await import (pathToFileURL (`${site}/reports.js`));
const module = new WebAssembly.Module (readFileSync (`${site}/reports.wasm`));
// No module of a page can open or calm a device, nor outlive its page: it imports nothing.
for (const name of ['reports.wasm', ...readdirSync (`${site}/graphs`).filter (one => one.endsWith ('.wasm')).map (one => `graphs/${one}`)])
    assert.deepEqual (WebAssembly.Module.imports (new WebAssembly.Module (readFileSync (`${site}/${name}`))), [], name);

const near = (a, b) => Math.abs (a - b) <= 1e-9 * Math.max (1, Math.abs (a), Math.abs (b));
const bytesOf = text => Uint8Array.from (text.split (' ').flatMap (part => {
    const [byte, times = 1] = part.split ('*');
    return Array (Number (times)).fill (parseInt (byte, 16));
}));
/** A report of a profile as WebHID gives it. */
function take (reports, bytes, has_id, at_ms = 1, driven_s = 0)
{
    const body = has_id ? bytes.slice (1) : bytes;
    return reports.take (has_id ? bytes[0] : 0, new DataView (body.buffer, body.byteOffset, body.length), at_ms, driven_s);
}

let compared = 0;
const profiles = JSON.parse (readFileSync (`${site}/profiles.json`, 'utf8')).profiles;
for (const profile of profiles)
{
    const has_id = profile.inputs.some (one => one.id !== undefined);
    for (const sample of profile.samples)
    {
        const reports = await Reports.open (module, profile);
        assert.equal (reports.about.why_not, '');
        let reading, at_ms = 0;
        for (const one of sample.input ?? [])
            reading = take (reports, bytesOf (one), has_id, ++at_ms);
        for (const [name, value] of Object.entries (sample.gives ?? {}))
        {
            if (['time', 'lost'].includes (name) || typeof value !== 'number') continue;   // units are for the native test, which has the same reader
            const [vector, axis] = name.split ('.'), given = axis ? reading[vector]['xyz'.indexOf (axis)] : reading[name] ?? reading.axes[name];
            assert (near (given, value), `${profile.id}, ${sample.about}: ${name} is ${given}`);
            ++compared;
        }
        if (sample.pressed)
        {
            assert.deepEqual (reports.about.buttons.filter ((_, i) => reading.buttons >> i & 1).sort(), [...sample.pressed].sort());
            ++compared;
        }
        if (! sample.report || ! profile.force) continue;
        const asked = sample.asked, vector = name => ['x', 'y', 'z'].map (axis => asked[`${name}.${axis}`] ?? 0);
        const report = reports.drive ({ force: vector ('force'), torque: vector ('torque') }, 0, 1, 0), wanted = [0, ...bytesOf (sample.report)];
        assert.equal (report.length, 65);
        for (let i = 0; i < 65; ++i)
            if ((i < 33 || i > 48) && i < 61)   // not the efforts of its own axes, which a page does not drive, and the checksum over them
            {
                assert.equal (report[i], wanted[i], `${profile.id}, ${sample.about}: byte ${i}`);
                ++compared;
            }
    }
}
assert (compared > 60, `${compared}`);

// The neutral report lets the motors go, and efforts that are not numbers are none.
const [board] = profiles.filter (one => one.id === 'tactus_board'), open = changed => Reports.open (module, { ...board, ...changed });
const reports = await open ({});
assert.equal (reports.rest()[3] & 1, 0);
assert.equal (reports.drive ({ force: [0, 0, 1], torque: [0, 0, 0] }, 0, 0.02, 0)[3] & 1, 1);
for (const wrong of [NaN, Infinity, -Infinity])
{
    reports.rest();
    assert.deepEqual ([...reports.drive ({ force: [wrong, 0, 0], torque: [0, 0, 0] }, wrong, 0.02, 0).slice (9, 61)], Array (52).fill (0));
}
assert.equal (reports.about.limits.max_force, 2);
assert.equal (reports.about.limits.watchdog, 0.02);
assert.equal (reports.about.device_watchdog, 0.02);

// A device that a page cannot drive is refused, with the reason.
await assert.rejects (open ({ limits: {} }), /tactus_board cannot be used/);
await assert.rejects (open ({ inputs: [] }), /cannot be used/);
for (const [changed, why] of [[{ init: [{ bytes: '00 01' }] }, /set up/], [{ quirks: ['only_changes'] }, /only changes/],
                              [{ outputs: [{ ...board.outputs[0], kind: 'feature' }] }, /feature/]])
{
    const { about } = await open (changed).catch (error => ({ about: { why_not: error.message } }));
    assert.match (about.why_not, why);
}

// Noise never makes a valid reading of a refused report, nor a number that is none.
let state = 1;
const random = () => (state = (Math.imul (state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
let accepted = 0;
for (let i = 0; i < 20000; ++i)
{
    const bytes = Uint8Array.from ({ length: random() < 0.8 ? 64 : Math.floor (70 * random()) }, () => Math.floor (256 * random()));
    if (random() < 0.8) [0x54, 1].forEach ((byte, at) => { bytes[at] = byte; });
    const reading = take (reports, bytes, false, 10 + i, random());
    const is_good = bytes.length >= 64 && bytes[0] === 0x54 && bytes[1] === 1;
    assert (! reading.valid || is_good);
    assert ([...reading.position, ...reading.rotation, reading.pressure, reading.age].every (Number.isFinite));
    accepted += is_good ? 1 : 0;
}
assert (accepted > 10000);
// The names of stops that are written a second time, in JavaScript, are those of the guard: all of them in their order, those that latch, and words for each.
const textOf = path => readFileSync (new URL (`../../${path}`, import.meta.url), 'utf8');
const quoted = (text, begin) => [...text.split (begin)[1].split (']')[0].matchAll (/'(\w+)'/g)].map (([, name]) => name);
const guard = textOf ('framework/run/guard.hpp'), [, listed] = /enum class Stop : std::uint32_t\s*\{([^}]*)\}/.exec (guard);
const stops = listed.split (',').map (name => name.trim()), first_latching = /latches \(Stop stop\) noexcept \{ return stop >= Stop::(\w+);/.exec (guard)[1];
assert.deepEqual (quoted (textOf ('host/code/generate/targets/tactus_graph.js'), 'const stops = ['), stops);
assert.deepEqual (quoted (textOf ('docs/site/playground/engine.js'), 'const latching = ['), stops.slice (stops.indexOf (first_latching)));
assert.equal (/const longest_silence_s = [\d.]+, fade_s = ([\d.]+)/.exec (textOf ('docs/site/playground/engine.js'))[1],
              /double fade_s = ([\d.]+);/.exec (guard)[1]);
const worded = [...textOf ('docs/site/playground/playground.js').split ('const words = {')[1].split ('}')[0].matchAll (/(\w+): '/g)].map (([, name]) => name);
assert.deepEqual (worded.filter (name => name !== 'limit').sort(), [...stops].sort());

console.log (`${compared} values compared, 0 differ; 20000 reports of noise do no harm`);
