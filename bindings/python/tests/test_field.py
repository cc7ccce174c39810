"""Sampled fields: an independent oracle of exact fractions, and files read by hand."""

import itertools
import random
import unittest
from fractions import Fraction
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import libicc
from libicc import fields


def determinant(field, cell, at):
    """The exact determinant of a displacement field at a place in a cell, by fractions."""
    dim, rows = field.dim, []
    for axis in range(dim):
        row = [Fraction(float(field.step[axis][k])) if field.displacement else Fraction(0) for k in range(dim)]
        for corner in itertools.product((0, 1), repeat=dim):
            weight = Fraction(2 * corner[axis] - 1)
            for k in range(dim):
                if k != axis:
                    weight *= at[k] if corner[k] else 1 - at[k]
            value = field.values[tuple(c + d for c, d in zip(cell, corner))]
            row = [number + weight * Fraction(float(v)) for number, v in zip(row, value)]
        rows.append(row)
    if dim == 2:
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    a, b, c = rows
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))


class Certificates(unittest.TestCase):
    def check(self, field, report, places):
        bad = dict(report["cells"])
        for cell in itertools.product(*(range(n - 1) for n in field.shape)):
            kind = bad.get(cell, "positive")
            values = [determinant(field, cell, at) for at in places]
            if kind == "positive":
                self.assertGreater(min(values), 0, cell)
            elif kind == "folded" and field.dim == 2:
                self.assertLessEqual(min(values), 0, cell)

    def test_signs_agree_with_fractions(self):
        rng, dice = np.random.default_rng(5), random.Random(7)
        for dim, dtype, trial in itertools.product((2, 3), (np.float32, np.float64), range(3)):
            shape = (4,) * dim
            values = rng.uniform(-.3, .3, (*shape, dim)).astype(dtype) * [1, .5, 2, .8][trial]
            field = libicc.Field(values.astype(dtype), .1, .7)
            inner = [tuple(Fraction(dice.randrange(65), 64) for _ in range(dim)) for _ in range(4)]
            places = list(itertools.product((Fraction(0), Fraction(1)), repeat=dim)) + inner
            report = libicc.certify_field(field)
            self.assertEqual(report["n_undecided"], 0)
            self.check(field, report, places)
            self.assertEqual(report, libicc.certify_field(field, threads=1))

    def test_cells_that_fold_are_listed_first(self):
        values = np.zeros((9, 9, 2))
        values[:4] = np.nan
        values[6, 6] = [5, 0]
        report = libicc.certify_field(values, most=3)
        self.assertEqual([kind for _, kind in report["cells"]], ["folded", "folded", "missing"])
        self.assertEqual(report["cells"][0], ((6, 5), "folded"))
        self.assertEqual(len(libicc.certify_field(values)["cells"]), 2 + 4 * 8)

    def test_a_fold_in_the_inside_of_a_cell_is_found(self):
        # Positive at all eight corners, negative between.
        values = np.array([-2, -2, -3, -3, -9, 9, 3, 7, 8, -5, -5, -7, -4, 0, 6, 1, -1, -3, 6, 2, -1, 3, 9, 6]) / 16
        field = libicc.Field(values.reshape(2, 2, 2, 3))
        for at in itertools.product((Fraction(0), Fraction(1)), repeat=3):
            self.assertGreater(determinant(field, (0, 0, 0), at), 0)
        sixths = itertools.product([Fraction(k, 6) for k in range(7)], repeat=3)
        self.assertLess(min(determinant(field, (0, 0, 0), at) for at in sixths), 0)
        self.assertEqual(libicc.certify_field(field)["n_folded"], 1)

    def test_zero_is_exact(self):
        values = np.zeros((2, 2, 2))
        values[1, :, 0] = -.1  # 0.1 and -0.1 cancel exactly
        self.assertEqual(libicc.certify_field(values, .1)["n_folded"], 1)
        values[1, :, 0] = np.nextafter(-.1, 0)
        report = libicc.certify_field(values, .1)
        self.assertTrue(report["certified"] and report["one_to_one"])

    def test_missing_and_one_to_one(self):
        values = np.zeros((3, 3, 3, 3))
        self.assertTrue(libicc.certify_field(values)["one_to_one"])
        values[0, 0, 0, 0] = np.nan
        report = libicc.certify_field(values)
        self.assertEqual(report["cells"], [((0, 0, 0), "missing")])
        # A spiral ramp: no cell folds, but the two ends overlap.
        angle = np.linspace(0, 2.2 * np.pi, 40)[:, None]
        radius = np.array([2., 3.])
        ring = np.stack([np.cos(angle) * radius, np.sin(angle) * radius], -1)[:, ::-1]
        report = libicc.certify_field(ring, displacement=False)
        self.assertTrue(report["certified"] and not report["one_to_one"], report)
        report = libicc.certify_field(ring[:30], displacement=False)
        self.assertTrue(report["one_to_one"], report)

    def test_bad_arguments(self):
        with self.assertRaises(ValueError):
            libicc.certify_field(np.zeros((3, 3)))
        with self.assertRaises(libicc.Error):
            libicc.certify_field(np.zeros((3, 3, 2)), [[1, 1], [2, 2]])


