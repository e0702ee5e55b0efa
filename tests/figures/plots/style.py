# SPDX-License-Identifier: MIT
"""The style of the figures in docs/chapter.md: one width, one typeface, few colours, labels next to the lines."""

import io
import pathlib

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
DATA = ROOT / "build" / "figures"
OUT = ROOT / "docs" / "figures"

WIDTH = 6.0  # inches; 1200 pixels, shown at half that size
DPI = 200

# The colours of Okabe and Ito's colour-blind-safe palette that are dark enough for text.
BLUE, VERMILION, GREEN, PURPLE = "#0072B2", "#D55E00", "#00805E", "#A3507F"
INK, GREY, PALE = "#22272B", "#7A828A", "#D5DADF"
SKY = "#56B4E9"  # for areas

plt.rcParams.update({
    "font.family": ["Inter", "DejaVu Sans"],
    "mathtext.fontset": "custom",
    "mathtext.rm": "Inter",
    "mathtext.it": "Inter:italic",
    "mathtext.bf": "Inter:bold",
    "mathtext.cal": "Inter",
    "mathtext.tt": "Inter",
    "font.size": 8.5,
    "axes.titlesize": 9,
    "axes.titleweight": "semibold",
    "axes.titlelocation": "left",
    "axes.titlepad": 8,
    "axes.labelsize": 8.5,
    "axes.labelcolor": INK,
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.unicode_minus": True,
    "text.color": INK,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 3,
    "ytick.major.size": 3,
    "lines.linewidth": 1.4,
    "lines.solid_joinstyle": "round",
    "lines.solid_capstyle": "round",
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.h_pad": 0.06,
    "figure.constrained_layout.w_pad": 0.06,
    "figure.constrained_layout.hspace": 0.06,
    "figure.constrained_layout.wspace": 0.06,
    "path.simplify": True,
    "path.simplify_threshold": 0.1,
    "agg.path.chunksize": 0,
})


def data(name):
    """The columns of build/figures/NAME.csv, by name."""
    with open(DATA / f"{name}.csv", encoding="utf-8") as file:
        columns = file.readline().strip().split(",")
        rows = np.loadtxt(file, delimiter=",", ndmin=2)
    return dict(zip(columns, rows.T))


def heat(columns, along):
    """A table of `tactus sweep` or `tactus spectrogram`: the places of its rows, the frequencies of its columns, and the amplitudes in dB."""
    lines = [name for name in columns if " Hz (" in name]
    level = 20 * np.log10(np.maximum(np.array([columns[name] for name in lines]), 1e-12))
    return columns[along], np.array([float(name.split()[0]) for name in lines]), level


def figure(height, *args, **kwargs):
    return plt.subplots(*args, figsize=(WIDTH, height), **kwargs)


def axis(ax, title, x, y):
    ax.set(title=title, xlabel=x, ylabel=y)


def zero(ax):
    ax.axhline(0, color=PALE, linewidth=0.8, zorder=0)


def name(ax, x, y, text, colour=INK, **kwargs):
    """Puts a label next to its line, instead of in a legend."""
    kwargs.setdefault("va", "center")
    ax.text(x, y, text, color=colour, **kwargs)


def note(ax, text, at, to, colour=GREY, **kwargs):
    """A note with a thin line to its subject."""
    ax.annotate(text, xy=at, xytext=to, color=colour, fontsize=8,
                arrowprops={"arrowstyle": "-", "color": colour, "linewidth": 0.6, "shrinkA": 2, "shrinkB": 2}, **kwargs)


def save(fig, name):
    """Saves a PNG with few colours, more for a figure with a map. It contains nothing that changes from run to run."""
    drawn = io.BytesIO()
    fig.savefig(drawn, format="png", dpi=DPI, facecolor="white", metadata={"Software": None})
    plt.close(fig)
    drawn.seek(0)
    flat = Image.open(drawn).convert("RGB").quantize(getattr(fig, "colours", 64), method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    flat.save(OUT / f"{name}.png", optimize=True)
