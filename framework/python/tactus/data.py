# SPDX-License-Identifier: MIT
"""Presets from the recordings and models of others.

    python3 -m tactus.data KIND FOLDER -o DIR [--mass KG] [--rate HZ] [--unit UNIT]

`tactus import-data` starts it. It needs only the standard library of Python.

hatt: the Penn Haptic Texture Toolkit (Culbertson, Lopez Delgado and Kuchenbecker 2014), one .xml a texture: models of the acceleration at scattered speeds and
forces, autoregressive (AR) or with a moving average (ARMA), as line spectral frequencies. Each becomes a preset with a texture.noise. The files of the
toolkit may be used for research without profit. Neither they nor anything made of them may be passed on.

lmt: the texture database of the LMT of TU Munich (Strese, Schuwerk and Steinbach), one number per line at 10 kHz: the acceleration of a stylus that a hand
moved freely, its axes combined, in folders named Accel… Each texture becomes a preset with one AR model of all its recordings.

cluster: the Cluster Haptic Texture Dataset (Eguchi, Hayase, Hiroi and Hiraki 2024), accel/ID_DIRECTION_SPEED_FORCE_REPEAT.csv with time, X, Y and Z in s
and g. Each texture becomes a preset with an AR model for each speed and force, of all directions and repeats.
"""

from __future__ import annotations

import argparse
import json
import math
import pathlib
import re
import sys
import xml.etree.ElementTree
from typing import Any, Sequence

MOST_COEFFICIENTS = 40   # of the AR model that stands for an ARMA model
FREQUENCIES = 512        # at which the two are compared
COEFFICIENTS = 20        # of the AR model of a recording
LAGS = 40                # of the autocorrelation for its error
FEWEST = 1000            # samples of a recording
USED = 0.8               # the middle part of a recording that is used: a stroke begins and ends at rest
GRAVITY = 9.80665        # m/s2
LARGEST = 1e12           # number in a file
RANGES = {"speed": (0.0, 1e9), "force": (0.0, 1e9), "rate": (10.0, 1e5)}   # of a model in a texture.noise; m/s, N and Hz
VARIANCES = (1e-30, 1e30)                                                  # N2
LICENCES = {
    "hatt": "made from a file of the Penn Haptic Texture Toolkit, whose licence allows research without profit, but does not allow passing on the toolkit "
            "or anything made of it: do not share this preset",
    "lmt": "made from recordings of the LMT texture database: its files do not state a licence, so ask its makers before you share this preset",
    "cluster": "made from recordings of the Cluster Haptic Texture Dataset: name it, and read the licence on its page, before you share this preset",
}


Element = xml.etree.ElementTree.Element
Model = dict[str, Any]   # speed, force, polynomial, variance, rate
Recordings = dict[tuple[float, float], list[pathlib.Path]]   # by speed in m/s and force in N


class Problem(Exception):
    """The reason why a file cannot be used, with the place."""


def shown(text: str) -> str:
    """The text for a terminal: a stranger has named the files, and no byte of a name may be a command for the terminal."""
    return "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in text)


def reason(problem: Exception) -> str:
    return "its numbers are too large or too small for a model" if isinstance(problem, ArithmeticError) else str(problem)


def needs_sense(value: float, what: str) -> float:
    if not math.isfinite(value):
        raise Problem(f"{what} is not finite")
    if abs(value) > LARGEST:
        raise Problem(f"{what} is {value:g}: it is too large")
    return value


def numbers(element: Element, path: str) -> list[float]:
    """The values of a list, such as <speedList><value>1</value>…</speedList>; a number must be finite."""
    found = element.find(path)
    return [] if found is None else [needs_sense(float(value.text or ""), f"a number of {path}") for value in found.findall("value")]


def number(element: Element, name: str, otherwise: float | None = None) -> float:
    text = element.findtext(name)
    if text is None or not text.strip():
        if otherwise is None:
            raise Problem(f"there is no <{name}>")
        return otherwise
    return needs_sense(float(text), f"<{name}>")


