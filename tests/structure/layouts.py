#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that no type in an installed header of the libraries changes its layout with the flags of a compiler.

Usage: layouts.py SOURCE_FOLDER COMPILER INCLUDE_FOLDER EIGEN_FOLDER. The compiler is g++ or a clang++ of version 14 or later.

Eigen aligns some of its types as the vector instructions of the processor like it, and takes the memory of matrices of any size in a way
that depends on the same flags. So a program and the library may differ. There are two checks:

- Headers name only types of Eigen that are the same everywhere: those of ALLOWED, and those with the option DontAlign.
- With g++: every class has the same size and alignment with the flags of the library, and with AVX-512 and vectors of Eigen.

Headers of nodes are not checked: they are compiled with the flags of the library (tactus::node_flags)."""

import pathlib
import re
import subprocess
import sys
import tempfile

ALLOWED = {"Vector3d", "Matrix3d", "Matrix<V, 3, 1>", "Index", "Dynamic", "DontAlign", "NumTraits", "GenericNumTraits"}
NOT_INSTALLED = re.compile(r"^(capi|examine|python|kit/single)/|^fit/(least_squares|ring_[a-z]+|spectrum_model)\.hpp$|^check/pair\.hpp$")   # framework/install.cmake
NAME = re.compile(r"\bEigen::(\w+(?:<[^;{}()]*?>(?=[\s;&*>)]))?)")
SAME_BITS = ["-DEIGEN_DONT_VECTORIZE", "-ffp-contract=off"]
OTHERS = ["-mavx512f", "-mfma"]


def headers(source):
    for path in sorted((source / "framework").rglob("*.hpp")):
        name = path.relative_to(source / "framework").as_posix()
        if not NOT_INSTALLED.match(name):
            yield name, path


def named(source):
    """The types of Eigen that may have another layout elsewhere, as FILE:LINE: NAME."""
    for name, path in headers(source):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            code = line.split("//")[0]
            for found in NAME.findall(code):
                if found not in ALLOWED and "DontAlign" not in found and found.split("<")[0] not in ("NumTraits", "GenericNumTraits"):
                    yield f"framework/{name}:{number}: Eigen::{found} has another layout with other flags: use one with Eigen::DontAlign, or std::array"


def layouts(source, compiler, include, eigen, flags):
    """Size and alignment of every class of Tactus that the headers define."""
    with tempfile.TemporaryDirectory() as folder:
        code = pathlib.Path(folder) / "all.cpp"
        code.write_text("".join(f"#include <tactus/{name}>\n" for name, _ in headers(source)))
        subprocess.run([compiler, "-std=c++20", "-w", *flags, f"-I{include}", "-isystem", eigen, "-fdump-lang-class=classes", "-fsyntax-only", code],
                       cwd=folder, check=True)
        text = (pathlib.Path(folder) / "classes").read_text()
    found = re.findall(r"^Class (tactus::\S.*)\n\s+size=(\d+) align=(\d+)", text, re.MULTILINE)
    return {name: (size, align) for name, size, align in found}


def main():
    source, compiler, include, eigen = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3], sys.argv[4]
    problems = list(named(source))
    version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout
    if "clang" not in version and "x86_64" in subprocess.run([compiler, "-dumpmachine"], capture_output=True, text=True, check=True).stdout:
        ours = layouts(source, compiler, include, eigen, SAME_BITS)
        theirs = layouts(source, compiler, include, eigen, OTHERS)
        if len(ours) < 200 or ours.keys() != theirs.keys():
            problems.append(f"{len(ours)} classes with the flags of the library and {len(theirs)} with others: this check sees too little")
        for name in ours.keys() & theirs.keys():
            if ours[name] != theirs[name]:
                problems.append(f"{name}: size and alignment are {ours[name]} with the flags of the library, and {theirs[name]} with {' '.join(OTHERS)}")
        print(f"{len(ours)} classes")
    print("\n".join(problems))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
