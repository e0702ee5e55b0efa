// SPDX-License-Identifier: MIT
// The types of tactus_graph.js.

/** What a device reports, in SI units. Vectors are arrays of three numbers in the memory of the module: set their elements. */
export interface Reading
{
    readonly position: Float64Array;
    readonly rotation: Float64Array;
    pressure: number;
    age: number;
    valid: boolean;
    buttons: number;
    readonly true_position: Float64Array;
    readonly true_velocity: Float64Array;
    readonly unrendered_force: Float64Array;
    readonly unrendered_torque: Float64Array;
    readonly axes: Float64Array;
    readonly signals: Float64Array;
}

/** What a device should apply, in SI units. */
export interface Effort
{
    readonly force: Float64Array;
    readonly torque: Float64Array;
    readonly brake?: number;
    readonly axes: Float64Array;
    readonly signals: Float64Array;
}

export interface Port { readonly name: string; readonly member: string; readonly unit: string; readonly count?: number; }
export interface RoleAbout
{
    readonly name: string;
    readonly member: string;
    readonly axes: readonly string[];
    readonly efforts: readonly string[];
    readonly signal_inputs: number;
    readonly signal_outputs: number;
    readonly has_brake: boolean;
    readonly mass: number;      // of the tool of a simulated device, kg
    readonly damping: number;   // of the same, N s/m
}
export interface ParamAbout
{
    readonly name: string;
    readonly unit: string;
    readonly about: string;
    readonly value: number;
    readonly min: number | null;
    readonly max: number | null;
    readonly choices?: readonly string[];
}
export interface ControlAbout { readonly name: string; readonly title: string; readonly value: number; readonly moves: readonly string[]; }
export interface About
{
    readonly name: string;
    readonly title: string;
    readonly about: string;
    readonly rate_hz: number;
    readonly roles: readonly RoleAbout[];
    readonly feeds: readonly Port[];
    readonly records: readonly Port[];
    readonly params: readonly ParamAbout[];
    readonly controls: readonly ControlAbout[];
    readonly hits: readonly { readonly name: string }[];
    readonly limits: readonly string[];
}
export type Stop = 'none' | 'not_finite' | 'stale' | 'starved' | 'released' | 'halted' | 'speed' | 'impulse' | 'energy' | 'emergency';

export function compile (address: string | URL): Promise<WebAssembly.Module>;

export class Graph<Inputs = any, Outputs = any, Param extends string = string, Control extends string = string, Hit extends string = string,
                   Role extends string = string>
{
    constructor (module: WebAssembly.Module, about: About);
    readonly about: About;
    readonly inputs: Inputs;
    readonly outputs: Outputs;
    tick (this: void): void;
    prepare (ticks_per_second: number): boolean;
    set (param: Param, value: number): void;
    get (param: Param): number;
    turn (control: Control, position: number): void;
    strike (hit: Hit, speed: number): void;
    tighten (role: Role, limits: Readonly<Record<string, number>>): boolean;
    limitsOf (role: Role): Record<string, number>;
    stop (role: Role): Stop;
    isLatched (role: Role): boolean;
    halt(): void;
    resume(): void;
    emergencyStop(): void;
    rearm(): void;
    loseTime (seconds: number): void;
}
