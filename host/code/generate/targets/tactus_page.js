// SPDX-License-Identifier: MIT
// Plays a graph on a page: a pointer moves a tool, and its force becomes sound and the rumble of a gamepad. tactus_page.d.ts has the options.
import { checkNumber, compile } from './tactus_graph.js';

const usual = { gain: 1, rumble: 10, position: ({ x, y, pressed }) => [1e-4 * x, 1e-4 * y, pressed ? -2e-4 : 2e-4], felt: () => {} };

/** A graph on the audio thread, with the pointer over an element. The sound begins with the first press, because browsers let no page sound before. */
export class Player
{
    node = null;       // of the AudioWorklet, once there is a sound
    last = null;       // event of the pointer
    pressed = false;
    waiting = [];      // messages to the node

    /** files: the addresses `module` and `worklet` of an export with this name. */
    constructor (name, files, element, options = {})
    {
        Object.assign (this, { name, element, options: { ...files, ...usual, ...options } });
        for (const number of ['gain', 'rumble'])
            checkNumber (this.options[number], number, 'give one, in 1/N');
        const { signal } = this.listening = new AbortController(), on = (target, type, act) => target.addEventListener (type, event =>
        {
            if (event.isPrimary) act (event);
        }, { signal });
        const { module } = this.options;
        this.module = module instanceof WebAssembly.Module ? Promise.resolve (module) : compile (module);
        this.module.catch (why => this.refuse (why));
        on (element, 'pointerenter', event => this.move (event, true));
        on (element, 'pointerdown', event => this.press (event));
        on (window, 'pointermove', event => this.move (event));
        for (const end of ['pointerup', 'pointercancel'])
            on (window, end, event => this.release (event));
    }

    /** Sends a message to the processor: now, or when the sound begins. */
    post (message)
    {
        if (this.node === null) this.waiting.push (message);
        else this.node.port.postMessage (message);
    }

    /** Ends all that the call began. */
    close()
    {
        this.listening.abort();
        this.node?.port.postMessage ({ end: true });
        this.node?.disconnect();
        if (this.options.destination === undefined) this.sound?.close();
    }

    refuse (why) { this.options.felt ({ refused: why.message }); }

    press (event)
    {
        this.pressed = true;
        this.move (event, true);
        this.node?.port.postMessage ({ rearm: true });   // a press is an act of a person
        this.begun ??= this.begin().catch (why => this.refuse (why));
    }

    release (event)
    {
        this.pressed = false;
        this.move (event);
        this.sound?.resume();   // a touch lets a page sound only when it ends
    }

    /** A pointer that leaps touches nothing on its way. */
    move (event, jump = false)
    {
        this.last = event;
        if (this.node === null) return;
        const { left, top, width, height } = this.element.getBoundingClientRect(), { clientX, clientY, pressure } = event;
        const place = pressed => this.options.position ({ x: clientX - left - width / 2, y: top + height / 2 - clientY, pressed, pressure });
        if (jump) this.post ({ position: place (false), jump });
        this.post ({ position: place (this.pressed) });
    }

    async begin()
    {
        const { destination, worklet, gain, role, sound } = this.options;
        this.sound = destination?.context ?? new AudioContext();
        if (this.sound.audioWorklet === undefined) throw new Error ('browsers have AudioWorklet only at https: and localhost');
        await this.sound.audioWorklet.addModule (worklet);
        const module = await this.module;
        if (this.listening.signal.aborted) return;
        this.node = new AudioWorkletNode (this.sound, this.name, { processorOptions: { module, gain, role, sound } });
        this.node.connect (destination ?? this.sound.destination);
        this.node.port.onmessage = ({ data }) => this.feel (data);
        this.node.onprocessorerror = () => this.refuse (new Error (`the AudioWorklet ${this.name} has ended; the console of the browser says why`));
        this.waiting.splice (0).forEach (message => this.post (message));
        this.move (this.last, true);
    }

    feel (data)
    {
        const weakMagnitude = Math.min (1, this.options.rumble * (data.level ?? 0)), pad = navigator.getGamepads?.().find (one => one?.vibrationActuator);
        if (weakMagnitude > 0.01) pad?.vibrationActuator.playEffect ('dual-rumble', { duration: 100, weakMagnitude })?.catch (() => {});   // it may be gone
        this.options.felt (data);
    }
}
