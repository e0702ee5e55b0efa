# SPDX-License-Identifier: MIT
"""A JACK server without hardware, and a recording of its output, for the scripts of ./test.sh --sound."""
import os
import subprocess
import time


class Server:
    """Runs the dummy driver with this block size (in frames) and this many channels. The server name is unique, so other servers can run too."""

    def __init__(self, rate, block, channels):
        self.rate, self.block, self.channels = rate, block, channels
        self.environment = dict(os.environ, JACK_NO_AUDIO_RESERVATION="1", JACK_DEFAULT_SERVER=f"tactus-{os.getpid()}")
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            ["jackd", "-n", self.environment["JACK_DEFAULT_SERVER"], "-d", "dummy", "-r", str(self.rate), "-p", str(self.block),
             "-C", str(self.channels), "-P", str(self.channels)],
            env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        for _ in range(100):
            time.sleep(0.1)
            listed = subprocess.run(["jack_lsp"], env=self.environment, capture_output=True, text=True)
            if f"system:playback_{self.channels}" in listed.stdout:
                return
        self.end()
        raise SystemExit("jackd did not start")

    def capture(self, file, seconds, channels, bits="FLOAT"):
        """Starts recording these channels of the card, counted from 1. The caller waits for the process."""
        ports = [word for c in channels for word in ("-p", f"system:playback_{c}")]
        return subprocess.Popen(
            ["jack_capture", "-d", str(seconds), "-b", str(bits), "-c", str(len(channels)), *ports, str(file)],
            env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )

    def end(self):
        self.process.terminate()
        self.process.wait()
