# SPDX-License-Identifier: MIT
"""Decaying tones after a hit: Hayward 2007, section 6; Okamura et al. 2001.

f = sum a v e^(b t) sin(w t), b < 0. A mode with w T >= pi or b >= 0 is mute.
"""

import cmath
import math

import table

MODAL = {"hit": 0.0, "gain": 1.0, "pitch": 1.0, "damping": 1.0}
WAVETABLE = {"hit": 0.0, "gain": 1.0, "pitch": 1.0, "voices": 8}


def struck(hit):
    return hit if math.isfinite(hit) and hit > 0.0 else 0.0


def turn(mode, now, dt):
    """The factor of the phasor for one tick; 0 for a mute mode."""
    b = -mode["decay"] * now["damping"]
    w = 2.0 * math.pi * mode["frequency"] * now["pitch"]
    return 0.0 if w * dt >= math.pi or b >= 0.0 else cmath.exp(complex(b, w) * dt)


def ringing(params, feed, dt):
    modes = params["modes"]
    z = [0j] * len(modes)
    for k in range(table.rows(feed)):
        now = table.row(MODAL, params, feed, k)
        v = struck(now["hit"])
        for i, mode in enumerate(modes):
            factor = turn(mode, now, dt)
            z[i] = z[i] * factor + (mode["amplitude"] * v if factor else 0.0)
        yield {"value": now["gain"] * sum(x.imag for x in z)}


def entries(wave, dt):
    """Entry i is the sum of the modes at i / rate; the last is 0."""
    heard = [m for m in wave["modes"]
             if turn(m, {"damping": 1.0, "pitch": 1.0}, dt)]

    def at(t):
        return sum(m["amplitude"] * math.exp(-m["decay"] * t)
                   * math.sin(2.0 * math.pi * m["frequency"] * t) for m in heard)

    return [at(i / wave["rate"]) for i in range(wave["length"] - 1)] + [0.0]


def playing(params, feed, dt):
    samples, voices = params["samples"], []
    for k in range(table.rows(feed)):
        now = table.row(WAVETABLE, params, feed, k)
        step = params["rate"] * dt * now["pitch"]
        moved = [(at + step, v) for at, v in voices]
        voices = [(at, v) for at, v in moved if at < len(samples) - 1]
        total = sum(v * between(samples, at) for at, v in voices)
        v = struck(now["hit"])
        if v and len(voices) < now["voices"]:
            voices.append((0.0, v))
        yield {"value": now["gain"] * total}


def between(samples, at):
    i = int(at)
    return samples[i] + (at - i) * (samples[i + 1] - samples[i])


def modal(params, feed, dt):
    return table.collect(ringing(params, feed, dt))


def wavetable(params, feed, dt):
    return table.collect(playing(params, feed, dt))
