# SPDX-License-Identifier: Apache-2.0
# Speaks HTTP to `penduline run --web` as browsers do, and as those do who mean no good.
import json
import re
import socket
import time


def address_of(run, seconds=10):
    """(host, port, token) of a run's live page, once it has said them."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for line in run.lines_said():
            found = re.search(r"live page: http://([^/]+):(\d+)/(?:#token=(\w+))?$", line)
            if found:
                return found[1], int(found[2]), found[3]
        time.sleep(0.02)
    raise AssertionError(f"no live page within {seconds} s: {run.lines_said()}")


def connect(port, host="127.0.0.1", receive_buffer_bytes=None):
    """The system keeps about `receive_buffer_bytes` of what is not read; none: as it does."""
    connection = socket.socket()
    connection.settimeout(10)
    if receive_buffer_bytes is not None:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer_bytes)
    try:
        connection.connect((host, port))
    except OSError:
        connection.close()
        raise
    return connection


def received(connection):
    """All that comes until the other side ends."""
    text = b""
    try:
        while more := connection.recv(65536):
            text += more
    except ConnectionResetError:
        pass
    return text


def ask(port, target, method="GET", headers=None, body=None, host="127.0.0.1"):
    """One request as it is written, nothing tidied up; (status, headers and body as text)."""
    head = {"Host": f"{host}:{port}", "Connection": "close", **(headers or {})}
    if body is not None:
        head["Content-Length"] = str(len(body))
    lines = [f"{method} {target} HTTP/1.1", *(f"{name}: {value}" for name, value in head.items()
                                             if value is not None)]
    with connect(port, host) as connection:
        connection.sendall("\r\n".join(lines).encode() + b"\r\n\r\n" + (body or "").encode())
        answer = received(connection).decode()
    return int(answer.split(" ", 2)[1]), answer.split("\r\n\r\n", 1)


def act(port, target, values=None, headers=None, host="127.0.0.1"):
    """An action as the page asks for it; (status, what JSON it says)."""
    all_headers = {"X-Penduline": "1", "Content-Type": "application/json", **(headers or {})}
    status, (_, body) = ask(port, target, "POST", all_headers, json.dumps(values or {}), host)
    return status, json.loads(body)


def joined(columns, more):
    """The columns of `points`, and behind them those of the next one."""
    return {key: [a + b for a, b in zip(column, more[key])] if key in ("signal_v", "gap_m")
            else column + more[key] for key, column in columns.items()}


class Viewer:
    """Server-sent events of /live, as they come."""

    def __init__(self, port, receive_buffer_bytes=None):
        self.connection = connect(port, receive_buffer_bytes=receive_buffer_bytes)
        self.connection.sendall(f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
        self.file = self.connection.makefile("rb")
        self.head = []
        while line := self.file.readline().strip():
            self.head.append(line.decode())

    def next(self):
        """(name, data) of the next event."""
        name = None
        while line := self.file.readline():
            if line.startswith(b"event: "):
                name = line[7:].strip().decode()
            elif line.startswith(b"data: "):
                return name, json.loads(line[6:])
        raise AssertionError("the stream has ended")

    def wait_for(self, name, accepted=lambda data: True, seconds=20):
        """The data of the next event of that name that is accepted."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found, data = self.next()
            if found == name and accepted(data):
                return data
        raise AssertionError(f"no such {name} within {seconds} s")

    def greeting(self):
        """What a connection begins with: the columns of all rows up to now, and the notes."""
        columns, notes = {}, []
        while (event := self.next())[0] != "state":
            name, data = event
            if name == "points":
                columns = joined(columns, data) if columns else data
            elif name == "note":
                notes.append(data)
        return columns, notes

    def close(self):
        self.file.close()
        self.connection.close()
