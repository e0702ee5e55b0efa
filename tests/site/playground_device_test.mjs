// SPDX-License-Identifier: MIT
// node playground_device_test.mjs SITE: what the playground sends to a board and to a DualSense, with simulated clocks. The engine, the guards and
// the HID device are those of the page; the page itself, the AudioWorklet and the devices are simulated here.
import assert from 'node:assert';
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const above = [0, 0, 0.005], pressed = [0, 0, -0.005], force_limit = 2 + 2e-6, slew_limit = 500, ramp_s = 0.2;   // as tactus_board.json, and its unit

const site = process.argv[2], load = name => import (pathToFileURL (`${site}/${name}`));
const quantum = 128, rate = 48000, quantum_ms = 1000 * quantum / rate;

//==============================================================================
// The clocks, and what the modules take from a browser.

let monotonic = 1000, wall = 1.7e12, timers = [], Engine;
performance.now = () => monotonic;
Date.now = () => Math.floor (wall);
globalThis.setInterval = (call, period) => { timers.push ({ call, period, at: monotonic + period }); return timers.at (-1); };
globalThis.clearInterval = timer => { timers = timers.filter (one => one !== timer); };
globalThis.setTimeout = (call, after) => { timers.push ({ call, period: Infinity, at: monotonic + after }); };
globalThis.sampleRate = rate;
globalThis.currentTime = 0;
globalThis.AudioWorkletProcessor = class { port = { sent: [], postMessage: data => this.port.sent.push (structuredClone (data)) }; };
globalThis.registerProcessor = (name, type) => { Engine = type; };
await load ('engine.js');
const { HidDevice } = await load ('hid.js'), { Reports } = await load ('reports.js');
const reports = new WebAssembly.Module (readFileSync (`${site}/reports.wasm`));
const profiles = JSON.parse (readFileSync (`${site}/profiles.json`, 'utf8')).profiles;
const boards = profiles.find (one => one.id === 'tactus_board'), pads = profiles.find (one => one.id === 'dualsense_usb');

/** The far end of WebHID. While `refuses` is set, it takes no report. */
class Device extends EventTarget
{
    sent = [];
    refused = 0;
    number = 0;

    async sendReport (id, bytes)
    {
        if (this.refuses)
        {
            ++this.refused;
            throw new Error ('the device is busy');
        }
        const data = new DataView (Uint8Array.from (bytes).buffer);
        if (id === 0)
        {
            const force = [8, 12, 16].map (at => data.getInt32 (at, true) * 1e-6);
            this.sent.push ({ at: monotonic, drives: data.getUint16 (2, true) & 1, force, size: Math.hypot (...force) });
        }
        else
            this.sent.push ({ at: monotonic, size: Math.max (bytes[2], bytes[3]) / 255 });   // the two motors
    }

    async close() { this.is_closed = true; }

    /** A board reports where the tool is. `flags`: homed, driven, timed out, too hot. */
    report (position, { flags = 0b11, number = ++this.number, at_ms = monotonic, size = 64 } = {})
    {
        const data = new DataView (new ArrayBuffer (64));
        data.setUint8 (0, 0x54);
        data.setUint8 (1, 1);
        data.setUint16 (2, flags, true);
        data.setUint32 (4, number, true);
        data.setUint32 (8, 1000 * at_ms, true);
        position.forEach ((value, i) => data.setInt32 (12 + 4 * i, Math.round (value * 1e9), true));
        this.dispatchEvent (Object.assign (new Event ('inputreport'), { reportId: 0, data: new DataView (data.buffer, 0, size) }));
    }

    /** A DualSense reports that nobody touches it. */
    reportPad()
    {
        const data = new DataView (new ArrayBuffer (63));
        for (const stick of [0, 1, 2, 3])
            data.setUint8 (stick, 0x80);
        data.setUint8 (6, ++this.number);
        data.setUint8 (7, 8);
        data.setUint32 (27, 3000 * monotonic, true);
        this.dispatchEvent (Object.assign (new Event ('inputreport'), { reportId: 1, data }));
    }
}

/** The page: what playground.js does with messages, without its pictures. */
class Page
{
    static async open (preset)
    {
        const page = new Page();
        timers = [];
        page.engine = new Engine();
        page.to_engine = [];
        await page.choose (preset);
        return page;
    }

