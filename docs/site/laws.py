# SPDX-License-Identifier: MIT
"""Typesets the laws in the comments of headers, which are plain text such as `f = -sigma d,   sigma = mu f_n / d_max`."""

import re

GREEK = {"alpha", "beta", "gamma", "delta", "zeta", "theta", "lambda", "mu", "nu", "pi", "phi", "sigma", "tau", "omega"}
FUNCTIONS = {"min", "max", "cos", "sin", "tan", "exp", "sqrt", "sgn", "clamp", "grad"}
OPERATORS = {"<-": r"\leftarrow ", "->": r"\rightarrow ", "<=": r"\le ", ">=": r"\ge ", "=": "=", "+": "+", "-": "-", "*": r"\,", "/": "/", "<": "<", ">": ">",
             ",": ",\\ ", ";": ";\\ ", ".": r"\cdot "}
TOKEN = re.compile(r"\s*(?:(?P<number>\d+(?:\.\d+)?(?:e-?\d+)?)|(?P<name>[A-Za-z]+\d*(?:_[A-Za-z0-9]+)*)(?P<mark>~|'{1,2}(?!\w))?"
                   r"|(?P<operator><-|->|<=|>=|[=+\-*/<>,;])|(?P<dot>\.(?=\s))"
                   r"|(?P<open>[(\[])|(?P<close>[)\]])|(?P<bar>\|)|(?P<raised>\^)|(?P<lowered>_(?=\()))")


class NoFormula(Exception):
    """The text has a word or a sign that is not known."""


def subscript(text):
    return text if len(text) == 1 or text.isdigit() else rf"\mathrm{{{text}}}"


def name(text, ports):
    """A name in TeX: a port, a Greek or Latin letter with subscripts, a function, or a differential such as dp."""
    if text in FUNCTIONS:
        return rf"\operatorname{{{text}}}"
    head, *below = text.split("_")
    letters, digits = re.fullmatch(r"([A-Za-z]+)(\d*)", head).groups()
    if text in ports and len(letters) > 1 and letters not in GREEK:
        return rf"\mathrm{{{text}}}".replace("_", r"\_")
    if letters in GREEK or len(letters) == 1:
        made = f"\\{letters}" if letters in GREEK else letters
    elif letters[0] == "d" and (letters[1:] in GREEK or len(letters) == 2):
        made = rf"\mathrm{{d}}{name(letters[1:], ports)}"
    else:
        raise NoFormula(text)
    below = ([digits] if digits else []) + below
    return made + (f"_{{{','.join(subscript(part) for part in below)}}}" if below else " ")


def group(text, at):
    """The end of what stands in the brackets that open at `at`."""
    depth = 0
    for k in range(at, len(text)):
        depth += text[k] in "([" or -(text[k] in ")]")
        if depth == 0:
            return k + 1
    raise NoFormula("a bracket that does not close")


def formula(text, ports=()):
    """The TeX of a formula. Throws NoFormula if the text is none."""
    made, at, after_operand, is_inside, depth = "", 0, False, False, 0
    text = text.rstrip()
    while at < len(text):
        token = TOKEN.match(text, at)
        if not token:
            raise NoFormula(text[at:])
        kind, at = token.lastgroup if token.lastgroup != "mark" else "name", token.end()
        if kind in ("raised", "lowered"):
            sign = "^" if kind == "raised" else "_"
            if text[at:at + 1] == "(":
                end = group(text, at)
                made += f"{sign}{{{formula(text[at + 1:end - 1], ports)}}}"
                at = end
            else:
                power = re.compile(r"-?\d+|-(?=\s|$)|[A-Za-z]+").match(text, at)
                if not power:
                    raise NoFormula(text[at:])
                made += f"^{{{name(power[0], ports) if power[0].isalpha() else power[0]}}}"
                at = power.end()
            after_operand = True
            continue
        opens = kind in ("number", "name", "open") or (kind == "bar" and not is_inside)
        if opens and after_operand:
            made += "" if kind == "open" else r"\,"
        if kind == "name" and token["name"].startswith("sum_"):
            made += rf"\sum_{{{token['name'][4:]}}} "
            after_operand = False
            continue
        if kind == "name" and token["name"] == "sqrt" and (bracket := re.compile(r"\s*\(").match(text, at)):
            end = group(text, bracket.end() - 1)
            made += rf"\sqrt{{{formula(text[bracket.end():end - 1], ports)}}}"
            at, after_operand = end, True
            continue
        if kind == "number":
            made += token["number"]
        elif kind == "name":
            one = name(token["name"], ports)
            mark = token["mark"]
            made += rf"\tilde{{{one}}}" if mark == "~" else one.rstrip() + (mark or "") + " "
        elif kind == "operator":
            made += OPERATORS[token["operator"]]
        elif kind == "dot":
            made += OPERATORS["."]
        elif kind == "open":
            depth += 1
            made += token["open"]
        elif kind == "close":
            depth -= 1
            made += token["close"]
        else:
            made += r"\rvert " if is_inside else r"\lvert "
            is_inside = not is_inside
        after_operand = kind in ("number", "name", "close") or (kind == "bar" and not is_inside)
        if kind == "name" and token["name"] in FUNCTIONS:
            after_operand = False
    if is_inside or depth != 0:
        raise NoFormula(text)
    return made.strip()


def typeset(chunk, ports):
    """A part of a line as a formula, or None."""
    try:
        if not re.search(r"\S\s*(?:[=<>]|<-)\s*\S", chunk):
            return None
        return f"${formula(chunk, ports).removesuffix(OPERATORS[','].rstrip())}$"
    except NoFormula:
        return None


def cell(text):
    return re.sub(r"([|<*_\\])", r"\\\1", text)


def law(lines, ports=()):
    """A table of the lines of a law: a name, the formula, and what stands beside it. None if most lines are words."""
    rows, count = [], 0   # lines with a formula
    for line in lines:
        chunks = re.split(r"\s{2,}", re.sub(r"\s+=", " =", line.strip()))
        made = [typeset(chunk, ports) for chunk in chunks]
        count += any(made)
        first = next((i for i, part in enumerate(made) if part), None)
        if first is None:   # words, or a formula that is left as it is
            is_code = [bool(re.search(r" = | < ", chunk)) and not chunk.endswith(":") for chunk in chunks]
            first = is_code.index(True) if True in is_code else min(1, len(chunks) - 1)
            made[first] = f"`` {chunks[first]} ``" if True in is_code else None
        last = max((i for i, part in enumerate(made) if part), default=first - 1)
        middle = [part or cell(chunk) for chunk, part in zip(chunks, made)][first:last + 1]
        rows.append((" ".join(cell(chunk) for chunk in chunks[:first]), ", ".join(middle), " ".join(cell(chunk) for chunk in chunks[last + 1:])))
    if 2 * count < len(lines):
        return None
    kept = [i for i in range(3) if any(row[i] for row in rows)]
    return "| " + " | ".join("" for _ in kept) + " |\n|" + "---|" * len(kept) + "\n" + "".join("| " + " | ".join(row[i] for i in kept) + " |\n" for row in rows)
