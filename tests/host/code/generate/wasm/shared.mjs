// SPDX-License-Identifier: MIT
// Functions that the tests in Node.js and in a browser share.

/** Moves all roles of an exported graph as a trace says, and gives what it records as lines of CSV, as `tactus render` does. */
export function render (graph, trace, sets)
{
    const { about } = graph, efforts = () => about.roles.flatMap (role => [...graph.outputs[role.member].force]);
    for (const set of sets)
    {
        const [name, value] = set.split ('=');
        if (about.controls.some (control => control.name === name)) graph.turn (name, Number (value));
        else graph.set (name, Number (value));
    }
    const lines = [['t', ...about.records.map (record => record.name)].join (',')];
    let largest = 0;
    for (const line of trace.trim().split ('\n').slice (1))
    {
        const [t, ...position] = line.split (',').map (Number);
        for (const role of about.roles)
            graph.inputs[role.member].position.set (position);
        graph.tick();
        lines.push ([t, ...about.records.map (record => graph.outputs[record.member])].join (','));
        largest = Math.max (largest, ...efforts().map (Math.abs));
    }
    if (! (largest > 0)) throw new Error ('no force was felt');
    return lines;
}

export const blocks = 400, size = 128, sample_rate = 48000, gain = 0.5;   // of the sound

/** Where the page says that the tool is before this block of samples; undefined: nothing. */
export const positionAt = block =>
    block % 6 === 0 ? [1e-3 * Math.sin (block / 42), 2e-4 * block / 6, 5e-4 - 5e-6 * block] : undefined;

/** What the AudioWorklet plays then, computed tick by tick apart from it. */
export function soundOf (graph)
{
    const rate = graph.about.rate_hz, role = graph.about.roles[0].member, glide = Math.round (0.016 * rate), keeps = Math.exp (-2 * Math.PI * 20 / rate);
    const samples = new Float32Array (blocks * size);
    let due = 0, before = 0, sound = 0, left = 0, target, pressed = 0;
    for (let i = 0; i < samples.length; ++i)
    {
        if (i % size === 0 && positionAt (i / size) !== undefined)
        {
            target = positionAt (i / size);
            left = i === 0 ? 1 : glide;
        }
        for (due += rate / sample_rate; due >= 1; --due)
        {
            const at = graph.inputs[role].position;
            for (let k = 0; k < 3 && left > 0; ++k)
                at[k] = left === 1 ? target[k] : at[k] + (target[k] - at[k]) / left;
            left = Math.max (0, left - 1);
            graph.tick();
            const f = graph.outputs[role].force, now = f[0] + f[1] + f[2];
            sound = now - before + keeps * sound;
            before = now;
            pressed += now !== 0 ? 1 : 0;
        }
        samples[i] = gain * sound;
    }
    if (pressed < 100) throw new Error ('the tool does not press');
    return samples;
}
