// SPDX-License-Identifier: MIT
// The graph in the AudioWorklet: simulated hands or a real device in, force and sound out.
import { Graph } from './graphs/tactus_graph.js';

const latching = ['speed', 'impulse', 'energy', 'emergency'];     // stops that only rearm() ends
const at_once = ['stop', 'rearm', 'rest', 'reading', 'volume'];   // what never waits for a new start of the graph
const longest_silence_s = 0.05, fade_s = 0.005;                   // the fade is that of the guard

/** A hand that holds the tool of a simulated device: a spring and a damper between the place it wants to be at and the tool. */
class Hand
{
    static stiffness = 600;   // N/m
    static damping = 6;       // N s/m

    constructor (role, start)
    {
        this.mass = role.mass > 0 ? role.mass : 0.05;
        this.own_damping = role.damping > 0 ? role.damping : 1;
        this.wanted = [...start];
        this.position = [...start];
        this.velocity = [0, 0, 0];
    }

    /** Moves the tool by one tick under the force that the graph gave on the last one. Semi-implicit, so stiff hands do not grow. */
    move (force, dt)
    {
        for (let i = 0; i < 3; ++i)
        {
            const pull = Hand.stiffness * (this.wanted[i] - this.position[i]) + force[i];
            const resistance = Hand.damping + this.own_damping + Hand.stiffness * dt;
            this.velocity[i] = (this.velocity[i] + dt * pull / this.mass) / (1 + dt * resistance / this.mass);
            this.position[i] += dt * this.velocity[i];
        }
    }
}

class Engine extends AudioWorkletProcessor
{
    constructor()
    {
        super();
        this.graph = null;
        this.latched = null;   // a stop that lasts until rearm(), even if the graph is restarted; 'limit' until its cause is known
        this.rest = null;      // the number of the rest that the device takes now
        this.waiting = [];     // requests, until no effort is left
        this.is_at_rest = true;
        this.wall = Date.now() / 1000;
        this.knobs = {};
        this.volume = 0.5;
        this.port.onmessage = ({ data }) => {
            for (const [name, value] of Object.entries (data))
                this.ask (name, value);
        };
    }

    /** Requests that restart the graph wait until the guards have brought all efforts to zero. Later requests keep their order. */
    ask (name, value)
    {
        const is_start = name === 'load' || name === 'device' || (name === 'record' && value);
        if (at_once.includes (name) || (this.waiting.length === 0 && ! (is_start && this.graph && ! this.is_at_rest)))
        {
            this[name + 'Asked'] (value);
            return;
        }
        this.waiting.push ([name, value]);
        this.hold();
    }

    hold()
    {
        if (this.rest !== null || this.waiting.length > 0) this.graph?.halt();
        else this.graph?.resume();
    }

    loadAsked ({ bytes, about, knobs, starts })
    {
        this.graph = new Graph (new WebAssembly.Module (bytes), about);
        this.about = about;
        this.knobs = knobs;
        this.starts = starts;
        this.hands = about.roles.map ((role, i) => new Hand (role, starts[i]));
        this.device = null;
        this.recording = null;
        this.begin();
        this.port.postMessage ({ loaded: about.name });
    }

    /** Restarts the graph. A latched stop stays. */
    begin()
    {
        this.graph.prepare (this.about.rate_hz);
        for (const [name, position] of Object.entries (this.knobs))
            this.graph.turn (name, position);
        const role = this.about.roles[this.device?.role]?.name;
        this.is_guarded = role === undefined || this.graph.tighten (role, this.device.limits);
        if (this.latched) this.graph.emergencyStop();
        this.is_at_rest = true;
        this.hold();
        this.phase = 0;
        this.before = this.now = 0;
        this.low = this.slow = 0;
        this.rumble = 0;
        this.scope = [];
        this.until_scope = 0;
        this.quanta = 0;
    }

    handAsked ({ role, wanted }) { if (this.hands?.[role]) this.hands[role].wanted = wanted; }

    turnAsked ({ name, position })
    {
        this.knobs[name] = position;
        this.graph?.turn (name, position);
    }

    volumeAsked (value) { this.volume = value; }

    stopAsked()
    {
        this.latched = 'emergency';
        this.graph?.emergencyStop();
    }

    rearmAsked()
    {
        this.latched = null;
        this.graph?.rearm();
    }

    /** The device gets neutral reports now. Halts the graph for as long, and report() says when no effort is left. */
    restAsked (number)
    {
        this.rest = number;
        this.is_at_rest = false;   // until a tick has shown it
        this.hold();
    }

    /** A real device takes the place of a simulated hand, if it has a role. Its limits are those of its profile: they only tighten those of the graph. */
    deviceAsked (device)
    {
        this.device = device;
        this.reading = undefined;
        if (this.graph) this.begin();
    }

    readingAsked (reading)
    {
        this.reading = reading;
        this.reading_at = currentTime - reading.age;   // a repeated report does not make it newer
    }

