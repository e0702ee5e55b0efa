// SPDX-License-Identifier: MIT
// The types of the options and messages of the AudioWorklet.
import { Stop } from './tactus_graph.js';

/** The processorOptions of the AudioWorkletNode. */
export interface Options
{
    module: WebAssembly.Module;
    gain?: number;    // of the sound, per N; default 1
    role?: string;    // that the page moves and hears; default: the first
    sound?: string;   // the recorded port that is played; default: the sum of the components of the force of the role
}

/** What a page posts to the port of the node. Of what cannot be taken, such as a number that is not finite, nothing is done. */
export interface ToWorklet
{
    position?: ArrayLike<number>;   // of the tool, in m; the graph begins with the first one
    rotation?: ArrayLike<number>;   // in rad
    jump?: boolean;                 // the tool is lifted and put down there: the force fades, and the way between is no speed
    role?: string;                  // of the tool, if not that of the options
    turn?: Record<string, number>;     // controls, 0 to 1
    set?: Record<string, number>;      // parameters
    strike?: Record<string, number>;   // hits, in m/s
    stop?: boolean;                 // the emergency stop
    rearm?: boolean;                // ends a latched stop: only after an act of a person
    end?: boolean;                  // ends the processor
}

/** What the node posts: 20 times a second what is felt, once there is a position, and why something was refused. */
export type FromWorklet = { level: number; force: number[]; stop: Stop; latched: boolean; refused?: undefined }
    | { refused: string; level?: undefined; force?: undefined; stop?: undefined; latched?: undefined };
