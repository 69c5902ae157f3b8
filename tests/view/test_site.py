# SPDX-License-Identifier: BSD-3-Clause
"""What `cambium view` answers, and what it refuses. Argument: the program."""

import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

from view_site import request, site

TYPES = {"index.html": "text/html; charset=utf-8", "page.js": "text/javascript; charset=utf-8", "page.css": "text/css; charset=utf-8",
         "map.json": "application/json", "r.bin": "application/octet-stream", "a.png": "image/png"}


def make(folder):
    page = Path(folder, "run", "page")
    page.mkdir(parents=True)
    for name in TYPES:
        (page / name).write_bytes(f"this is {name}".encode() * 3)
    (page / "empty").write_bytes(b"")
    (page / "large.bin").write_bytes(bytes(range(256)) * 20000)
    (page / "ä b.txt").write_text("a name to escape")
    Path(folder, "run", "secret.txt").write_text("secret")
    (page / "link").symlink_to("../secret.txt")
    (page / "up").symlink_to("..")
    return page


def answers(port, page):
    for name, kind in TYPES.items():
        status, headers, body = request(port, f"/{name}")
        assert (status, headers["content-type"]) == (200, kind), (name, status, headers)
        assert body == (page / name).read_bytes() and int(headers["content-length"]) == len(body), name
    assert request(port, "/")[2] == (page / "index.html").read_bytes()
    assert request(port, "/page.js?version=2")[0] == 200
    assert request(port, "/empty")[0] == 200
    assert request(port, "/large.bin")[2] == (page / "large.bin").read_bytes()
    assert request(port, "/%C3%A4%20b.txt")[2] == b"a name to escape"
    status, headers, body = request(port, "/large.bin", "HEAD")
    assert (status, headers["content-length"], body) == (200, "5120000", b""), headers
    assert request(port, "/nothing")[0] == 404


def refusals(port):
    for target in ("/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/%2e%2e%2fsecret.txt", "/a/../../secret.txt", "/..%5csecret.txt",
                   "/%252e%252e/secret.txt", "//../secret.txt", "/link", "/up/secret.txt", "/up/", "/./../secret.txt", "/index.html%00.png",
                   "/../../../../../../etc/passwd", "http://127.0.0.1/../secret.txt", "/.."):
        status, _, body = request(port, target)
        assert status in (400, 403, 404), (target, status)
        assert b"secret" not in body and b"root:" not in body, target
    for method in ("POST", "PUT", "DELETE"):
        assert request(port, "/index.html", method)[0] in (400, 405), method
    assert request(port, "/", host=f"evil.example:{port}")[0] == 403  # a name that an attacker lets point here
    assert request(port, "/", host=f"localhost:{port}")[0] == 200


def on_this_machine_only(port):
    """Every other address of this machine refuses the connection."""
    own = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)} - {"127.0.0.1"}
    for address in own | {"127.0.0.2"}:
        try:
            socket.create_connection((address, port), timeout=3).close()
        except OSError:
            continue
        raise AssertionError(f"answers on {address}")


def mistakes(cambium, folder, port):
    def fails(*arguments, expect):
        done = subprocess.run([cambium, "view", *map(str, arguments)], capture_output=True, text=True, timeout=60)
        assert done.returncode == 2 and expect in done.stderr, (arguments, done.returncode, done.stderr)
    page = Path(folder, "run", "page")
    fails(page, "--port", port, expect="is taken")
    fails(Path(folder, "nobody"), expect="is no folder")
    (Path(folder, "empty")).mkdir()
    fails(Path(folder, "empty"), expect="holds no finished run")
    other = Path(folder, "run", "other")
    other.mkdir()
    (other / "index.html").write_text("another page")
    fails(Path(folder, "run"), expect="several pages")


def main(cambium):
    with tempfile.TemporaryDirectory() as folder:
        page = make(folder)
        with site(cambium, Path(folder, "run")) as port:  # finds the page below
            answers(port, page)
            refusals(port)
            on_this_machine_only(port)
            mistakes(cambium, folder, port)
            answers(port, page)  # still
    return 0


if __name__ == "__main__":
    os.environ.pop("CAMBIUM_PLUGIN_PATH", None)
    sys.exit(main(sys.argv[1]))
