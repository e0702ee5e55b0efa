// SPDX-License-Identifier: MIT
// What the WebAssembly modules of all graphs share. It needs nothing but WebAssembly, so it also runs in an AudioWorklet.

/** Why a guard withholds the effort of a device, in the order of tactus::Guard::Stop. */
const stops = ['none', 'not_finite', 'stale', 'starved', 'released', 'halted', 'speed', 'impulse', 'energy', 'emergency'];

let read = null;   // reads the file at a URL, where fetch cannot

/** From now on, compile() reads files with this function. tactus_node.js calls this: no file that a browser gets may name a module of Node.js. */
export function readFilesWith (reader) { read = reader; }

/** Compiles the module at this address. In Node.js, it may be that of a file. */
export async function compile (address)
{
    if (read !== null && ! /^[a-z][a-z0-9+.-]+:/i.test (address))
        throw new TypeError (`"${address}" is not a URL; in Node.js, give a file: URL, such as new URL ('./graph.wasm', import.meta.url)`);
    if (String (address).startsWith ('file:') && (read !== null || typeof process === 'object'))
    {
        if (read === null) throw new Error (`${address} is a file; in Node.js, import the package by its name, or its file that ends in _node.js`);
        return WebAssembly.compile (await read (new URL (address)));
    }
    const answer = await fetch (address);
    if (! answer.ok) throw new Error (`${address} cannot be loaded: ${answer.status} ${answer.statusText}`);
    return WebAssembly.compile (await answer.arrayBuffer());
}

function addNumber (object, name, values, index)
{
    Object.defineProperty (object, name, { enumerable: true, get: () => values[index], set: value => { values[index] = value; } });
}

/** What is assigned to the member is copied: the graph reads its own memory. */
function addArray (object, name, values)
{
    const set = given =>
    {
        if (given?.length !== values.length) throw new TypeError (`"${name}" takes ${values.length} numbers, not ${written (given)}`);
        values.set (given);
    };
    Object.defineProperty (object, name, { enumerable: true, get: () => values, set });
}

const written = value => typeof value === 'string' ? `"${value}"` : Array.isArray (value) ? `[${value.map (written).join (', ')}]` : String (value);

/** Throws unless this is a number, and finite. `place` and `remedy` are for the message. */
export function checkNumber (value, place, remedy)
{
    const Type = typeof value !== 'number' ? TypeError : Number.isFinite (value) ? null : RangeError;
    if (Type !== null) throw new Type (`${place}: ${written (value)} is not a finite number; ${remedy}`);
}

/** Throws unless these are three finite numbers. */
export function checkPlace (values, place)
{
    if (values?.length !== 3) throw new TypeError (`${place}: ${written (values)} is not a place; give three numbers, [x, y, z]`);
    for (const value of values)
        checkNumber (value, `${place}: ${written ([...values])}`, 'give three finite numbers, [x, y, z]');
}

/** Gives out the members of a C struct of doubles, in their order. */
class Struct
{
    constructor (memory, address)
    {
        this.memory = memory;
        this.address = address;
    }

    array (count, Type = Float64Array)
    {
        const values = new Type (this.memory, this.address, count);
        this.address += values.byteLength;
        return values;
    }

    number (object, name) { addNumber (object, name, this.array (1), 0); }
}

function reading (struct, role)
{
    const all = {}, add = (name, count) => addArray (all, name, struct.array (count));
    add ('position', 3);
    add ('rotation', 3);
    struct.number (all, 'pressure');
    struct.number (all, 'age');
    const bits = struct.array (2, Uint32Array);
    Object.defineProperty (all, 'valid', { enumerable: true, get: () => (bits[0] & 1) === 1, set: value => { bits[0] = value ? 1 : 0; } });
    addNumber (all, 'buttons', bits, 1);
    for (const name of ['true_position', 'true_velocity', 'unrendered_force', 'unrendered_torque'])
        add (name, 3);
    add ('axes', role.axes.length);
    add ('signals', role.signal_inputs);
    return Object.freeze (all);
}

function effort (struct, role)
{
    const all = { force: struct.array (3), torque: struct.array (3) };
    if (role.has_brake) struct.number (all, 'brake');
    all.axes = struct.array (role.efforts.length);
    all.signals = struct.array (role.signal_outputs);
    return Object.freeze (all);
}

/** The number of the one with this name in a list. */
export function indexOf (list, name, kind)
{
    const index = list.findIndex (one => one.name === name), others = list.map (one => one.name).join (', ');
    if (index < 0) throw new RangeError (`there is no ${kind} "${name}"; there are${others === '' ? ' none' : `: ${others}`}`);
    return index;
}

