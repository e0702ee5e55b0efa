# SPDX-License-Identifier: MIT
"""Presets from the recordings and models of others.

    python3 -m tactus.data hatt FOLDER -o DIR [--mass KG] [--rate HZ]

`tactus import-data` starts it. It needs nothing but Python's library.

hatt: the Penn Haptic Texture Toolkit (Culbertson, Lopez Delgado and Kuchenbecker 2014), one .xml a texture: models of the acceleration at scattered speeds and
forces, autoregressive (AR) or with a moving average (ARMA), as line spectral frequencies. Each becomes a preset with a texture.noise. The files of the
toolkit may be used for research without profit, and may not be passed on, and neither may what is made of them.
"""

import argparse
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

MOST_COEFFICIENTS = 40   # of the AR model that stands for an ARMA model
FREQUENCIES = 512        # at which the two are compared
LICENCE = ("made from a file of the Penn Haptic Texture Toolkit, whose licence allows research without profit, and does not allow to pass it on or what is "
           "made of it: do not share this preset")


class Problem(Exception):
    """What is wrong with a file, and where."""


def numbers(element, path):
    """The values of a list, such as <speedList><value>1</value>…</speedList>; a number must be finite."""
    found = element.find(path)
    values = [] if found is None else [float(value.text) for value in found.findall("value")]
    if not all(map(math.isfinite, values)):
        raise Problem(f"a number of {path} is not finite")
    return values


def number(element, name, otherwise=None):
    text = element.findtext(name)
    if text is None or not text.strip():
        if otherwise is None:
            raise Problem(f"there is no <{name}>")
        return otherwise
    value = float(text)
    if not math.isfinite(value):
        raise Problem(f"<{name}> is not finite")
    return value


