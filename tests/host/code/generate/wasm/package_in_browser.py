#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""An exported folder in Chromium: package_in_browser.py FOLDER TRACE.csv [NAME=VALUE...]. Moves the tool as the trace says, plays the AudioWorklet in an
OfflineAudioContext, and uses the page of the folder with a pointer and a simulated gamepad. Prints what the graph records, as render_in_node.mjs does. Exit
status 77 if there is no Chromium."""

import functools
import http.server
import json
import pathlib
import queue
import shutil
import subprocess
import sys
import tempfile
import threading

HERE = pathlib.Path(__file__).resolve().parent
PATIENCE_S = 300   # only if the browser hangs


class Handler(http.server.SimpleHTTPRequestHandler):
    job, found = {}, queue.Queue()

    def translate_path(self, path):
        own = path.removeprefix("/test/")
        return str(HERE / own) if own != path else super().translate_path(path)

    def do_GET(self):
        if self.path != "/test/job":
            return super().do_GET()
        return self.answer(json.dumps(self.job).encode())

    def do_POST(self):
        self.found.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.answer(b"")

    def answer(self, body):
        self.send_response(200)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format, *arguments):
        pass


def main(folder, trace, *sets):
    browser = shutil.which("chromium")
    if browser is None:
        print("skipped: needs chromium")
        return 77
    name = json.loads(pathlib.Path(folder, "package.json").read_text(encoding="utf-8"))["name"]
    Handler.job = {"name": name, "trace": pathlib.Path(trace).read_text(encoding="utf-8"), "sets": sets}
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        process = subprocess.Popen([browser, "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--disable-audio-output",
                                    f"--user-data-dir={profile}",
                                    "--autoplay-policy=no-user-gesture-required",
                                    f"http://127.0.0.1:{server.server_port}/test/package_in_browser.html"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            found = Handler.found.get(timeout=PATIENCE_S)
        finally:
            process.terminate()
            process.wait()
    if found.get("fault") or found["different"] != 0 or found["rumbles"] is not True or found["plays"] is not True:
        print({key: value for key, value in found.items() if key != "lines"}, file=sys.stderr)
        return 1
    print("\n".join(found["lines"]))
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
