// SPDX-License-Identifier: MIT
import { HidDevice } from './hid.js';
import { drawPad, drawScope } from './picture.js';
import { linksOf } from './recording.js';
import { heightsOf } from './scene.js';

const $ = id => document.getElementById (id);
const pad = $('pad'), scope = $('scope');
const words = { none: '', not_finite: 'a reading is not a number', stale: 'the device is silent', starved: 'the engine is too slow',
                released: 'a button is released', halted: 'the device comes to rest first', speed: 'the hand was too fast', impulse: 'it pushed for too long',
                energy: 'it gave too much energy', limit: 'a limit was exceeded', emergency: 'you stopped it' };   // emergency: see stopHere

const longest_rumble_ms = 100;

const pages = new BroadcastChannel ('tactus-stop');   // all pages of this origin

let presets = [], preset = null, about = null, module_bytes = null;
let engine = null, context = null, device = null, recording = false, is_stopped = false, is_kept = false;
let state = { positions: [], efforts: [], stops: [], rumble: 0 }, reason;
let heights = null, wanted = [], chosen = 0, pressing = new Map(), forces = [], trail = [];

function say (text) { $('status').textContent = text; }

//==============================================================================
// Presets, and the address that holds preset and knobs.

function readAddress() { return Object.fromEntries (new URLSearchParams (location.hash.slice (1))); }

function knobs() { return Object.fromEntries (about.controls.map (control => [control.name, Number ($('knob-' + control.name).value)])); }

function writeAddress()
{
    const all = new URLSearchParams ({ preset: preset.id });
    for (const control of about.controls)
        if (knobs()[control.name] !== control.value) all.set (control.name, knobs()[control.name]);
    history.replaceState (null, '', '#' + all);
}

async function choose (id)
{
    const next = presets.find (one => one.id === id) ?? presets.find (one => one.id === 'dry_wood') ?? presets[0];
    say (`Loading ${next.title}…`);
    const [{ about: loaded }, answer] = await Promise.all ([import (`./graphs/${next.id}.js`), fetch (`graphs/${next.id}.wasm`)]);
    if (! answer.ok) throw new Error (`${next.title} cannot be loaded: ${answer.status}`);
    module_bytes = await answer.arrayBuffer();
    preset = next;
    about = loaded;
    wanted = about.roles.map (role => start (role.name));
    state = { positions: wanted.map (one => [...one]), efforts: [], stops: [], rumble: 0 };
    reason = undefined;
    trail = [];
    forces = [];
    makeKnobs();
    makeHands();
    $('preset').value = preset.id;
    $('view').value = preset.view;
    $('about').textContent = about.about;
    if (engine) load();
    else say (matchMedia ('(pointer: coarse)').matches ? 'Tap the picture once, then drag in it.' : 'Press and drag in the picture.');
    writeAddress();
    look();
}

function makeKnobs()
{
    const given = readAddress();
    $('knobs').replaceChildren (...about.controls.map (control => {
        const row = document.createElement ('div'), label = document.createElement ('label'), slider = document.createElement ('input'),
              output = document.createElement ('output');
        row.className = 'knob';
        slider.type = 'range';
        slider.id = label.htmlFor = 'knob-' + control.name;
        slider.min = 0;
        slider.max = 1;
        slider.step = 'any';
        const asked = Number (given.preset === preset.id ? given[control.name] ?? control.value : control.value);
        slider.value = Number.isFinite (asked) ? asked : control.value;
        label.textContent = control.title;
        output.htmlFor = slider.id;
        const show = () => { output.textContent = Number (slider.value).toFixed (2); };
        slider.addEventListener ('input', () => {
            show();
            engine?.port.postMessage ({ turn: { name: control.name, position: Number (slider.value) } });
        });
        slider.addEventListener ('change', writeAddress);
        show();
        row.append (label, slider, output);
        return row;
    }));
}

function makeHands()
{
    chosen = 0;
    $('hands').hidden = about.roles.length < 2;
    $('hand').replaceChildren (...about.roles.map ((role, i) => new Option (role.name, i)));
}

/** Finds the surface that the chosen hand meets in this view. */
async function look()
{
    heights = null;
    const of = preset, found = await heightsOf (module_bytes, about, chosen, box (about.roles[chosen].name), $('view').value === 'above');
    if (of === preset) heights = found;
}

