"""Figures of limbs around bones, with pins at the joints, and poses of them."""

import numpy as np
from shapely.geometry import LineString
from shapely.ops import unary_union

# Bones of a figure about 400 high: the joint that each begins at, its length, its direction in degrees, half its
# width, and by how many degrees a pose turns it at most. Bone k ends at joint k + 1. Joint 0 is the hip.
BONES = (
    (0, 75, 90, 44, 10), (1, 55, 90, 26, 10), (2, 48, 90, 34, 15),
    (1, 85, 200, 17, 45), (4, 80, 225, 15, 45), (1, 85, -20, 17, 45), (6, 80, -45, 15, 45),
    (0, 80, 246, 22, 14), (8, 85, 262, 19, 18), (0, 80, -66, 22, 14), (10, 85, -82, 19, 18))
HEAD, HANDS, FEET = 3, (5, 7), (9, 11)
SPACING = 6.        # of the outline's vertices, in pixels


class Rig:
    """A figure. Angles and lengths vary by `rng`; None: the figure as it is drawn above."""

    def __init__(self, rng=None):
        self.parents = [bone[0] for bone in BONES]
        self.lengths, self.angles, self.widths, self.turns = np.array(BONES, float)[:, 1:].T
        self.angles, self.turns = np.radians(self.angles), np.radians(self.turns)
        if rng is not None:
            self.lengths = self.lengths * rng.uniform(.8, 1.2, len(BONES))
            self.widths = self.widths * rng.uniform(.8, 1.15, len(BONES))
            self.angles = self.angles + np.radians(rng.uniform(-8, 8, len(BONES)))

    def joints(self, turns=None):
        """Places of all joints when each bone turns, and everything beyond it with it."""
        turned, places = [0.], [np.zeros(2)]
        for k, parent in enumerate(self.parents):
            turned.append(turned[parent] + (0. if turns is None else turns[k]))
            angle = self.angles[k] + turned[-1]
            places.append(places[parent] + self.lengths[k] * np.array([np.cos(angle), np.sin(angle)]))
        return np.array(places)

    def outline(self):
        """The outline of all limbs, counter-clockwise, with vertices at even distances."""
        places = self.joints()
        limbs = [LineString([places[parent], places[k + 1]]).buffer(width)
                 for k, (parent, width) in enumerate(zip(self.parents, self.widths))]
        # Rounds off the corners between limbs.
        ring = unary_union(limbs).buffer(5).buffer(-5).exterior
        n = round(ring.length / SPACING)
        points = np.array([ring.interpolate(k / n, normalized=True).coords[0] for k in range(n)])
        x, y = points.T
        return points if x @ np.roll(y, -1) > np.roll(x, -1) @ y else points[::-1]

    def pose(self, rng):
        """Turns of all bones, drawn within their limits."""
        return self.turns * rng.uniform(-1, 1, len(BONES))

    def head(self, points):
        """Which points are in the head."""
        return ((points - self.joints()[HEAD]) ** 2).sum(1) < self.widths[HEAD - 1] ** 2
