// SPDX-License-Identifier: MIT
// A board or a DualSense by WebHID. What reaches its motors has passed the guard of the graph, in the AudioWorklet, with the limits of the
// profile. After a stop, and after a silence of the engine, of this page or of the device, it gets its neutral report until it takes one. Then
// nothing else is sent until the engine says that the graph is halted and gives no effort, so the force comes back along the ramp of the guard.
import { Reports } from './reports.js';

const longest_silence = 0.05, longest_close_ms = 200;
let count = 0;

/** What a profile asks a browser for. The browser shows only such devices. */
function filtersOf (profile)
{
    return profile.match.flatMap (one => [one.pid].flat().map (pid => ({
        vendorId: Number (one.vid), productId: Number (pid),
        ...(one.usage === undefined ? {} : { usagePage: Number (one.usage_page), usage: Number (one.usage) }) })));
}

/** One page at a time drives a device: two would add up their changes, and a stop of one would not stop the other. Returns what ends the lock, or null
    if another page of this origin has it. WebHID does not tell two devices of one kind apart, so the lock is for the kind. A page that ends loses it. */
async function lock ({ vendorId, productId }, onlost)
{
    if (! navigator.locks) throw new Error ('this browser has no locks, so another tab could drive the same device');
    return new Promise ((done, fail) => {
        navigator.locks.request (`tactus-device-${vendorId}-${productId}`, { ifAvailable: true },
                                 held => { if (held) return new Promise (release => done (release)); done (null); })
            .catch (error => { fail (error); onlost(); });
    });
}

export class HidDevice
{
    /** Asks the person for a device that has a profile. Null if the person chooses none. */
    static async choose (profiles)
    {
        const [device] = await navigator.hid.requestDevice ({ filters: profiles.flatMap (filtersOf) });
        if (! device) return null;
        const module = await Reports.compile();
        const all = await Promise.all (profiles.map (profile => Reports.open (module, profile)));
        const [reports] = all.sort ((a, b) => b.fit (device) - a.fit (device));
        if (! reports || reports.fit (device) <= 0) throw new Error (`no profile fits ${device.productName}`);
        if (reports.about.why_not) throw new Error (`${reports.about.name} cannot be driven from a page: ${reports.about.why_not}. Use \`tactus play\` instead.`);
        return { device, reports };
    }

    /** Opens what was chosen, if no other page has it open. */
    static async open ({ device, reports })
    {
        let opened;
        const unlock = await lock (device, () => opened?.abandon());
        if (! unlock) throw new Error (`another tab drives a ${reports.about.name}: release the device there first`);
        try
        {
            await device.open();
            opened = new HidDevice (device, reports, unlock);
            return opened;
        }
        catch (error)
        {
            unlock();
            throw error;
        }
    }

    constructor (device, reports, unlock = () => {})
    {
        this.device = device;
        this.reports = reports;
        this.unlock = unlock;
        this.number = ++count;   // tells this connection from earlier ones
        this.longest_silence_ms = 1000 * Math.min (longest_silence, reports.about.device_watchdog || Infinity);   // then the device has let its motors go
        this.reading = null;
        this.is_stopped = this.is_sending = this.is_over = false;
        this.has_to_rest = true;
        this.rests = 1;                  // how often it had to rest
        this.driven = 1;                 // reports that drive it; what it did before is unknown
        this.rested = this.asked = 0;    // of those, how many came before the last neutral report that was taken, and that was sent
        this.driven_since = 0;
        this.last_write = -Infinity;
        this.post = this.onreading = () => {};
        device.addEventListener ('inputreport', event => this.read (event));
        this.timer = setInterval (() => this.watch(), 10);
    }

    get name() { return this.reports.about.name; }
    get hasForce() { return this.reports.about.has_force; }

    /** Gives the device a role of the graph. `post` sends messages to the engine. */
    use (post, role)
    {
        this.post = post;
        post ({ rest: this.has_to_rest ? this.rests : null });
        post ({ device: { number: this.number, role: this.hasForce ? role : undefined, limits: this.reports.about.limits } });
    }

    read ({ reportId, data })
    {
        const now = performance.now(), driven_s = this.has_to_rest ? 0 : (now - this.driven_since) / 1000;
        const reading = this.module (() => this.reports.take (reportId, data, now, driven_s));
        if (! reading) return;
        this.reading = { ...reading, at: Date.now() - 1000 * reading.age };
        this.read_at = now - 1000 * reading.age;
        this.onreading ({ ...this.reading, stick: [reading.axes.left_x ?? 0, reading.axes.left_y ?? 0] });
    }

    /** What the module answers. If it fails, which is a mistake in it, the page gives the device up. */
    module (call)
    {
        try { return call(); }
        catch (error)
        {
            console.error (error);
            this.abandon();
            return undefined;
        }
    }

    /** Passes the effort that a state of the engine has for this device on, as often as the device takes one. Old states do not count. */
    receive ({ at, device, rumble })
    {
        if (device?.number !== this.number || Math.abs (Date.now() - at) > this.longest_silence_ms) return;
        this.watch();
        const now = performance.now();
        if (this.has_to_rest)
        {
            if (this.is_stopped || this.is_over || this.rested !== this.driven || device.rest !== this.rests) return;
            this.has_to_rest = false;
            this.last_write = this.driven_since = now;
            this.hear();
            this.post ({ rest: null });
            return;
        }
        if (this.is_sending || now - this.last_write < 1000 / this.reports.about.max_rate) return;
        const { force = [0, 0, 0], torque = [0, 0, 0] } = device, passed_s = Math.min (now - this.last_write, this.longest_silence_ms) / 1000;
        const bytes = this.module (() => this.reports.drive ({ force, torque }, rumble, passed_s, (now - this.read_at) / 1000));
        if (! bytes) return;
        ++this.driven;
        this.is_sending = true;
        this.send (bytes).then (() => this.hear(), () => {}).finally (() => { this.is_sending = false; });   // a refused report counts as silence
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
        return this.device.sendReport (bytes[0], bytes.slice (1));
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
        this.send (this.reports.rest()).then (() => { this.rested = driven; }, () => { this.asked = 0; });
    }

    stop()
    {
        this.is_stopped = true;
        ++this.driven;   // the neutral report is sent, whatever was sent before
        this.rest();
    }

    rearm() { this.is_stopped = false; }

    /** Stops for good, and lets another page have the device at once: this one may get no more time. */
    abandon()
    {
        this.stop();
        this.is_over = true;
        this.unlock();
    }

    async close()
    {
        this.post ({ rest: null, device: null });
        this.post = this.onreading = () => {};
        this.stop();
        for (const end = performance.now() + longest_close_ms; this.rested !== this.driven && performance.now() < end;)
            await new Promise (done => setTimeout (done, 10));
        clearInterval (this.timer);
        try
        {
            for (const step of this.reports.about.exit)
                await this.send (Uint8Array.from (step)).catch (() => {});   // it may be unplugged
            await this.device.close();
        }
        finally { this.unlock(); }
    }
}
