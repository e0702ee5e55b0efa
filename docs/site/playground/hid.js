// SPDX-License-Identifier: MIT
// A board or a DualSense by WebHID. What reaches its motors has passed the guard of the graph, in the AudioWorklet, with the limits of the
// profile. After a stop, and after a silence of the engine, of this page or of the device, it gets its neutral report until it takes one. Then
// nothing else is sent until the engine says that the graph is halted and gives no effort, so the force comes back along the ramp of the guard.
import { decode, encode, limitsOf, neutral } from './reports.js';

const longest_silence = 0.05, longest_close_ms = 200;
let count = 0;

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
        const { max_signal = 1, max_signal_slew = Infinity, ramp = 0, device_watchdog = Infinity }
            = limitsOf (profile, ['max_signal', 'max_signal_slew', 'ramp', 'device_watchdog']);
        this.device = device;
        this.profile = profile;
        this.output = profile.outputs[0];
        this.number = ++count;   // tells this connection from earlier ones
        this.most = { size: max_signal, slew: max_signal_slew, ramp };
        this.longest_silence_ms = 1000 * Math.min (longest_silence, device_watchdog);   // after its watchdog, the device has let its motors go
        this.values = null;
        this.is_stopped = this.is_sending = false;
        this.has_to_rest = true;
        this.rests = 1;                  // how often it had to rest
        this.driven = 1;                 // reports that drive it; what it did before is unknown
        this.rested = this.asked = 0;    // of those, how many came before the last neutral report that was taken, and that was sent
        this.rumble = this.enabled = 0;
        this.last_write = -Infinity;
        this.post = this.onreading = () => {};
        device.addEventListener ('inputreport', event => this.read (event));
        this.timer = setInterval (() => this.watch(), 10);
    }

    get hasForce() { return this.profile.force !== undefined; }

    /** Gives the device a role of the graph. `post` sends messages to the engine; `names` are those of the limits that a guard knows. */
    use (post, role, names)
    {
        this.post = post;
        post ({ rest: this.has_to_rest ? this.rests : null });
        post ({ device: { number: this.number, role: this.hasForce ? role : undefined, limits: limitsOf (this.profile, names) } });
    }

    read ({ reportId, data })
    {
        const body = new Uint8Array (data.buffer, data.byteOffset, data.byteLength);
        const values = decode (this.profile, reportId === 0 ? body : Uint8Array.of (reportId, ...body));
        if (! values) return;
        this.values = values;
        const vector = names => names ? names.map (name => values[name] ?? 0) : [0, 0, 0];
        this.onreading ({ at: Date.now(), position: vector (this.profile.position), rotation: vector (this.profile.rotation),
                          pressure: values[this.profile.pressure] ?? 0, buttons: values.buttons,
                          valid: this.profile.valid === undefined || values[this.profile.valid] === 1,
                          stick: [values.left_x ?? 0, values.left_y ?? 0] });
    }

    /** Passes the effort that a state of the engine has for this device on, as often as the device takes one. Old states do not count. */
    receive ({ at, device, rumble })
    {
        if (device?.number !== this.number || Math.abs (Date.now() - at) > this.longest_silence_ms) return;
        this.watch();
        const now = performance.now();
        if (this.has_to_rest)
        {
            if (this.is_stopped || this.rested !== this.driven || device.rest !== this.rests) return;
            this.has_to_rest = false;
            this.rumble = this.enabled = 0;
            this.last_write = now;
            this.hear();
            this.post ({ rest: null });
            return;
        }
        if (this.is_sending || now - this.last_write < 1000 / (this.output.max_rate ?? 250)) return;
        const values = {};
        this.profile.force?.forEach ((name, i) => { values[name] = device.force[i]; });
        this.profile.torque?.forEach ((name, i) => { values[name] = device.torque[i]; });
        this.approach (rumble, (now - this.last_write) / 1000);
        for (const signal of this.profile.signals ?? [])
            values[signal.amplitude] = this.rumble;
        ++this.driven;
        this.is_sending = true;
        this.send (encode (this.profile, this.output, values, this.values?.sequence ?? 0))
            .then (() => this.hear(), () => {}).finally (() => { this.is_sending = false; });   // a refused report counts as silence
    }

    /** The rumble, 0 to 1, within the limits of the profile. */
    approach (rumble, passed_s)
    {
        const { size, slew, ramp } = this.most;
        this.enabled = ramp > 0 ? Math.min (1, this.enabled + passed_s / ramp) : 1;
        const change = this.enabled * Math.min (size, rumble) - this.rumble, most = slew * passed_s;
        this.rumble += Math.min (most, Math.max (-most, change));
    }

    hear() { this.heard = [performance.now(), Date.now()]; }

    /** Called every 10 ms, and with each state: a page that has stalled may get that first. The second clock goes on while the computer sleeps. */
    watch()
    {
        const is_silent = () => Math.max (performance.now() - this.heard[0], Math.abs (Date.now() - this.heard[1])) > this.longest_silence_ms;
        if (this.has_to_rest || is_silent()) this.rest();
    }

    send (bytes)
    {
        this.last_write = performance.now();
        const id = Number (this.output.id ?? 0);
        return this.device.sendReport (id, id === 0 ? bytes : bytes.slice (1));
    }

    /** Brings the device to rest. Called again until it has taken the neutral report. */
    rest()
    {
        if (! this.has_to_rest)
        {
            this.has_to_rest = true;
            this.post ({ rest: ++this.rests });
        }
        if (this.rested === this.driven || this.asked === this.driven) return;
        const driven = this.asked = this.driven;
        this.send (neutral (this.output)).then (() => { this.rested = driven; }, () => { this.asked = 0; });
    }

    stop()
    {
        this.is_stopped = true;
        ++this.driven;   // the neutral report is sent, whatever was sent before
        this.rest();
    }

    rearm() { this.is_stopped = false; }

    async close()
    {
        this.post ({ rest: null, device: null });
        this.post = this.onreading = () => {};
        this.stop();
        for (const end = performance.now() + longest_close_ms; this.rested !== this.driven && performance.now() < end;)
            await new Promise (done => setTimeout (done, 10));
        clearInterval (this.timer);
        await this.device.close();
    }
}
