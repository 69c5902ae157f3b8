# SPDX-License-Identifier: BSD-3-Clause
"""LAS files against an independent implementation: the PyPI package laspy (LAZ: with lazrs).

test_las.py CAMBIUM SOURCES: exports a simulated map as LAS, reads it with laspy, packs it as LAZ and
back; then real LAZ clouds of ../shared/data, where they are, become missions on the globe.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import laspy
    import lazrs  # noqa: F401  laspy finds it by itself
    import numpy as np
    from scipy.spatial import cKDTree  # comes with evo
except ModuleNotFoundError as missing:
    print(f"SKIPPED: {missing.name} is not installed; ./bootstrap peers installs it")
    sys.exit(77)

SPEC = """
version: 1
seed: 5
stand: {size: [60, 50], density: 300}
sensor: {beams: 16, columns: 90, max_range: 20, labels: true}
path: {kind: line, size: [30, 0], spacing: 3}
missions:
  - {name: spring, gnss: {enabled: true, sigma: 0.5}}
  - {name: autumn, path: {offset: 2}, gnss: {enabled: true, sigma: 0.5}}
"""
PIPELINE = """
version: 1
steps:
  - georeference: similarity_4dof
  - export: las
    params: {crs: 'EPSG:32635', voxel_size: 0.1, colours: true}
  - export: projected
    params: {crs: 'EPSG:32635', voxel_size: 0.1}
"""

program, root = sys.argv[1], Path(sys.argv[2])


def run(*arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, f"{arguments}: {done.stderr}"
    return done.stdout


def projected_points(path):
    """x y z of the PLY file that the exporter `projected` wrote."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    count = int(head.split(b"element vertex ")[1].split()[0])
    rows = np.frombuffer(body, dtype=[("p", "<f8", 3), ("i", "<f4")], count=count)
    return rows["p"]


def a_map_reads_back(folder):
    (folder / "spec.yaml").write_text(SPEC)
    (folder / "p.yaml").write_text(PIPELINE)
    run("simulate", folder / "spec.yaml", folder / "missions")
    missions = [folder / "missions" / m for m in ("spring", "autumn")]
    run("run", folder / "p.yaml", *missions, "--out", folder / "map", "--cache", "none")
    clouds = sorted((folder / "map" / "las").glob("map*.las"))
    assert clouds
    for las_file in clouds:
        las = laspy.read(las_file)
        assert (las.header.version.major, las.header.version.minor) == (1, 4)
        assert las.header.point_format.id == 7
        assert las.header.global_encoding.wkt
        wkt = next(v for v in las.header.vlrs if v.record_id == 2112).string
        assert "WGS 84 / UTM zone 35N" in wkt and "32635" in wkt, wkt
        island = las_file.name.replace("map", "cloud").replace(".las", ".ply")
        ply = projected_points(folder / "map" / "projected" / island)
        xyz = np.vstack([las.x, las.y, las.z]).T
        # Both keep the first point of a voxel; only voxels cut by the border of a tile hold two.
        assert 0 <= len(xyz) - len(ply) < 0.02 * len(ply), (len(xyz), len(ply))
        both = {tuple(p) for p in np.round(ply, 3)} & {tuple(p) for p in np.round(xyz, 3)}
        assert len(both) > 0.98 * len(ply), (len(both), len(ply))
        assert np.allclose(las.header.mins, xyz.min(axis=0)) and np.allclose(las.header.maxs, xyz.max(axis=0))
        assert len(set(las.point_source_id)) == len({tuple(c) for c in np.vstack([las.red, las.green, las.blue]).T})
        assert {2, 64} <= set(np.asarray(las.classification)), set(np.asarray(las.classification))
        packed = las_file.with_suffix(".laz")
        las.write(packed)
        again = laspy.read(packed)
        assert packed.stat().st_size < las_file.stat().st_size / 2
        assert np.array_equal(again.points.array, las.points.array)


# By file: the parameters of the reader, and what it must warn of. Heights are above NAVD88 by a geoid
# whose grid is not part of PROJ; one file states no system, one is in coordinates of its own.
UTM12 = "EPSG:6341"
PLOTS = {
    "ALS_Clip": ({}, "the grid of the geoid"),
    "UAS_Clip": ({}, "the grid of the geoid"),
    "MLS_Clip": ({"crs": UTM12}, None),
    "TLS_Clip": ({}, "states no coordinate reference system"),
}