def product(a: list[float], b: list[float]) -> list[float]:
    """The product of two polynomials, as lists of coefficients."""
    out = [0.0] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for k, y in enumerate(b):
            out[i + k] += x * y
    return out


def polynomial_of(frequencies: list[float]) -> list[float]:
    """The coefficients 1, a_1, a_2, … of the polynomial with these line spectral frequencies, in rad from 0 to pi. Its zeros are within the unit circle
    exactly if the frequencies increase. Source: Itakura 1975."""
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


def magnitude(polynomial: list[float], angle: float) -> float:
    re = sum(c * math.cos(angle * k) for k, c in enumerate(polynomial))
    im = sum(c * math.sin(angle * k) for k, c in enumerate(polynomial))
    return math.hypot(re, im)


def response(numerator: list[float], denominator: list[float], count: int) -> list[float]:
    """The first numbers of the impulse response of numerator / denominator."""
    out: list[float] = []
    for n in range(count):
        value = numerator[n] if n < len(numerator) else 0.0
        value -= sum(denominator[k] * out[n - k] for k in range(1, min(n, len(denominator) - 1) + 1))
        out.append(value)
    return out


def levinson(correlation: list[float], order: int) -> tuple[list[float], float]:
    """The AR polynomial with this autocorrelation, and the variance of its noise. Source: Levinson 1947, Durbin 1960."""
    polynomial, error = [1.0], correlation[0]
    for m in range(1, order + 1):
        reflection = -sum(polynomial[k] * correlation[m - k] for k in range(m)) / error
        extended = polynomial + [0.0]
        polynomial = [extended[k] + reflection * extended[m - k] for k in range(m + 1)]
        error *= 1.0 - reflection * reflection
    return polynomial, error


def ar_for(numerator: list[float], denominator: list[float]) -> tuple[list[float], float, float]:
    """An AR model for numerator / denominator: the polynomial, the variance for noise of variance 1, and the error in dB, rms over all frequencies."""
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


def read_hatt(path: pathlib.Path) -> tuple[list[Model], float]:
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
        except (Problem, ValueError, ArithmeticError) as problem:
            raise Problem(f"model {i + 1}: {reason(problem)}") from None
        models.append({"speed": speed, "force": force, "polynomial": denominator, "variance": variance, "error": error})
    if not models:
        raise Problem("it has no <model>")
    claimed = int(number(root, "numMod", len(models)))
    if claimed != len(models):
        raise Problem(f"it has {len(models)} models, but <numMod> says {claimed}")
    friction = number(root, "mu", 0.0)
    if not 0.0 <= friction <= 10.0:
        raise Problem(f"<mu> is {friction:g}, not between 0 and 10")
    return models, friction


def on_even_clock(times: list[float], columns: list[list[float]]) -> tuple[list[list[float]], float, float]:
    """The columns at even times, on straight lines between the rows; the rate in Hz; and the error: the rms difference between the recording and the new
    columns, read back at the recorded times, over the rms of the recording."""
    count = len(times)
    if any(b <= a for a, b in zip(times, times[1:])):
        raise Problem("its times do not increase")
    step = (times[-1] - times[0]) / (count - 1)
    even = [times[0] + step * i for i in range(count)]
    made: list[list[float]] = []
    off, size = 0.0, 0.0
    for column in columns:
        values: list[float] = []
        row = 0
        for t in even:
            while row + 2 < count and times[row + 1] < t:
                row += 1
            share = min(max((t - times[row]) / (times[row + 1] - times[row]), 0.0), 1.0)
            values.append(column[row] + share * (column[row + 1] - column[row]))
        for t, v in zip(times, column):
            place = min(max((t - times[0]) / step, 0.0), count - 1.001)
            i = int(place)
            off += (values[i] + (place - i) * (values[i + 1] - values[i]) - v)**2
            size += v * v
        made.append(values)
    return made, 1.0 / step, math.sqrt(off / size) if size > 0.0 else 0.0


