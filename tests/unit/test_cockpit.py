"""The cockpit's door: who comes in, what broken frames do, what a page that does not read costs; its pace."""

import base64
import contextlib
import http.client
import json
import os
import re
import socket
import struct
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

import wakeflight as wf
from wakeflight.cockpit import messages
from wakeflight.cockpit.messages import Message
from wakeflight.cockpit.pace import AHEAD, LATE, Pace
from wakeflight.cockpit.picture import Shown
from wakeflight.cockpit.server import MOST, PATIENCE, Server

MODELS = ("dynamic", "time-marching")


# --- messages ---------------------------------------------------------------------------------------------------


def test_a_page_may_say_three_things():
    assert messages.read('{"sticks": [0, 0.5, 2, -1], "run": 3}', MODELS) == Message(3, (0.0, 0.5, 1.0, 0.0))
    assert messages.read('{"do": "pause"}', MODELS) == Message(do="pause")
    assert messages.read('{"inflow": "dynamic"}', MODELS) == Message(inflow="dynamic")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        "null",
        "[" * 1000,
        b'{"do": "pause"}',
        '{"do": "fly"' + " " * 2000 + "}",
        '{"do": "fly", "inflow": "dynamic"}',
        '{"do": "explode"}',
        '{"do": ["fly"]}',
        '{"inflow": "relaxation"}',
        '{"sticks": [0, 0, 0, 0]}',
        '{"sticks": [0, 0, 0], "run": 1}',
        '{"sticks": [0, 0, 0, "0"], "run": 1}',
        '{"sticks": [0, 0, 0, true], "run": 1}',
        '{"sticks": [0, 0, 0, NaN], "run": 1}',
        '{"sticks": [0, 0, 0, Infinity], "run": 1}',
        '{"sticks": [0, 0, 0, 1' + "0" * 500 + '], "run": 1}',
        '{"sticks": [0, 0, 0, 1e400], "run": 1}',
        '{"sticks": [0, 0, 0, 0], "run": "1"}',
        '{"sticks": {"0": 1}, "run": 1}',
    ],
)
def test_whatever_else_is_said_is_refused_in_a_line(text):
    with pytest.raises(wf.InputError) as refused:
        messages.read(text, MODELS)
    assert len(str(refused.value)) < 400


# --- pace ---------------------------------------------------------------------------------------------------------


class Wall:
    """A clock on a wall that moves when it is told to, or slept at."""

    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds


def _flown(exchange, cost, n=1000):
    """Wall clock of a flight of `n` exchanges [s] that cost some time each, and its pace."""
    wall = Wall()
    pace = Pace(wall, wall.sleep)
    pace.begin(0.0)
    for k in range(n):
        wall.now += cost(k)
        pace.wait((k + 1) * exchange)
    return wall.now - 100.0, pace.factor


def test_a_flight_that_is_fast_enough_keeps_real_time():
    seconds, factor = _flown(0.0065, lambda k: 0.002)
    assert seconds == pytest.approx(6.5, abs=AHEAD + 1e-9)
    assert factor == pytest.approx(1.0, abs=0.01)


def test_a_flight_that_is_too_slow_goes_slower_and_says_so():
    seconds, factor = _flown(0.0065, lambda k: 0.013)
    assert seconds == pytest.approx(13.0)
    assert factor == pytest.approx(0.5, abs=0.01)


def test_short_delays_are_caught_up_with_long_ones_are_not():
    assert _flown(0.0065, lambda k: 0.05 if k == 500 else 0.002)[0] == pytest.approx(6.5, abs=AHEAD + 1e-9)
    lost = _flown(0.0065, lambda k: 3.0 if k == 500 else 0.002)[0] - 6.5
    assert 3.0 - LATE < lost < 3.0 + AHEAD


# --- the door -----------------------------------------------------------------------------------------------------


class Desk:
    """What a server talks to."""

    def __init__(self):
        self.said = []
        self.server = Server(self.say, MODELS)

    def say(self, message):
        self.said.append(message)
        return True

    @property
    def host(self):
        return f"127.0.0.1:{self.server.port}"

    def join(self, token=None, origin=True, **more):
        token = self.server.token if token is None else token
        origin = f"http://{self.host}" if origin is True else origin
        return connect(f"ws://{self.host}/fly?token={token}", origin=origin, compression=None, max_size=None, **more)

    def get(self, path, host=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.server.port, timeout=10)
        connection.putrequest("GET", path, skip_host=True)
        connection.putheader("Host", host or self.host)
        connection.endheaders()
        response = connection.getresponse()
        return response.status, dict(response.getheaders()), response.read().decode()