/** A graph. Its class, which `tactus export` writes, knows its names. All functions are for one thread. */
export class Graph
{
    constructor (module, about)
    {
        const wasm = new WebAssembly.Instance (module).exports;
        if (wasm.digest?.() !== about.digest)
            throw new Error (`${about.name}.wasm is from another export than ${about.name}.js; run "make wasm" in their folder`);
        wasm._initialize();
        wasm.prepare (about.rate_hz);            // sorting a mesh may make the memory grow, once
        const memory = wasm.memory.buffer;
        this.about = about;
        this.wasm = wasm;
        this.inputs = {};
        this.outputs = {};
        const inputs = new Struct (memory, wasm.inputs()), outputs = new Struct (memory, wasm.outputs());
        for (const role of about.roles)
        {
            this.inputs[role.member] = reading (inputs, role);
            this.outputs[role.member] = effort (outputs, role);
        }
        for (const feed of about.feeds)
            inputs.number (this.inputs, feed.member);
        for (const record of about.records)
            if (record.count === undefined) outputs.number (this.outputs, record.member);
            else this.outputs[record.member] = outputs.array (record.count);
        this.limits = about.roles.length > 0 ? new Float64Array (memory, wasm.limits(), about.limits.length) : null;
        Object.freeze (this.inputs);
        Object.freeze (this.outputs);
        this.dead_man_buttons = about.roles.length > 0 ? new BigUint64Array (memory, wasm.limits() + 8 * about.limits.length, 1) : null;
        this.tick = wasm.tick;   // computes one tick
        this.prepare (about.rate_hz);
    }

    /** Resets all nodes, for this many ticks per second. False if the rate is not above 0 or is above about.rate_hz. */
    prepare (ticks_per_second) { return this.wasm.prepare (ticks_per_second) !== 0; }

    /** Moves a parameter to a value within 20 ms; at once before the first tick. The value is clamped to the hard range. */
    set (param, value)
    {
        const index = indexOf (this.about.params, param, 'parameter'), { hard_min, hard_max, choices } = this.about.params[index];
        checkNumber (value, `set ('${param}')`, choices ? `give ${choices.map ((name, i) => `${i} for ${name}`).join (', ')}`
                                                         : `give one from ${hard_min ?? -Infinity} to ${hard_max ?? Infinity}`);
        this.wasm.set (index, value);
    }

    /** The value that a parameter has or moves to. */
    get (param) { return this.wasm.get (indexOf (this.about.params, param, 'parameter')); }

    /** Turns a control to a position from 0 to 1; others are clamped to that. */
    turn (control, position)
    {
        const index = indexOf (this.about.controls, control, 'control');
        checkNumber (position, `turn ('${control}')`, 'give one from 0 to 1');
        this.wasm.turn (index, Math.min (1, Math.max (0, position)));
    }

    /** Hits an input at this speed, in m/s. */
    strike (hit, speed)
    {
        const index = indexOf (this.about.hits, hit, 'hit');
        checkNumber (speed, `strike ('${hit}')`, 'give a speed in m/s');
        this.wasm.strike (index, speed);
    }

    /** Tightens the limits of a device, by their names. Returns false, and does nothing, after the first tick since prepare. */
    tighten (role, limits)
    {
        const index = indexOf (this.about.roles, role, 'role');
        this.wasm.no_limits();
        for (const [name, value] of Object.entries (limits))
        {
            if (name === 'dead_man_buttons')
                this.dead_man_buttons[0] = BigInt (value);
            else
                this.limits[indexOf (this.about.limits.map (one => ({ name: one })), name, 'limit')] = value;
        }
        return this.wasm.tighten (index) !== 0;
    }

    /** The limits of a device that hold: those of the patch, tightened. */
    limitsOf (role)
    {
        this.wasm.limits_of (indexOf (this.about.roles, role, 'role'));
        return Object.fromEntries ([...this.about.limits.map ((name, i) => [name, this.limits[i]]), ['dead_man_buttons', Number (this.dead_man_buttons[0])]]);
    }

    /** Why the guard withholds the effort of a device: "none" if it does not. */
    stop (role) { return stops[this.wasm.stop (indexOf (this.about.roles, role, 'role'))]; }

    /** True during a stop that only rearm() ends, even if stop() names another cause. */
    isLatched (role) { return this.wasm.latched (indexOf (this.about.roles, role, 'role')) !== 0; }

    /** Brings all efforts to zero smoothly, and keeps them there until resume(). */
    halt() { this.wasm.halt?.(); }
    resume() { this.wasm.resume?.(); }

    /** Like halt, but only rearm() ends it. It also ends every other stop that a guard has latched. */
    emergencyStop() { this.wasm.emergency_stop?.(); }
    rearm() { this.wasm.rearm?.(); }

    /** The devices were not ticked for this time, in s, before the next tick. */
    loseTime (seconds) { this.wasm.lose_time?. (seconds); }
}
