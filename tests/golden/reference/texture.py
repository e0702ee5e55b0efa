# SPDX-License-Identifier: MIT
"""Gratings, their anti-alias guard, and the windows and filters after them.

Hayward 2007, section 5: f = A sin(2 pi k x + phi), k in cycles per metre.
"""

import math

import table
import vec

ZERO = (0.0, 0.0, 0.0)
GRATING = {"position": ZERO, "amplitude": 0.1, "spatial_frequency": 200.0,
           "angle": 0.0, "phase": 0.0}
ANTIALIAS = {"position": ZERO, "spatial_frequency": 200.0, "angle": 0.0,
             "f_max": 100.0}


def along(now):
    return (math.cos(now["angle"]), math.sin(now["angle"]), 0.0)


def ridges(params, feed):
    for k in range(table.rows(feed)):
        now = table.row(GRATING, params, feed, k)
        if not vec.finite(*now.values()):
            yield {"value": 0.0, "force": ZERO}
            continue
        x = vec.dot(along(now), now["position"])
        value = now["amplitude"] * math.sin(
            2.0 * math.pi * now["spatial_frequency"] * x + now["phase"])
        yield {"value": value, "force": vec.scale(value, along(now))}


def fade(frequency, f_max):
    """1 up to f_max / 2, then a raised cosine to 0 at f_max."""
    if frequency <= 0.5 * f_max:
        return 1.0
    if frequency >= f_max:
        return 0.0
    return 0.5 * (1.0 + math.cos(math.pi * (2.0 * frequency / f_max - 1.0)))


def guards(params, feed, dt):
    before = None
    for k in range(table.rows(feed)):
        now = table.row(ANTIALIAS, params, feed, k)
        if not vec.finite(*now.values()):
            before = None
            yield {"gain": 0.0, "speed": 0.0}
            continue
        p, speed = now["position"], 0.0
        if before:
            speed = vec.dot(along(now), vec.sub(p, before)) / dt
        before = p
        yield {"gain": fade(now["spatial_frequency"] * abs(speed),
                            now["f_max"]), "speed": speed}


def window(depths, width):
    """clamp(depth / width, 0, 1): avoids a step when contact begins."""
    return [min(max(d / width, 0.0), 1.0) if math.isfinite(d) else 0.0
            for d in depths]


def butterworth2(samples, cutoff, dt):
    """Second order low-pass: bilinear, prewarped, transposed direct form II."""
    w = math.tan(math.pi * cutoff * dt)
    a0 = 1.0 + math.sqrt(2.0) * w + w * w
    b0 = w * w / a0
    a1, a2 = 2.0 * (w * w - 1.0) / a0, (1.0 - math.sqrt(2.0) * w + w * w) / a0
    s1 = s2 = 0.0
    out = []
    for x in samples:
        y = b0 * x + s1
        s1, s2 = 2.0 * b0 * x - a1 * y + s2, b0 * x - a2 * y
        out.append(y)
    return out


def grating(params, feed):
    return table.collect(ridges(params, feed))


def antialias(params, feed, dt):
    return table.collect(guards(params, feed, dt))
