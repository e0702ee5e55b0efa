#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tries the kept folder (.ci/kept.sh) and the memory of tests (.ci/remember.py) with a small project: nothing is compiled or tested again that need
not be, and nothing stale is left. Exit status 77 without rsync, flock or ninja."""

import fcntl
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

CMAKE = """cmake_minimum_required (VERSION 3.25)
project (Small C)
file (GLOB sources CONFIGURE_DEPENDS *.c)
add_executable (small ${sources})
target_compile_definitions (small PRIVATE GREETING="hello")
enable_testing ()
add_test (NAME "part: says" COMMAND small ${PROJECT_SOURCE_DIR}/words.txt)
set_tests_properties ("part: says" PROPERTIES LABELS remembered REQUIRED_FILES ${PROJECT_SOURCE_DIR}/read)
add_test (NAME "always" COMMAND small)
"""
MAIN = """#include <stdio.h>
int other (void);
#ifdef GREETING
static const char* const greeting = GREETING;
#else
static const char* const greeting = "nothing";
#endif
int main (void) { printf ("says %s %d\\n", greeting, other()); return other() == 13; }
"""
OTHER = "int other (void) { return %d; }\n"
# As the real one: builds in the folder where it is, and asks the memory which tests to run.
SCRIPT = """#!/usr/bin/env bash
set -euo pipefail
if [ "${1:-}" = --kept ]; then exec .ci/kept.sh "${@:2}"; fi
if [ "${1:-}" = --install ]; then exit; fi
packages=(first)
packages+=(second)
echo "not a package (of the list)"
cd "$(dirname "$0")"
[ -f build/release/build.ninja ] || cmake -G Ninja -S . -B build/release >/dev/null
ninja -v -C build/release
build/release/small
/usr/bin/env python3 -B .ci/remember.py tests build/release "$@"
"""


class Kept(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.top = pathlib.Path(self.folder.name)
        self.keep = self.top / "keep"
        self.number = 0
        self.checkout = self.fresh()

    def tearDown(self):
        self.folder.cleanup()

    def fresh(self):
        """A fresh checkout in another folder, with the same files, all of them new."""
        self.number += 1
        checkout = self.top / f"checkout{self.number}"
        if self.number > 1:
            shutil.copytree(self.checkout, checkout, copy_function=shutil.copyfile, ignore=shutil.ignore_patterns("build"))
            for script in [checkout / "test.sh", *(checkout / ".ci").glob("*")]:
                script.chmod(0o755)
        else:
            (checkout / ".ci").mkdir(parents=True)
            (checkout / "read").mkdir()
            for script in ("kept.sh", "remember.py", "compare_builds.py", "setup.sh"):
                shutil.copy(ROOT / ".ci" / script, checkout / ".ci")
            for name, text in (("CMakeLists.txt", CMAKE), ("main.c", MAIN), ("other.c", OTHER % 1), ("words.txt", "words"), ("read/graph.json", "{}"), ("test.sh", SCRIPT)):
                (checkout / name).write_text(text, encoding="utf-8")
            (checkout / "test.sh").chmod(0o755)
        self.checkout = checkout
        return checkout

    def start(self, *options, **environment):
        variables = {k: v for k, v in os.environ.items() if not re.fullmatch(r"CC|CXX|\w*FLAGS|RC_PARAMS|TACTUS_\w+", k)}
        return subprocess.Popen(["./test.sh", "--kept", *options], cwd=self.checkout, env={**variables, "TACTUS_CI_KEEP": str(self.keep), **environment},
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def run_kept(self, *options, status=0, **environment):
        process = self.start(*options, **environment)
        text = process.communicate()[0]
        self.assertEqual(process.returncode, status, text)
        return text

    @staticmethod
    def compiled(text):
        return sorted(re.findall(r" -c \S*/(\w+\.c)", text))

    @staticmethod
    def passed(text):
        return sorted(re.findall(r"Test +#\d+: (.*?) \.+ +Passed", text))

    def test_the_same_files_in_another_checkout_compile_and_test_nothing_again(self):
        text = self.run_kept()
        self.assertEqual(self.compiled(text), ["main.c", "other.c"])
        self.assertEqual(self.passed(text), ["always", "part: says"])
        self.fresh()
        text = self.run_kept()
        self.assertEqual(self.compiled(text), [])
        self.assertEqual(self.passed(text), ["always"])
        self.assertIn("1 of 2 tests passed before, and nothing that they read has changed: part 1", text)
        self.assertTrue(text.rstrip().splitlines()[-1].startswith("Total Test time"))   # ctest's own closing lines

    def test_only_what_changed_is_compiled_and_the_memory_follows(self):
        self.run_kept()
        (self.checkout / "other.c").write_text(OTHER % 2, encoding="utf-8")
        text = self.run_kept()
        self.assertEqual(self.compiled(text), ["other.c"])
        self.assertIn("says hello 2", text)
        self.assertEqual(self.passed(text), ["always", "part: says"])

    def test_a_removed_definition_and_a_deleted_file_leave_nothing(self):
        self.run_kept()
        (self.checkout / "CMakeLists.txt").write_text(CMAKE.replace('target_compile_definitions (small PRIVATE GREETING="hello")\n', ""), encoding="utf-8")
        self.assertIn("says nothing 1", self.run_kept())
        (self.checkout / "other.c").rename(self.checkout / "another.c")
        text = self.run_kept()
        self.assertIn("another.c", self.compiled(text))
        self.assertFalse((self.keep / "tactus/other.c").exists())

    def test_a_file_that_is_named_a_seed_and_all_run_a_test_again_and_a_failure_is_not_remembered(self):
        self.run_kept()
        self.assertEqual(self.passed(self.run_kept()), ["always"])
        (self.checkout / "read/graph.json").write_text('{ "version": 2 }', encoding="utf-8")
        self.assertIn("part: says", self.passed(self.run_kept()))
        (self.checkout / "words.txt").write_text("other words", encoding="utf-8")
        self.assertIn("part: says", self.passed(self.run_kept()))
        self.assertIn("part: says", self.passed(self.run_kept(RC_PARAMS="seed=2")))
        self.assertIn("part: says", self.passed(self.run_kept("--all", RC_PARAMS="seed=2")))
        (self.checkout / "test.sh").write_text(SCRIPT.replace("build/release/small\n", ""), encoding="utf-8")
        (self.checkout / "other.c").write_text(OTHER % 13, encoding="utf-8")
        for _ in range(2):
            self.assertIn("part: says (Failed)", self.run_kept(status=8))
        (self.checkout / "other.c").write_text(OTHER % 2, encoding="utf-8")
        self.assertIn("part: says", self.passed(self.run_kept()))

    def test_other_flags_and_a_clock_that_was_set_back_delete_what_was_built(self):
        self.run_kept()
        self.assertEqual(self.compiled(self.run_kept(CFLAGS="-O1")), ["main.c", "other.c"])
        self.assertEqual(self.compiled(self.run_kept(CFLAGS="-O1")), [])
        script = self.checkout / "test.sh"
        script.write_text(SCRIPT.replace("of the list", "of any list"), encoding="utf-8")
        self.assertEqual(self.compiled(self.run_kept(CFLAGS="-O1")), [])
        script.write_text(SCRIPT.replace("(second)", "(another)"), encoding="utf-8")
        self.assertEqual(self.compiled(self.run_kept(CFLAGS="-O1")), ["main.c", "other.c"])
        later = (self.keep / "flags").stat().st_mtime + 1e6
        os.utime(self.keep / "flags", (later, later))
        text = self.run_kept(CFLAGS="-O1")
        self.assertIn("the clock was set back", text)
        self.assertEqual(self.compiled(text), ["main.c", "other.c"])
        packages = (self.keep / "packages").read_text(encoding="utf-8")
        (self.keep / "packages").write_text(packages + "zzz-gone:amd64 1.0 ii \n", encoding="utf-8")
        text = self.run_kept(CFLAGS="-O1")
        self.assertIn("these packages changed or are gone: zzz-gone:amd64 1.0", text)
        self.assertEqual(self.compiled(text), ["main.c", "other.c"])

    def test_a_second_run_does_not_share_the_folder(self):
        self.run_kept()
        with open(self.keep / "lock", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            text = self.run_kept(TACTUS_CI_WAIT="0")
        self.assertIn("another run uses", text)
        self.assertEqual(self.compiled(text), ["main.c", "other.c"])
        self.assertTrue((self.checkout / "build").is_dir())

    def test_without_a_folder_or_with_that_of_another_user_it_works_in_the_checkout(self):
        for keep in ("", "/proc/none"):
            text = self.run_kept(TACTUS_CI_KEEP=keep)
            self.assertIn("Without a kept folder", text)
            self.assertIn("says hello 1", text)
        if os.getuid() == 0:
            (self.keep / "tactus").mkdir(parents=True)
            os.chown(self.keep, 65534, 65534)
            self.assertIn("belongs to another user", self.run_kept())

    def test_kill_9_at_ten_places_leaves_a_next_run_that_is_right(self):
        for place in range(10):
            (self.checkout / "other.c").write_text(OTHER % (20 + place), encoding="utf-8")
            process = self.start()
            for _ in range(place * 2):   # after so many lines of what it prints
                process.stdout.readline()
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()   # until all that it started is gone
            text = self.run_kept()
            self.assertIn(f"says hello {20 + place}", text, f"killed after {place * 2} lines")
            again = self.run_kept()
            self.assertEqual(self.passed(again), ["always"], f"killed after {place * 2} lines\n{text}\n{again}")

    def test_an_object_that_somebody_changed_is_found(self):
        self.run_kept()
        tree = self.keep / "tactus"
        poisoned = next((tree / "build").rglob("other.c.o"))
        good = poisoned.read_bytes()
        shutil.copytree(tree / "build", tree / "build.kept")
        compare = [tree / ".ci/compare_builds.py", tree / "build.kept", tree / "build"]
        self.assertEqual(subprocess.run(["python3", *compare], stdout=subprocess.PIPE, check=False).returncode, 0)
        kept = tree / "build.kept" / poisoned.relative_to(tree / "build")
        kept.write_bytes(good.replace(good[-8:], b"poisoned"))
        found = subprocess.run(["python3", *compare], stdout=subprocess.PIPE, text=True, check=False)
        self.assertEqual(found.returncode, 1)
        self.assertIn("other.c.o", found.stdout)


class Crash(unittest.TestCase):
    def test_a_process_that_dies_hides_no_other_failure_of_its_file(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder, "tests")
            program.write_text("""#!/usr/bin/env bash
case "$*" in
    *--list-test-names-only) printf 'first\\nsecond, which dies\\nthird\\n' ;;
    *first) echo 'All tests passed' ;;
    *third) echo 'test cases: 1 | 1 failed'; exit 1 ;;
    *) kill -SEGV $$ ;;
esac
""", encoding="utf-8")
            program.chmod(0o755)
            ran = subprocess.run(["python3", "-B", ROOT / "tests/support/run_file.py", program, "some_test"], stdout=subprocess.PIPE, text=True, check=False)
        self.assertEqual(ran.returncode, 1)
        self.assertIn("== died: second, which dies", ran.stdout)
        self.assertIn("== failed: third", ran.stdout)
        self.assertNotIn("first", ran.stdout)


if __name__ == "__main__":
    if not all(map(shutil.which, ("rsync", "flock", "ninja", "cmake"))):
        print("skipped: rsync, flock, ninja or cmake is not installed")
        raise SystemExit(77)
    unittest.main()
