"""The add-on for Blender as it is packed, in Blender without a window.

usage: blender -b --factory-startup -P blender_cage.py -- ZIP      libicc-blender.zip, as examples/addons.py makes it

BLENDER_USER_SCRIPTS must be a scratch folder that exists, because the add-on is installed there. The scene is a ball in
a box whose top is twisted. A tube, which has no lids, is refused.
"""

import os
import shutil
import sys
import traceback
from math import radians
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix


def box():
    """A box with three shape keys: two in which its top turns, and one that is flat."""
    bpy.ops.mesh.primitive_cube_add(size=3)
    thing = bpy.context.active_object
    thing.name = "Box"
    thing.shape_key_add(name="Basis")
    for name, angle in (("Half", 30), ("Twisted", 60)):
        for vertex, place in zip(thing.data.vertices, thing.shape_key_add(name=name).data):
            top = vertex.co.z > 0
            place.co = Matrix.Rotation(radians(angle) if top else 0.0, 3, "Z") @ vertex.co
    for place in thing.shape_key_add(name="Flat").data:
        place.co.z = 0
    return thing


def choose(mesh, thing):
    bpy.ops.object.select_all(action="DESELECT")
    mesh.select_set(True)
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def show(thing, name):
    for key in thing.data.shape_keys.key_blocks[1:]:
        key.value = float(key.name == name)
    bpy.context.view_layer.update()


def volume(places, faces):
    """What a surface encloses; below 0 it is inside out."""
    return np.linalg.det(places[faces]).sum() / 6


def shown(addon, mesh):
    """The vertices as they are rendered, in the world."""
    places = addon.coordinates(mesh.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices)
    return addon.transformed(mesh.matrix_world, places)


def expected(addon, libicc, mesh, thing, name):
    """Where the Python package alone takes the vertices."""
    keys, faces = thing.data.shape_keys.key_blocks, addon.triangles(thing.data)
    rest, pose = (addon.coordinates(keys[key].data) for key in ("Basis", name))
    mapping = libicc.Map(libicc.Domain(rest, faces).filled(), libicc.Domain(pose, faces))
    to_cage = np.linalg.inv(thing.matrix_world) @ np.array(mesh.matrix_world)
    return addon.transformed(thing.matrix_world, mapping(addon.transformed(to_cage, addon.at_rest(mesh))))


def test_deform(addon, libicc, ball, thing):
    for name in ("Half", "Twisted"):
        show(thing, name)
        choose(ball, thing)
        assert bpy.ops.object.libicc_deform_by_cage() == {"FINISHED"}
        assert addon.bound["Box"].map.certified
        places = shown(addon, ball)
        assert np.abs(places - expected(addon, libicc, ball, thing, name)).max() < 1e-5, "a shape key holds floats"
        faces = addon.triangles(ball.data)
        assert volume(places, faces) > 0.9 * volume(addon.at_rest(ball), faces)
    assert ball.libicc_cage is None


def test_bind(addon, libicc, ball, thing):
    """Frames come in any order, and the whole scene moves. What is bound survives in a file. In frame 4 the cage has no
    inside, so the ball stays as it was."""
    ball.parent = thing
    thing.location = (5, 0, 1)
    show(thing, "Basis")
    for frame, name in ((1, "Basis"), (2, "Half"), (3, "Twisted"), (4, "Flat")):
        for key in thing.data.shape_keys.key_blocks[1:]:
            key.value = float(key.name == name)
            key.keyframe_insert("value", frame=frame)
    bpy.context.scene.frame_set(1)
    choose(ball, thing)
    assert bpy.ops.object.libicc_bind_to_cage() == {"FINISHED"} and ball.libicc_cage == thing
    path = Path(os.environ["BLENDER_USER_SCRIPTS"], "scene.blend")
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))
    addon.bound.clear()
    ball, thing = bpy.data.objects["Ball"], bpy.data.objects["Box"]
    for frame, name in ((3, "Twisted"), (2, "Half"), (3, "Twisted"), (1, "Basis")):
        bpy.context.scene.frame_set(frame)
        off = np.abs(shown(addon, ball) - expected(addon, libicc, ball, thing, name)).max()
        assert off < 1e-5, (frame, off)
    bpy.context.scene.frame_set(4)
    assert np.abs(shown(addon, ball) - expected(addon, libicc, ball, thing, "Basis")).max() < 1e-5, "it does not stay"
    ball.libicc_cage = None
    bpy.context.scene.frame_set(3)
    assert np.abs(shown(addon, ball) - expected(addon, libicc, ball, thing, "Basis")).max() < 1e-5, "it is still bound"
    return ball


def test_tube(ball):
    bpy.ops.mesh.primitive_cylinder_add(radius=2, depth=3, end_fill_type="NOTHING")
    tube = bpy.context.active_object
    choose(ball, tube)
    for operator in (bpy.ops.object.libicc_deform_by_cage, bpy.ops.object.libicc_bind_to_cage):
        try:
            operator()
        except RuntimeError as error:  # reports of kind ERROR are raised for scripts
            assert "open" in str(error), error
        else:
            sys.exit("a tube is taken as a cage")
    assert ball.libicc_cage is None


def main(path):
    bpy.ops.preferences.addon_install(filepath=path)
    bpy.ops.preferences.addon_enable(module="libicc_cage")
    import libicc
    import libicc_cage as addon

    for module in (addon, libicc):
        assert Path(module.__file__).is_relative_to(os.environ["BLENDER_USER_SCRIPTS"]), module.__file__
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1, location=(0.1, 0, 0))
    ball = bpy.context.active_object
    ball.name = "Ball"
    thing = box()
    test_deform(addon, libicc, ball, thing)
    ball = test_bind(addon, libicc, ball, thing)
    test_tube(ball)
    bpy.ops.preferences.addon_disable(module="libicc_cage")
    shutil.rmtree(Path(os.environ["BLENDER_USER_SCRIPTS"], "addons"))
    Path(bpy.data.filepath).unlink()
    print("the add-on works")


try:
    main(sys.argv[sys.argv.index("--") + 1])
except BaseException:
    traceback.print_exc()
    sys.exit(1)
