// SPDX-License-Identifier: MIT
// The graph in the AudioWorklet: simulated hands or a real device in, force and sound out.
import { Graph } from './graphs/tactus_graph.js';

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
        this.is_stopped = false;
        this.knobs = {};
        this.volume = 0.5;
        this.port.onmessage = ({ data }) => {
            for (const [name, value] of Object.entries (data))
                this[name + 'Asked'] (value);
        };
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

    /** Starts the graph anew. What was stopped stays stopped. */
    begin()
    {
        this.graph.prepare (this.about.rate_hz);
        for (const [name, position] of Object.entries (this.knobs))
            this.graph.turn (name, position);
        if (this.device) this.graph.tighten (this.about.roles[this.device.role].name, this.device.limits);
        if (this.is_stopped) this.graph.emergencyStop();
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
        this.is_stopped = true;
        this.graph?.emergencyStop();
    }

    rearmAsked()
    {
        this.is_stopped = false;
        this.graph?.rearm();
    }

    /** A real device takes the place of a simulated hand. Its limits are those of its profile: they only tighten those of the graph. */
    deviceAsked (device)
    {
        this.device = device;
        if (! this.graph) return;
        this.readings = 0;
        this.begin();
    }

    readingAsked (reading)
    {
        if (! this.device) return;
        this.reading = reading;
        this.reading_at = currentTime;
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
            input.age = Math.max (0, currentTime - this.reading_at);
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
        let heard = 0;
        for (const role of this.about.roles)
        {
            const force = this.graph.outputs[role.member].force;
            heard += force[0] + force[1] + force[2];
        }
        // What one hears and what rumbles is what changes: a high-pass at 20 Hz, and the size of that with a fall of 50 ms.
        this.slow += (heard - this.slow) * Math.min (1, 126 * dt);
        this.before = this.now;
        this.now = heard - this.slow;
        this.rumble = Math.max (Math.abs (this.now), this.rumble * Math.exp (-20 * dt));
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
        if (! this.graph) return true;
        const step = this.about.rate_hz / sampleRate;
        for (let i = 0; i < sound.length; ++i)
        {
            this.phase += step;
            while (this.phase >= 1)
            {
                this.phase -= 1;
                this.tick();
            }
            const value = this.before + (this.now - this.before) * this.phase;
            sound[i] = Math.tanh (this.volume * value);   // 1 N is full scale
        }
        if (this.device || ++this.quanta % 6 === 0) this.report();
        return true;
    }

    report()
    {
        const roles = this.about.roles;
        this.port.postMessage ({ state: { positions: this.hands.map (hand => [...hand.position]), scope: this.scope,
                                          efforts: roles.map (role => ({ force: [...this.graph.outputs[role.member].force],
                                                                         torque: [...this.graph.outputs[role.member].torque] })),
                                          stops: roles.map (role => this.graph.stop (role.name)), rumble: Math.min (1, this.rumble / 2) } });
        this.scope = [];
    }
}

registerProcessor ('tactus-engine', Engine);