def a_plot_reads_in(laz, folder):
    """As a mission on the globe, and out again in its own system: the same points and classes."""
    params, warning = PLOTS[laz.stem]
    local = laz.stem == "TLS_Clip"
    out = folder / f"out_{laz.stem}"
    crs = "map" if local else UTM12
    mission = {"path": str(laz), "reader": "las_tiles", "params": params}
    pipeline = {"version": 1, "missions": [mission], "steps": [
        {"export": "las", "params": {"crs": crs, "voxel_size": 0}}]}
    (folder / "plot.yaml").write_text(json.dumps(pipeline))
    run("run", folder / "plot.yaml", "--out", out, "--cache", "none")
    warnings = " ".join(json.loads((out / "report.json").read_text())["warnings"])
    assert (warning in warnings) if warning else not warnings, warnings
    given, written = laspy.read(laz), laspy.read(out / "las" / "map.las")
    assert len(given.points) == len(written.points)
    shift = np.floor([(given.header.mins + given.header.maxs)[0] / 2,
                      (given.header.mins + given.header.maxs)[1] / 2, given.header.mins[2]])
    off, same = cKDTree(written.xyz).query(given.xyz - (shift if local else 0))  # written in an order of its own
    off = off.max()
    assert off < 0.0016, off  # floats in a plot of 40 m: micrometres; both files: half a step each
    assert len(np.unique(same)) > 0.99 * len(same)  # some stand within a step of another
    classes, again = np.asarray(given.classification), np.asarray(written.classification)
    other = np.count_nonzero(classes != again[same])
    assert np.array_equal(np.bincount(classes), np.bincount(again)) and other < 1e-4 * len(classes), (laz.name, other)
    assert written.header.parse_crs() is None if local else "UTM zone 12N" in next(
        v for v in written.header.vlrs if v.record_id == 2112).string
    print(f"{laz.name}: {len(given.points)} points, at most {1000 * off:.2f} mm off")


def tiles_read_in(clouds, folder):
    """A folder of two tiles is one mission; as LAS and as LAZ they are the same points."""
    sums = []
    for kind in ("laz", "las"):
        tiles = folder / f"tiles_{kind}"
        tiles.mkdir()
        for laz in clouds:
            laspy.read(laz).write(tiles / f"{laz.stem}.{kind}")
        (folder / "tiles.yaml").write_text(
            f"version: 1\nsteps: [{{export: las, params: {{crs: '{UTM12}', voxel_size: 0}}}}]\n")
        run("run", folder / "tiles.yaml", tiles, "--out", folder / f"out_{kind}", "--cache", "none")
        report = json.loads((folder / f"out_{kind}" / "report.json").read_text())
        assert report["missions"][0]["nodes"] == len(clouds), report["missions"]
        sums.append(laspy.read(folder / f"out_{kind}" / "las" / "map.las").xyz.sum(axis=0))
    assert np.array_equal(sums[0], sums[1])


def damage_is_named(laz, folder):
    """A LAZ file that is cut off, and one that nobody can unpack."""
    cut = folder / "cut.laz"
    cut.write_bytes(laz.read_bytes()[:-5000])
    (folder / "cut.yaml").write_text("version: 1\nsteps: [{export: cloud}]\n")
    for environment, expected in ((None, "cut.laz: is compressed (LAZ) and cannot be unpacked"),
                                  ({"PATH": "/nowhere"}, "is compressed (LAZ), which needs python3")):
        done = subprocess.run([program, "run", str(folder / "cut.yaml"), str(cut), "--out",
                               str(folder / "out_cut"), "--cache", "none"],
                              capture_output=True, text=True, env=environment)
        assert done.returncode == 4 and expected in done.stderr, done.stderr
    left = list((folder / "out_cut").rglob("cloud*"))
    assert all(p.is_dir() for p in left), left


def real_clouds_read_in(folder):
    archive = root.parent / "shared/data/aerial_terrestrial_ftvalley.tar.xz"
    if not archive.exists():
        print("not tried: ../shared/data/aerial_terrestrial_ftvalley.tar.xz is not there")
        return
    (folder / "data").mkdir()
    subprocess.run(["tar", "-xJf", archive, "-C", folder / "data"], check=True)
    clouds = {laz.stem: laz for laz in sorted((folder / "data").rglob("*.laz"))}
    assert set(clouds) == set(PLOTS), clouds
    for laz in clouds.values():
        a_plot_reads_in(laz, folder)
    tiles_read_in([clouds["ALS_Clip"], clouds["UAS_Clip"]], folder)
    damage_is_named(clouds["ALS_Clip"], folder)


with tempfile.TemporaryDirectory() as name:
    a_map_reads_back(Path(name))
    real_clouds_read_in(Path(name))
