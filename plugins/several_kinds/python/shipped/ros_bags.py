# SPDX-License-Identifier: BSD-3-Clause
"""Write maps as ROS recordings, with a file for RViz. docs/recordings.md"""

from pathlib import Path

import numpy as np
from cambium import MapExporter, Param, above, at_least, one_of, write_file

from cambium_recordings import need_rosbags
from cambium_recordings.map_bag import MapBag
from cambium_recordings.rviz import rviz_config
from cambium_recordings.writers import Ros1Writer, Ros2Writer


class _MapRecording(MapExporter):
    rate = Param(20.0, "Nodes a second when the recording is played at its speed", above(0.0, "1/s"))
    line_width = Param(0.2, "Of accepted loops; rejected ones are drawn with 0.3 of it", above(0.0, "m"))
    stem_radius = Param(0.5, "Detections so near each other are one tree", above(0.0, "m"))
    min_sightings = Param(3, "A stem was detected at so many nodes", at_least(1))
    stem_height = Param(6.0, "Of the cylinders; how tall trees are is not measured", above(0.0, "m"))

    def __init__(self):
        need_rosbags()

    def write(self, atlas, folder, context):
        with self._writer(Path(folder)) as writer:
            bag = MapBag(atlas, writer, self)
            stems = bag.write(atlas, context)
        config = Path(folder) / "map.rviz"
        write_file(str(config), rviz_config(writer.ros, bag.names, *_view(bag.poses), stems > 0))
        return [*writer.files(), config]


def _view(poses):
    """(middle, extent) of all poses."""
    places = np.concatenate([T[:, :3, 3] for T in poses])
    low, high = places.min(axis=0), places.max(axis=0)
    return 0.5 * (low + high), max(20.0, float(np.linalg.norm(high - low)))


class Ros1Bag(_MapRecording):
    def _writer(self, folder):
        return Ros1Writer(folder / "map.bag")


class Ros2Bag(_MapRecording):
    storage = Param("mcap", "Of rosbag2", one_of(["mcap", "sqlite3"]))

    def _writer(self, folder):
        return Ros2Writer(folder / "map", self.storage)
