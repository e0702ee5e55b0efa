# SPDX-License-Identifier: MIT
"""The catalogue of node types."""

from __future__ import annotations

import json
from typing import Any, Dict

from . import _tactus


def nodes() -> Dict[str, Dict[str, Any]]:
    """The datasheets of all node types, by id, in the JSON format of `tactus nodes`: name, summary, source, and for each input, param,
    setting and output its unit, range and default."""
    return {sheet["id"]: sheet for sheet in json.loads(_tactus.nodes_json())}
