// SPDX-License-Identifier: MIT
// node reports_test.mjs SITE: the reports of the playground are those that the samples of the profiles demand.
import assert from 'node:assert';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const site = process.argv[2];
const load = name => import (pathToFileURL (`${site}/${name}`));
const { bytesOf, decode, encode, limitsOf, neutral } = await load ('reports.js'), { si } = await load ('quantity.js');

const near = (a, b) => Math.abs (a - b) <= 1e-9 * Math.max (1, Math.abs (a), Math.abs (b));
assert (near (si ('40 cm'), 0.4) && near (si ('0.05 N*m'), 0.05) && near (si ('20 deg/s'), 0.3490658503988659) && near (si ('9 m/s2'), 9) && near (si ('1 uN'), 1e-6));
assert (near (si ('6300 1/s'), 6300) && near (si ('1e-6 rad'), 1e-6) && near (si ('50 g'), 0.05) && near (si ('5 N*s/m'), 5) && si (2) === 2);
assert.throws (() => si ('3 furlong'), /unknown unit/);

let compared = 0;
for (const profile of JSON.parse (readFileSync (`${site}/profiles.json`, 'utf8')).profiles)
{
    const vectors = { position: profile.position, rotation: profile.rotation, force: profile.force, torque: profile.torque };
    const fieldOf = name => {
        const [vector, axis] = name.split ('.');
        return axis === undefined ? name : vectors[vector]['xyz'.indexOf (axis)];
    };
    for (const sample of profile.samples)
    {
        const values = sample.input ? decode (profile, bytesOf (sample.input.at (-1))) : {};
        for (const [name, value] of Object.entries (sample.gives ?? {}))
        {
            if (['time', 'lost'].includes (name)) continue;   // of several reports
            assert (near (values[fieldOf (name)], si (value)), `${profile.id}, ${sample.about}: ${name} is ${values[fieldOf (name)]}`);
            ++compared;
        }
        if (! sample.report) continue;
        const asked = Object.fromEntries (Object.entries (sample.asked).map (([name, value]) => [fieldOf (name), si (value)]));
        const output = profile.outputs.find (one => one.name === sample.output);
        assert.deepEqual (encode (profile, output, asked, values.sequence), bytesOf (sample.report), `${profile.id}, ${sample.about}`);
        ++compared;
    }
    assert.equal (decode (profile, new Uint8Array (64)), undefined);
    assert.equal (decode (profile, new Uint8Array (3)), undefined);
    assert (Object.values (limitsOf (profile, ['max_force', 'max_signal', 'watchdog'])).every (value => value > 0));
    const rest = neutral (profile.outputs[0]);
    for (const field of profile.outputs[0].fields)
        if (field.source === 'enable') assert.equal (rest[field.at] & 1, 0);
}
assert (compared > 20);
console.log (`${compared} values compared, 0 differ`);
