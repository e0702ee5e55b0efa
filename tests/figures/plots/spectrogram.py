# SPDX-License-Identifier: MIT
"""docs/spectra.md: the frequencies of a run against time."""

from style import axis, data, figure, heat, name


def draw():
    run = data("spectrogram")
    time, hz, level = heat(run, "time (s)")
    fig, ax = figure(3.0)
    shown = ax.pcolormesh(time, hz, level, vmin=-70, vmax=-20, cmap="viridis", rasterized=True)
    name(ax, 0.45, 660, "a ring at 600 Hz", "white")
    name(ax, 1.25, 420, "ridges: the frequency is the speed divided by 0.5 mm", "white", ha="center")
    axis(ax, "Strokes over ridges, with a ring at one end", "time (s)", "frequency (Hz)")
    ax.set(xlim=(time[0], time[-1]), ylim=(0, 800), yticks=range(0, 801, 100))
    fig.colorbar(shown, ax=ax, label="amplitude (dB re 1 N)", ticks=range(-70, -19, 10), pad=0.02)
    fig.colours = 160
    return fig
