#!/usr/bin/env python3
"""A torso takes a breath: its label volume and Slicer's landmarks go along, and other programs get the map as a field.

    python3 examples/field.py FOLDER     needs nibabel

Writes before.nii.gz and before.mrk.json, which stand for data of your own, and after.nii.gz, after.mrk.json, field.nii.gz
and field.mha. No outside data is used.

The files use three kinds of coordinates, and each mistake between them would be silent. NIfTI's world is RAS: x to the
right, y to the front. Slicer's landmarks say LPS, x to the left and y to the back. Voxels are counted from 0, and the affine
of a volume takes them to its world. Here the map is made in RAS, in millimetres.
"""

import json
import sys
from pathlib import Path

import libicc
import nibabel
import numpy as np
from nibabel.affines import apply_affine
from torso import LANDMARKS, torso

TURN = np.array([-1, -1, 1])  # from LPS to RAS and back
MILLIMETRES = 10.0            # the torso is in centimetres, LPS
VOXEL = 6.0


def to_ras(places):
    return MILLIMETRES * np.asarray(places) * TURN


def body(breath):
    """The surfaces, and the domain that they bound. Two signs turn, so triangles still face outwards."""
    parts = torso(breath=breath)
    skin, *organs = [(to_ras(vertices), triangles) for vertices, triangles in [parts["skin"], *parts["organs"]]]
    return skin, organs, libicc.Domain(*skin, surfaces=organs)


def labelled(skin, organs):
    """A label volume: 0 outside, 1 tissue, 2 and 3 lungs, 4 heart."""
    low, high = skin[0].min(axis=0) - 2 * VOXEL, skin[0].max(axis=0) + 2 * VOXEL
    shape = np.ceil((high - low) / VOXEL).astype(int)
    affine = np.diag([VOXEL, VOXEL, VOXEL, 1])
    affine[:3, 3] = low
    voxels = np.moveaxis(np.indices(shape), 0, -1).reshape(-1, 3)
    labels = np.zeros(len(voxels), np.uint8)
    for label, surface in enumerate([skin, *organs], 1):
        labels[libicc.Domain(*surface).locate(apply_affine(affine, voxels)) != libicc.OUTSIDE] = label
    return nibabel.Nifti1Image(labels.reshape(shape), affine)


def landmarks_file(places):
    """Landmarks as Slicer stores them."""
    points = [{"id": str(number), "label": name, "position": place}
              for number, (name, place) in enumerate(zip(LANDMARKS, (places * TURN).tolist()), 1)]
    return json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": points}]}, indent=1)


def warped(image, mapping):
    """A label volume after the map, on the same grid: each voxel takes the label of the place that it comes from."""
    back = mapping.field(image, inverse=True, displacement=False).images
    labels, result = np.asarray(image.dataobj), np.zeros(image.shape, np.uint8)
    inside = np.isfinite(back).all(axis=-1)
    at = np.rint(apply_affine(np.linalg.inv(image.affine), back[inside])).astype(int)
    result[inside] = labels[tuple(np.clip(at, 0, np.array(image.shape) - 1).T)]
    return nibabel.Nifti1Image(result, image.affine)


def shifted(path, places):
    """Where the displacements of a NIfTI file take places: those of the nearest samples. ITK stores them in LPS."""
    image = nibabel.load(path)
    at = np.rint(apply_affine(np.linalg.inv(image.affine), places)).astype(int)
    samples = apply_affine(image.affine, at)
    return samples, samples + np.asarray(image.dataobj)[tuple(at.T)][:, 0] * TURN


def main():
    folder = Path(sys.argv[1])
    skin, organs, before = body(0)
    _, after_organs, after = body(1)
    mapping = libicc.Map(before, after)
    print(mapping)

    image, places = labelled(skin, organs), to_ras(torso()["landmarks"])
    nibabel.save(image, folder / "before.nii.gz")
    nibabel.save(warped(image, mapping), folder / "after.nii.gz")
    (folder / "before.mrk.json").write_text(landmarks_file(places))
    (folder / "after.mrk.json").write_text(landmarks_file(mapping(places)))
    for name, number in (("lungs", (2, 3)), ("heart", (4,))):
        sizes = [np.isin(nibabel.load(folder / f"{when}.nii.gz").dataobj, number).sum() * VOXEL**3 / 1e6
                 for when in ("before", "after")]
        surfaces = [sum(libicc.Domain(*chosen[label - 2]).info.measure for label in number) / 1e6
                    for chosen in (organs, after_organs)]
        print("%s: %.2f -> %.2f litres by voxels, %.2f -> %.2f by surfaces" % (name, *sizes, *surfaces))

    field = mapping.field(image, dtype="float32")
    field.save(folder / "field.nii.gz")
    field.save(folder / "field.mha")
    report = field.report
    print("field: %d cells in the body, %d fold, %d undecided" % (
        report["n_cells"] - report["n_missing"], report["n_folded"], report["n_undecided"]))
    for cell, kind in report["cells"]:
        if kind == "folded":
            print("   a cell that folds:", cell, "at", apply_affine(image.affine, cell).round().tolist(), "mm")
    samples, images = shifted(folder / "field.nii.gz", places)
    print("the file is off by at most %.4f mm at the landmarks' samples" % np.abs(mapping(samples) - images).max())


if __name__ == "__main__":
    main()