@pytest.fixture(scope="module")
def desk():
    found = Desk()
    yield found
    found.server.close()


def _shown(k, frame=b"frame"):
    return Shown(1, '{"opening": {}}', k, '{"status": {}}', frame + struct.pack("<I", k))


def test_the_page_is_for_who_has_the_token(desk):
    token = desk.server.token
    status, headers, text = desk.get(f"/?token={token}")
    assert status == 200 and headers["Content-Type"] == "text/html; charset=utf-8"
    assert len(token) >= 32 and token not in text
    for path in ("/", "/?token=", "/?token=wrong", f"/?token={token[:-1]}", f"/?token={token}x", "/?token=%ff"):
        assert desk.get(path)[0] == 403
    assert desk.get(f"/cockpit.js?token={token}")[0] == 404


def test_the_page_asks_nobody_else_for_anything(desk):
    _, headers, text = desk.get(f"/?token={desk.server.token}")
    assert "default-src 'none'" in headers["Content-Security-Policy"]
    nonce = re.search(r"script-src 'nonce-(\S+)'", headers["Content-Security-Policy"])[1]
    assert text.count(f'<script nonce="{nonce}">') == 4 and text.count("<script") == 4
    assert not re.search(r"(src|href)=\"(?!data:,)|https?://(?!127)|@import|url\(", text)
    assert f'nonce="{nonce}"' not in desk.get(f"/?token={desk.server.token}")[2]


def test_other_machines_names_and_pages_are_refused(desk):
    query = f"?token={desk.server.token}"
    for host in ("evil.example", f"evil.example:{desk.server.port}", "127.0.0.1", "127.0.0.1:1"):
        assert desk.get(f"/{query}", host)[0] == 403
    assert desk.get(f"/{query}", f"localhost:{desk.server.port}")[0] == 200
    for wrong in ({"origin": "http://evil.example"}, {"origin": None}, {"origin": "null"}, {"token": "wrong"}):
        with pytest.raises(InvalidStatus, match="403"), desk.join(**wrong):
            pass
    with desk.join(origin=f"http://localhost:{desk.server.port}"):
        pass


def test_it_listens_on_this_machine_alone(desk):
    own = {each[4][0] for each in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)} - {"127.0.0.1"}
    for address in sorted(own):
        with pytest.raises(OSError):
            socket.create_connection((address, desk.server.port), timeout=1.0)


def test_a_port_that_is_taken_is_said(desk):
    with pytest.raises(wf.InputError, match="port = "):
        Server(desk.say, MODELS, desk.server.port)


def test_too_many_pages_are_refused(desk):
    with contextlib.ExitStack() as pages:
        for _ in range(MOST):
            pages.enter_context(desk.join())
        with pytest.raises(InvalidStatus, match="503"), desk.join():
            pass
    for _ in range(100):
        with contextlib.suppress(InvalidStatus), desk.join():
            return
        time.sleep(0.01)
    raise AssertionError("a page that has gone leaves no place")


def test_a_page_is_shown_the_run_first_and_then_the_newest(desk):
    desk.server.publish(_shown(1))
    with desk.join() as page:
        said = [page.recv(timeout=5) for _ in range(3)]
        assert said == ['{"opening": {}}', '{"status": {}}', b"frame" + struct.pack("<I", 1)]
        desk.said.clear()
        page.send('{"do": "fly"}')
        desk.server.publish(_shown(2))
        assert page.recv(timeout=5)[-4:] == struct.pack("<I", 2)
        for _ in range(200):
            if desk.said:
                break
            time.sleep(0.01)
        assert desk.said == [Message(do="fly")]


def _memory():
    return int(re.search(r"VmRSS:\s+(\d+)", Path("/proc/self/status").read_text())[1]) / 1024


@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory of a process is read where Linux shows it")
def test_a_page_that_does_not_read_misses_pictures_and_costs_neither_time_nor_memory(desk):
    raw = _raw(desk)
    block = os.urandom(100_000)
    before, clock = _memory(), time.perf_counter()
    longest = 0.0
    for k in range(3000):
        one = time.perf_counter()
        desk.server.publish(_shown(k, block))
        longest = max(longest, time.perf_counter() - one)
        if k % 50 == 0:
            time.sleep(0.005)
    assert longest < 0.5 and time.perf_counter() - clock < 10.0
    time.sleep(0.1)
    # three hundred megabytes were shown
    assert _memory() - before < 20.0
    # and when it reads, the last it gets is the newest
    raw.settimeout(0.5)
    tail, count = b"", 0
    try:
        while got := raw.recv(1 << 20):
            tail, count = (tail + got)[-4:], count + len(got)
    except TimeoutError:
        pass
    raw.close()
    assert tail == struct.pack("<I", 2999) and count < 30_000_000


