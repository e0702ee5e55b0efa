# SPDX-License-Identifier: MIT
"""A 2-down-1-up staircase on roughness with a simulated observer, and its figures.

    python3 staircase.py [FOLDER]     without a folder, nothing stays
"""

import pathlib
import sys
import tempfile

from tactus import lab


def protocol() -> lab.Protocol:
    block = lab.Block(name="wood", task="2ifc", varies=lab.Varies(target="roughness", unit="1", standard=0.0, rest=0.0), interval=1.0, practice=2,
                      procedure=lab.Staircase(start=0.9, steps=(0.2, 0.1, 0.05), low=0.0, high=1.0, trials=80))
    return lab.Protocol(name="staircase", graph="dry_wood", devices={"stylus": "gesture:circle"}, blocks=[block])


def main() -> None:
    with tempfile.TemporaryDirectory() as temporary:
        out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else temporary)
        observer = lab.Observer(threshold=0.4, width=0.08, lapse=0.01)
        data = lab.Experiment(protocol(), out, window=lab.Simulated(observer), stage=lab.Silent()).run()   # without the stage, it plays the graph
        fit = data.fit("wood")
        assert isinstance(fit, lab.Psychometric)
        print(f"threshold {fit.threshold:.3f} (95 % {fit.threshold_interval.low:.3f} to {fit.threshold_interval.high:.3f}), true 0.400")
        print(f"mean of the reversals {lab.mean_of_turns(data.turns('wood')['graph/0']):.3f}, where 70.7 % are right")
        if len(sys.argv) > 1:
            lab.save_plot(fit.plot(), out / "fit.svg")
            chosen = data.chosen("wood")
            lab.save_plot(lab.plot_staircase(chosen["levels"], chosen["outcomes"]), out / "staircase.svg")
            data.write("mat")


if __name__ == "__main__":
    main()
