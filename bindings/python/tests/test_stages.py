import libicc
import numpy as np
import pytest
from libicc import stages


def test_papers_pipeline(before):
    grid = stages.Grid(before, 40)
    inside = grid.inside
    assert inside.sum() == grid.info.n_inside and inside.shape == grid.shape
    tree = stages.Tree(grid)
    assert tree.root == grid.maximum()[0] and tree.report().n_cousin_violations == 0
    assert tree.generations.max() > 10 and tree.parents.dtype == np.uint32
    field = stages.Function(tree, "laplace")
    assert field.info.function == "laplace"
    report = field.report()
    assert (report.n_maxima, report.n_minima, report.n_saddles) == (1, 0, 0)
    assert np.nanmax(field.values) == 1
    edges, kinds = stages.Function(tree).edges()
    assert len(edges) == len(kinds) and set(kinds.tolist()) <= {1, 2}
    facets, again = stages.Function(tree).facets()
    assert (facets == edges).all() and (again == kinds).all()
    rank, report = tree.grow()
    assert report.n_remaining == 0 and tree.rank_report(rank).n_maxima == 1
    assert np.allclose(grid.position(grid.nearest([2, 3])), [2, 3], atol=grid.info.spacing)


def test_own_stages(before):
    grid = stages.Grid(before, 40)
    tree = stages.Tree(grid)
    again = stages.Tree.from_parents(grid, tree.root, tree.parents)
    assert (again.generations == tree.generations).all()
    laplace = stages.Function(tree, "laplace")
    values = np.where(grid.inside, laplace.values, np.nan)
    own = stages.Function.from_values(again, values)
    assert own.info.function == "values" and own.report().n_maxima == 1
    logs = stages.Function.from_logs(tree, laplace.logs)
    assert np.allclose(logs.values, laplace.values, rtol=1e-12, equal_nan=True)
    points = [[2, 3], [-99, 0]]
    up, down = stages.Curves(own, points), stages.Curves(own, points, "down")
    assert up.info.way == "up" and len(up) == 2 and len(up[1]) == 0
    assert np.allclose(up[0][0], points[0]) and np.allclose(up[0][-1], grid.position(tree.root))
    ends = down.ends()
    assert ends.end.tolist() == ["boundary", "none"] and np.isclose(ends.bary[0].sum(), 1)
    assert 0 < ends.alone[0] <= ends.length[0]
    chart = libicc.Chart(before, method="gradient", function="laplace", cells=40)
    exact = stages.Curves(stages.Function.of(chart), points[:1], "down").ends()
    assert exact.facet[0] == chart.encode(points[:1])[0][0]


def test_views_keep_their_owner(before):
    values = stages.Function(stages.Tree(stages.Grid(before, 30))).values
    assert np.isfinite(values).any()


def test_masks():
    inside = np.zeros((5, 6, 7), bool)
    inside[1:4, 1:5, 1:6] = True
    grid = stages.Grid.from_mask(inside)
    assert np.array_equal(grid.inside, inside)
    assert stages.Tree(grid).grid.shape == (5, 6, 7)


def test_chart_hands_out_its_field(before):
    field = stages.Function.of(libicc.Chart(before, "gradient", function="laplace", cells=30))
    assert field.info.function == "laplace"
    assert stages.Function.of(libicc.Chart(before, "foliation")) is None


def test_charts_of_stages(before):
    points = np.array([[2, 3], [3, 7], [8, 3]])
    tree = stages.Tree(stages.Grid(before, 40), axis_order=[1, 0])
    function = stages.Function(tree, "laplace")
    chart = libicc.Chart.from_function(function)
    same = libicc.Chart(before, "gradient", function="laplace", cells=40, axis_order=[1, 0])
    assert np.array_equal(stages.Function.of(same).tree.parents, tree.parents)
    assert all(np.array_equal(x, y) for x, y in zip(chart.encode(points), same.encode(points)))
    assert libicc.Chart.from_bytes(chart.to_bytes()).to_bytes() == chart.to_bytes()
    mapped = libicc.Map(before, before, "curves", method="gradient", cells=40, axis_order=[1, 0])
    assert np.array_equal(stages.Function.of(mapped.source_chart).tree.parents, tree.parents)

    own = stages.Function.from_values(tree, np.where(tree.grid.inside, function.values ** 2, np.nan))
    del function
    other = libicc.Chart.from_function(own)
    assert other.info.function == "values" and stages.Function.of(other).info.function == "values"
    facet, bary, t = other.encode(points)
    assert np.allclose(other.decode(facet, bary, t), points)
    with pytest.raises(ValueError):
        libicc.Chart(before, "gradient", axis_order=[0, 0])
    with pytest.raises(libicc.UnsupportedError, match="refined"):
        libicc.Chart.from_function(stages.Function(stages.Tree(tree.grid.refine())))


def test_a_function_is_traced_like_its_chart(before):
    chart = libicc.Chart(before, "gradient", cells=20, function="laplace")
    function = stages.Function.of(chart)
    for point in before.mean(axis=0), 0.9 * before.mean(axis=0) + 0.1 * before[0]:
        assert np.allclose(function.trace(point), chart.trace(point), atol=1e-12)
    assert function.trace([99, 99]).shape == (0, 2)


def test_triangulate(before):
    points = np.vstack([before, [[2, 2], [3, 7], [8, 3]]])
    triangles = stages.triangulate(points, 6)
    a, b, c = points[triangles].transpose(1, 0, 2)
    areas = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    assert (areas > 0).all() and np.isclose(areas.sum() / 2, 75)


def test_facets_in_space():
    grid = stages.Grid.from_mask(np.pad(np.ones((3, 4, 5), bool), 2))
    function = stages.Function(stages.Tree(grid), "laplace")
    facets, kinds = function.facets()
    report = function.facet_report()
    assert facets.shape == (len(kinds), 3) and report.n_tested > len(kinds) > 0
    assert ((kinds == 1).sum(), (kinds == 2).sum()) == (report.n_compression, report.n_expansion)


def test_solve():
    inside = np.pad(np.ones((4, 5), bool), 2)
    tree = stages.Tree(stages.Grid.from_mask(inside))
    fixed = np.where(inside, np.nan, 2.5)
    fixed[3, 3] = -1
    f = stages.Function.solve(tree, fixed=fixed, right_side=np.ones(inside.shape))
    rows = 4 * f.values - sum(np.roll(f.values, step, axis) for step in (1, -1) for axis in (0, 1))
    free = inside & np.isnan(fixed)
    assert np.allclose(rows[free], 1) and f.values[3, 3] == -1 and f.info.n_unknowns == free.sum()
    with pytest.raises(libicc.UnsupportedError):
        stages.Function.solve(tree, "harmonic")
