# SPDX-License-Identifier: BSD-3-Clause
"""A map as messages, one node after the other: never more than one payload is in memory."""

import numpy as np
from cambium import map_to_geodetic, stems_of

from .clouds import encode
from .messages import GREEN, RED, Messages
from .names import map_frame, topic_names


class MapBag:
    """Writes an atlas through a Writer. Messages carry the stamps of the recording; they are received `rate` nodes a
    second, mission after mission, so that what was recorded over months plays at once."""

    def __init__(self, atlas, writer, options):
        self._writer, self._options, self._make = writer, options, Messages(writer.typestore)
        self._missions = atlas.missions
        self.names = topic_names([m.name for m in self._missions])
        self._frames = [map_frame(m.island) for m in self._missions]
        self.poses = [m.T_map_node for m in self._missions]
        stamps = [m.stamps for m in self._missions]
        known = [int(s) * 10**9 + int(n) for rows in stamps for s, n in rows if s >= 0]
        # Time 0 means "not yet" to ROS.
        self._now = self._start = max(min(known, default=0), 10**9)
        step = int(1e9 / options.rate)
        first = np.cumsum([0, *map(len, stamps)])
        self._played = [self._start + step * (np.arange(len(s)) + f) for s, f in zip(stamps, first)]
        self._times = [[int(s) * 10**9 + int(n) if s >= 0 else int(p) for (s, n), p in zip(rows, played)]
                       for rows, played in zip(stamps, self._played)]

    def write(self, atlas, context):
        """Returns the number of stems."""
        self._overlays(atlas, context)
        stems = self._stems(atlas, context)
        for i in range(len(self._missions)):
            self._mission(i, atlas.georeferences[self._missions[i].island], context)
        return stems

    def _overlays(self, atlas, context):
        """What RViz shows at once: paths, loops, where east and north are."""
        for i, name in enumerate(self.names):
            self._writer.write(f"/{name}/path", self._start, self._make.path(
                self._frames[i], self._start, self._times[i], self.poses[i]), latched=True)
        lines, apart = {}, 0
        for loop in atlas.loops:
            (tm, tn), (hm, hn) = loop.tail, loop.head
            if loop.state not in ("accepted", "rejected"):
                continue
            if self._frames[tm] != self._frames[hm]:
                apart += 1
                continue
            points = lines.setdefault((loop.state, self._frames[tm]), [])
            points += [self.poses[tm][tn][:3, 3], self.poses[hm][hn][:3, 3]]
        if apart:
            context.warn(f"{apart} rejected loops are not drawn: their missions are tied to each other by nothing")
        # Rejected ones are many more as a rule, and drawn thinner.
        look = {"accepted": (GREEN, self._options.line_width), "rejected": (RED, 0.3 * self._options.line_width)}
        markers = [self._make.lines(frame, self._start, state, i, *look[state], points)
                   for i, ((state, frame), points) in enumerate(sorted(lines.items()))]
        self._writer.write("/loops", self._start, self._make.array(markers), latched=True)
        for island, g in enumerate(atlas.georeferences):
            if g:
                suffix = map_frame(island)[3:]
                self._writer.write("/tf_static", self._start, self._make.transform(
                    map_frame(island), f"enu{suffix}", self._start, np.asarray(g[3])), latched=True)

    def _stems(self, atlas, context):
        markers = []
        for island in sorted({m.island for m in self._missions}):
            members = [i for i, m in enumerate(self._missions) if m.island == island]
            base, axis, dbh = stems_of(atlas, members, self._options.stem_radius, self._options.min_sightings, context)
            for b, a, d in zip(base, axis, dbh):
                markers.append(self._make.stem(map_frame(island), self._start, len(markers), b, a,
                                               d if np.isfinite(d) else 0.1, self._options.stem_height))
        if markers:
            self._writer.write("/stems", self._start, self._make.array(markers), latched=True)
        return len(markers)

    def _mission(self, i, georeference, context):
        mission, name, parent = self._missions[i], self.names[i], self._frames[i]
        child, make = f"{name}/base", self._make
        places = map_to_geodetic(georeference, self.poses[i][:, :3, 3]) if georeference else None
        for node, T in enumerate(self.poses[i]):
            context.check_cancelled()
            if node % 500 == 499:
                context.info(f"{name}: {node + 1} of {len(self.poses[i])} nodes written")
            played, time = int(self._played[i][node]), self._times[i][node]
            self._writer.write("/tf", played, make.transform(parent, child, time, T))
            self._writer.write(f"/{name}/odometry", played, make.odometry(parent, child, time, T))
            if places is not None:
                self._writer.write(f"/{name}/fix", played, make.fix(child, time, places[node], georeference[4]))
            cloud = mission.payload(node).cloud
            if cloud is not None and len(cloud):
                self._writer.write(f"/{name}/cloud", played, encode(cloud, make.header(child, time), self._writer.types))
