# SPDX-License-Identifier: MIT
"""A fit over a folder of recordings: which friction explains each of them? The recordings are made here, so the answer is known."""

import pathlib
import sys

import numpy as np
import tactus
from tactus import lab

FRICTIONS = {"felt": 0.35, "ice": 0.1, "oak": 0.25, "rubber": 0.8}


def record(folder: pathlib.Path) -> None:
    """Strokes over four surfaces: times, positions and noisy forces."""
    noise = np.random.RandomState(1)
    for name, mu in FRICTIONS.items():
        t = np.arange(1000) / 1000.0
        x = 0.02 * np.sin(2 * np.pi * 2.0 * t)
        path = np.stack([x, 0 * x, 0 * x], axis=1)
        force = drag().render(feed={"drag.position": path, "drag.normal_force": 1.0}, record=["drag.force.x"], set={"drag.mu": mu})["drag.force.x"]
        rows = np.stack([t, x, force + noise.normal(0.0, 0.02, len(t))], axis=1)
        np.savetxt(folder / f"{name}.csv", rows, delimiter=",", header="t,x,force", comments="")


def drag() -> tactus.Graph:
    """A contact that slides, at 1 kHz, under a load of 1 N."""
    graph = tactus.Graph(name="drag", rate=1000)
    graph.add_node("drag", "friction.elasto_plastic", {"mu": 0.4, "d_max": "0.1 mm"})
    return graph


def main(folder: pathlib.Path) -> None:
    record(folder)
    study = lab.Study(name="fit", graph="", folder=str(folder), feed={"drag.position.x": "x", "drag.normal_force": 1.0},
                      factors=[lab.Factor("recording", values=["*.csv"]), lab.Factor("drag.mu", low=0.05, high=1.0, count=96)],
                      measures=[lab.Measure("misfit", "misfit", port="drag.force.x", column="force")])
    results = study.run(folder / "results", graph=drag())
    for name in sorted(set(results["recording"])):
        rows = [i for i, recording in enumerate(results["recording"]) if recording == name]
        best = rows[int(np.argmin(results["misfit"][rows]))]
        print(f"{name}: mu {results['drag.mu'][best]:.2f}, rms of the rest {results['misfit'][best]:.3f} N")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
