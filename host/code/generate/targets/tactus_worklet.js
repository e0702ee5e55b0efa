// SPDX-License-Identifier: MIT
// Ticks a graph in time with the sound, on the audio thread of a browser. The page sends where the tools are, and is told how strong the effort is.
import { checkNumber, checkPlace, indexOf } from './tactus_graph.js';

const glide_s = 0.016;    // pages hear of a pointer 60 times a second; in between, the tool moves steadily
const told_s = 0.05;      // how often the page is told
const settle_s = 0.02;    // after a leap: what the graph makes of it dies away before there is an effort again
const lowest_hz = 20;     // slower changes of the force are no sound
const most_speed = 0.9;   // of the speed at which the guard stops
const messages = ['position', 'rotation', 'jump', 'role', 'turn', 'set', 'strike', 'stop', 'rearm', 'end'].map (name => ({ name }));

/** A tool that the page moves. Its role has no valid reading until the page has said where it is. */
class Tool
{
    constructor (graph, role)
    {
        const rate = graph.about.rate_hz, { max_speed, max_angular_speed } = graph.limitsOf (role.name);
        this.name = role.name;
        this.reading = graph.inputs[role.member];
        this.effort = graph.outputs[role.member];
        this.glide = Math.max (1, Math.round (glide_s * rate));
        this.settle = Math.max (1, Math.round (settle_s * rate));
        this.most = { position: most_speed * max_speed / rate, rotation: most_speed * max_angular_speed / rate };   // in a tick
        this.lines = {};              // by member of the reading: where it goes, and in how many ticks it is there
        this.leap = null;             // the members that change without a way between, once there is no effort
        this.rested = this.left = 0;  // ticks without effort before a leap; ticks until there is an effort after it
        this.is_placed = this.reading.valid = false;
    }

    get isLeaping() { return this.leap !== null || this.left > 0; }

    /** Begins a leap: the guard must see no reading while the effort fades, so that the way to the new place is no speed. */
    lift (where)
    {
        this.leap = { ...this.leap, ...where };
        this.lines = {};
        this.rested = 0;
    }

    put (where)
    {
        Object.assign (this.reading, where);
        this.is_placed ||= where.position !== undefined;
        this.reading.valid = this.is_placed;
    }

    glideTo (where)
    {
        for (const [part, to] of Object.entries (where))
            this.lines[part] = { to };
    }

    ticksFor (part, to)
    {
        const way = Math.hypot (...to.map ((value, i) => value - this.reading[part][i])), ticks = Math.ceil (way / this.most[part]);
        return ticks > this.glide ? ticks : this.glide;   // not a number if neither the way nor the speed is finite
    }

    /** Moves the tool by one tick: 16 ms for each line, or more if the guard would take that for a fault. */
    move()
    {
        if (this.leap !== null) this.reading.valid = false;
        if (this.isLeaping) return;
        for (const [part, line] of Object.entries (this.lines))
        {
            const at = this.reading[part];
            line.left ??= this.ticksFor (part, line.to);
            for (let i = 0; i < 3; ++i)
                at[i] = line.left === 1 ? line.to[i] : at[i] + (line.to[i] - at[i]) / line.left;
            if (--line.left === 0) delete this.lines[part];
        }
    }

    /** After each tick. */
    land()
    {
        if (this.leap === null)
        {
            this.left = Math.max (0, this.left - 1);
            return;
        }
        const { force, torque, axes, signals, brake = 0 } = this.effort, is_held = brake === this.brake;
        this.brake = brake;
        this.rested = is_held && [force, torque, axes, signals].every (all => all.every (value => value === 0)) ? this.rested + 1 : 0;
        if (this.rested < 2) return;   // the guard forgets the old place on the second of them
        this.put (this.leap);
        this.leap = null;
        this.left = this.settle;
    }
}

/** Registers the processor `name`, for `new AudioWorkletNode (context, name, { processorOptions: { module, gain, role, sound } })`.
 *  module: the compiled graph. gain: of the sound, per N; default 1. role: the role that the page moves and hears; default: the first.
 *  sound: the recorded port that is played; default: the sum of the components of the force of the role.
 *
 *  tactus_worklet.d.ts has the messages to the processor and those that it sends. */
