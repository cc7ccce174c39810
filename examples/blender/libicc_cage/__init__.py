"""Blender add-on: meshes follow a cage, one-to-one.

Select meshes, and last the cage, which is a mesh with a closed surface around them. The cage's rest is its mesh (the
shape key Basis, if there are shape keys). Its pose is what its shape keys and modifiers make of it.

Object > Deform by Cage moves the meshes once, into the shape key "Cage". Object > Bind to Cage binds them to the volume
of the cage. They follow in every frame, also when it is rendered. The object properties of a mesh show its cage.

Any closed surface will do that does not meet itself, however near it comes to the meshes. Only what lies inside moves.
The map is certified one-to-one, so nothing inside turns inside out. If that cannot be proved, a message says so.
"""

import sys
from pathlib import Path

import bpy
import numpy as np
from bpy.app.handlers import persistent

WHEEL = Path(__file__).resolve().parent / "wheel"
"""The Python package libicc, if this add-on brings it along."""

if WHEEL.exists():
    sys.path.insert(0, str(WHEEL))

import libicc

from .cage_deform import Cage, transformed

bl_info = {
    "name": "Deform by Cage (libicc)",
    "description": "Moves meshes along with a cage, one-to-one",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "View3D > Object",
    "category": "Object",
}

bound = {}
"""The cages that have been filled, by name."""


def coordinates(vertices):
    flat = np.empty(3 * len(vertices))
    vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def triangles(mesh):
    mesh.calc_loop_triangles()
    flat = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", flat)
    return flat.reshape(-1, 3)


def at_rest(thing):
    """An object's vertices before shape keys and modifiers, in its own coordinates."""
    keys = thing.data.shape_keys
    return coordinates(keys.reference_key.data if keys else thing.data.vertices)


def cage_of(thing):
    """The cage, filled anew only if its rest has changed."""
    rest, faces = at_rest(thing), triangles(thing.data)
    if thing.name not in bound or not bound[thing.name].is_of(rest, faces):
        bound[thing.name] = Cage(rest, faces)
    return bound[thing.name]


def shape_key(thing):
    if thing.data.shape_keys is None:
        thing.shape_key_add(name="Basis")
    keys = thing.data.shape_keys.key_blocks
    key = keys.get("Cage") or thing.shape_key_add(name="Cage", from_mix=False)
    key.value = 1.0
    return key


def deform(thing, meshes, depsgraph):
    """Moves meshes along with their cage, in its coordinates. Returns warnings."""
    cage = cage_of(thing)
    mapping = cage.move(coordinates(thing.evaluated_get(depsgraph).data.vertices))
    warnings = [] if mapping.certified else [f"{thing.name}: the map is not certified to be one-to-one"]
    for mesh in meshes:
        to_cage = np.linalg.inv(thing.matrix_world) @ np.array(mesh.matrix_world)
        images, n_outside = cage.deform(transformed(to_cage, at_rest(mesh)))
        shape_key(mesh).data.foreach_set("co", transformed(np.linalg.inv(to_cage), images).ravel())
        mesh.data.update()
        if n_outside > 0:
            warnings.append(f"{mesh.name}: {n_outside} vertices lie outside the cage and stay")
    return warnings


@persistent
def follow(scene, depsgraph):
    """Moves what is bound, after the frame has changed. If a cage has no map in this frame, its meshes stay."""
    followers = {}
    for mesh in scene.objects:
        if mesh.type == "MESH" and mesh.libicc_cage is not None:
            followers.setdefault(mesh.libicc_cage, []).append(mesh)
    for thing, meshes in followers.items():
        try:
            deform(thing, meshes, depsgraph)
        except (libicc.Error, ValueError) as error:
            print(f"frame {scene.frame_current}, {thing.name}: {error}", file=sys.stderr)


class ByCage(bpy.types.Operator):
    """What both operators do"""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        chosen = context.active_object
        return chosen is not None and chosen.type == "MESH" and len(context.selected_objects) > 1

    def execute(self, context):
        thing = context.active_object
        meshes = [mesh for mesh in context.selected_objects if mesh is not thing and mesh.type == "MESH"]
        try:
            warnings = deform(thing, meshes, context.evaluated_depsgraph_get())
        except (libicc.Error, ValueError) as error:
            self.report({"ERROR"}, f"{thing.name}: {error}")
            return {"CANCELLED"}
        for text in warnings:
            self.report({"WARNING"}, text)
        self.finish(thing, meshes)
        return {"FINISHED"}

    def finish(self, thing, meshes):
        pass


class DeformByCage(ByCage):
    """Move the selected meshes along with the active one, their cage"""

    bl_idname = "object.libicc_deform_by_cage"
    bl_label = "Deform by Cage"


class BindToCage(ByCage):
    """Let the selected meshes follow the volume inside the active one, their cage, in every frame"""

    bl_idname = "object.libicc_bind_to_cage"
    bl_label = "Bind to Cage"

    def finish(self, thing, meshes):
        for mesh in meshes:
            mesh.libicc_cage = thing


class CagePanel(bpy.types.Panel):
    """Shows to which cage a mesh is bound. Empty the field to unbind it"""

    bl_idname = "OBJECT_PT_libicc_cage"
    bl_label = "Cage (libicc)"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        self.layout.prop(context.object, "libicc_cage")


CLASSES = (DeformByCage, BindToCage, CagePanel)


def in_menu(menu, context):
    menu.layout.operator(DeformByCage.bl_idname)
    menu.layout.operator(BindToCage.bl_idname)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Object.libicc_cage = bpy.props.PointerProperty(
        type=bpy.types.Object, name="Cage", description="The mesh whose inside this mesh follows in every frame",
        poll=lambda mesh, other: other.type == "MESH" and other != mesh)
    bpy.types.VIEW3D_MT_object.append(in_menu)
    bpy.app.handlers.frame_change_post.append(follow)


def unregister():
    bpy.app.handlers.frame_change_post.remove(follow)
    bpy.types.VIEW3D_MT_object.remove(in_menu)
    del bpy.types.Object.libicc_cage
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
