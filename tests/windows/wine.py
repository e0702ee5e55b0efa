# SPDX-License-Identifier: MIT
"""The server of wine, which programs of Windows need. It stays, so that they start at once."""

import pathlib
import subprocess


def restart(wine, environment=None):
    """Starts it again, with all that it starts: these would hold the pipes of the first program."""
    server = pathlib.Path(wine).with_name("wineserver64")
    for command in ([server, "-k"], [server, "-p"], [wine, "hostname"]):
        subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, check=False)


def add_port(wine, name, link):
    """Lets the file `link` be the serial port of this name. Wine looks for ports when it starts."""
    subprocess.run([wine, "reg", "add", "HKLM\\Software\\Wine\\Ports", "/v", name, "/d", link, "/f"], check=True, capture_output=True)


def end(wine, environment=None):
    subprocess.run([pathlib.Path(wine).with_name("wineserver64"), "-k"], env=environment, check=False)
