# SPDX-License-Identifier: MIT
"""Checks a JSON schema against examples: good examples must be valid, and must be invalid after each bad change.

Exits with status 77 (skipped) if python3-jsonschema is not installed."""

import copy
import json
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(77)


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


def first_example(page):
    """The first JSON block in a Markdown page."""
    return json.loads(page.read_text(encoding="utf-8").split("```json")[1].split("```")[0])


def changed(example, path, value):
    """A copy of an example with a different value at a path; None removes the key."""
    example = copy.deepcopy(example)
    inner = example
    for key in path[:-1]:
        inner = inner[key]
    if value is None:
        del inner[path[-1]]
    else:
        inner[path[-1]] = value
    return example


class SchemaCheck:
    def __init__(self, schema_path):
        schema = read_json(schema_path)
        jsonschema.Draft202012Validator.check_schema(schema)
        self.validator = jsonschema.Draft202012Validator(schema)
        self.failures = 0

    def complain(self, text):
        self.failures += 1
        print(text)

    def must_fit(self, name, example):
        for error in self.validator.iter_errors(example):
            self.complain(f"{name}: {error.json_path}: {error.message}")

    def must_refuse(self, name, example, changes):
        """Each change is a path into the example and the bad value there."""
        for path, value in changes:
            if self.validator.is_valid(changed(example, path, value)):
                self.complain(f"accepted although it is wrong: {name} {path} = {value!r}")

    def finish(self, counts):
        print(f"{counts}, {self.failures} failures")
        sys.exit(1 if self.failures else 0)