class Maps(unittest.TestCase):
    def setUp(self):
        square = np.array([[0, 0], [8, 0], [8, 6], [0, 6]], float)
        self.map = libicc.Map(square, square + [[0, 0], [1, 1], [0, 2], [-1, 0]])

    def test_samples_are_images(self):
        for outside in ("nan", "identity", "nearest"):
            field = self.map.field((11, 9), 1, -1, outside=outside, dtype=np.float32)
            images = self.map(field.places)
            inside = ~np.isnan(images[..., 0])
            np.testing.assert_allclose(field.images[inside], images[inside], atol=1e-5)
            self.assertEqual(field.n_outside, (~inside).sum())
            if outside == "nan":
                self.assertTrue(np.isnan(field.values[~inside]).all())
                self.assertEqual(field.report["n_folded"], 0)
            elif outside == "identity":
                self.assertTrue((field.values[~inside] == 0).all())
            else:
                np.testing.assert_allclose(field.values[-1, 0], [1, 1], atol=1e-6)
                self.assertTrue(np.isfinite(field.values).all())

    def test_inverse_and_refinement(self):
        field = self.map.field((3, 3), 2, (2, 2), inverse=True, displacement=False, refine=3)
        np.testing.assert_array_equal(field.values, self.map.apply_inverse(field.places))
        self.assertTrue(field.certified)
        self.assertEqual(field.factor, 1)

    def test_remap_reads_pixels(self):
        x, y = fields.remap(self.map.field((8, 6), 1, .5, inverse=True))
        self.assertEqual((x.shape, x.dtype), ((6, 8), np.float32))
        image = self.map.apply_inverse([[3.5, 2.5]])[0] - .5
        np.testing.assert_allclose([x[2, 3], y[2, 3]], image, atol=1e-6)


class Files(unittest.TestCase):
    def setUp(self):
        rng = np.random.default_rng(1)
        self.field = libicc.Field(rng.uniform(-.2, .2, (4, 5, 6, 3)), (1, 2, 3), np.diag([.5, 1, 2]))

    def test_mha_by_hand(self):
        with TemporaryDirectory() as folder:
            path = Path(folder) / "field.mha"
            self.field.save(path)
            head, data = path.read_bytes().split(b"LOCAL\n", 1)
        words = dict(line.split(" = ") for line in head.decode().splitlines())
        shape = [int(n) for n in words["DimSize"].split()]
        data = np.frombuffer(data).reshape(*shape[::-1], 3)
        index = np.array([1, 2, 3])
        matrix = np.array(words["TransformMatrix"].split(), float).reshape(3, 3)
        place = np.array(words["Offset"].split(), float) + (index * np.array(words["ElementSpacing"].split(), float)) @ matrix
        moved = (place + data[3, 2, 1]) * [-1, -1, 1]
        np.testing.assert_allclose(moved, self.field.images[1, 2, 3], atol=1e-12)

    def test_nifti_by_nibabel(self):
        try:
            import nibabel
        except ImportError:
            self.skipTest("nibabel is not installed")
        with TemporaryDirectory() as folder:
            path = Path(folder) / "field.nii"
            self.field.save(path)
            image = nibabel.load(path)
            data = np.asarray(image.dataobj)
        self.assertEqual((data.shape, image.header.get_intent()[0]), ((4, 5, 6, 1, 3), "vector"))
        place = (image.affine @ [1, 2, 3, 1])[:3]
        np.testing.assert_allclose(place + data[1, 2, 3, 0] * [-1, -1, 1], self.field.images[1, 2, 3], atol=1e-12)

    def test_vti_by_vtk(self):
        try:
            import vtk
        except ImportError:
            self.skipTest("vtk is not installed")
        with TemporaryDirectory() as folder:
            path = Path(folder) / "field.vti"
            self.field.save(path)
            reader = vtk.vtkXMLImageDataReader()
            reader.SetFileName(str(path))
            reader.Update()
            grid = vtk.vtkGridTransform()
            grid.SetDisplacementGridConnection(reader.GetOutputPort())
            grid.SetInterpolationModeToLinear()
            grid.Update()
        rng = np.random.default_rng(2)
        for at in rng.uniform(0, 1, (1000, 3)) * (np.array(self.field.shape) - 1):
            i = np.minimum(at.astype(int), np.array(self.field.shape) - 2)
            expected = np.zeros(3)
            for corner in itertools.product((0, 1), repeat=3):
                expected += np.prod(np.where(corner, at - i, 1 - at + i)) * self.field.images[tuple(i + corner)]
            place = self.field.origin + at @ self.field.step
            np.testing.assert_allclose(grid.TransformPoint(place), expected, atol=1e-5)  # VTK computes in float


if __name__ == "__main__":
    unittest.main()
