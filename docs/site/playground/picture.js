// SPDX-License-Identifier: MIT
// The picture of the place to touch, and the scope.

function colour (name) { return getComputedStyle (document.documentElement).getPropertyValue ('--' + name); }

function sized (canvas)
{
    const ratio = devicePixelRatio, { clientWidth, clientHeight } = canvas;
    if (canvas.width !== Math.round (clientWidth * ratio) || canvas.height !== Math.round (clientHeight * ratio))
    {
        canvas.width = Math.round (clientWidth * ratio);
        canvas.height = Math.round (clientHeight * ratio);
    }
    const painter = canvas.getContext ('2d');
    painter.setTransform (ratio, 0, 0, ratio, 0, 0);
    painter.clearRect (0, 0, clientWidth, clientHeight);
    return [painter, clientWidth, clientHeight];
}

function line (painter, points)
{
    painter.beginPath();
    points.forEach (([x, y], k) => k ? painter.lineTo (x, y) : painter.moveTo (x, y));
    painter.stroke();
}

/** The surface that scene.js has found: a line from the side, and shades of height from above. */
function drawSurface (painter, width, height, { heights, axes, depths: [low, high], toPicture }, role)
{
    if (! heights) return;
    if (axes[1] === 2)
    {
        const heightOf = z => (z === null ? 1 : toPicture (role, [0, 0, z])[1]) * height;
        const points = heights[0].map ((z, i) => [i / (heights[0].length - 1) * width, heightOf (z)]);
        painter.fillStyle = colour ('panel');
        painter.beginPath();
        [[0, height], ...points, [width, height]].forEach (([x, y], k) => k ? painter.lineTo (x, y) : painter.moveTo (x, y));
        painter.fill();
        painter.strokeStyle = colour ('line');
        painter.lineWidth = 2;
        line (painter, points);
        return;
    }
    const rows = heights.length, columns = heights[0].length;
    painter.fillStyle = colour ('line');
    heights.forEach ((row, j) => row.forEach ((z, i) => {
        painter.globalAlpha = z === null ? 0 : 0.1 + 0.5 * (z - low) / (high - low);
        painter.fillRect (i / columns * width, (rows - 1 - j) / rows * height, width / columns + 1, height / rows + 1);
    }));
    painter.globalAlpha = 1;
}

/** An arrow of 25 pixels per newton. */
function drawForce (painter, [x, y], across, up)
{
    const tip = [x + 25 * across, y - 25 * up], length = Math.hypot (tip[0] - x, tip[1] - y);
    if (length <= 2) return;
    const [dx, dy] = [(tip[0] - x) / length, (tip[1] - y) / length];
    painter.strokeStyle = painter.fillStyle = colour ('x');
    painter.lineWidth = 4;
    line (painter, [[x, y], tip]);
    painter.beginPath();
    painter.moveTo (tip[0] + 8 * dx, tip[1] + 8 * dy);
    painter.lineTo (tip[0] - 6 * dy, tip[1] + 6 * dx);
    painter.lineTo (tip[0] + 6 * dy, tip[1] - 6 * dx);
    painter.fill();
}

/** The surface, and of each hand: where it wants to be, its tool, and the force on that. */
export function drawPad (pad, touch)
{
    const { about, state, wanted, chosen, trail, axes: [across, up], toPicture } = touch, [painter, width, height] = sized (pad);
    drawSurface (painter, width, height, touch, about.roles[chosen].name);
    about.roles.forEach (({ name }, i) => {
        const place = at => { const [x, y] = toPicture (name, at); return [x * width, y * height]; };
        const force = state.efforts[i]?.force ?? [0, 0, 0], tool = place (state.positions[i]);
        if (i === chosen)
        {
            trail.push ([...tool, Math.hypot (...force)]);
            trail.splice (0, Math.max (0, trail.length - 400));
            painter.fillStyle = colour ('strong');
            for (const [x, y, size] of trail)
                if (size > 0) painter.fillRect (x - 1, y - 1, 2 + Math.min (6, size), 2 + Math.min (6, size));
        }
        painter.strokeStyle = colour ('line');
        painter.lineWidth = 1;
        line (painter, [place (wanted[i]), tool]);
        painter.fillStyle = colour ('text');
        painter.beginPath();
        painter.arc (...tool, 8, 0, 2 * Math.PI);
        painter.fill();
        drawForce (painter, tool, force[across], force[up]);
    });
}

/** The forces of the last two seconds, one per millisecond. */
export function drawScope (scope, forces)
{
    const [painter, width, height] = sized (scope);
    let most = 0.5;
    for (const force of forces)
        most = Math.max (most, ...force.map (Math.abs));
    painter.strokeStyle = colour ('line');
    painter.lineWidth = 1;
    line (painter, [[0, height / 2], [width, height / 2]]);
    'xyz'.split ('').forEach ((name, i) => {
        painter.strokeStyle = colour (name);
        painter.lineWidth = 1.5;
        line (painter, forces.map ((force, k) => [(k + 2000 - forces.length) / 2000 * width, height / 2 - force[i] / most * (height / 2 - 4)]));
    });
    painter.fillStyle = colour ('soft');
    painter.fillText (`${most.toFixed (1)} N`, 4, 12);
}