def product(a, b):
    """The product of two polynomials, as lists of coefficients."""
    out = [0.0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for k, y in enumerate(b):
            out[i + k] += x * y
    return out


def polynomial_of(frequencies):
    """1, a_1, a_2, … of the polynomial with these line spectral frequencies, in rad from 0 to pi. Source: Itakura 1975: its zeros are within the
    unit circle exactly if the frequencies increase."""
    inside = all(0.0 < f < math.pi for f in frequencies)
    if not inside or any(b <= a for a, b in zip(frequencies, frequencies[1:])):
        raise Problem("line spectral frequencies must increase from 0 to pi: the model is unstable")
    symmetric, other = [1.0], [1.0]
    for i, f in enumerate(frequencies):
        factor = [1.0, -2.0 * math.cos(f), 1.0]
        if i % 2 == 0:
            symmetric = product(symmetric, factor)
        else:
            other = product(other, factor)
    if len(frequencies) % 2 == 0:
        symmetric, other = product(symmetric, [1.0, 1.0]), product(other, [1.0, -1.0])
    else:
        other = product(other, [1.0, 0.0, -1.0])
    return [0.5 * (a + b) for a, b in zip(symmetric, other)][:len(frequencies) + 1]


def magnitude(polynomial, angle):
    re = sum(c * math.cos(angle * k) for k, c in enumerate(polynomial))
    im = sum(c * math.sin(angle * k) for k, c in enumerate(polynomial))
    return math.hypot(re, im)


def response(numerator, denominator, count):
    """The first numbers of the impulse response of numerator / denominator."""
    out = []
    for n in range(count):
        value = numerator[n] if n < len(numerator) else 0.0
        value -= sum(denominator[k] * out[n - k] for k in range(1, min(n, len(denominator) - 1) + 1))
        out.append(value)
    return out


def levinson(correlation, order):
    """The AR polynomial with this autocorrelation, and the variance of its noise. Source: Levinson 1947, Durbin 1960."""
    polynomial, error = [1.0], correlation[0]
    for m in range(1, order + 1):
        reflection = -sum(polynomial[k] * correlation[m - k] for k in range(m)) / error
        extended = polynomial + [0.0]
        polynomial = [extended[k] + reflection * extended[m - k] for k in range(m + 1)]
        error *= 1.0 - reflection * reflection
    return polynomial, error


def ar_for(numerator, denominator):
    """An AR model for numerator / denominator: polynomial, variance for noise of variance 1, and its error in dB, the rms over all frequencies."""
    count = 4096
    impulse = response(numerator, denominator, count)
    correlation = [sum(impulse[n] * impulse[n + k] for n in range(count - k)) for k in range(MOST_COEFFICIENTS + 1)]
    polynomial, variance = levinson(correlation, MOST_COEFFICIENTS)
    squares = 0.0
    for i in range(FREQUENCIES):
        angle = math.pi * (i + 0.5) / FREQUENCIES
        wanted = max(magnitude(numerator, angle), 1e-6) / magnitude(denominator, angle)
        squares += (20.0 * math.log10(math.sqrt(variance) / magnitude(polynomial, angle) / wanted))**2
    return polynomial, variance, math.sqrt(squares / FREQUENCIES)


def read_hatt(path):
    """The models of a texture: speed in m/s, force in N, polynomial, variance in (m/s2)2 and the error of the AR model in dB; and the friction."""
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except xml.etree.ElementTree.ParseError as problem:
        raise Problem(f"it is not XML: {problem}") from None
    if root.tag != "modelSet":
        raise Problem(f"its root is <{root.tag}>, not <modelSet>")
    models = []
    for i, model in enumerate(root.findall("model")):
        try:
            denominator = polynomial_of(numbers(model, "ARlsf"))
            variance, error, moving = number(model, "var"), 0.0, numbers(model, "MAlsf")
            if not variance > 0.0:
                raise Problem("<var> must be above 0")
            if moving:
                gain = number(model, "gain", 1.0)
                denominator, share, error = ar_for([gain * c for c in polynomial_of(moving)], denominator)
                variance *= share
            speed, force = 1e-3 * number(model, "speedMod"), number(model, "forceMod")
        except (Problem, ValueError) as problem:
            raise Problem(f"model {i + 1}: {problem}") from None
        models.append({"speed": speed, "force": force, "polynomial": denominator, "variance": variance, "error": error})
    if not models:
        raise Problem("it has no <model>")
    claimed = int(number(root, "numMod", len(models)))
    if claimed != len(models):
        raise Problem(f"it has {len(models)} models, but <numMod> says {claimed}")
    return models, number(root, "mu", 0.0)


def preset_of(name, models, friction, mass, rate, source):
    """A graph that plays the models on a simulated stylus."""
    settings = [{"speed": m["speed"], "force": m["force"], "rate": rate, "coefficients": [-c for c in m["polynomial"][1:]],
                 "variance": m["variance"] * mass * mass} for m in models]
    nodes = {
        "hand": {"type": "device.position", "role": "stylus"},
        "surface": {"type": "deform.plane", "params": {"stiffness": "1.5 N/mm", "damping": "0.3 N*s/m"}},
        "drag": {"type": "friction.elasto_plastic", "params": {"mu": friction, "d_max": "0.2 mm"}},
        "motion": {"type": "motion.velocity", "settings": {"window": "10 ms"}},
        "texture": {"type": "texture.noise", "settings": {"models": settings}},
        "sideways": {"type": "vector.join"},
        "motor": {"type": "device.force", "role": "stylus"},
    }
    wires = ["hand.position -> surface.position", "surface.force -> motor.force", "hand.position -> drag.position",
             "surface.resistance -> drag.normal_force", "drag.force -> motor.force", "hand.position -> motion.position", "motion.speed -> texture.speed",
             "surface.resistance -> texture.normal_force", "texture.value -> sideways.x", "sideways.out -> motor.force"]
    device = {"driver": "sim", "mass": "50 g", "damping": "1 N*s/m", "hand": {"stiffness": "600 N/m", "damping": "6 N*s/m", "path": "stroke"},
              "guard": {"max_force": "6 N"}}
    return {"format": "tactus-graph", "version": 2, "name": name, "about": f"{name}, from the models of {source}. {LICENCE[0].upper()}{LICENCE[1:]}.",
            "rate_hz": 4000, "devices": {"stylus": device}, "nodes": nodes, "wires": wires,
            "ui": {"sources": {"texture.models": f"{source}; the force is the acceleration of the file times {mass:g} kg", "drag.mu": source,
                               "surface.stiffness": "a guess", "drag.d_max": "a guess"}}}


def import_hatt(folder, out, mass, rate):
    """Writes a preset for each file; returns the sentences of the report, and whether one was refused."""
    files = sorted(p for p in folder.rglob("*.xml") if not p.name.startswith("Taps_"))
    if not files:
        raise Problem(f"{folder}: there is no .xml of a texture; the toolkit has one for each, such as Models_Wood.xml")
    sentences, refused = [], False
    for path in files:
        name = path.stem.removeprefix("Models_")
        target = out / f"{name.lower().replace(' ', '_')}.json"
        try:
            models, friction = read_hatt(path)
        except (Problem, ValueError, OSError) as problem:
            sentences.append(f"{path}: refused: {problem}")
            refused = True
            continue
        if target.exists():
            sentences.append(f"{target}: refused: it exists; choose an empty folder")
            refused = True
            continue
        target.write_text(json.dumps(preset_of(name, models, friction, mass, rate, f"HaTT, {path.name}"), indent=2) + "\n", encoding="utf-8")
        worst = max(m["error"] for m in models)
        error = f"ARMA as AR of order {MOST_COEFFICIENTS}, off by at most {worst:.2g} dB rms" if worst > 0.0 else "AR, as in the file"
        sentences.append(f"{target}: {len(models)} models ({error}); between models, the nearest on the grid of their speeds and forces plays, where the toolkit "
                         "interpolates in triangles")
    return sentences, refused


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="tactus import-data", description="Presets from the recordings and models of others.")
    parser.add_argument("kind", choices=["hatt"], help="hatt: Penn Haptic Texture Toolkit, one .xml a texture")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", dest="out", type=pathlib.Path, required=True, help="the folder to write to")
    parser.add_argument("--mass", type=float, default=0.05, help="kg that turn the acceleration of the models into a force; default: 0.05")
    parser.add_argument("--rate", type=float, default=1000.0, help="Hz of the models; default: 1000")
    given = parser.parse_args(arguments)
    if not (0.0 < given.mass < 100.0 and 10.0 <= given.rate <= 1e5):
        parser.error("--mass must be above 0 and below 100, and --rate from 10 to 100000")
    try:
        given.out.mkdir(parents=True, exist_ok=True)
        sentences, refused = import_hatt(given.folder, given.out, given.mass, given.rate)
    except (Problem, OSError) as problem:
        print(f"error: {problem}", file=sys.stderr)
        return 1
    for sentence in sentences:
        print(sentence)
    print(f"note: {LICENCE}")
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
