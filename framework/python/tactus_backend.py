# SPDX-License-Identifier: MIT
"""Makes the wheel of the package tactus with CMake (PEP 517). It needs no other package; docs/python.md says what CMake needs.

The config setting `build-dir`, or the environment variable TACTUS_BUILD, names a build folder in which the targets of TARGETS are built. Without one,
everything is built in a temporary folder."""

import base64
import hashlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import time
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TARGETS = ["tactus_python", "tactus_live_shared", "force-guardian"]
LICENCES = ["LICENSE", "LICENSES/MIT.txt", "framework/python/licences_of_others.txt"]


# ---------------------------------------------------------------------------- The hooks

def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as work:
        stage = pathlib.Path(work, "stage")
        _install(_build(pathlib.Path(work, "build"), config_settings or {}), stage)
        _check_interpreter(stage)
        _write_metadata(stage / _dist_info())
        name = f"tactus-{_version()}-{_tag()}.whl"
        _pack(stage, pathlib.Path(wheel_directory, name))
    return name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    _write_metadata(pathlib.Path(metadata_directory, _dist_info()))
    return _dist_info()


def build_sdist(sdist_directory, config_settings=None):
    """The sources, with a pyproject.toml at the top that leads here."""
    base = f"tactus-{_version()}"
    project = (HERE / "pyproject.toml").read_text(encoding="utf-8").replace('backend-path = ["."]', 'backend-path = ["framework/python"]')
    with tarfile.open(pathlib.Path(sdist_directory, base + ".tar.gz"), "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for path in _sources():
            archive.add(ROOT / path, f"{base}/{path}", recursive=False, filter=_anonymous)
        for name, text in (("pyproject.toml", project), ("PKG-INFO", _metadata())):
            data = text.encode()
            info = tarfile.TarInfo(f"{base}/{name}")
            info.size, info.mtime, info.mode = len(data), _date(), 0o644
            archive.addfile(info, io.BytesIO(data))
    return base + ".tar.gz"


# ---------------------------------------------------------------------------- Building

def _build(folder, settings):
    """The build folder, in which the targets are built."""
    given = settings.get("build-dir") or os.environ.get("TACTUS_BUILD")
    if given:
        if not pathlib.Path(given, "cmake_install.cmake").is_file():
            sys.exit(f"build-dir: {given} is no build folder of CMake; configure it, and build the targets {' '.join(TARGETS)}")
        return pathlib.Path(given).resolve()
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    _run("cmake", "-S", ROOT, "-B", folder, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DTACTUS_HOST=OFF", "-DTACTUS_LIVE=ON", "-DTACTUS_TESTS=OFF",
         "-DTACTUS_PYTHON=ON", "-DTACTUS_INSTALL=ON", "-DTACTUS_JOIN=ON", f"-DPython_EXECUTABLE={sys.executable}")
    _run("cmake", "--build", folder, "--parallel", os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count() or 1), "--target", *TARGETS)
    return folder


def _install(build, stage):
    _run("cmake", "--install", build, "--component", "wheel", "--prefix", stage, "--strip")
    if not list(stage.glob("tactus/_tactus*")):
        sys.exit(f"{build} has no Python package: CMake needs pybind11, the headers of Python and hidapi, and TACTUS_INSTALL=ON")
    # A wheel cannot hold links, so the library has the name under which it is loaded.
    for link in [p for p in stage.rglob("*") if p.is_symlink()]:
        target = link.resolve()
        link.unlink()
        target.rename(link)


def _check_interpreter(stage):
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    if not (stage / f"tactus/_tactus{suffix}").is_file():
        made = ", ".join(p.name for p in stage.glob("tactus/_tactus*"))
        sys.exit(f"{made} is for another Python: {sys.executable} needs _tactus{suffix}; configure with -DPython_EXECUTABLE={sys.executable}")


def _run(*command):
    subprocess.run([str(part) for part in command], check=True)


# ---------------------------------------------------------------------------- Metadata

def _version():
    return re.search(r"project \(Tactus VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def _dist_info():
    return f"tactus-{_version()}.dist-info"


def _tag():
    """The interpreter and the platform that the module is for."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}{getattr(sys, 'abiflags', '')}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _project():
    try:
        import tomllib
    except ImportError:   # before Python 3.11
        import tomli as tomllib
    return tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def _metadata():
    project = _project()
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}", f"Summary: {project['description']}",
             f"Keywords: {','.join(project['keywords'])}", f"License: {project['license']['text']}"]
    lines += [f"License-File: {path}" for path in LICENCES]
    lines += [f"Classifier: {each}" for each in project["classifiers"]]
    lines += [f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {each}" for each in project["dependencies"]]
    for extra, packages in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}"] + [f'Requires-Dist: {each}; extra == "{extra}"' for each in packages]
    page = re.sub(r"\]\((?!http)[^)]*\)", "]", (ROOT / "docs/python.md").read_text(encoding="utf-8"))   # links lead nowhere outside of the tree
    return "\n".join(lines + ["Description-Content-Type: text/markdown", "", page])


def _write_metadata(folder):
    folder.mkdir(parents=True)
    (folder / "METADATA").write_text(_metadata(), encoding="utf-8")
    (folder / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: tactus_backend {_version()}\nRoot-Is-Purelib: false\nTag: {_tag()}\n", encoding="utf-8")
    for path in LICENCES:
        (folder / "licenses" / path).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / path, folder / "licenses" / path)


# ---------------------------------------------------------------------------- Packing

def _date():
    """The time of all files, in s since 1970, so that two builds give the same bytes."""
    return max(int(os.environ.get("SOURCE_DATE_EPOCH", "0")), 315619200)   # zip files begin in 1980


def _pack(stage, wheel):
    record = _dist_info() + "/RECORD"
    rows = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        def add(name, data, mode):
            info = zipfile.ZipInfo(name, time.gmtime(_date())[:6])
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = (0o100000 | mode) << 16
            archive.writestr(info, data)

        for path in sorted(p for p in stage.rglob("*") if p.is_file()):
            name, data = path.relative_to(stage).as_posix(), path.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            rows.append(f"{name},sha256={digest},{len(data)}\n")
            add(name, data, 0o755 if os.access(path, os.X_OK) else 0o644)
        add(record, "".join(rows) + f"{record},,\n", 0o644)


def _sources():
    """The files of the source tree, relative to its top."""
    if (ROOT / ".git").exists():
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"], stdout=subprocess.PIPE, check=True).stdout.decode()
        return sorted(path for path in listed.split("\0") if path and (ROOT / path).is_file())
    skipped = {"build", "out", "pyproject.toml", "PKG-INFO"}
    return sorted(p.relative_to(ROOT).as_posix() for p in ROOT.rglob("*") if p.is_file() and p.relative_to(ROOT).parts[0] not in skipped
                  and "__pycache__" not in p.parts)


def _anonymous(info):
    info.uid = info.gid = 0
    info.uname = info.gname = ""
    info.mtime = _date()
    return info
