#!/usr/bin/env python3
"""Runs a show on a LightBots server and keeps its report, with Python's standard library alone.

    LIGHTBOTS_TOKEN=... python3 docs/run_show.py https://127.0.0.1:8420 shows/hello.json \
        --ca DATA/certs/server.pem --report report.html

The token is made by an operator (docs/api.md, "Sign in"). On a loopback address no token is asked for. The exit code is 0
when every frame was shown and no robot was lost, else 1.
"""

import argparse
import base64
import hashlib
import json
import os
import pathlib
import secrets
import socket
import ssl
import struct
import sys
import time
import urllib.error
import urllib.parse
import urllib.request

# Longest silence of the server, seconds: it sends a state 20 times a second.
PATIENCE_S = 60


class Refused(Exception):
    """The server refused something; the text says why, and what to do."""


class Server:
    """HTTP requests with a token."""

    def __init__(self, address, token, ca):
        self.url = urllib.parse.urlsplit(address)
        self.headers = {"Authorization": f"Bearer {token}"} if token else {}
        self.context = ssl.create_default_context(cafile=ca) if self.url.scheme == "https" else None

    def request(self, method, path, body=None, headers=None):
        """The bytes of the answer."""
        url = f"{self.url.scheme}://{self.url.netloc}{path}"
        request = urllib.request.Request(url, body, {**self.headers, **(headers or {})}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE_S, context=self.context) as answer:
                return answer.read()
        except urllib.error.HTTPError as error:
            text = error.read().decode(errors="replace")
            try:
                text = json.loads(text)["error"]
            except (ValueError, KeyError, TypeError):
                pass
            raise Refused(f"{method} {path}: {error.code}: {text}") from None

    def get(self, path):
        """The answer to a GET, read as JSON."""
        return json.loads(self.request("GET", path))

    def save(self, name, file):
        """Saves a show in the library, over an older one of this name; its entry."""
        path = "/api/shows/" + urllib.parse.quote(name, safe="")
        return json.loads(self.request("PUT", path, pathlib.Path(file).read_bytes()))


class Screen:
    """The WebSocket (RFC 6455), with the last message of each type in `last`."""

    def __init__(self, server):
        url = server.url
        port = url.port or (443 if server.context else 80)
        self.socket = socket.create_connection((url.hostname, port), timeout=PATIENCE_S)
        if server.context:
            self.socket = server.context.wrap_socket(self.socket, server_hostname=url.hostname)
        self.stream = self.socket.makefile("rb")
        self.last, self.requests = {}, 0
        key = base64.b64encode(secrets.token_bytes(16)).decode()
        lines = ["GET /ws HTTP/1.1", f"Host: {url.netloc}", "Connection: Upgrade", "Upgrade: websocket",
                 "Sec-WebSocket-Version: 13", f"Sec-WebSocket-Key: {key}"]
        lines += [f"{name}: {value}" for name, value in server.headers.items()]
        self.socket.sendall("\r\n".join([*lines, "", ""]).encode())
        head = iter(lambda: self.stream.readline().strip().decode(), "")
        head = list(head)
        accept = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
        wanted = f"sec-websocket-accept: {base64.b64encode(accept).decode()}"
        if not any(line.casefold() == wanted.casefold() for line in head):
            raise Refused(f"GET /ws: {head[0] if head else 'the server hung up'}")

    def read(self, count):
        """The next bytes of the connection."""
        data = self.stream.read(count)
        if len(data) < count:
            raise Refused("the server closed the WebSocket: the token may have been revoked")
        return data

    def frame(self):
        """The next frame: whether a message ends with it, its kind and its bytes."""
        first, length = self.read(2)
        if length >= 126:
            length = int.from_bytes(self.read(2 if length == 126 else 8), "big")
        return bool(first & 0x80), first & 0x0F, self.read(length)

    def send(self, kind, data):
        """Sends a frame; those of clients are masked."""
        size = bytes([0x80 | len(data)]) if len(data) < 126 else b"\xfe" + struct.pack(">H", len(data))
        mask = secrets.token_bytes(4)
        masked = bytes(byte ^ mask[index % 4] for index, byte in enumerate(data))
        self.socket.sendall(bytes([0x80 | kind]) + size + mask + masked)

    def tell(self, message):
        """Sends a message of the API."""
        self.send(1, json.dumps(message).encode())

    def next(self):
        """Takes in the next message, and acknowledges a state; without that the server sends no more of them."""
        kind, data, is_last = 0, b"", False
        while not is_last:
            is_last, part_kind, part = self.frame()
            if part_kind == 8:
                raise Refused("the server closed the WebSocket: the token may have been revoked")
            if part_kind == 9:
                self.send(10, part)
            if part_kind >= 8:
                is_last = False
                continue
            kind, data = part_kind or kind, data + part
        if kind == 1:
            message = json.loads(data)
            self.last[message["type"]] = message
            if message["type"] == "state":
                self.tell({"type": "took"})

    def until(self, what, look):
        """Reads on until `look` finds something."""
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            if found := look(self.last):
                return found
            self.next()
        raise Refused(f"waited {PATIENCE_S} s in vain for {what}")

    def operate(self, **operation):
        """Asks for an operation, and waits for its answer."""
        self.requests += 1
        self.tell({"type": "operate", "id": self.requests, "operation": operation})
        answer = self.until("an answer", lambda last: last.get("answer", {}).get("id") == self.requests and last["answer"])
        if not answer["ok"]:
            raise Refused(f"{operation['do']}: {answer['error']}")


