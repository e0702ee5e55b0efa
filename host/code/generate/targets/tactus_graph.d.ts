// SPDX-License-Identifier: MIT
// The types of tactus_graph.js.

/** What a device reports, in SI units. Vectors are arrays of numbers in the memory of the module. What is assigned to them is copied. */
export interface Reading
{
    get position(): Float64Array;
    set position (values: ArrayLike<number>);
    get rotation(): Float64Array;
    set rotation (values: ArrayLike<number>);
    pressure: number;
    age: number;
    valid: boolean;
    buttons: number;
    get true_position(): Float64Array;
    set true_position (values: ArrayLike<number>);
    get true_velocity(): Float64Array;
    set true_velocity (values: ArrayLike<number>);
    get unrendered_force(): Float64Array;
    set unrendered_force (values: ArrayLike<number>);
    get unrendered_torque(): Float64Array;
    set unrendered_torque (values: ArrayLike<number>);
    get axes(): Float64Array;
    set axes (values: ArrayLike<number>);
    get signals(): Float64Array;
    set signals (values: ArrayLike<number>);
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
    readonly min: number | null;        // of the usual range, for a slider
    readonly max: number | null;
    readonly hard_min: number | null;   // values are clamped to these
    readonly hard_max: number | null;
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
    readonly digest: number;   // of the export: that of the module must be the same
}
export type Stop = 'none' | 'not_finite' | 'stale' | 'starved' | 'released' | 'halted' | 'speed' | 'impulse' | 'energy' | 'emergency';

export function compile (address: string | URL): Promise<WebAssembly.Module>;
export function readFilesWith (reader: (file: URL) => Promise<BufferSource>): void;
export function indexOf (list: readonly { readonly name: string }[], name: string, kind: string): number;
export function checkNumber (value: unknown, place: string, remedy: string): void;
export function checkPlace (values: unknown, place: string): void;

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
