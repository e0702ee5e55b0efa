# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the messages of sources that know nothing of translations, as patterns such as "there is no node %1". The window finds the pattern of a
message again, and translates it (host/app/text/translated.hpp).

A pattern is an expression of literals and values that are joined by +. Each value becomes %1, %2 and so on; values without a text between
them become one. If parentheses choose between texts, there is a pattern for each choice."""

import itertools
import math
import re

# Where the messages come from that the window shows. Left out: what only the command line or a programmer sees, and what goes into files.
SOURCES = {
    "Messages about limits": ["framework/check/judg*"],
    "Messages and names of fits": ["framework/fit/*", "host/fitting/fit_kinds.cpp", "host/fitting/fitting.cpp", "host/fitting/recording.cpp"],
    "Messages about graphs and values": ["framework/graph/*.cpp", "framework/plan/*", "framework/text/*", "framework/run/t*.cpp"],
    "Messages about files": ["framework/file/**/*.cpp", "host/assets/*.cpp", "host/io/clip_io.cpp", "host/io/wav.cpp"],
    "Messages about devices and runs": [
        "framework/node/device_parts.cpp", "framework/node/reading_fault.hpp", "framework/run/[ger]*.cpp",
        "framework/run/device/*.cpp", "host/sessions/*.cpp", "host/audio/*.cpp", "host/hid_link/*.cpp", "host/platform/*.cpp",
        "host/plugins/*.cpp", "host/device_plugins/*.cpp", "host/osc/osc_port.cpp", "framework/plugin/plugin_library.cpp",
    ],
}
LEFT_OUT = {"edit_names.cpp", "budget.hpp", "replay.cpp", "describe_audio.cpp", "udev_rule.cpp", "compiler_output.cpp"}

# Names of one word in these sources, which no rule can tell from ids.
WORDS = {
    "Cut", "Friction", "Impact", "Press", "Ridges", "Ring", "Texture", "acceleration", "damping", "depth", "fitted", "force", "height", "load",
    "mass", "position", "quantum", "recorded", "speed", "time", "toughness", "value",
}

TOKEN = re.compile(r'"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\\w+|\\.)\'|\d[\w.\']*|::|->|\+=|<<|&&|\|\||[=!<>]=|[\w.]+|\S')
RAW = re.compile(r'R"\(([^\n]*?)\)"')
OPEN, CLOSE = "([{", ")]}"
BREAKS = {",", ";", "?", ":", "=", "+=", "<<", "return", "&&", "||", "==", "!=", "<", ">", "<=", ">="}
WRAPPERS = {"", "std::string", "std::string_view"}
FOR_PROGRAMMERS = {"static_assert", "logic_error", "invalid_argument", "runtime_error"}
VALUE = "\0"
MOST_CHOICES, MOST_VALUES, FEWEST_LETTERS = 8, 9, 4   # letters: as in translated.cpp


def tokens_of(code):
    """The tokens of code without comments, with a list for what is in brackets."""
    stack = [[]]
    for token in TOKEN.findall(code):
        if token in OPEN:
            stack.append([token])
        elif token in CLOSE and len(stack) > 1:
            inner = stack.pop()
            stack[-1].append(inner)
        else:
            stack[-1].append(token)
    while len(stack) > 1:
        inner = stack.pop()
        stack[-1].append(inner)
    return stack[0]


def parts_of(tokens):
    """The expressions between commas, assignments and so on, each with the break after it."""
    part = []
    for token in tokens:
        if isinstance(token, str) and token in BREAKS:
            yield part, token
            part = []
        else:
            part.append(token)
    yield part, ""


def choices(part):
    """What an expression can be: texts in which a value is VALUE. And the brackets that these texts contain."""
    operands, operand = [], []
    for token in part + ["+"]:
        if token == "+":
            operands.append(operand)
            operand = []
        else:
            operand.append(token)
    each = [choices_of_operand(o) for o in operands]
    if math.prod(len(texts) for texts, _ in each) > MOST_CHOICES:
        each = [(texts, within) if len(texts) == 1 else ([VALUE], []) for texts, within in each]
    return ["".join(c) for c in itertools.product(*(texts for texts, _ in each))], [w for _, within in each for w in within]


def choices_of_operand(operand):
    strings = [t for t in operand if isinstance(t, str)]
    if operand and len(strings) == len(operand) and all(t[0] == '"' for t in strings):
        return ["".join(t[1:-1] for t in strings)], []
    if len(operand) == 1 and strings and strings[0][0] == "'":
        return [strings[0][1:-1].replace('"', '\\"')], []
    if operand and isinstance(operand[-1], list) and operand[-1][0] == "(" and "".join(strings) in WRAPPERS and len(strings) == len(operand) - 1:
        inner = operand[-1]
        parts = list(parts_of(inner[1:]))
        breaks = [b for _, b in parts]
        if "?" in breaks and set(breaks) <= {"?", ":", "", "==", "!=", "<", ">", "&&", "||", "<=", ">="}:
            start = breaks.index("?") + 1
            branches = [choices(part) for part, b in parts[start:] if b in (":", "")]
        else:
            branches = [choices(part) for part, _ in parts] if len(parts) == 1 else []
        if branches:
            return [t for texts, _ in branches for t in texts], [id(inner)] + [w for _, within in branches for w in within]
    return [VALUE], []


def numbered(text):
    """%1 for the first value, and so on; empty if this is no text of English words that a translation can have."""
    text = re.sub(VALUE + "+", VALUE, text)
    words = set(re.findall("[A-Za-z]{3,}", text)) - {"alpha", "beta", "delta", "gamma", "sigma"}
    is_code = re.search(r"\\[^\"]|^[\w.[\]]+ -> [\w.[\]]+$|::|<=? |%[.+0-9a-z]|^--|^' |`tactus fit", text)
    if not words or is_code or text.count(VALUE) > MOST_VALUES or " " not in text.strip(VALUE) or sum(c.isalpha() for c in text) < FEWEST_LETTERS:
        return ""
    pieces = text.split(VALUE)
    return "".join(p + (f"%{i}" if i < len(pieces) else "") for i, p in enumerate(pieces, 1))


def patterns(code):
    """The patterns in code without comments, and the literals of one word."""
    code = RAW.sub(lambda m: '"' + m.group(1).replace("\\", "\\\\").replace('"', '\\"') + '"', code)
    found = set()

    def visit(tokens):
        read = set()
        for part, _ in parts_of(tokens):
            texts, within = choices(part)
            found.update(numbered(t) for t in texts)
            read.update(within)
        for before, token in zip([""] + tokens, tokens):
            if isinstance(token, list) and id(token) not in read and not (isinstance(before, str) and before in FOR_PROGRAMMERS):
                visit(token[1:])

    visit(tokens_of("\n".join("" if line.lstrip().startswith("#") else line for line in code.split("\n"))))
    return found - {""} | {w for w in WORDS if f'"{w}"' in code}


def collect(root, without_comments):
    """The patterns of each section."""
    found = {}
    for title, globs in SOURCES.items():
        for path in {p for g in globs for p in root.glob(g) if p.suffix in (".hpp", ".cpp") and p.name not in LEFT_OUT}:
            for pattern in patterns(without_comments(path.read_text(encoding="utf-8"))):
                found.setdefault(pattern, title)
    missing = WORDS - set(found)
    if missing:
        raise SystemExit(f"messages.py: no source has {', '.join(sorted(missing))}")
    return found