def correlation_of(columns: list[list[float]]) -> list[float]:
    """The autocorrelation at the lags 0 to LAGS of the columns together, without their means. It is that of one signal with the spectrum of all axes, as
    DFT321 (Landin et al. 2010) combines them."""
    total = [0.0] * (LAGS + 1)
    for column in columns:
        skipped = round(0.5 * (1.0 - USED) * len(column))
        middle = column[skipped:len(column) - skipped]
        mean = math.fsum(middle) / len(middle)
        middle = [v - mean for v in middle]
        for lag in range(LAGS + 1):
            total[lag] += sum(map(float.__mul__, middle[lag:], middle)) / len(middle)
    return total


def model_of(correlations: list[list[float]]) -> tuple[list[float], float, float]:
    """The AR model of recordings: the polynomial, the variance, and the largest difference of its autocorrelation from theirs, over the variance."""
    mean = [math.fsum(c) / len(correlations) for c in zip(*correlations)]
    if not mean[0] > 0.0:
        raise Problem("its recordings do not vary")
    polynomial, variance = levinson([mean[0] * (1.0 + 1e-9)] + mean[1:], COEFFICIENTS)
    extended = mean[:COEFFICIENTS + 1]
    while len(extended) <= LAGS:
        extended.append(-sum(polynomial[k] * extended[-k] for k in range(1, COEFFICIENTS + 1)))
    return polynomial, variance, max(abs(a - b) for a, b in zip(extended, mean)) / mean[0]


def finite_numbers(words: Sequence[str]) -> list[float]:
    return [needs_sense(float(word), "a number") for word in words]


def read_rows(path: pathlib.Path, names: list[str]) -> list[list[float]]:
    """The columns of a table with this header."""
    lines = path.read_text(encoding="utf-8-sig").split("\n")
    if [word.strip() for word in lines[0].split(",")] != names:
        raise Problem(f"its first row is not {','.join(names)}")
    rows = []
    for number_of_line, line in enumerate(lines[1:], 2):
        if not line.strip():
            continue
        words = line.split(",")
        if len(words) != len(names):
            raise Problem(f"line {number_of_line} has {len(words)} fields instead of {len(names)}")
        rows.append(finite_numbers(words))
    return [list(column) for column in zip(*rows)]


def long_enough(columns: list[list[float]]) -> list[list[float]]:
    if not columns or len(columns[0]) < FEWEST:
        raise Problem(f"it has {len(columns[0]) if columns else 0} samples; a model needs at least {FEWEST}")
    return columns


def cluster_recordings(folder: pathlib.Path) -> dict[str, Recordings]:
    """The recordings by texture, then by speed in m/s and force in N."""
    found: dict[str, Recordings] = {}
    for path in sorted(folder.rglob("*.csv")):
        named = re.fullmatch(r"(\d+)_(\d+)_(\d+)_(\d+)_(\d+)", path.stem)
        if named is None or path.parent.name != "accel":
            continue
        texture, _, speed, force, _ = map(int, named.groups())
        found.setdefault(f"texture {texture}", {}).setdefault((1e-3 * speed, 1e-3 * force), []).append(path)
    if not found:
        raise Problem(f"{folder}: there is no accel/ID_DIRECTION_SPEED_FORCE_REPEAT.csv, such as accel/0_135_40_500_0.csv")
    return found


def lmt_recordings(folder: pathlib.Path) -> dict[str, Recordings]:
    """The recordings by texture. Their speeds and forces were not recorded; those of the preset are guesses."""
    found: dict[str, Recordings] = {}
    for path in sorted(folder.rglob("*.txt")):
        within = path.relative_to(folder).parts[:-1]
        is_struck = any(word in path.stem.lower() for word in ("tap", "impact"))
        if is_struck or not any(part.startswith("Accel") for part in (folder.name, *within)):
            continue
        found.setdefault(path.stem.split("_")[0], {}).setdefault((0.1, 1.0), []).append(path)
    if not found:
        raise Problem(f"{folder}: there is no .txt in a folder Accel…, such as AccelScansDFT321/G6Carpet_Andrea.txt")
    return found