function box (role) { return preset.boxes[role]; }
function start (role) { return box (role).map (([low, high], axis) => axis === 2 ? high : (low + high) / 2); }

//==============================================================================
// The engine.

async function begin()
{
    if (context)
    {
        await context.resume();
        return;
    }
    if (! window.AudioWorkletNode || ! window.isSecureContext)
        throw new Error ('this page needs an AudioWorklet, which browsers have only on https and on localhost');
    context = new AudioContext ({ latencyHint: 'interactive' });
    await context.audioWorklet.addModule ('engine.js');
    engine = new AudioWorkletNode (context, 'tactus-engine', { numberOfInputs: 0, outputChannelCount: [1] });
    engine.port.onmessage = ({ data }) => receive (data);
    engine.onprocessorerror = () => { say ('The engine has failed. Load the page again.'); device?.stop(); };
    engine.connect (context.destination);
    load();
    await context.resume();
}

function load()
{
    if (is_stopped) engine.port.postMessage ({ stop: true });
    engine.port.postMessage ({ load: { bytes: module_bytes, about, knobs: knobs(), starts: wanted } });
    engine.port.postMessage ({ show: chosen });
    engine.port.postMessage ({ volume: Number ($('volume').value) });
    useDevice();
}

function receive (data)
{
    if (data.loaded && ! is_kept) keepForLater().catch (() => {});   // it works without
    is_kept ||= data.loaded !== undefined;
    if (data.loaded === about.name) say (`${about.title} is running.`);
    if (data.recorded) keepRecording (data.recorded);
    if (! data.state) return;
    device?.receive (data.state);
    if (data.state.positions.length !== about.roles.length) return;
    state = data.state;
    for (let i = 0; i < state.scope.length; i += 3)
        forces.push (state.scope.slice (i, i + 3));
    forces.splice (0, Math.max (0, forces.length - 2000));
    const now = state.latched ?? state.stops[device?.role ?? chosen];
    if (now === reason || (now === 'halted' && ! device)) return;
    if (now !== 'none') quiet();
    $('rearm').hidden = ! state.latched;
    if (now !== 'none') say (`No force: ${(now === 'stale' && device?.hasForce && device.reading?.fault) || words[now]}.`);
    else if (reason !== undefined) say (`${about.title} is running.`);
    reason = now;
}

/** A stop of this page alone, and who or what caused it. */
function stopHere (why)
{
    is_stopped = true;
    words.emergency = why;
    device?.stop();
    engine?.port.postMessage ({ stop: true });
    $('rearm').hidden = false;
    say (`No force: ${words.emergency}.`);
    quiet();
}

/** What a person stops in one page, the person stops in all of them, and each has its own START. */
function stop()
{
    pages.postMessage ('stop');
    stopHere ('you stopped it');
}

pages.onmessage = () => stopHere ('you stopped it in another tab');

function rearm()
{
    is_stopped = false;
    device?.rearm();
    engine?.port.postMessage ({ rearm: true });
    $('rearm').hidden = true;
    reason = undefined;   // a stop that has not ended is shown again
    say (about ? `${about.title} is running.` : '');
}

/** Keeps the page and what it has loaded, so that it opens without its server, too: offline.js keeps what it is asked for. */
async function keepForLater()
{
    const workers = navigator.serviceWorker;
    if (! workers) return;
    const page = location.href.split ('#')[0];
    const keep = () => {
        const loaded = performance.getEntriesByType ('resource').map (one => one.name).filter (name => name.startsWith (new URL ('.', page).href));
        const needed = ['engine.js', 'graphs/tactus_graph.js', 'profiles.json', 'reports.wasm'].map (name => new URL (name, page).href);
        return Promise.all ([...new Set ([page, ...needed, ...loaded])].map (url => fetch (url)));
    };
    workers.addEventListener ('controllerchange', keep);   // the first worker, or that of a new build, which has kept nothing so far
    await workers.register ('offline.js');
    if (workers.controller) await keep();
}

//==============================================================================
// The hand: mouse, pen, touch, keyboard.

function axes() { return $('view').value === 'side' ? [0, 2] : [0, 1]; }

function toPlace (role, x, y)
{
    const [across, up] = axes(), limits = box (role);
    const place = [...wanted[about.roles.findIndex (one => one.name === role)]];
    place[across] = limits[across][0] + x * (limits[across][1] - limits[across][0]);
    place[up] = limits[up][1] - y * (limits[up][1] - limits[up][0]);
    return place;
}

