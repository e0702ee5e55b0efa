// SPDX-License-Identifier: MIT
// The module reports.wasm: what the program itself uses to read profiles, to read and judge reports, and to write them (docs/site/reports).
const text_of = new TextDecoder(), bytes_of = new TextEncoder();

/** A device as its profile describes it. `about` says what the page has to know of it, with limits in SI units by the names that a guard gives them. */
export class Reports
{
    /** Compiles the module, once for all devices. */
    static async compile (address = new URL ('reports.wasm', import.meta.url))
    {
        const answer = await fetch (address);
        if (! answer.ok) throw new Error (`${address} cannot be loaded: ${answer.status}`);
        return WebAssembly.compile (await answer.arrayBuffer());
    }

    /** Throws if the profile has errors. */
    static async open (module, profile)
    {
        return new Reports (await WebAssembly.instantiate (module), profile);
    }

    constructor ({ exports: wasm }, profile)
    {
        wasm._initialize();
        this.wasm = wasm;
        const is_open = wasm.open (this.give (bytes_of.encode (JSON.stringify (profile)))), answer = text_of.decode (this.answer());
        if (! is_open) throw new Error (`the profile ${profile.id} cannot be used: ${answer}`);
        this.about = JSON.parse (answer);
        this.at_rest = this.rest();
    }

    /** Passes bytes, and returns how many. */
    give (bytes)
    {
        new Uint8Array (this.wasm.memory.buffer, this.wasm.input (bytes.length), bytes.length).set (bytes);
        return bytes.length;
    }

    answer() { return new Uint8Array (this.wasm.memory.buffer, this.wasm.answer(), this.wasm.answer_size()).slice(); }

    /** How well the profile fits a device of WebHID; 0: not at all. */
    fit ({ vendorId, productId, productName, collections })
    {
        const places = collections.length > 0 ? collections : [{ usagePage: 0, usage: 0 }];
        return Math.max (...places.map (({ usagePage, usage }) => this.wasm.fit (vendorId, productId, usagePage, usage, this.give (bytes_of.encode (productName)))));
    }

    /** Takes a report as WebHID gives it, and returns the reading. `driven_s`: for how long the motors have been driven. */
    take (id, data, at_ms, driven_s)
    {
        const body = new Uint8Array (data.buffer, data.byteOffset, data.byteLength);
        this.wasm.take (this.give (id === 0 ? body : Uint8Array.of (id, ...body)), at_ms, driven_s);
        const all = new Float64Array (this.wasm.memory.buffer, this.wasm.reading(), 11 + this.about.axes.length);
        return { position: [...all.subarray (0, 3)], rotation: [...all.subarray (3, 6)], pressure: all[6], age: all[7], valid: all[8] === 1,
                 fault: this.about.faults[all[9]], buttons: all[10], axes: Object.fromEntries (this.about.axes.map ((name, i) => [name, all[11 + i]])) };
    }

    /** The report that drives the device with this effort; the first byte is its id, or 0. */
    drive ({ force, torque }, rumble, passed_s, age_s)
    {
        new Float64Array (this.wasm.memory.buffer, this.wasm.effort(), 7).set ([...force, ...torque, rumble]);
        this.wasm.drive (passed_s, age_s);
        return this.answer();
    }

    /** The report that asks for nothing, and lets the motors go. If the module has failed, as it was at the beginning. */
    rest()
    {
        try
        {
            this.wasm.rest();
            return this.answer();
        }
        catch (error)
        {
            if (! this.at_rest) throw error;
            return this.at_rest;
        }
    }
}
