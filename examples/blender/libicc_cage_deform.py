"""Blender add-on: Object > Deform by Cage deforms meshes by a cage that has been moved, one-to-one.

Select meshes, and last the cage: a mesh with a closed surface round them. Its rest is its mesh (the shape key Basis,
where there are any); what its shape keys and its modifiers that keep the number of vertices make of it is the pose. The
meshes get the shape key "Cage". Do it again for another pose, or before each frame.

Any closed surface that does not meet itself will do, however near it comes to the meshes; only what lies inside is moved.
The map is certified to be one-to-one, so that what is inside does not turn inside out; where it cannot be, that is said.

Needs libicc for Blender's Python, and beside this file cage_deform.py.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import cage_deform
import libicc

bl_info = {
    "name": "Deform by Cage (libicc)",
    "description": "Moves meshes along with a cage, one-to-one",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "View3D > Object",
    "category": "Object",
}

bound = {}
"""The cages that are bound, by name, with what they were bound by: vertices and triangles at rest."""


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
    """An object's vertices before shape keys and modifiers, in the world."""
    keys = thing.data.shape_keys
    vertices = keys.reference_key.data if keys else thing.data.vertices
    return cage_deform.transformed(thing.matrix_world, coordinates(vertices))


def as_posed(thing, depsgraph):
    evaluated = thing.evaluated_get(depsgraph)
    return cage_deform.transformed(thing.matrix_world, coordinates(evaluated.data.vertices))


def cage_of(thing):
    """The cage, bound anew only if its rest has changed."""
    rest, faces = at_rest(thing), triangles(thing.data)
    old = bound.get(thing.name)
    if old is None or not (np.array_equal(old[0], rest) and np.array_equal(old[1], faces)):
        bound[thing.name] = (rest, faces, cage_deform.Cage(rest, faces))
    return bound[thing.name][2]


def shape_key(thing):
    if thing.data.shape_keys is None:
        thing.shape_key_add(name="Basis")
    keys = thing.data.shape_keys.key_blocks
    key = keys.get("Cage") or thing.shape_key_add(name="Cage", from_mix=False)
    key.value = 1.0
    return key


class DeformByCage(bpy.types.Operator):
    """Move the selected meshes along with the active one, their cage"""

    bl_idname = "object.libicc_deform_by_cage"
    bl_label = "Deform by Cage"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        chosen = context.active_object
        return chosen is not None and chosen.type == "MESH" and len(context.selected_objects) > 1

    def execute(self, context):
        thing = context.active_object
        posed = as_posed(thing, context.evaluated_depsgraph_get())
        try:
            cage = cage_of(thing)
            if len(posed) != len(thing.data.vertices):
                raise ValueError("a modifier of the cage changes the number of its vertices")
            mapping = cage.move(posed)
        except (libicc.Error, ValueError) as error:
            self.report({"ERROR"}, f"{thing.name}: {error}")
            return {"CANCELLED"}
        for mesh in context.selected_objects:
            if mesh is not thing and mesh.type == "MESH":
                self.deform(mesh, cage)
        if not mapping.certified:
            self.report({"WARNING"}, f"{thing.name}: the map is not certified to be one-to-one")
        return {"FINISHED"}

    def deform(self, mesh, cage):
        images, n_outside = cage.deform(at_rest(mesh))
        images = cage_deform.transformed(mesh.matrix_world.inverted(), images)
        shape_key(mesh).data.foreach_set("co", images.ravel())
        mesh.data.update()
        if n_outside > 0:
            self.report({"WARNING"}, f"{mesh.name}: {n_outside} vertices lie outside the cage and stay")


def in_menu(menu, context):
    menu.layout.operator(DeformByCage.bl_idname)


def register():
    bpy.utils.register_class(DeformByCage)
    bpy.types.VIEW3D_MT_object.append(in_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(in_menu)
    bpy.utils.unregister_class(DeformByCage)


if __name__ == "__main__":
    register()
