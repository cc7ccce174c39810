"""Tries the add-on in Blender, without a window: blender -b --factory-startup -P examples/blender/try_it.py

A ball in a box, the top of which is twisted, and twisted further. A tube, which has no lids, is refused.
"""

import sys
from math import radians
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

sys.path.insert(0, str(Path(__file__).resolve().parent))

import libicc_cage_deform as addon


def box():
    bpy.ops.mesh.primitive_cube_add(size=3)
    thing = bpy.context.active_object
    thing.name = "Box"
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name="Twisted")
    key.value = 1.0
    return thing, key


def twist(thing, key, angle):
    for vertex, place in zip(thing.data.vertices, key.data):
        top = vertex.co.z > 0
        place.co = Matrix.Rotation(angle if top else 0.0, 3, "Z") @ vertex.co
    bpy.context.view_layer.update()


def deform(ball, thing):
    bpy.ops.object.select_all(action="DESELECT")
    ball.select_set(True)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    return bpy.ops.object.libicc_deform_by_cage()


def volume(ball):
    """What the ball's surface encloses; below 0 it is inside out."""
    places, faces = addon.coordinates(ball.data.shape_keys.key_blocks["Cage"].data), addon.triangles(ball.data)
    return np.linalg.det(places[faces]).sum() / 6


def main():
    addon.register()
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1, location=(0.1, 0, 0))
    ball = bpy.context.active_object
    thing, key = box()
    for angle in (30, 60):
        twist(thing, key, radians(angle))
        assert deform(ball, thing) == {"FINISHED"}
        rest = addon.coordinates(ball.data.shape_keys.key_blocks["Basis"].data)
        moved = addon.coordinates(ball.data.shape_keys.key_blocks["Cage"].data)
        cage = addon.bound["Box"][2]
        assert cage.map.certified
        to_world = np.asarray(ball.matrix_world)
        place = rest @ to_world[:3, :3].T + to_world[:3, 3]
        images = cage.map(place) - to_world[:3, 3]
        assert np.abs(images - moved).max() < 1e-6, "a shape key holds floats"
        assert np.abs(moved - rest).max() > 0.1 and volume(ball) > 0
        print(f"{angle} degrees: {len(rest)} vertices, moved by at most {np.abs(moved - rest).max():.2f}")
    bpy.ops.mesh.primitive_cylinder_add(radius=2, depth=3, end_fill_type="NOTHING")
    try:
        result = deform(ball, bpy.context.active_object)
    except RuntimeError as error:  # reports of kind ERROR are raised for scripts
        result, text = {"CANCELLED"}, str(error)
        assert "open" in text, text
        print(text.strip())
    assert result == {"CANCELLED"}
    addon.unregister()
    print("the add-on works")


try:
    main()
except BaseException:
    import traceback

    traceback.print_exc()
    sys.exit(1)