def models_of(recordings: Recordings, kind: str, given: argparse.Namespace) -> tuple[list[Model], str]:
    """The models of a texture from its recordings, and the sentence about them."""
    models: list[Model] = []
    rates: list[float] = []
    worst, jitter = 0.0, 0.0
    unit = GRAVITY if kind == "cluster" or given.unit == "g" else 1.0
    for (speed, force), paths in sorted(recordings.items()):
        correlations = []
        for path in paths:
            try:
                if kind == "cluster":
                    time, *axes = long_enough(read_rows(path, ["time", "X", "Y", "Z"]))
                    means = [math.fsum(axis) / len(axis) for axis in axes]   # gravity
                    axes, rate, off = on_even_clock(time, [[v - mean for v in axis] for axis, mean in zip(axes, means)])
                    jitter = max(jitter, off)
                else:
                    rate = given.rate or 1e4
                    axes = long_enough([finite_numbers(re.split(r"[\s,;]+", path.read_text(encoding="utf-8-sig").strip()))])
                correlations.append(correlation_of(axes))
                rates.append(rate)
            except (Problem, ValueError, ArithmeticError) as problem:
                raise Problem(f"{path}: {reason(problem)}") from None
        polynomial, variance, error = model_of(correlations)
        models.append({"speed": speed, "force": force, "polynomial": polynomial, "variance": variance * unit * unit})
        worst = max(worst, error)
    if max(rates) > 1.02 * min(rates):
        raise Problem(f"its recordings have rates from {min(rates):.0f} to {max(rates):.0f} Hz, and a texture.noise has one")
    for model in models:
        model["rate"] = math.fsum(rates) / len(rates)
    sentence = (f"{len(models)} models of {len(rates)} recordings; the AR models of order {COEFFICIENTS} miss their autocorrelations by at most "
                f"{100.0 * worst:.2g} % of the variance")
    if kind == "cluster":
        sentence += (f"; their times are uneven, and their rows were interpolated: read back, they differ by at most {100.0 * jitter:.2g} % (rms); "
                     "the friction is a guess, and directions are averaged")
    else:
        sentence += f"; speed, force and friction were not recorded and are guesses, and the numbers are taken as {'g' if unit != 1.0 else 'm/s2'} (--unit)"
    return models, sentence


