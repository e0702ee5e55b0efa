// SPDX-License-Identifier: MIT
// The types of tactus_page.js.
import { FromWorklet, Options, ToWorklet } from './tactus_worklet.js';

/** Where a pointer is, in pixels from the middle of the element; y is upwards. */
export interface Pointer { readonly x: number; readonly y: number; readonly pressed: boolean; readonly pressure: number; }

export interface PlayOptions extends Partial<Omit<Options, 'module'>>
{
    rumble?: number;                             // of a gamepad, per N; default 10, which is all of it at 0.1 N; 0: none
    position?: (at: Pointer) => ArrayLike<number>;   // of the tool, in m; default: 0.1 mm for each pixel, 0.2 mm below z = 0 if pressed, else above
    felt?: (data: FromWorklet) => void;          // 20 times a second, and where something was refused
    destination?: AudioNode;                     // where the sound goes; default: an AudioContext of its own
    module?: string | URL | WebAssembly.Module;  // default: NAME.wasm beside the script
    worklet?: string | URL;                      // of the AudioWorklet; default: NAME_worklet.js beside the script
}

export class Player
{
    constructor (name: string, files: { module: string | URL; worklet: string | URL }, element: Element, options?: PlayOptions);
    readonly node: AudioWorkletNode | null;      // null before the first press
    post (message: ToWorklet): void;             // sends it when the sound begins, or at once
    close(): void;
}