function toPicture (role, place)
{
    const [across, up] = axes(), limits = box (role);
    return [(place[across] - limits[across][0]) / (limits[across][1] - limits[across][0]), (limits[up][1] - place[up]) / (limits[up][1] - limits[up][0])];
}

function send (i)
{
    engine?.port.postMessage ({ hand: { role: i, wanted: wanted[i] } });
}

/** A pen or finger that measures pressure presses deeper; from above, the slider does so where nothing is measured. */
function moveHand (i, x, y, pressure)
{
    const role = about.roles[i].name, [, , [low, high]] = box (role);
    wanted[i] = toPlace (role, x, y);
    if ($('view').value === 'above') wanted[i][2] = high + (pressure ?? Number ($('press').value)) * (low - high);
    else if (pressure !== undefined) wanted[i][2] -= 0.5 * pressure * (high - low);
    send (i);
}

function pointer (event)
{
    const edges = pad.getBoundingClientRect();
    const measured = event.pointerType !== 'mouse' && event.pressure > 0 && event.pressure !== 0.5 ? event.pressure : undefined;
    moveHand (pressing.get (event.pointerId), (event.clientX - edges.left) / edges.width, (event.clientY - edges.top) / edges.height, measured);
}

pad.addEventListener ('pointerdown', async event => {
    event.preventDefault();
    pad.focus();
    const others = [...pressing.values()];
    pressing.set (event.pointerId, others.includes (chosen) && about.roles.length > 1 ? about.roles.findIndex ((_, i) => ! others.includes (i)) : chosen);
    if (pressing.get (event.pointerId) < 0) pressing.set (event.pointerId, chosen);
    pad.setPointerCapture (event.pointerId);
    pointer (event);
    if (event.pointerType !== 'mouse' && ! context) return;   // browsers let a touch start sound only when it ends
    await begin().catch (error => say (error.message));
    send (chosen);
});
pad.addEventListener ('pointermove', event => {
    if (! pressing.has (event.pointerId)) return;
    for (const one of event.getCoalescedEvents?.().slice (-1) ?? [])
        if (one.clientX !== undefined) pointer (event);
});
for (const end of ['pointerup', 'pointercancel'])
    pad.addEventListener (end, event => {
        if (! pressing.has (event.pointerId)) return;
        const i = pressing.get (event.pointerId);
        pressing.delete (event.pointerId);
        wanted[i] = [wanted[i][0], wanted[i][1], start (about.roles[i].name)[2]];   // the hand lifts
        send (i);
        if (end === 'pointerup') begin().catch (error => say (error.message));
    });

pad.addEventListener ('keydown', async event => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (! step) return;
    event.preventDefault();
    const role = about.roles[chosen].name, [x, y] = toPicture (role, wanted[chosen]);
    const clamp = value => Math.min (1, Math.max (0, value));
    wanted[chosen] = toPlace (role, clamp (x + 0.02 * step[0]), clamp (y + 0.02 * step[1]));
    await begin().catch (error => say (error.message));
    send (chosen);
});
document.addEventListener ('keydown', event => { if (event.key === 'Escape') stop(); });

//==============================================================================
// Gamepads and HID.

function quiet()
{
    for (const one of navigator.getGamepads?.() ?? [])
        one?.vibrationActuator?.reset?.();
}

function gamepads()
{
    const all = [...navigator.getGamepads?.() ?? []].filter (one => one);
    const one = all.find (found => found.vibrationActuator) ?? all[0];
    if (! one || ! about) return;
    $('pads').textContent = `${one.id.split (' (')[0]} moves the hand with its left stick${one.vibrationActuator ? ' and rumbles' : '; it cannot rumble here'}.`;
    const [x, y] = one.axes;
    if (Math.hypot (x, y) > 0.15 && pressing.size === 0 && ! device?.hasForce)
        moveHand (chosen, 0.5 + 0.5 * x, 0.5 + 0.5 * y);
    if (one.buttons[1]?.pressed) stop();
    if (state.rumble > 0.02 && reason === 'none' && Date.now() - state.at < longest_rumble_ms)
        one.vibrationActuator?.playEffect ('dual-rumble', { duration: longest_rumble_ms, strongMagnitude: state.rumble, weakMagnitude: state.rumble });
}

