#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes zip.json: the teeth of a zip, one every 20 ms of a clip of 0.8 s that lies along 80 mm.

Each tooth is a transient. No two are alike, as in a zip that has been used. Nothing was measured.

    python3 zip_clip.py > zip.json
"""
import random

TEETH, APART = 40, 0.02


def main():
    dice = random.Random(4)
    teeth = [(round(i * APART + dice.uniform(0.0, 0.001), 4), round(dice.uniform(0.7, 1.0), 2), round(dice.uniform(0.2, 0.8), 2)) for i in range(TEETH)]
    rows = ",\n        ".join(f"[{t}, {a}, {s}]" for t, a, s in teeth)
    print(f"""{{
  "format": "tactus-clip",
  "version": 1,
  "notes": {{ "description": "The teeth of a zip; zip_clip.py writes it" }},
  "voice": {{ "lowest": 50.0, "highest": 100.0, "transient_lowest": 80.0, "transient_highest": 105.0, "ducking": 1.0 }},
  "tracks": [
    {{
      "channel": 1,
      "amplitude": [[0.0, 0.08], [{TEETH * APART}, 0.08]],
      "sharpness": [[0.0, 0.5]],
      "transients": [
        {rows}
      ]
    }}
  ]
}}""")


main()