def _raw(desk):
    """A WebSocket by hand, opened."""
    stream = socket.create_connection(("127.0.0.1", desk.server.port), timeout=10)
    key = base64.b64encode(os.urandom(16)).decode()
    lines = [
        f"GET /fly?token={desk.server.token} HTTP/1.1",
        f"Host: {desk.host}",
        "Upgrade: websocket",
        "Connection: Upgrade",
        f"Sec-WebSocket-Key: {key}",
        "Sec-WebSocket-Version: 13",
        f"Origin: http://{desk.host}",
    ]
    stream.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
    answer = b""
    while b"\r\n\r\n" not in answer:
        answer += stream.recv(4096)
    assert b" 101 " in answer.split(b"\r\n")[0]
    return stream


def _frame(payload, code=1, final=True, masked=True, reserved=0):
    """A frame of the protocol, with whatever is wrong in it."""
    head = bytes([(0x80 if final else 0) | reserved << 4 | code])
    n, mask = len(payload), (0x80 if masked else 0)
    head += bytes([mask | n]) if n < 126 else bytes([mask | 126]) + struct.pack(">H", n)
    # a mask of zeros leaves the payload as it is
    return head + (bytes(4) if masked else b"") + payload


def _broken_message(rng):
    """A whole frame that says nothing."""
    kind = rng.integers(7)
    if kind == 0:
        return _frame(rng.bytes(int(rng.integers(0, 200))), code=2)
    if kind == 1:
        return _frame(json.dumps({"sticks": rng.normal(size=int(rng.integers(0, 9))).tolist(), "run": "x"}).encode())
    if kind == 2:
        return _frame(b'{"sticks": [NaN, Infinity, -Infinity, 1e999], "run": 1}')
    if kind == 3:
        return _frame(b"[" * int(rng.integers(1, 1000)))
    if kind == 4:
        return _frame(json.dumps({"do": "".join(map(chr, rng.integers(32, 1000, 12)))}).encode())
    if kind == 5:
        return _frame(b'{"inflow": null}')
    good = bytearray(b'{"sticks": [0.5, 0.5, 0.5, 0.5], "run": 1}')
    good[int(rng.integers(len(good) - 30))] = 33
    return _frame(bytes(good))


def _broken_protocol(rng):
    """Bytes that are no frame, or one that the protocol forbids."""
    return (
        lambda: rng.bytes(int(rng.integers(1, 400))),
        lambda: _frame(b"x", masked=False),
        lambda: _frame(b"x", code=int(rng.integers(3, 8))),
        lambda: _frame(b"x", reserved=int(rng.integers(1, 8))),
        lambda: _frame(b"\xff\xfe\xfd"),
        lambda: _frame(b"x" * 200, code=9),
        lambda: _frame(b"x", code=9, final=False),
        lambda: _frame(b"x", code=0),
        lambda: _frame(b"\x00", code=8),
        lambda: _frame(b"x" * 5000),
        lambda: b"\x81\xff" + b"\xff" * 12,
        lambda: _frame(b'{"do":', final=False) + _frame(b'"fly"}'),
    )[int(rng.integers(12))]()


def test_ten_thousand_broken_frames_are_survived(desk):
    rng = np.random.default_rng(16)
    desk.said.clear()
    before, sent = desk.server.refused, 0
    for k in range(110):
        stream = _raw(desk)
        # in half of the connections patience ends, in the others something worse comes before
        frames = [_broken_message(rng) for _ in range(PATIENCE + 1 if k % 2 else PATIENCE - 1)]
        frames.append(_broken_protocol(rng))
        sent += len(frames)
        try:
            stream.sendall(b"".join(frames))
            stream.shutdown(socket.SHUT_WR)
            while stream.recv(1 << 16):
                pass
        except OSError:
            pass  # closed while we were talking
        stream.close()
    assert sent >= 10_000
    assert desk.server.refused - before >= 0.95 * sent
    assert not [each for each in desk.said if each != Message(do="fly")]
    # the door stands open to who knows how to speak
    with desk.join() as page:
        desk.server.publish(_shown(7))
        page.send('{"do": "pause"}')
        while page.recv(timeout=5)[-4:] != struct.pack("<I", 7):
            pass
        for _ in range(PATIENCE):
            page.send("{}")
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                page.recv(timeout=5)
        assert closed.value.rcvd.code == 1008


def test_without_the_package_websockets_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "websockets.asyncio.server", None)
    with pytest.raises(wf.InputError, match=r"pip install wakeflight\[cockpit\]"):
        Server(lambda message: True, MODELS)