    async choose (preset)
    {
        this.about = (await load (`graphs/${preset}.js`)).about;
        this.chosen = 0;
        const bytes = readFileSync (`${site}/graphs/${preset}.wasm`), starts = this.about.roles.map (() => above);
        this.post ({ load: { bytes, about: this.about, knobs: {}, starts } });
        this.post ({ show: 0 });
        if (this.hid) this.use();
    }

    connect (profile)
    {
        this.device = new Device();
        this.hid = new HidDevice (this.device, new Reports (new WebAssembly.Instance (reports), profile));
        this.hid.onreading = reading => this.post ({ reading });
        this.use();
    }

    use() { this.hid.use (message => this.post (message), this.chosen); }

    post (message) { this.to_engine.push (structuredClone (message)); }

    /** What waits at either end: the engine handles its messages, and the page its own and its timers, unless it stalls. */
    async deliver()
    {
        for (const data of this.to_engine.splice (0))
            this.engine.port.onmessage ({ data });
        if (this.stalls) return;
        this.on_its_way.push (this.engine.port.sent.splice (0));
        for (const data of this.on_its_way.splice (0, this.on_its_way.length - this.delay).flat())
            if (data.state)
            {
                this.state = data.state;
                this.hid?.receive (data.state);
                await new Promise (setImmediate);   // promises of sendReport
            }
            else if (data.recorded) this.recorded = data.recorded;
        for (const timer of [...timers])
            while (timer.at <= monotonic)
            {
                timer.at += timer.period;
                timer.call();
            }
        await new Promise (setImmediate);
    }

    /** The board reports where the hand is, which trembles and moves at 1 m/s. */
    report (towards, speed)
    {
        ++this.ticks;
        this.place = this.place.map ((x, i) => x + Math.max (-speed, Math.min (speed, 1e3 * (towards[i] - x) / quantum_ms)) * quantum_ms / 1e3);
        this.device.report (this.place.map ((x, i) => x + 2e-5 * Math.sin (0.15 * this.ticks + i)), this.says?.());
    }

    /** Lets time pass. Returns what the device has got meanwhile. `position`: the board reports it each 2.7 ms. */
    async run (seconds, { position, is_silent = false, speed = 1 } = {})
    {
        const before = this.device?.sent.length;
        for (let i = 0; i < Math.round (seconds * rate / quantum); ++i)
        {
            if (position && ! this.stalls) this.report (position, speed);
            if (this.hid && ! this.hid.hasForce) this.device.reportPad();
            if (! is_silent)
            {
                this.engine.process ([], [[new Float32Array (quantum)]]);
                globalThis.currentTime += quantum / rate;
            }
            monotonic += quantum_ms;
            wall += quantum_ms;
            await this.deliver();
        }
        return this.device?.sent.slice (before);
    }

    ticks = 0;
    place = above;
    on_its_way = [];
    delay = 0;   // of messages of the engine, in quanta
}

//==============================================================================

const distance = (a, b) => Math.hypot (...a.map ((x, axis) => x - b[axis]));
/** The fastest change from one report to the next, in N/s. A neutral report has no force. */
const fastest = sent => Math.max (0, ...sent.slice (1).map ((one, i) => distance (one.force, sent[i].force) / (one.at - sent[i].at) * 1e3));
const most = sent => Math.max (0, ...sent.map (one => one.size));

/** The force comes back from a neutral report along the ramp: at no time is it more than the ramp allows. */
function assertRises (sent)
{
    const last = sent.findLastIndex (one => one.drives === 0);
    assert (last >= 0, 'no neutral report');
    for (const one of sent.slice (last))
        assert (one.size <= force_limit * Math.min (1, (one.at - sent[last].at) / 1e3 / ramp_s) + 1e-6, `${one.size} N after ${one.at - sent[last].at} ms`);
}

async function pressing (profile = boards)
{
    const page = await Page.open ('dry_wood');
    page.connect (profile);
    await page.run (0.3, { position: above });
    const sent = await page.run (0.5, { position: pressed });
    assert (sent.at (-1).size > 1.9, `it pushes with ${sent.at (-1).size} N`);
    return page;
}

