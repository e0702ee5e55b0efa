// SPDX-License-Identifier: MIT
// Numbers with units, as profiles and graphs write them, in SI units: "40 cm" is 0.4.

const prefixes = { n: 1e-9, u: 1e-6, m: 1e-3, c: 1e-2, k: 1e3 };
const units = { m: 1, s: 1, N: 1, J: 1, Hz: 1, rad: 1, A: 1, W: 1, g: 1e-3, deg: Math.PI / 180, 1: 1 };

function scaleOf (unit)
{
    const [, name, power] = /^([A-Za-z1]+)(\d?)$/.exec (unit) ?? [];
    const one = units[name] ?? prefixes[name?.[0]] * units[name?.slice (1)];
    if (! Number.isFinite (one)) throw new Error (`unknown unit ${unit}`);
    return one ** Number (power || 1);
}

export function si (value)
{
    if (typeof value === 'number') return value;
    const [number, unit = '1'] = value.split (' ');
    const [above, ...below] = unit.split ('/');
    const scale = above.split ('*').map (scaleOf).reduce ((a, b) => a * b) / below.flatMap (part => part.split ('*')).map (scaleOf).reduce ((a, b) => a * b, 1);
    return Number (number) * scale;
}