def preset_of(name: str, models: list[Model], friction: float, mass: float, source: str, kind: str) -> dict[str, Any]:
    """A graph that plays the models on a simulated stylus."""
    licence = LICENCES[kind]
    settings = [{"speed": m["speed"], "force": m["force"], "rate": m["rate"], "coefficients": [-c for c in m["polynomial"][1:]],
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
    return {"format": "tactus-graph", "version": 2, "name": name, "about": f"{name}, from {source}. {licence[0].upper()}{licence[1:]}.",
            "rate_hz": 4000, "devices": {"stylus": device}, "nodes": nodes, "wires": wires,
            "ui": {"sources": {"texture.models": f"{source}; the force is the acceleration of the file times {mass:g} kg",
                               "drag.mu": source if kind == "hatt" else "a guess",
                               "surface.stiffness": "a guess", "drag.d_max": "a guess"}}}


def check(models: list[Model], mass: float) -> None:
    """Refuses models that a texture.noise cannot hold."""
    for i, m in enumerate(models):
        low, high = VARIANCES
        if not all(map(math.isfinite, m["polynomial"])) or not low <= m["variance"] * mass * mass <= high:
            raise Problem(f"model {i + 1}: its variance of {m['variance'] * mass * mass:g} N2 is not between {low:g} and {high:g}")
        for name, (low, high) in RANGES.items():
            if not low <= m[name] <= high:
                raise Problem(f"model {i + 1}: its {name} of {m[name]:g} is not between {low:g} and {high:g}")


def write_preset(out: pathlib.Path, name: str, models: list[Model], friction: float, given: argparse.Namespace, source: str) -> pathlib.Path:
    check(models, given.mass)
    target = out / f"{name.lower().replace(' ', '_')}.json"
    preset = preset_of(name, models, friction, given.mass, source, given.kind)
    try:
        with target.open("x", encoding="utf-8") as file:   # it follows no link, not even one that leads nowhere: the folder may be a stranger's
            file.write(json.dumps(preset, indent=2) + "\n")
    except FileExistsError:
        raise Problem(f"{target} exists; choose an empty folder") from None
    return target


def import_hatt(given: argparse.Namespace) -> tuple[list[str], bool]:
    """Writes a preset for each file; returns the sentences of the report, and whether one was refused."""
    files = sorted(p for p in given.folder.rglob("*.xml") if not p.name.startswith("Taps_"))
    if not files:
        raise Problem(f"{given.folder}: there is no .xml of a texture; the toolkit has one for each, such as Models_Wood.xml")
    sentences, refused = [], False
    for path in files:
        name = path.stem.removeprefix("Models_")
        try:
            models, friction = read_hatt(path)
            for m in models:
                m["rate"] = given.rate or 1000.0
            target = write_preset(given.out, name, models, friction, given, f"the models of HaTT, {path.name}")
        except (Problem, ValueError, LookupError, ArithmeticError, OSError) as problem:
            sentences.append(f"{path}: refused: {reason(problem)}")
            refused = True
            continue
        worst = max(m["error"] for m in models)
        error = f"ARMA as AR of order {MOST_COEFFICIENTS}, off by at most {worst:.2g} dB rms" if worst > 0.0 else "AR, as in the file"
        sentences.append(f"{target}: {len(models)} models ({error}); between models, the nearest on the grid of their speeds and forces plays, "
                         "where the toolkit interpolates in triangles")
    return sentences, refused


def import_recordings(given: argparse.Namespace) -> tuple[list[str], bool]:
    """Writes a preset for each texture; returns the sentences of the report, and whether one was refused."""
    found = cluster_recordings(given.folder) if given.kind == "cluster" else lmt_recordings(given.folder)
    source = "the recordings of the Cluster Haptic Texture Dataset" if given.kind == "cluster" else "the recordings of the LMT texture database"
    sentences, refused = [], False
    for name, recordings in found.items():
        try:
            models, sentence = models_of(recordings, given.kind, given)
            target = write_preset(given.out, name, models, 0.4, given, f"{source}, {name}")
            sentences.append(f"{target}: {sentence}")
        except (Problem, ArithmeticError, OSError) as problem:
            sentences.append(f"{name}: refused: {reason(problem)}")
            refused = True
    return sentences, refused


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="tactus import-data", description="Presets from the recordings and models of others.")
    parser.add_argument("kind", choices=list(LICENCES),
                        help="hatt: Penn Haptic Texture Toolkit; lmt: texture database of the LMT; cluster: Cluster Haptic Texture Dataset")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", dest="out", type=pathlib.Path, required=True, help="the folder to write to")
    parser.add_argument("--mass", type=float, default=0.05, help="kg that turn the acceleration into a force; default: 0.05")
    parser.add_argument("--rate", type=float, help="Hz of the models or recordings; default: 1000 (hatt), 10000 (lmt), from the times (cluster)")
    parser.add_argument("--unit", choices=["m/s2", "g"], help="unit of the recordings of lmt; default: m/s2")
    given = parser.parse_args(arguments)
    if not 0.0 < given.mass < 100.0 or (given.rate is not None and not 10.0 <= given.rate <= 1e5):
        parser.error("--mass must be above 0 and below 100, and --rate from 10 to 100000")
    if given.rate is not None and given.kind == "cluster":
        parser.error("--rate: the recordings of cluster have times")
    if given.unit is not None and given.kind != "lmt":
        parser.error("--unit is for lmt; the units of the others are known")
    try:
        given.out.mkdir(parents=True, exist_ok=True)
        sentences, refused = import_hatt(given) if given.kind == "hatt" else import_recordings(given)
    except (Problem, OSError) as problem:
        print(shown(f"error: {problem}"), file=sys.stderr)
        return 1
    for sentence in sentences:
        print(shown(sentence))
    print(f"note: {LICENCES[given.kind]}")
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
