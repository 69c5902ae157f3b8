# SPDX-License-Identifier: BSD-3-Clause
"""A simulated fusion, looked at in a real browser through `cambium view`.

Arguments: the program, the folder of the plugins, node_modules with playwright-core. Skipped (77) where the page was not built or no
Chromium is installed. PICTURES=folder keeps the screenshots.
"""

import json
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

from view_site import site

HERE = Path(__file__).parent


def picture(path):
    """A green PNG of 8 x 6 pixels."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + b"\x30\x90\x50" * 8 for _ in range(6))
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 6, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def call(cambium, *arguments):
    done = subprocess.run([cambium, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, (arguments, done.stderr)


def fuse(cambium, folder, pipeline):
    """A finished run of two missions, one of which has pictures at its nodes."""
    missions, run = folder / "missions", folder / "run"
    call(cambium, "simulate", HERE / "forest.yaml", missions)
    for line in (missions / "backpack" / "slam_pose_graph.g2o").read_text().splitlines():
        if vertex := re.match(r"VERTEX_SE3:QUAT_TIME 3 .* (\d+) (\d+)$", line):
            picture(missions / "backpack" / "individual_images" / f"image_{vertex[1]}_{int(vertex[2]):09}.png")
    call(cambium, "run", pipeline, *sorted(p for p in missions.iterdir() if p.is_dir()), "--out", run, "--cache", "none", "--quiet")
    return run


def browse(node, script, modules, chromium, port, *arguments):
    done = subprocess.run([node, HERE / script, modules, chromium, f"http://127.0.0.1:{port}/", *map(str, arguments)],
                          capture_output=True, text=True, timeout=1200)
    print(done.stdout, done.stderr)
    assert done.returncode == 0


def changes_are_a_layer(cambium, folder, pictures, *browser):
    """What `cambium changes` found, on the page of the run; on another run's page it is refused by name."""
    node, modules, chromium = browser
    missions, run, found = folder / "surveys", folder / "map", folder / "changes"
    steps = (HERE.parents[1] / "pipelines" / "fuse_trees.yaml").read_text()
    (folder / "trees.yaml").write_text(steps + "  - georeference: similarity_4dof\n  - export: web_view\n")
    call(cambium, "simulate", HERE / "surveys.yaml", missions)
    call(cambium, "run", folder / "trees.yaml", missions / "spring", missions / "autumn", "--out", run, "--cache", "none", "--quiet")
    call(cambium, "changes", f"{run}:spring", f"{run}:autumn", "--out", found, "--cache", "none")
    counts = json.loads((found / "changes.json").read_text())["stems"]
    assert counts["gone"] >= 5 and counts["kept"] >= 20, counts
    with site(cambium, run, "--changes", found) as port:
        browse(node, "changes.mjs", modules, chromium, port, json.dumps(counts), pictures)
    done = subprocess.run([cambium, "view", run, "--changes", run], capture_output=True, text=True)
    assert done.returncode == 2 and "holds no layer.json" in done.stderr, done
    (run / "web_view" / "layers.json").unlink()
    done = subprocess.run([cambium, "view", run, "--changes", found], capture_output=True, text=True)
    assert done.returncode == 2 and "takes no layers" in done.stderr, done


def main(cambium, plugins, modules):
    if not Path(plugins, "web_view.so").exists():
        print("SKIPPED: this build has no web_view, see the lines of CMake; ./bootstrap view")
        return 77
    chromium, node = shutil.which("chromium") or shutil.which("chromium-browser"), shutil.which("node")
    if not chromium or not Path(modules, "playwright-core").exists():
        print("SKIPPED: no Chromium, or no playwright-core; ./bootstrap view")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        # At the end of a pipeline, the page can look back at each optimisation.
        pipeline = Path(folder, "pipeline.yaml")
        pipeline.write_text((HERE / "pipeline.yaml").read_text() + "  - export: web_view\n")
        run = fuse(cambium, Path(folder), pipeline)
        points = json.loads((run / "web_view" / "map.json").read_text())["islands"][0]["points"]["points"]
        pictures = Path(os.environ.get("PICTURES", folder))
        with site(cambium, run) as port:
            browse(node, "browser.mjs", modules, chromium, port, points, pictures)
        # A run without a page gets one.
        shutil.rmtree(run / "web_view")
        with site(cambium, run, "--cache", "none"):
            again = json.loads((run / "web_view" / "map.json").read_text())
        assert again["islands"][0]["points"]["points"] == points
        assert [s["name"] for s in again["stages"]] == ["odometry", "map"]
        changes_are_a_layer(cambium, Path(folder), pictures, node, modules, chromium)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