export function register (name, Graph)
{
    registerProcessor (name, class extends AudioWorkletProcessor
    {
        constructor ({ processorOptions: how })
        {
            super();
            if (! how?.module) throw new TypeError (`processorOptions.module is missing: compile ('${name}.wasm') gives it`);
            checkNumber (how.gain ?? 1, 'processorOptions.gain', 'give the gain of the sound, per N');
            this.graph = new Graph (how.module);
            const { rate_hz, roles, records } = this.graph.about;
            this.tools = roles.map (role => new Tool (this.graph, role));
            this.first = how.role === undefined ? this.tools[0] : this.toolOf (how.role);
            this.record = how.sound === undefined ? null : this.memberOf (records.filter (one => one.count === undefined), how.sound, 'recorded port');
            this.gain = how.gain ?? 1;
            this.keeps = Math.exp (-2 * Math.PI * lowest_hz / rate_hz);
            this.told = Math.max (1, Math.round (told_s * rate_hz));
            this.due = this.ticks = this.before = this.sound = this.squares = 0;
            this.has_ended = false;
            this.port.onmessage = ({ data }) => this.take (data);
        }

        /** The member of outputs with this name; its name in the graph is as good. */
        memberOf (list, which, kind)
        {
            const member = list.find (one => one.member === which) ?? list[indexOf (list, which, kind)];
            return member.member;
        }

        toolOf (role)
        {
            const { roles } = this.graph.about, member = this.memberOf (roles, role, 'role');
            return this.tools[roles.findIndex (one => one.member === member)];
        }

        /** Whether there is something to tick: a graph without its tool would take the first position for a leap from the origin. */
        get hasBegun() { return this.tools.length === 0 || this.tools.some (tool => tool.is_placed); }

        /** A part of a message that cannot be taken changes nothing, and the page is told why. */
        attempt (act)
        {
            try { act(); }
            catch (why) { this.port.postMessage ({ refused: why.message }); }
        }

        take (data)
        {
            const each = (all, act) => Object.entries (all ?? {}).forEach (one => this.attempt (() => act (...one)));
            if (data?.stop) this.graph.emergencyStop();
            if (data?.rearm) this.graph.rearm();
            this.has_ended ||= Boolean (data?.end);
            each (data, part => indexOf (messages, part, 'message'));
            this.attempt (() => this.place (data ?? {}));
            each (data?.turn, (control, position) => this.graph.turn (control, position));
            each (data?.set, (param, value) => this.graph.set (param, value));
            each (data?.strike, (hit, speed) => this.graph.strike (hit, speed));
        }

        place (data)
        {
            const where = {};
            for (const part of ['position', 'rotation'])
                if (data[part] !== undefined)
                {
                    checkPlace (data[part], part);
                    where[part] = [...data[part]];
                }
            if (Object.keys (where).length === 0) return;
            const tool = data.role === undefined ? this.first : this.toolOf (data.role);
            if (tool === undefined) throw new RangeError ('the graph has no tool to move');
            if (! this.hasBegun || (! tool.is_placed && where.position === undefined)) tool.put (where);
            else if (data.jump || ! tool.is_placed) tool.lift (where);
            else tool.glideTo (where);
        }

        tick()
        {
            if (this.tools.some (tool => tool.isLeaping)) this.graph.halt();
            else this.graph.resume();
            for (const tool of this.tools)
                tool.move();
            this.graph.tick();
            const f = this.first?.effort.force, now = this.record ? this.graph.outputs[this.record] : f ? f[0] + f[1] + f[2] : 0;
            const is_landing = this.tools.some (tool => tool.left > 0);   // what a graph makes of a leap is not heard, before the guard neither
            this.sound = (is_landing ? 0 : now - this.before) + this.keeps * this.sound;
            this.before = now;
            for (const tool of this.tools)
                tool.land();
            this.squares += this.sound * this.sound;
            if (++this.ticks % this.told === 0) this.tell (f);
        }

        tell (force)
        {
            const placed = this.tools.filter (tool => tool.is_placed), stopOf = tool => this.graph.stop (tool.name);
            const latched = placed.find (tool => this.graph.isLatched (tool.name)), stopped = latched ?? placed.find (tool => stopOf (tool) !== 'none');
            this.port.postMessage ({ level: Math.sqrt (this.squares / this.told), force: force ? Array.from (force) : [],
                                     stop: stopped === undefined ? 'none' : stopOf (stopped), latched: latched !== undefined });
            this.squares = 0;
        }

        process (_, [channels])
        {
            const [first, ...others] = channels, step = this.graph.about.rate_hz / sampleRate;
            for (let i = 0; i < first.length; ++i)
            {
                for (this.due += this.hasBegun ? step : 0; this.due >= 1; --this.due)
                    this.tick();
                first[i] = this.gain * this.sound;
            }
            for (const other of others)
                other.set (first);
            return ! this.has_ended;
        }
    });
}
