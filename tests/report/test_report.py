# SPDX-License-Identifier: BSD-3-Clause
"""Opens the report of a large run in a real browser and uses it as a person would.

Argument: the program. Skipped (77) where no Chromium is installed.
"""

import html
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import big_run

# Runs in the page behind its own scripts, and leaves what it saw in an element.
SCRIPT = """
const seen = {}, change = (name, value) => {
  const c = document.querySelector(`[data-filter=${name}]`);
  c.value = value; c.dispatchEvent(new Event(c.tagName === "SELECT" ? "change" : "input")); };
const count = () => document.getElementById("count").textContent;
const cells = n => [...document.querySelectorAll(".row.body")].slice(0, 20).map(r => r.children[n].textContent);
seen.title = document.getElementById("title").textContent;
seen.subtitle = document.getElementById("subtitle").textContent;
seen.warnings = document.getElementById("warning-list").textContent;
seen.metrics = [...document.querySelectorAll("#metrics td")].map(c => c.textContent);
seen.all = count();
seen.rows = document.querySelectorAll(".row.body").length;
change("verdict", "rejected"); seen.rejected = [count(), ...new Set(cells(0))];
change("proposed", "proximity"); seen.proximity = [count(), ...new Set(cells(3))];
change("pair", "within drone"); seen.pair = [count(), ...new Set(cells(1).concat(cells(2)).map(c => c.split(" ")[0]))];
change("reason", "MIN_OVERLAP"); seen.reason = [count(), cells(10).every(c => c.includes("min_overlap"))];
[...document.querySelectorAll("#filters button")].pop().click(); seen.again = count();
const sort = () => document.querySelector("[data-field=after]").click();
sort(); seen.up = cells(6); sort(); seen.down = cells(6);
seen.address = location.hash;
document.querySelector(".row.body").click();
seen.detail = document.getElementById("detail").textContent;
const plan = document.getElementById("plan");
change("verdict", "accepted"); change("pair", "within backpack"); change("proposed", "scan_context");
const target = view.shown[5], box = plan.getBoundingClientRect();
const [a, b] = endsOf(target).map(p => planCanvas.at(p));
for (const type of ["pointerdown", "pointerup"]) plan.dispatchEvent(new PointerEvent(type, {pointerId: 1, bubbles: true,
  clientX: box.left + (a[0] + b[0]) / 2, clientY: box.top + (a[1] + b[1]) / 2}));
seen.clicked = view.picked !== null && document.querySelector(".row.picked") !== null;
const out = document.createElement("pre"); out.id = "seen"; out.textContent = JSON.stringify(seen);
document.body.append(out);
"""


def browse(chromium, page, profile):
    """The page's own words after its scripts, and what the console said."""
    done = subprocess.run(
        [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--window-size=1400,1200", f"--user-data-dir={profile}",
         "--enable-logging=stderr", "--virtual-time-budget=10000", "--dump-dom", page.resolve().as_uri()],
        capture_output=True, text=True, timeout=120)
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    found = re.search(r'<pre id="seen">(.*?)</pre>', done.stdout, re.S)
    assert found, f"the page's scripts did not come to their end: {console}\n{done.stdout[-2000:]}"
    return json.loads(html.unescape(found[1])), console


def check(seen, rows):
    total = len(rows)
    rejected = [r for r in rows if r["state"] == "rejected"]
    near = [r for r in rejected if r["proposed_by"] == "proximity"]
    drone = [r for r in near if r["tail"]["mission"] == r["head"]["mission"] == "drone"]
    few = [r for r in drone if "min_overlap" in r["reason"]]
    of = lambda part: f"{len(part):,} of {total:,} candidates"
    expected = {
        "title": "3 missions, one map", "subtitle": " · ".join(sorted(big_run.NAMES)), "all": f"{total:,} candidates", "again": f"{total:,} candidates",
        "warnings": "mission <i>backpack</i> is tired", "metrics": ["ate.rmse", "4.2", "0.1", "m"],
        "rejected": [of(rejected), "rejected"], "proximity": [of(near), "proximity"],
        "pair": [of(drone), "drone"], "reason": [of(few), True], "address": "#sort=after&order=down", "clicked": True}
    for name, value in expected.items():
        assert seen[name] == value, f"{name}: the page shows {seen[name]}, expected {value}"
    assert seen["rows"] < 100, "all rows are drawn at once"
    up, down = ([float(v.replace(",", "")) for v in seen[k]] for k in ("up", "down"))
    assert up == sorted(up) and down == sorted(down, reverse=True) and down[0] > up[-1], (up, down)
    for part in ("overlap", "seen_through", "off the map", "rejected by pairwise_consistency"):
        assert part in seen["detail"], f"'{part}' is not in the details: {seen['detail']}"


def main(cambium):
    with tempfile.TemporaryDirectory() as folder:
        run = big_run.write(folder)
        made = subprocess.run([cambium, "report", run, "--quiet"], capture_output=True, text=True)
        assert made.returncode == 0, made.stderr
        page = run / "report.html"
        size, text = page.stat().st_size, page.read_text()
        print(f"3000 nodes, 20000 candidates: {size / 1e6:.2f} MB")
        assert size < 5e6, "larger than 5 MB"
        assert not re.search(r"""(src|href)=["'](?!#)|@import|url\(|fetch\(|XMLHttpRequest""", text), "the page asks for something outside of it"
        chromium = shutil.which("chromium") or shutil.which("chromium-browser")
        if not chromium:
            print("SKIPPED in a browser: no chromium; apt-get install chromium")
            return 77
        page.write_text(text.replace("</body>", f"<script>{SCRIPT}</script></body>"))
        seen, console = browse(chromium, page, Path(folder, "profile"))
        assert not console, f"the console is not silent: {console}"
        check(seen, [json.loads(line) for line in (run / "ledger.jsonl").read_text().splitlines()])
    print("sorted, filtered, clicked: as expected")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
