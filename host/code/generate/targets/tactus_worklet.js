// SPDX-License-Identifier: MIT
// Ticks a graph in time with the sound, on the audio thread of a browser. The page sends where the tool is, and is told how strong the effort is.

const glide_s = 0.016;   // pages hear of a pointer 60 times a second; in between, the tool moves steadily
const told_s = 0.05;     // how often the page is told
const lowest_hz = 20;    // slower changes of the force are no sound

/** Registers the processor `name`, for `new AudioWorkletNode (context, name, { processorOptions: { module, gain, role, sound } })`.
 *  module: the compiled graph. gain: of the sound, per N; default 1. role: the member of inputs and outputs that the page moves; default: the first.
 *  sound: the member of outputs that is played, such as a recorded port; default: the sum of the components of the force of the role.
 *
 *  The page posts { position: [x, y, z] } in m, { rotation: [x, y, z] } in rad, { turn: { control: position } }, { set: { param: value } } or { stop: true }.
 *  It is sent { level, force }: the root of the mean square of the sound in N, and the force, after the guard. */
export function register (name, Graph)
{
    registerProcessor (name, class extends AudioWorkletProcessor
    {
        constructor ({ processorOptions: how })
        {
            super();
            this.graph = new Graph (how.module);
            const role = how.role ?? this.graph.about.roles[0]?.member;
            this.reading = this.graph.inputs[role];
            this.effort = this.graph.outputs[role];
            this.record = how.sound;
            this.gain = how.gain ?? 1;
            const rate = this.graph.about.rate_hz;
            this.keeps = Math.exp (-2 * Math.PI * lowest_hz / rate);
            this.glide = Math.max (1, Math.round (glide_s * rate));
            this.told = Math.max (1, Math.round (told_s * rate));
            this.targets = {};   // by member of the reading: where it goes, and in how many ticks it is there
            this.placed = {};    // the members that have been there before: the first time, the tool does not fly in from the origin
            this.due = this.ticks = this.before = this.sound = this.squares = 0;
            this.port.onmessage = ({ data }) => this.take (data);
        }

        take (data)
        {
            for (const part of ['position', 'rotation'])
                if (data[part] && this.reading)
                {
                    this.targets[part] = { to: data[part], left: this.placed[part] ? this.glide : 1 };
                    this.placed[part] = true;
                }
            for (const [control, position] of Object.entries (data.turn ?? {}))
                this.graph.turn (control, position);
            for (const [param, value] of Object.entries (data.set ?? {}))
                this.graph.set (param, value);
            if (data.stop) this.graph.emergencyStop();
        }

        tick()
        {
            for (const [part, target] of Object.entries (this.targets))
            {
                for (let i = 0; i < 3; ++i)
                    this.reading[part][i] += (target.to[i] - this.reading[part][i]) / target.left;
                if (--target.left === 0) delete this.targets[part];
            }
            this.graph.tick();
            const f = this.effort?.force, now = this.record ? this.graph.outputs[this.record] : f ? f[0] + f[1] + f[2] : 0;
            this.sound = now - this.before + this.keeps * this.sound;
            this.before = now;
            this.squares += this.sound * this.sound;
            if (++this.ticks % this.told !== 0) return;
            this.port.postMessage ({ level: Math.sqrt (this.squares / this.told), force: f ? Array.from (f) : [] });
            this.squares = 0;
        }

        process (_, [channels])
        {
            const [first, ...others] = channels, step = this.graph.about.rate_hz / sampleRate;
            for (let i = 0; i < first.length; ++i)
            {
                for (this.due += step; this.due >= 1; --this.due)
                    this.tick();
                first[i] = this.gain * this.sound;
            }
            for (const other of others)
                other.set (first);
            return true;
        }
    });
}