    recordAsked (is_on)
    {
        if (is_on && this.graph)
        {
            this.begin();
            this.recording = { positions: this.about.roles.map (() => []), records: [] };
        }
        else if (this.recording)
        {
            this.port.postMessage ({ recorded: this.recording });
            this.recording = null;
        }
    }

    setInput (i, dt)
    {
        const role = this.about.roles[i], input = this.graph.inputs[role.member], hand = this.hands[i];
        if (this.device?.role === i)
        {
            const reading = this.reading;
            input.valid = reading !== undefined && reading.valid;
            if (! reading) return;
            input.position.set (reading.position);
            input.rotation.set (reading.rotation);
            input.pressure = reading.pressure;
            input.buttons = reading.buttons;
            input.age = Math.max (0, currentTime - this.reading_at, this.wall - reading.at / 1000);   // the sound may have stood still
            hand.position = [...reading.position];
            return;
        }
        hand.move (this.graph.outputs[role.member].force, dt);
        input.position.set (hand.position);
        input.rotation.fill (0);
        input.pressure = 0;
        input.age = 0;
        input.valid = true;
    }

    tick()
    {
        const dt = 1 / this.about.rate_hz;
        for (let i = 0; i < this.about.roles.length; ++i)
            this.setInput (i, dt);
        this.graph.tick();
        if (this.recording) this.keep();
        let heard = 0, is_stopped = false;
        for (const role of this.about.roles)
        {
            const stop = this.graph.stop (role.name);
            is_stopped ||= stop !== 'none';
            if (latching.includes (stop) && (this.latched === null || (this.latched === 'limit' && stop !== 'emergency'))) this.latched = stop;
            else if (this.graph.isLatched (role.name)) this.latched ??= 'limit';   // another stop, such as that of a silent device, hides it
            const force = this.graph.outputs[role.member].force;
            heard += force[0] + force[1] + force[2];
        }
        // What one hears and what rumbles is what changes: a high-pass at 20 Hz, and the size of that, 2 N at most, with a fall of 50 ms. A stop ends
        // the rumble as fast as the force.
        this.slow += (heard - this.slow) * Math.min (1, 126 * dt);
        this.before = this.now;
        this.now = heard - this.slow;
        this.rumble = is_stopped ? Math.max (0, this.rumble - dt / fade_s)
                                 : Math.min (1, Math.max (Math.abs (this.now) / 2, this.rumble * Math.exp (-20 * dt)));
        if (--this.until_scope > 0) return;
        this.until_scope = Math.round (this.about.rate_hz / 1000);
        this.scope.push (...this.graph.outputs[this.about.roles[this.shown ?? 0].member].force);
    }

    keep()
    {
        this.hands.forEach ((hand, i) => this.recording.positions[i].push (...hand.position));
        for (const record of this.about.records)
            this.recording.records.push (this.graph.outputs[record.member]);
        const longest = 20 * this.about.rate_hz;
        if (this.recording.records.length >= longest * this.about.records.length) this.recordAsked (false);
    }

    showAsked (role) { this.shown = role; }

    process (inputs, [[sound]])
    {
        const now = Date.now() / 1000, gap = now - this.wall;
        this.wall = now;
        if (! this.graph) return true;
        if (this.waiting.length > 0 && this.is_at_rest) this.startAnew();
        if (this.device?.role !== undefined && gap > longest_silence_s) this.graph.loseTime (gap);   // simulated hands stood still, too
        const step = this.about.rate_hz / sampleRate;
        let has_ticked = false;
        for (let i = 0; i < sound.length; ++i)
        {
            this.phase += step;
            while (this.phase >= 1)
            {
                this.phase -= 1;
                this.tick();
                has_ticked = true;
            }
            const value = this.before + (this.now - this.before) * this.phase;
            sound[i] = Math.tanh (this.volume * value);   // 1 N is full scale
        }
        if (has_ticked) this.is_at_rest = this.about.roles.every (role => this.isAtRest (this.graph.outputs[role.member]));
        if (this.device || ++this.quanta % 6 === 0) this.report();
        return true;
    }

    startAnew()
    {
        for (const [name, value] of this.waiting.splice (0))
            this[name + 'Asked'] (value);
        this.hold();
    }

    isAtRest ({ force, torque, axes, signals }) { return [force, torque, axes, signals].every (all => all.every (value => value === 0)); }

    report()
    {
        const roles = this.about.roles, effortOf = role => {
            const { force, torque } = this.graph.outputs[role.member];
            return { force: [...force], torque: [...torque] };
        };
        const role = roles[this.device?.role], device = this.device && this.is_guarded
            ? { number: this.device.number, rest: this.is_at_rest ? this.rest : null, ...(role && effortOf (role)) } : null;
        this.port.postMessage ({ state: { at: Date.now(), positions: this.hands.map (hand => [...hand.position]), scope: this.scope,
                                          efforts: roles.map (effortOf), stops: roles.map (role => this.graph.stop (role.name)), latched: this.latched,
                                          rumble: this.rumble, device } });
        this.scope = [];
    }
}

registerProcessor ('tactus-engine', Engine);
