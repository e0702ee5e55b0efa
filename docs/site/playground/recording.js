// SPDX-License-Identifier: MIT
// A recording as CSV: the movement of each role is a trace that `tactus render --device ROLE=trace:FILE` plays, and the forces are what that renders.

function link (preset, name, lines, text)
{
    const made = document.createElement ('a');
    made.id = 'of-' + name;
    made.href = URL.createObjectURL (new Blob ([lines.join ('\n') + '\n'], { type: 'text/csv' }));
    made.download = `${preset}_${name}.csv`;
    made.textContent = text;
    return made;
}

/** Links to the files of a recording, which the engine has made. */
export function linksOf (preset, about, { positions, records })
{
    const count = about.records.length, times = Array.from ({ length: positions[0].length / 3 }, (_, k) => k / about.rate_hz);
    const table = (head, values, width) => [head.join (','), ...times.map ((t, k) => [t, ...values.slice (width * k, width * (k + 1))].join (','))];
    return [...about.roles.flatMap (({ name }, i) => [link (preset, name, table (['t', 'x', 'y', 'z'], positions[i], 3), `the movement of ${name}`), ' ']),
            link (preset, 'forces', table (['t', ...about.records.map (record => record.name)], records, count), 'the forces')];
}
