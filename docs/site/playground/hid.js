// SPDX-License-Identifier: MIT
// A board or a DualSense by WebHID. What reaches its motors has passed the guard of the graph, in the AudioWorklet, with the limits of the
// profile. If the engine falls silent, or anything stops, the device gets its neutral report.
import { decode, encode, limitsOf, neutral } from './reports.js';

const longest_silence_ms = 50;

function matches (profile, device)
{
    return profile.match.some (one => Number (one.vid) === device.vendorId && [one.pid].flat().some (pid => Number (pid) === device.productId)
                                      && (one.usage === undefined || device.collections.some (all => all.usagePage === Number (one.usage_page)
                                                                                                     && all.usage === Number (one.usage))));
}

export class HidDevice
{
    /** Asks the person for a device that has a profile. Null if the person chooses none. */
    static async request (profiles)
    {
        const filters = profiles.flatMap (profile => profile.match.flatMap (one => [one.pid].flat().map (pid => ({
            vendorId: Number (one.vid), productId: Number (pid),
            ...(one.usage === undefined ? {} : { usagePage: Number (one.usage_page), usage: Number (one.usage) }) }))));
        const [device] = await navigator.hid.requestDevice ({ filters });
        if (! device) return null;
        const profile = profiles.find (one => matches (one, device));
        if (! profile) throw new Error (`no profile fits ${device.productName}`);
        await device.open();
        return new HidDevice (device, profile);
    }

    constructor (device, profile)
    {
        this.device = device;
        this.profile = profile;
        this.output = profile.outputs[0];
        this.values = null;
        this.is_stopped = false;
        this.last_write = this.last_state = -Infinity;
        this.is_resting = true;
        this.onreading = () => {};
        device.addEventListener ('inputreport', event => this.read (event));
        this.timer = setInterval (() => { if (performance.now() - this.last_state > longest_silence_ms) this.rest(); }, 10);
    }

    get hasForce() { return this.profile.force !== undefined; }
    limits (names) { return limitsOf (this.profile, names); }

    read ({ reportId, data })
    {
        const body = new Uint8Array (data.buffer, data.byteOffset, data.byteLength);
        const values = decode (this.profile, reportId === 0 ? body : Uint8Array.of (reportId, ...body));
        if (! values) return;
        this.values = values;
        const vector = names => names ? names.map (name => values[name] ?? 0) : [0, 0, 0];
        this.onreading ({ position: vector (this.profile.position), rotation: vector (this.profile.rotation), pressure: values[this.profile.pressure] ?? 0,
                          buttons: values.buttons, valid: this.profile.valid === undefined || values[this.profile.valid] === 1,
                          stick: [values.left_x ?? 0, values.left_y ?? 0] });
    }

    /** Passes an effort of the graph on, as often as the device takes one. `rumble` is 0 to 1. */
    write ({ force, torque }, rumble)
    {
        const now = performance.now();
        this.last_state = now;
        if (this.is_stopped || now - this.last_write < 1000 / (this.output.max_rate ?? 250)) return;
        const values = {};
        this.profile.force?.forEach ((name, i) => { values[name] = force[i]; });
        this.profile.torque?.forEach ((name, i) => { values[name] = torque[i]; });
        for (const signal of this.profile.signals ?? [])
            values[signal.amplitude] = rumble;
        this.is_resting = false;
        this.send (encode (this.profile, this.output, values, this.values?.sequence ?? 0));
    }

    send (bytes)
    {
        this.last_write = performance.now();
        const id = Number (this.output.id ?? 0);
        this.device.sendReport (id, id === 0 ? bytes : bytes.slice (1)).catch (() => {});   // a device that is gone gets its silence
    }

    rest()
    {
        if (this.is_resting) return;
        this.is_resting = true;
        this.send (neutral (this.output));
    }

    stop()
    {
        this.is_stopped = true;
        this.is_resting = false;
        this.rest();
    }

    rearm() { this.is_stopped = false; }

    async close()
    {
        clearInterval (this.timer);
        this.stop();
        await this.device.close();
    }
}
