# SPDX-License-Identifier: BSD-3-Clause
"""The file that RViz opens: every topic of the map, a colour a mission, seen from above."""

# The colours of the other exports, in order of the missions.
COLOURS = ((31, 119, 180), (255, 127, 14), (148, 103, 189), (23, 190, 207), (227, 119, 194), (188, 189, 34), (140, 86, 75),
           (127, 127, 127))
PACKAGE = {1: "rviz", 2: "rviz_default_plugins"}


def _topic(ros, key, topic, latched):
    if ros == 1:
        return f"{key}: {topic}"
    durability = "Transient Local" if latched else "Volatile"
    return (f"Topic:\n        Depth: 100\n        Durability Policy: {durability}\n        History Policy: Keep Last\n"
            f"        Reliability Policy: Reliable\n        Value: {topic}")


def _display(ros, kind, name, lines, enabled=True):
    body = "".join(f"      {line}\n" for line in lines)
    return f"    - Class: {PACKAGE[ros]}/{kind}\n      Enabled: {str(enabled).lower()}\n      Name: {name}\n{body}"


def rviz_config(ros, missions, middle, extent, stems):
    """`missions`: names as they are in the topics; `middle` (x, y, z) and `extent` [m]: what the camera looks at."""
    key = "Marker Topic" if ros == 1 else "Topic"
    shown = [_display(ros, "Grid", "Grid", ["Cell Size: 10", "Plane Cell Count: 100", "Color: 80; 80; 80"], False),
             _display(ros, "TF", "Frames", ["Marker Scale: 3", "Show Names: true"], False)]
    for i, name in enumerate(missions):
        colour = "; ".join(map(str, COLOURS[i % len(COLOURS)]))
        # The clouds stay: each is placed where its node is, by the transform of its own time.
        shown.append(_display(ros, "PointCloud2", f"{name} clouds", [
            _topic(ros, "Topic", f"/{name}/cloud", False), "Color Transformer: FlatColor", f"Color: {colour}",
            "Position Transformer: XYZ", "Style: Points", "Size (Pixels): 1", "Alpha: 0.7", "Decay Time: 1e+06",
            "Queue Size: 100"]))
        shown.append(_display(ros, "Path", f"{name} path", [
            _topic(ros, "Topic", f"/{name}/path", True), f"Color: {colour}", "Line Style: Billboards", "Line Width: 0.15"]))
    shown.append(_display(ros, "MarkerArray", "Loops", [_topic(ros, key, "/loops", True)]))
    if stems:
        shown.append(_display(ros, "MarkerArray", "Stems", [_topic(ros, key, "/stems", True)]))
    x, y, z = (f"{v:.3f}" for v in middle)
    return (f"Panels:\n  - Class: {'rviz' if ros == 1 else 'rviz_common'}/Displays\n    Name: Displays\n"
            f"Visualization Manager:\n  Class: \"\"\n  Displays:\n{''.join(shown)}  Enabled: true\n"
            f"  Global Options:\n    Background Color: 255; 255; 255\n    Fixed Frame: map\n    Frame Rate: 30\n"
            f"  Tools:\n    - Class: {PACKAGE[ros]}/MoveCamera\n"
            f"  Value: true\n  Views:\n    Current:\n      Class: {PACKAGE[ros]}/Orbit\n      Name: Current View\n"
            f"      Distance: {1.2 * extent:.3f}\n      Pitch: 1.0\n      Yaw: 4.71\n"
            f"      Focal Point:\n        X: {x}\n        Y: {y}\n        Z: {z}\n      Target Frame: map\n"
            f"Window Geometry:\n  Height: 900\n  Width: 1440\n")