/** A device that has a force stays in the role that it gets here, whichever hand is chosen later. */
function useDevice()
{
    if (! device) return;
    device.role = device.hasForce ? chosen : undefined;
    device.use (message => engine.port.postMessage (message), device.role);
    const role = about.roles.length > 1 && device.hasForce ? ` as ${about.roles[chosen].name}` : '';
    $('device').textContent = `${device.name} is connected${role}.`;
}

async function connect()
{
    if (! navigator.hid) throw new Error ('this browser has no WebHID; Chromium and Edge do');
    const { profiles } = await (await fetch ('profiles.json')).json();
    await begin();
    const choice = await HidDevice.choose (profiles);
    if (! choice) return;
    if (device) await disconnect();
    const found = device = await HidDevice.open (choice);
    device.onreading = reading => {
        if (found.hasForce) engine.port.postMessage ({ reading });
        else if (Math.hypot (...reading.stick) > 0.15) moveHand (chosen, 0.5 + 0.5 * reading.stick[0], 0.5 - 0.5 * reading.stick[1]);
    };
    if (is_stopped) device.stop();
    useDevice();
    $('disconnect').hidden = false;
}

async function disconnect()
{
    const gone = device;
    device = null;
    $('disconnect').hidden = true;
    $('device').textContent = '';
    await gone?.close();
}

$('connect').addEventListener ('click', () => connect().catch (error => { $('device').textContent = error.message; }));
$('disconnect').addEventListener ('click', disconnect);
navigator.hid?.addEventListener ('disconnect', event => { if (event.device === device?.device) disconnect(); });
/** The page ends, or is frozen or kept for the way back: its device rests, and is free for another page. */
function leave()
{
    if (device) stopHere ('this page was left');
    device?.abandon();
    quiet();
}

/** A page that comes back may have missed a stop of another page. */
function comeBack()
{
    stopHere ('this page was left');
    disconnect();
}

addEventListener ('pagehide', leave);
addEventListener ('pageshow', event => { if (event.persisted) comeBack(); });
document.addEventListener ('freeze', leave);
document.addEventListener ('resume', comeBack);
document.addEventListener ('visibilitychange', () => { if (document.hidden && device) stopHere ('this tab was hidden'); });

//==============================================================================
// Recording.

function keepRecording (recorded)
{
    for (const old of $('traces').querySelectorAll ('a'))
        URL.revokeObjectURL (old.href);
    $('traces').replaceChildren (...linksOf (preset.id, about, recorded));
    recording = false;
    $('record').setAttribute ('aria-pressed', 'false');
    $('record').textContent = 'Record';
}

$('record').addEventListener ('click', async () => {
    await begin().catch (error => say (error.message));
    recording = ! recording;
    engine.port.postMessage ({ record: recording });
    if (! recording) return;
    $('record').setAttribute ('aria-pressed', 'true');
    $('record').textContent = 'End the recording';
    $('traces').replaceChildren();
});

//==============================================================================

function draw()
{
    if (about)
    {
        drawPad (pad, { about, heights, state, wanted, chosen, trail, axes: axes(), depths: box (about.roles[chosen].name)[2], toPicture });
        drawScope (scope, forces);
        const force = state.efforts[chosen]?.force ?? [0, 0, 0];
        $('force').textContent = `${Math.hypot (...force).toFixed (2)} N`;
    }
    requestAnimationFrame (draw);
}

$('stop').addEventListener ('click', stop);
$('rearm').addEventListener ('click', rearm);
$('preset').addEventListener ('change', () => choose ($('preset').value).catch (error => say (error.message)));
$('hand').addEventListener ('change', () => {
    chosen = Number ($('hand').value);
    trail = [];
    engine?.port.postMessage ({ show: chosen });
    look();
});
$('view').addEventListener ('change', () => { trail = []; look(); });
$('volume').addEventListener ('input', () => engine?.port.postMessage ({ volume: Number ($('volume').value) }));
$('link').addEventListener ('click', async () => {
    writeAddress();
    await navigator.clipboard?.writeText (location.href).then (() => say ('The link is copied.'), () => say (location.href));
});
addEventListener ('hashchange', () => choose (readAddress().preset).catch (error => say (error.message)));
setInterval (gamepads, 50);

presets = (await (await fetch ('presets.json')).json()).presets;
$('preset').replaceChildren (...presets.map (one => new Option (one.title, one.id)));
await choose (readAddress().preset).catch (error => say (error.message));
draw();
