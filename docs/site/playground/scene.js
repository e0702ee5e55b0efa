// SPDX-License-Identifier: MIT
// The surface that a hand meets: a second copy of the graph is touched from above, column by column.
import { Graph } from './graphs/tactus_graph.js';

const steps = 100, smallest_force = 1e-3, longest_ms = 150;

/** The height at which the hand is first felt, on a grid: a row of columns from the side, rows and columns from above. Null: nowhere. */
export async function heightsOf (bytes, about, chosen, [across, along, [low, high]], is_above)
{
    const graph = new Graph (await WebAssembly.compile (bytes), about), role = about.roles[chosen].member;
    const felt = about.records.filter (record => record.name.includes ('.force.') || record.name.endsWith ('.force')).map (record => record.member);
    const columnAt = (x, y) => {
        graph.prepare (about.rate_hz);
        for (let k = 0; k <= steps; ++k)
        {
            const z = high + k / steps * (low - high);
            graph.inputs[role].position.set ([x, y, z]);
            graph.tick();
            if (felt.some (name => Math.abs (graph.outputs[name]) > smallest_force)) return k === 0 ? null : z;   // at the top: not a surface
        }
        return null;
    };
    const at = ([from, to], part) => from + part * (to - from);
    const begin = performance.now();
    columnAt (at (across, 0.5), at (along, 0.5));
    const affordable = longest_ms / Math.max (0.05, performance.now() - begin);   // a mesh takes longer to touch than a plane
    const columns = Math.max (2, Math.min (is_above ? 24 : 80, Math.floor (is_above ? Math.sqrt (affordable) : affordable))), rows = is_above ? columns : 1;
    return Array.from ({ length: rows }, (_, j) => Array.from ({ length: columns }, (_, i) => columnAt (at (across, i / (columns - 1)),
                                                                                                       at (along, is_above ? j / (rows - 1) : 0.5))));
}