def plan_of(last, name):
    """The plan of the show of this name, once it is open and planned."""
    show, plan = last.get("show", {}), last.get("plan", {"planning": True})
    is_there = show.get("name") == name and plan.get("revision") == show["revision"] and not plan["planning"]
    return is_there and plan


def is_ready(last, pixels):
    """Whether as many robots as pixels report, and no show is on."""
    robots = [row for row in last.get("fleet", {}).get("rows", []) if row["presence"] == "active"]
    phase = last.get("state", {}).get("playback", {}).get("phase")
    return len(robots) >= pixels and phase == "ready"


def newest_run(server):
    """The last run; None before the first."""
    runs = server.get("/api/runs")
    return runs[0] if runs else None


def follow(server, screen, before):
    """Prints each frame of the run that comes after the run `before`; the run, once it has ended."""
    frame, asked = None, time.monotonic()
    while True:
        screen.next()
        playback = screen.last["state"]["playback"]
        if playback["frame"] != frame and playback["phase"] == "playing":
            frame = playback["frame"]
            if frame is not None:
                print(f"Frame {frame + 1} of {playback['frames']}", flush=True)
        if time.monotonic() - asked > 0.5:
            run, asked = newest_run(server), time.monotonic()
            if run and run["number"] > before and run["ended_ms"] is not None:
                return run


def report_of(server, number):
    """The page of a run. For a moment after the end the run may still count as on."""
    for _ in range(20):
        try:
            return server.request("GET", f"/api/runs/{number}/report")
        except Refused as refused:
            if ": 409: " not in str(refused):
                raise
            time.sleep(0.5)
    raise Refused(f"the report of run {number} is not made")


def run(arguments):
    """Runs the show; whether all went well."""
    server = Server(arguments.server, os.environ.get("LIGHTBOTS_TOKEN"), arguments.ca)
    me = server.get("/api/session")
    print(f"Signed in as {me['name'] or 'a user of this machine'} ({me['role']}).")
    entry = server.save(arguments.name, arguments.show)
    print(f"Saved {entry['name']}: {entry['frames']} frames, {entry['pixels']} pixels.")
    screen = Screen(server)
    screen.operate(do="open", name=entry["name"])
    plan = screen.until("the plan", lambda last: plan_of(last, entry["name"]))
    for issue in plan["issues"]:
        print(f"{issue['severity']}: {issue['message']}")
    if not plan["ok"]:
        raise Refused("this show cannot be played")
    print(f"Planned: {plan['duration_s']:.1f} s.")
    screen.until(f"{entry['pixels']} robots", lambda last: is_ready(last, entry["pixels"]))
    robots = screen.last["fleet"]["rows"]
    real = sum(not row["simulated"] for row in robots)
    if real and not arguments.real:
        raise Refused(f"{real} of {len(robots)} robots are real: look at the floor, then say --real")
    print(f"{len(robots)} robots, {len(robots) - real} of them simulated.")
    before = newest_run(server)
    screen.operate(do="play", **{"from": 0}, missing="refuse")
    done = follow(server, screen, before["number"] if before else 0)
    print(f"Run {done['number']}: {done['outcome']}")
    page = report_of(server, done["number"])
    pathlib.Path(arguments.report).write_bytes(page)
    print(f"Report: {arguments.report}, {len(page)} bytes.")
    return done["ok"]


def main():
    """Reads the command line."""
    parser = argparse.ArgumentParser(description="Runs a show on a LightBots server and keeps its report.")
    parser.add_argument("server", help="address of the server, such as https://127.0.0.1:8420")
    parser.add_argument("show", help="show file of any format")
    parser.add_argument("--name", help="name in the library [default: that of the file]")
    parser.add_argument("--ca", help="certificate that the server or its authority has, PEM [default: those of the system]")
    parser.add_argument("--report", default="report.html", help="where the report is written")
    parser.add_argument("--real", action="store_true", help="also run on real robots")
    arguments = parser.parse_args()
    arguments.name = arguments.name or pathlib.Path(arguments.show).name.split(".")[0]
    try:
        return 0 if run(arguments) else 1
    except (Refused, OSError) as error:
        print(error, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
