# SPDX-License-Identifier: MIT
"""docs/spectra.md: the frequencies of a stroke against its speed."""

import numpy as np

from style import axis, data, figure, heat, name


def draw():
    run = data("sweep")
    speed, hz, level = heat(run, "speed (m/s)")
    fig, ax = figure(3.0)
    shown = ax.pcolormesh(speed, hz, level, vmin=-70, vmax=-20, cmap="viridis", rasterized=True)
    name(ax, 0.215, 225, "ridges 0.8 mm apart", "white", ha="left")
    name(ax, 0.03, 345, "rumble of the board", "white")
    axis(ax, "A stroke over ridges, at 96 speeds", "speed (m/s)", "frequency (Hz)")
    ax.set(xlim=(0.02, 0.4), ylim=(0, 600), xticks=np.arange(0.05, 0.41, 0.05), yticks=range(0, 601, 100))
    fig.colorbar(shown, ax=ax, label="amplitude (dB re 1 N)", ticks=range(-70, -19, 10), pad=0.02)
    fig.colours = 160
    return fig
