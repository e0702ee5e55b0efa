// SPDX-License-Identifier: MIT
// HID reports, as the profiles of Tactus describe them (host/devices/profiles).
import { si } from './quantity.js';

/** "54 01 00*62" as bytes. */
export function bytesOf (text)
{
    return Uint8Array.from (text.split (' ').flatMap (part => {
        const [byte, count = '1'] = part.split ('*');
        return Array (Number (count)).fill (parseInt (byte, 16));
    }));
}

function sizeOf (type)
{
    const [, kind, bits, order] = /^([us])(\d+)(le|be)?$/.exec (type);
    return { is_signed: kind === 's', bits: Number (bits), is_big: order === 'be' };
}

function rawBits (bytes, at, bit, { bits, is_big, is_signed })
{
    const count = Math.ceil ((bit + bits) / 8);
    let value = 0n;
    for (let i = 0; i < count; ++i)
        value |= BigInt (bytes[at + (is_big ? count - 1 - i : i)]) << BigInt (8 * i);
    value = (value >> BigInt (bit)) & ((1n << BigInt (bits)) - 1n);
    return Number (is_signed ? BigInt.asIntN (bits, value) : value);
}

function setBits (bytes, at, bit, { bits, is_big }, value)
{
    const count = Math.ceil ((bit + bits) / 8), mask = ((1n << BigInt (bits)) - 1n) << BigInt (bit);
    let all = 0n;
    for (let i = 0; i < count; ++i)
        all |= BigInt (bytes[at + (is_big ? count - 1 - i : i)]) << BigInt (8 * i);
    all = (all & ~mask) | ((BigInt (value) << BigInt (bit)) & mask);
    for (let i = 0; i < count; ++i)
        bytes[at + (is_big ? count - 1 - i : i)] = Number ((all >> BigInt (8 * i)) & 255n);
}

/** What a report says, by field; undefined if it is not one of this profile. `bytes` begin with the report id, if there is one. */
export function decode (profile, bytes)
{
    const layout = profile.inputs.find (one => (one.id === undefined || Number (one.id) === bytes[0]) && (one.length === undefined || one.length === bytes.length));
    if (! layout) return undefined;
    const values = { buttons: 0 };
    let next_button = 0;
    for (const field of layout.fields)
    {
        const raw = rawBits (bytes, field.at, field.bit ?? 0, sizeOf (field.type));
        if (field.expect !== undefined && raw !== Number (field.expect)) return undefined;
        if (field.name) values[field.name] = raw * si (field.scale ?? 1) + si (field.offset ?? 0);
        for (const name of field.buttons ?? [])
        {
            if (name !== '' && (raw >> field.buttons.indexOf (name)) & 1) values.buttons |= 1 << next_button;
            if (name !== '') ++next_button;
        }
    }
    return values;
}

function crc32 (bytes)
{
    let crc = ~0;
    for (const byte of bytes)
    {
        crc ^= byte;
        for (let i = 0; i < 8; ++i)
            crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc >>> 0;
}

/** The report that sets these fields. `answers` is the number of the report that it answers. */
export function encode (profile, output, values, answers = 0)
{
    const bytes = bytesOf (output.body ?? output.neutral);
    for (const field of output.fields)
    {
        const size = sizeOf (field.type);
        const limit = size.is_signed ? [-(2 ** (size.bits - 1)), 2 ** (size.bits - 1) - 1] : [0, 2 ** size.bits - 1];
        let value = values[field.name] ?? 0;
        if (field.source === 'enable') value = 1;
        else if (field.source === 'echo') value = answers;
        else
        {
            value = Math.min (field.max ?? Infinity, Math.max (field.min ?? -Infinity, value));
            value = Math.round ((value - si (field.offset ?? 0)) / si (field.scale ?? 1));
        }
        setBits (bytes, field.at, field.bit ?? 0, size, Math.min (limit[1], Math.max (limit[0], value)));
    }
    return withCrc (output, bytes);
}

/** The report that asks for nothing, and lets the motors go. */
export function neutral (output) { return withCrc (output, bytesOf (output.neutral)); }

function withCrc (output, bytes)
{
    if (output.crc32) new DataView (bytes.buffer).setUint32 (output.crc32.at, crc32 (bytes.subarray (0, output.crc32.at)), true);
    return bytes;
}

/** Limits of a profile, by the names that a guard gives them, in SI units. */
export function limitsOf (profile, names)
{
    const limits = {};
    for (const [name, value] of Object.entries (profile.limits ?? {}))
    {
        const known = name === 'stale_input' ? 'watchdog' : name;
        if (names.includes (known)) limits[known] = si (value);
    }
    return limits;
}