const tests = {
    async 'a board begins at rest, and its force along the ramp'()
    {
        const page = await Page.open ('dry_wood');
        page.post ({ hand: { role: 0, wanted: pressed } });
        await page.run (0.5);
        page.connect (boards);
        const sent = await page.run (1, { position: pressed });
        assert.equal (sent[0].drives, 0);
        assertRises (sent);
        assert (most (sent) > 1.9 && most (sent) <= force_limit, `${most (sent)} ${JSON.stringify (page.state)}`);
        page.device.sent = [];
        await page.run (0.1, { position: pressed });
        page.device.report (pressed, { flags: 0b10 });   // it has lost its home
        assert.equal ((await page.run (0.05)).at (-1).size, 0);
    },

    async 'another hand is chosen: the board keeps its role and its limits'()
    {
        const page = await Page.open ('two_fingers');
        page.connect (boards);
        await page.run (0.5, { position: above });
        page.chosen = 1;
        page.post ({ show: 1 });
        page.post ({ hand: { role: 1, wanted: [0, 0, -0.01] } });   // the mouse presses with the other hand
        let sent = await page.run (1, { position: above });
        assert (Math.hypot (...page.state.efforts[1].force) > 3);
        assert (Math.abs (sent.at (-1).size - Math.hypot (...page.state.efforts[0].force)) < 2e-6);
        assert (most (sent) < 0.5, `${most (sent)} N`);   // the cork creaks, which both fingers feel
        assert (fastest (sent) <= slew_limit);
        sent = await page.run (1, { position: [0, 0, -0.01] });
        assert (most (sent) > 0.5 && most (sent) <= force_limit, `${most (sent)} N, ${page.state.stops}`);
        assert (fastest (sent) <= slew_limit);
        sent = await page.run (5);   // the board is silent
        assert.equal (sent.findLast (one => one.at < sent[0].at + 60).size, 0);
        assert.equal (most (sent.filter (one => one.at > sent[0].at + 60)), 0);
        assert.deepEqual (page.state.stops, ['stale', 'none']);
        page.chosen = 0;
        assert.equal (most (await page.run (0.5)), 0);
    },

    async 'the engine is silent, for 25 ms to 30 s'()
    {
        for (const silence of [0.025, 0.06, 1])
        {
            const page = await pressing();
            const sent = [...await page.run (silence, { is_silent: true, position: pressed }), ...await page.run (1.5, { position: pressed })];
            assert (sent.some (one => one.drives === 0));
            assertRises (sent);
            assert (sent.at (-1).size > 1.9);
        }
        const page = await pressing();
        await page.run (0.1, { is_silent: true, position: pressed });
        monotonic += 30e3;
        wall += 30e3;
        const sent = await page.run (3, { position: pressed });
        assert.equal (most (sent), 0);
        assert.equal (page.state.latched, 'impulse');   // as if the last force had been on the device for 30 s
    },

    async 'a limit that is exceeded while the board is silent stops it after a new start, too'()
    {
        const page = await pressing();
        await page.run (0.1, { is_silent: true });
        monotonic += 30e3;
        wall += 30e3;
        await page.run (0.1);   // the last force counts for 30 s, and the stop of a silent board hides that
        assert.deepEqual (page.state.stops, ['stale']);
        assert.equal (page.state.latched, 'limit');
        page.post ({ record: true });
        assert.equal (most (await page.run (1, { position: pressed })), 0);
        assert.equal (page.state.latched, 'limit');
        page.hid.rearm();
        page.post ({ rearm: true });
        assert (most (await page.run (1, { position: pressed })) > 1.9);
        assert.equal (page.state.latched, null);
    },

    async 'the computer sleeps: one clock stands still, and the first thing that runs is an old state'()
    {
        const page = await pressing();
        wall += 3000;
        let sent = await page.run (2, { position: pressed });
        assert.equal (sent[0].drives, 0);
        assertRises (sent);
        assert (sent.at (-1).size > 1.9);
        wall -= 3600e3;   // the clock is set
        sent = await page.run (2, { position: pressed });
        assert.equal (sent[0].drives, 0);
        assertRises (sent);
        assert (sent.at (-1).size > 1.9);
    },

    async 'the page stalls: what the engine has said meanwhile is dropped'()
    {
        for (const stall of [0.015, 0.03, 0.06, 0.15, 2])
        {
            const page = await pressing();
            page.stalls = true;
            await page.run (stall, { position: pressed });
            page.stalls = false;
            const sent = await page.run (1, { position: pressed });
            if (stall > 0.02)
            {
                assert.equal (sent[0].drives, 0, `after ${stall} s`);
                assertRises (sent);
            }
            assert (fastest (sent) <= slew_limit);
            assert (sent.at (-1).size > 1.9);
        }
    },

    async 'a page that is always late gets no force'()
    {
        const page = await pressing();
        page.delay = 9;   // 24 ms
        const sent = await page.run (0.5, { position: pressed });
        assert.deepEqual (sent.map (one => one.drives), [0]);
        page.delay = 0;
        assertRises ([...sent, ...await page.run (1, { position: pressed })]);
        assert (page.device.sent.at (-1).size > 1.9);
    },

    async 'a slow fade: the force comes back when it is over'()
    {
        const page = await pressing ({ ...boards, limits: { ...boards.limits, max_slew: '8 N/s' } });
        const sent = [...await page.run (0.03, { is_silent: true, position: pressed }), ...await page.run (1, { position: pressed })];
        const neutral = sent.find (one => one.drives === 0);
        assert (sent.every (one => one.size === 0 || one.at < neutral.at || one.at > neutral.at + 200));
        assertRises (sent);
        page.post ({ record: true });
        const fast = fastest (await page.run (1, { position: pressed }));
        assert (fast < 9, `${fast} N/s`);   // a tick more or less between two states
    },

    async 'the sound and the board are silent for the same time: the last reading is old'()
    {
        const page = await pressing();
        await page.run (0.04, { is_silent: true });
        await page.run (0.002);
        assert.deepEqual (page.state.stops, ['stale']);
    },

    async 'latched stops last until START'()
    {
        const stops = { async speed (page)
                        {
                            await page.run (0.03, { position: [0.2, 0, -0.005], speed: 5 });
                        },
                        async emergency (page)
                        {
                            page.hid.stop();
                            page.post ({ stop: true });
                        } };
        for (const [name, stop] of Object.entries (stops))
        {
            const page = await pressing();
            await stop (page);
            await page.run (0.1, { position: pressed });
            assert.equal (page.state.latched, name);
            for (const act of [() => page.post ({ record: true }), () => page.post ({ record: false }), () => page.choose ('two_fingers'),
                               () => page.choose ('dry_wood'), () => page.hid.close(), () => page.connect (boards), () => page.run (0.1, { is_silent: true })])
            {
                const done = act();
                const sent = await page.run (0.7, { position: pressed });
                await done;
                assert.equal (most (sent), 0, `${name}: ${act}`);
                assert.equal (page.state.latched, name, `${act}`);
            }
            page.hid.rearm();
            page.post ({ rearm: true });
            const sent = await page.run (1, { position: pressed });
            assert.equal (page.state.latched, null);
            assertRises ([...page.device.sent.slice (0, 1), ...sent]);
            assert (sent.at (-1).size > 1.9);
        }
    },

    async 'a stop before there is a graph, and while one restarts'()
    {
        const page = new Page();
        timers = [];
        page.engine = new Engine();
        page.to_engine = [];
        page.post ({ stop: true });
        await page.choose ('dry_wood');
        page.connect (boards);
        assert.equal (most (await page.run (1, { position: pressed })), 0);
        page.post ({ rearm: true });
        assert (most (await page.run (1, { position: pressed })) > 1.9);
        page.post ({ record: true });
        page.post ({ stop: true });
        const sent = await page.run (1, { position: pressed });
        assert.equal (sent.at (-1).size, 0);
        assert (fastest (sent) <= slew_limit);
        assert.equal (page.state.latched, 'emergency');
    },

    async 'a new start takes the force away smoothly, and gives it back along the ramp'()
    {
        for (const act of [page => page.post ({ record: true }), page => page.choose ('two_fingers'), page => page.choose ('dry_wood'), page => page.use()])
        {
            const page = await pressing(), before = page.device.sent.length - 1;
            await act (page);
            await page.run (1, { position: pressed });
            const sent = page.device.sent.slice (before), zero = sent.findIndex (one => one.size === 0);
            assert (zero > 0, `${act}: the force never goes to zero`);
            assert (fastest (sent) <= slew_limit, `${act}: ${fastest (sent)} N/s`);
            for (const one of sent.slice (zero))
                assert (one.size <= force_limit * (one.at - sent[zero].at) / 1e3 / ramp_s + 1e-6);
            assert (most (sent.slice (zero)) > 0.5);
        }
    },

    async 'requests that come while the force fades keep their order'()
    {
        const page = await pressing();
        await page.choose ('two_fingers');
        page.post ({ show: 1 });
        page.post ({ hand: { role: 1, wanted: [0, 0, -0.01] } });
        page.post ({ turn: { name: page.about.controls[0].name, position: 0.9 } });
        page.post ({ record: true });
        await page.run (0.5, { position: above });
        page.post ({ record: false });
        await page.run (0.1, { position: above });
        assert.equal (page.recorded.positions.length, 2);
        assert (page.recorded.positions[0].length > 3 * 1000);
        assert (page.state.positions[1][2] < -0.001);
        assert.equal (page.engine.knobs[page.about.controls[0].name], 0.9);
    },

    async 'a neutral report that is refused is sent again, and nothing else before the device takes it'()
    {
        const page = await pressing();
        page.device.refuses = true;
        await page.run (0.5, { position: pressed });   // refused forces count as silence
        assert (page.device.refused > 40);
        page.device.refuses = false;
        let sent = await page.run (1, { position: pressed });
        assert.equal (sent[0].drives, 0);
        assertRises (sent);
        assert (sent.at (-1).size > 1.9);
        page.device.refuses = true;
        page.hid.stop();
        page.post ({ stop: true });
        await page.run (0.1, { position: pressed });
        page.device.refuses = false;
        sent = await page.run (0.1, { position: pressed });
        assert.deepEqual (sent.map (one => one.drives), [0]);
        page.device.refuses = true;
        const closed = page.hid.close();
        await page.run (0.1);
        assert (! page.device.is_closed);
        page.device.refuses = false;
        sent = await page.run (0.1);
        await closed;
        assert.deepEqual (sent.map (one => one.drives), [0]);
        assert (page.device.is_closed);
    },

    async 'a device that takes its time gets one report at a time, and then rests'()
    {
        const page = await pressing(), send = page.device.sendReport.bind (page.device), held = [];
        page.device.sendReport = (...report) => new Promise (done => held.push (() => send (...report).then (done)));
        await page.run (0.5, { position: pressed });
        assert.equal (held.length, 2);   // one with a force, and the neutral one
        page.device.sendReport = send;
        const before = page.device.sent.length;
        held.forEach (take => take());
        await page.run (1, { position: pressed });
        const sent = page.device.sent.slice (before);
        assert.deepEqual (sent.slice (0, 3).map (one => one.drives), [1, 0, 1]);
        assertRises (sent);
        assert (sent.at (-1).size > 1.9);
    },

    async 'a DualSense rumbles within its limits, and a stop ends that'()
    {
        const stroke = async (page, seconds) => {
            const sent = [];
            for (let t = 0; t < seconds; t += 0.02)
            {
                page.post ({ hand: { role: 0, wanted: [0.02 * Math.sin (40 * t), 0, -0.004 * (1 + Math.sin (60 * t))] } });
                sent.push (...await page.run (0.02));
            }
            return sent;
        };
        const soft = { ...pads, limits: { ...pads.limits, max_signal: 0.1, max_signal_slew: '2 1/s' } };
        for (const [profile, size, slew] of [[pads, 1, 6300], [soft, 0.1, 2]])
        {
            const page = await Page.open ('dry_wood');
            page.connect (profile);
            const sent = await stroke (page, 1), unit = 0.5 / 255 + 1e-9;
            assert (most (sent) > 0.05 && most (sent) <= size + unit);
            sent.slice (1).forEach ((one, i) => assert (Math.abs (one.size - sent[i].size) <= slew * (one.at - sent[i].at) / 1e3 + 2 * unit));
            const driven = sent.filter (one => one.at < sent[0].at + 50);
            driven.forEach (one => assert (one.size <= size * (one.at - sent[0].at) / 50 + unit, 'it follows the ramp of the profile'));
        }
        const page = await Page.open ('dry_wood');
        page.connect (pads);
        await stroke (page, 1);
        while (page.state.rumble < 0.1)
            await stroke (page, 0.02);
        page.engine.graph.emergencyStop();   // a stop of the guard
        const at = monotonic, sent = await page.run (0.2);
        assert.equal (most (sent.filter (one => one.at > at + 15)), 0);   // the fade of 5 ms, a quantum and two reports
        await page.run (0.2);
        assert.equal (page.state.latched, 'emergency');
    },

    async 'what a board says of itself is heard: alarms, numbers, clock, malformed and lost reports'()
    {
        const said = {
            'the device reports that a motor is too hot': () => ({ flags: 0b1011 }),
            'the device reports that its watchdog has released the motors': () => ({ flags: 0b111 }),
            'the device reports that its motors are not driven': () => ({ flags: 0b01 }),
            'the device reports that it does not know its position': () => ({ flags: 0b10 }),
            'the device repeats the same report': page => ({ number: page.device.number }),
            'the clock of the device has stopped': page => ({ at_ms: page.stopped_at ??= monotonic }),
            'the report number or the clock of the device went back, as after a restart': page => ({ number: page.device.number + (++page.old % 2 ? 0 : 5) }),
            "more than half of the device's reports are missing": page => ({ number: page.device.number += 15 }),
            'the latest report of the device is malformed': () => ({ size: 20 }),
        };
        for (const [why, says] of Object.entries (said))
        {
            const page = await pressing();
            page.old = 0;
            page.says = () => says (page);
            let sent = await page.run (0.3, { position: pressed });
            assert.equal (page.hid.reading.fault, why);
            assert.deepEqual (page.state.stops, ['stale'], why);
            const late = sent.filter (one => one.at > sent[0].at + 120);   // the board's own 50 ms, or 32 reports, and the fade
            assert (late.length > 0 && most (late) === 0, `${why}: ${most (late)} N`);
            page.says = undefined;
            page.device.number += 5;
            sent = await page.run (1, { position: pressed });
            assert (sent.at (-1).size > 1.9, `${why}: ${sent.at (-1).size} N, ${page.hid.reading.fault}`);
            const zero = sent.findLastIndex (one => one.size === 0);
            for (const one of sent.slice (zero))
                assert (one.size <= force_limit * (one.at - sent[zero].at + 2 * quantum_ms) / 1e3 / ramp_s + 1e-6, `${why}: a step`);
        }
    },

    async 'the module fails: the board gets its neutral report, and nothing else for good'()
    {
        const page = await pressing(), log = console.error;
        console.error = () => {};
        page.hid.reports.wasm = { ...page.hid.reports.wasm, drive() { throw new WebAssembly.RuntimeError ('unreachable'); }, rest() { throw new Error(); } };
        const sent = await page.run (0.1, { position: pressed });
        page.hid.rearm();
        sent.push (...await page.run (0.5, { position: pressed }));
        console.error = log;
        assert.deepEqual (sent.map (one => one.drives), [0]);
    },

    async 'states of another connection are not used'()
    {
        const page = await pressing(), old = { ...page.state, device: { ...page.state.device, rest: 1 } };
        page.post ({ hand: { role: 0, wanted: pressed } });
        await Promise.all ([page.hid.close(), page.run (0.1)]);
        assert.equal (page.device.sent.at (-1).drives, 0);
        await page.run (0.5);
        assert (Math.hypot (...page.state.efforts[0].force) > 1);   // the mouse has the hand again
        page.connect (boards);
        page.hid.watch();   // the neutral report
        for (let i = 0; i < 5; ++i)
        {
            monotonic += quantum_ms;
            wall += quantum_ms;
            page.hid.receive ({ ...old, at: Date.now() });
            await new Promise (setImmediate);
        }
        assert.deepEqual (page.device.sent.map (one => one.drives), [0]);
        page.post ({ device: null, hand: { role: 0, wanted: above } });
        await page.run (0.2, { position: above });
        page.use();
        await page.run (0.011);
        assert.deepEqual (page.state.stops, ['stale']);   // the last reading was that of another connection
    },
};

for (const [name, test] of Object.entries (tests))
{
    await test();
    console.log (`ok: ${name}`);
}
