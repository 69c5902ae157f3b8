# SPDX-License-Identifier: BSD-3-Clause
"""`cambium view` as a process, and requests as an attacker would write them."""

import re
import signal
import socket
import subprocess
from contextlib import contextmanager


@contextmanager
def site(cambium, *arguments):
    """Yields the port; ends the server as Ctrl-C does and expects that it goes at once."""
    process = subprocess.Popen([cambium, "view", *map(str, arguments), "--port", "0", "--quiet"], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    try:
        line = process.stdout.readline()
        found = re.search(r"http://127\.0\.0\.1:(\d+)/", line)
        assert found, f"no address: {line!r} {process.stderr.read()}"
        yield int(found[1])
        process.send_signal(signal.SIGINT)
        code = process.wait(timeout=30)
        assert code == 0, f"exit code {code} after Ctrl-C: {process.stderr.read()}"
    finally:
        process.kill()
        process.wait()


def request(port, target, method="GET", host=None):
    """(status, headers in small letters, body) of one raw request; `target` goes out as it is."""
    with socket.create_connection(("127.0.0.1", port), timeout=10) as s:
        s.sendall(f"{method} {target} HTTP/1.1\r\nHost: {host or f'127.0.0.1:{port}'}\r\nConnection: close\r\n\r\n".encode("latin-1"))
        answer = b""
        while part := s.recv(65536):
            answer += part
    head, _, body = answer.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    assert lines[0].startswith("HTTP/1.1 "), f"{target}: {answer[:200]}"
    return int(lines[0].split()[1]), dict(line.lower().split(": ", 1) for line in lines[1:]), body
