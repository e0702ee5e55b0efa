# SPDX-License-Identifier: MIT
"""Marks from outside by OSC, and triggers over a serial line."""

from __future__ import annotations

import contextlib
import os
import queue
import secrets
import socket
import struct
import threading
from typing import Callable, List, Optional, Tuple, Union

from .._messages import fail
from ._protocol import Triggers
from ._stages import Marks, Moment, Silent

PORT = 7771   # of experiments; 7770 is that of `tactus play`
NO_MESSAGE = ValueError, KeyError, struct.error   # what is wrong with a packet

Argument = Union[str, float, int]
_NUMBERS = {"i": ">i", "f": ">f", "h": ">q", "d": ">d"}


def osc(address: str, *arguments: Argument) -> bytes:
    """An OSC message with texts, whole numbers (32 bits) and other numbers (32 bits)."""
    kinds = ["s" if isinstance(each, str) else "i" if isinstance(each, int) else "f" for each in arguments]
    data = (_padded(each) if isinstance(each, str) else struct.pack(_NUMBERS[kind], each) for kind, each in zip(kinds, arguments))
    return b"".join([_padded(address), _padded("," + "".join(kinds)), *data])


def read_osc(packet: bytes) -> Tuple[str, List[Argument]]:
    """The address and the arguments of an OSC message. It raises one of NO_MESSAGE if the packet is not one."""
    address, rest = _text(packet)
    types, rest = _text(rest)
    if not address.startswith("/") or not types.startswith(","):
        raise ValueError("it is not a message")
    found: List[Argument] = []
    for kind in types[1:]:
        if kind == "s":
            value, rest = _text(rest)
        else:
            (value,), rest = struct.unpack_from(_NUMBERS[kind], rest), rest[struct.calcsize(_NUMBERS[kind]):]
        found.append(value)
    return address, found


def _padded(text: str) -> bytes:
    data = text.encode() + b"\0"
    return data + b"\0" * (-len(data) % 4)


def _text(data: bytes) -> Tuple[str, bytes]:
    end = data.index(b"\0")
    return data[:end].decode(), data[end + 4 - end % 4:]


class Receiver:
    """Receives /tactus/mark (name, and perhaps a value) and /tactus/answer (an answer, and the token) on this computer, on a thread of its own. Both get
    /tactus/done back. A mark is only kept. An answer may raise the next level, and with it a force, so it needs the token that the experiment shows."""

    def __init__(self, port: int = PORT):
        """port: UDP port on 127.0.0.1; 0: any free one."""
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.bind(("127.0.0.1", port))
        except OSError as why:
            self._socket.close()
            fail("lab/port", str(port), f"the port cannot be opened: {why}", "choose another one with --osc, or 0 for any")
        self.token = secrets.token_hex(4)
        self.port: int = self._socket.getsockname()[1]
        self.now: Callable[[], Moment] = Silent().now   # the clock of the experiment
        self.marks: Marks = queue.Queue(10000)
        self.answers: "queue.Queue[str]" = queue.Queue(100)
        self._thread = threading.Thread(target=self._receive, name="tactus.lab marks", daemon=True)
        self._thread.start()

    def _receive(self) -> None:
        while True:
            packet, sender = self._socket.recvfrom(4096)
            if not packet:
                return
            try:
                address, given = read_osc(packet)
                if address == "/tactus/mark" and given:
                    self.marks.put_nowait((str(given[0])[:1000], " ".join(map(str, given[1:]))[:1000], self.now()))
                elif address == "/tactus/answer" and len(given) == 2 and secrets.compare_digest(str(given[1]).encode(), self.token.encode()):
                    self.answers.put_nowait(str(given[0])[:1000])
                else:
                    continue
                self._socket.sendto(osc("/tactus/done", address, given[0]), sender)
            except (*NO_MESSAGE, queue.Full, OSError):
                continue   # a stranger's packet

    def answer(self) -> Optional[str]:
        """The oldest answer that was not taken yet; None if there is none."""
        with contextlib.suppress(queue.Empty):
            return self.answers.get_nowait()
        return None

    def close(self) -> None:
        """Ends the thread."""
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
            own.sendto(b"", ("127.0.0.1", self.port))
        self._thread.join()
        self._socket.close()


def mark(text: str, value: str = "", port: int = PORT, wait: float = 2.0) -> bool:
    """Sends a mark to the experiment that runs on this computer, as `tactus mark` does. wait: for its reply, in s. True if it replied."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as own:
        own.settimeout(wait)
        try:
            own.sendto(osc("/tactus/mark", text, *([value] if value else [])), ("127.0.0.1", port))
            return read_osc(own.recv(4096))[0] == "/tactus/done"
        except (OSError, *NO_MESSAGE):
            return False


class TriggerLine:
    """A serial line that carries a byte for each mark."""

    def __init__(self, triggers: Triggers):
        import termios
        import tty

        self._codes = triggers.codes
        speed = getattr(termios, f"B{triggers.baud}", None)
        if speed is None:
            fail("lab/value", "/triggers/baud", f"serial lines of this system have no speed of {triggers.baud} bits per second",
                 "give a standard one, such as 115200")
        try:
            self._line = os.open(triggers.port, os.O_WRONLY | os.O_NOCTTY | os.O_NONBLOCK)
            tty.setraw(self._line)   # a file that is no serial line is refused here, before anything is written
            now = termios.tcgetattr(self._line)
            now[4] = now[5] = speed
            termios.tcsetattr(self._line, termios.TCSANOW, now)
        except (OSError, termios.error) as why:
            fail("lab/triggers", triggers.port, f"the serial line cannot be opened: {why}", "check /triggers/port of the protocol")

    def send(self, name: str) -> Optional[int]:
        """Sends the code of a mark; returns it, or None if the mark has none. A full line is an error, not a wait."""
        code = self._codes.get(name)
        if code is not None:
            try:
                os.write(self._line, bytes([code]))
            except OSError as why:
                fail("lab/triggers", name, f"the trigger was not sent: {why}", "check the serial line, then resume the session")
        return code

    def close(self) -> None:
        """Closes the line."""
        os.close(self._line)
