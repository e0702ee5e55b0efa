# SPDX-License-Identifier: MIT
"""PsychoPy shows, Tactus is felt: each picture is marked in the session of `tactus experiment`, with the tick of the graph. Not run here: PsychoPy is not
among the packages of the tests."""

from psychopy import core, visual   # type: ignore[import]

from tactus import lab

window = visual.Window(fullscr=False)
for name in ("wood", "steel", "skin"):
    picture = visual.TextStim(window, text=name)
    picture.draw()
    window.callOnFlip(lab.mark, "picture", name)   # when the picture appears; `tactus mark picture wood` does the same
    window.flip()
    core.wait(1.0)
window.close()
