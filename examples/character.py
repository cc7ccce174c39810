#!/usr/bin/env python3
"""Makes a character with bones, before and after it is posed, for libicc's tutorial.

    python3 examples/character.py FOLDER      writes character.geojson

The outline is drawn round the joints of five limbs, so that it has the same vertices in every pose; the bones are
lines inside, and each limb begins at a joint of the spine. Import it for poses in between: rig(share) gives the outline and the bones, from rest (0) to posed (1).
"""

import json
import sys

import numpy as np

# Joints of each limb, at rest and posed, and how wide the limb is at each of them.
SPINE = ([[0, -.1], [0, 1.3], [0, 2.6], [0, 4.2]], [[0, -.1], [.12, 1.3], [.1, 2.6], [-.15, 4.15]])
RIGHT_ARM = ([[.9, 2.75], [1.45, 1.5], [1.5, .2]], [[.95, 2.85], [1.9, 3.5], [2.1, 4.8]])
LEFT_ARM = ([[-.9, 2.75], [-1.45, 1.5], [-1.5, .2]], [[-.8, 2.7], [-2.0, 2.2], [-3.1, 2.9]])
RIGHT_LEG = ([[.55, -.5], [.7, -2.1], [.8, -3.7]], [[.6, -.5], [1.7, -1.6], [1.5, -3.1]])
LEFT_LEG = ([[-.55, -.5], [-.7, -2.1], [-.8, -3.7]], [[-.55, -.5], [-.75, -2.1], [-.7, -3.75]])
ARM, LEG = [.38, .36, .32], [.46, .42, .36]


def between(pair, share):
    """Joints part of the way from the first pose to the second: bones turn, so that they keep their lengths."""
    first, second = (np.array(joints, float) @ [1, 1j] for joints in pair)
    bones = np.diff(first) * (np.diff(second) / np.diff(first)) ** share
    joints = np.cumsum(np.concatenate([(1 - share) * first[:1] + share * second[:1], bones]))
    return np.column_stack([joints.real, joints.imag])


def sides(joints, widths):
    """The right side of a limb from its root on, its tip, and its left side back to the root."""
    ways = np.diff(joints, axis=0)
    ways /= np.hypot(*ways.T)[:, None]
    at_joints = np.vstack([ways[:1], ways[:-1] + ways[1:], ways[-1:]])
    at_joints /= np.hypot(*at_joints.T)[:, None]
    across = np.column_stack([at_joints[:, 1], -at_joints[:, 0]]) * np.array(widths)[:, None]
    turn, tip = np.linspace(-1, 1, 5)[1:-1, None] * np.pi / 2, joints[-1]
    end = tip + np.cos(turn) * at_joints[-1] * widths[-1] - np.sin(turn) * across[-1]
    return np.vstack([joints + across, end, (joints - across)[::-1]])


def rig(share):
    """The outline, (n, 2), counter-clockwise, and the bones, each (m, 2)."""
    spine, *limbs = (between(pair, share) for pair in (SPINE, RIGHT_LEG, RIGHT_ARM, LEFT_ARM, LEFT_LEG))
    right_leg, right_arm, left_arm, left_leg = limbs
    turn = np.linspace(-.32, .32, 13)[:, None] * 2 * np.pi
    up = (spine[3] - spine[2]) / np.hypot(*(spine[3] - spine[2]))
    head = spine[3] + .85 * (np.cos(turn) * up + np.sin(turn) * np.array([-up[1], up[0]]))
    outline = np.vstack([
        spine[:1] + [0, -.75], sides(right_leg, LEG), spine[1:2] + [.75, 0], sides(right_arm, ARM),
        spine[2:3] + [.32, .55], head, spine[2:3] + [-.32, .55],
        sides(left_arm, ARM), spine[1:2] - [.75, 0], sides(left_leg, LEG)])
    return outline, [spine, *(np.vstack([joint, limb]) for joint, limb in (
        (spine[0], right_leg), (spine[2], right_arm), (spine[2], left_arm), (spine[0], left_leg)))]


def feature(kind, places, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": places}}


def main():
    features = []
    for role, share in (("source", 0), ("target", 1)):
        outline, bones = rig(share)
        outline, bones = outline.round(3).tolist(), [bone.round(3).tolist() for bone in bones]
        features.append(feature("Polygon", [outline + outline[:1]], role=role))
        features += [feature("LineString", bone, role=role, feature=k) for k, bone in enumerate(bones, 1)]
    with open(f"{sys.argv[1]}/character.geojson", "w", encoding="utf-8") as file:
        lines = ",\n".join(json.dumps(f) for f in features)
        file.write('{"type": "FeatureCollection", "features": [\n' + lines + "\n]}\n")


if __name__ == "__main__":
    main()
