import pickle

import libicc
import numpy as np
import pytest

CORNERS = np.array([[0, 0], [4, 0], [4, 3], [0, 3]], float)
FIGURE = np.array([[40, 0], [55, 0], [55, 70], [65, 70], [65, 0], [80, 0], [85, 110], [125, 110], [125, 125], [82, 128],
                   [80, 150], [60, 175], [40, 150], [38, 128], [-5, 125], [-5, 110], [35, 110]], float)
PINS = np.array([[48, 5], [72, 5], [60, 100], [60, 150], [118, 117], [2, 117]], float)
UP = PINS + [[0, 0], [0, 0], [0, 0], [0, 0], [-16, 28], [16, 28]]


def curved(p):
    x, y = np.asarray(p, float).T
    return np.column_stack([1000 + 30 * x + 4 * y + np.sin(2 * x), 500 - 3 * x + 28 * y + np.cos(x - y)])


@pytest.fixture
def known():
    return np.random.default_rng(3).uniform(0, 4, (20, 2))


def grid(columns, rows):
    """Vertices and triangles of a grid of unit squares, row after row."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0))
    corner = np.arange(columns * (rows + 1) + rows + 1).reshape(rows + 1, columns + 1)
    a, b, c, d = (corner[i:i + rows, j:j + columns].ravel() for i, j in ((0, 0), (0, 1), (1, 1), (1, 0)))
    return np.column_stack([x.ravel(), y.ravel()]), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def test_control_points(known):
    mapping = libicc.fit(known, curved(known))
    assert isinstance(mapping, libicc.Map) and mapping.certified and mapping.dim == 2
    assert np.allclose(mapping(known), curved(known)) and np.allclose(mapping.inverse(curved(known)), known)
    assert mapping.residuals.shape == mapping.left_out.shape == (20, 2)
    assert np.allclose(mapping.residuals, 0, atol=1e-9) and np.isfinite(mapping.left_out).all()
    info = mapping.info
    assert info.model == "spline" and info.repair == "none" and info.n_items == 20 and info.kind == "mesh"
    assert np.isclose(info.left_out, np.sqrt((mapping.left_out ** 2).sum(1).mean()))
    assert info.margin > 0 and info.smoothing == 0 and info.affine_residual > info.residual
    between = np.random.default_rng(4).uniform(1, 3, (50, 2))
    assert np.abs(mapping(between) - curved(between)).max() < 2
    assert "spline" in repr(mapping) and mapping.jacobian(between).shape == (50, 2, 2)


def test_few_points():
    assert np.allclose(libicc.fit([[1, 1]], [[2, 3]], box=[[0, 0], [4, 4]])([[2, 2]]), [[3, 4]])
    assert np.allclose(libicc.fit(CORNERS[:2], [[0, 0], [0, 8]], box=[0, -1, 4, 3])([[2, 2]]), [[-4, 4]])
    affine = np.array([[2, 1], [0, 3]])
    mapping = libicc.fit(CORNERS[:3], CORNERS[:3] @ affine + 5)
    assert np.allclose(mapping([[3, 1]]), np.array([[3, 1]]) @ affine + 5)


def test_a_box_and_a_margin(known):
    near, far = (libicc.fit(known, curved(known), box=([-1, -1], [5, 5]), margin=margin) for margin in (0.05, 1))
    assert np.isfinite(near([[-1, -1], [5, 5]])).all() and np.isnan(near([[-5, 2]])).all()
    assert np.isfinite(far([[-5, 2]])).all() and far.info.margin == 1


def test_points_that_were_measured(known):
    noisy = curved(known) + np.random.default_rng(5).normal(0, 0.5, known.shape)
    exact, loose = libicc.fit(known, noisy, tolerance=0.5, smoothing=0), libicc.fit(known, noisy, tolerance=0.5)
    assert exact.info.smoothing == 0 and np.abs(exact.residuals).max() < 1e-9
    assert loose.info.smoothing > 0 and loose.info.residual > 0.01
    more = libicc.fit(known, noisy, tolerance=np.full(20, 0.5), smoothing=2 * loose.info.smoothing)
    assert more.info.residual > loose.info.residual


def test_lines_among_points(known):
    river = np.array([[5, 48], [30, 58], [61, 41], [97, 52.0]])
    brook = np.array([[61, 41], [58, 3.0]])
    points = np.array([[10, 90], [90, 85], [15, 10], [88, 12.0]])
    mapping = libicc.fit(points, curved(points), lines=[(river, curved(river)), (brook, curved(brook))])
    assert mapping.certified
    for line in (river, brook):
        middle = (line[1:] + line[:-1]) / 2
        ends = curved(line)
        assert np.allclose(mapping(middle), (ends[1:] + ends[:-1]) / 2, rtol=0, atol=1e-11)
        assert np.array_equal(mapping(line), ends)
    assert np.isnan(mapping.left_out[4:]).all() and np.isfinite(mapping.left_out[:4]).all()
    with pytest.raises(libicc.CertificateError, match="meets the line from point 0 to point 1"):
        libicc.fit(lines=[([[0, 0], [1, 1]], [[0, 0], [1, 1]]), ([[0, 1], [1, 0]], [[0, 1], [1, 0]])])


def test_a_figure_with_pins():
    mapping = libicc.fit(PINS, UP, FIGURE)
    assert mapping.certified and mapping.info.model == "elastic" and mapping.info.n_off == 0
    assert np.allclose(mapping(PINS), UP) and np.isnan(mapping.left_out).all()
    moved = mapping.move(UP + [[0, 0], [0, 0], [0, 0], [0, 0], [4, 2], [0, 0]])
    assert isinstance(moved, libicc.Fit) and np.allclose(moved(PINS[4]), UP[4] + [4, 2])
    assert np.array_equal(mapping.targets, UP) and np.allclose(mapping(PINS), UP)
    one = mapping.move(UP[:1] + [1, 0])
    assert np.allclose(one(PINS[:1]), UP[:1] + [1, 0]) and np.array_equal(one.targets[1:], UP[1:])


def test_a_wall_that_moves():
    vertices, triangles = grid(8, 4)
    top, bottom = (np.flatnonzero(vertices[:, 1] == y) for y in (4, 0))
    sides = np.flatnonzero(np.isin(vertices[:, 0], (0, 8)) & (vertices[:, 1] > 0) & (vertices[:, 1] < 4))
    numbers = np.concatenate([bottom, top])
    places = vertices[numbers] + [[0, 1.5 * (v in top)] for v in numbers]
    mapping = libicc.fit(mesh=(vertices, triangles), vertices=(numbers, places), sliding=sides, stiffness=1.5)
    before, after, same = mapping.mesh()
    assert np.array_equal(before, vertices) and np.array_equal(np.sort(same), np.sort(triangles))
    assert np.allclose(after[numbers], places) and np.allclose(after[sides, 0], vertices[sides, 0])
    assert mapping.certified and mapping.info.n_items == len(numbers) + len(sides) == len(mapping.targets)
    same = libicc.fit(mesh=(vertices, triangles), vertices=(numbers, places), sliding=tuple(int(v) for v in sides[:2]))
    assert same.info.n_items == len(numbers) + 2  # a tuple of two vertices is no pair
    along = libicc.fit(mesh=(vertices, triangles), vertices=(numbers, places), sliding=(sides, [0, 1]),
                       cell_stiffness=np.ones(len(triangles)))
    assert np.allclose(along(vertices[sides])[:, 0], vertices[sides, 0])


def test_quadrilaterals():
    vertices, _ = grid(4, 3)
    corner = np.add.outer(5 * np.arange(3), np.arange(4)).ravel()
    cells = np.stack([corner, corner + 1, corner + 6, corner + 5], 1)
    numbers = np.r_[np.arange(5), 15 + np.arange(5)]
    places = vertices[numbers] + np.c_[np.repeat([0, 1.5], 5), np.zeros(10)]
    mapping = libicc.fit(mesh=(vertices, cells), vertices=(numbers, places), stiffness=1.0)
    before, after, triangles = mapping.mesh()
    assert np.array_equal(before, vertices) and len(triangles) == 24
    assert np.array_equal(after[numbers], places)
    edges = np.roll(after[cells], -1, 1) - after[cells]
    following = np.roll(edges, -1, 1)
    assert (edges[..., 0] * following[..., 1] - edges[..., 1] * following[..., 0] > 0).all()


def test_a_line_in_a_domain():
    square = np.array([[0, 0], [8, 0], [8, 8], [0, 8]], float)
    before, after = [[2, 4], [6, 4]], [[2.5, 3.5], [5.5, 4.5]]
    mapping = libicc.fit(domain=square, lines=[(before, after)], vertices=(range(4), square))
    assert np.allclose(mapping([*before, [4, 4]]), [*after, [4, 4]])


def test_reach():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    spike, broad = (libicc.fit([[0.5, 0.5]], [[0.65, 0.5]], square, vertices=(range(4), square), reach=reach)
                    for reach in (None, 0.1))
    beside = [[0.5, 0.52]]
    assert np.allclose(broad([[0.5, 0.5]]), [[0.65, 0.5]])
    assert np.linalg.cond(broad.jacobian(beside)[0]) < np.linalg.cond(spike.jacobian(beside)[0])


def test_bytes_keep_the_map(known):
    mapping = libicc.fit(known, curved(known))
    for again in (pickle.loads(pickle.dumps(mapping)), libicc.Fit.from_bytes(mapping.to_bytes())):
        assert type(again) is libicc.Map and np.array_equal(again(known), mapping(known))
    assert type(mapping.improve(iterations=1)[0]) is libicc.Map


def test_what_is_refused():
    for wrong in (dict(), dict(points=CORNERS), dict(points=CORNERS, to=CORNERS, tolerance=[1, 2]),
                  dict(vertices=[0]), dict(points=CORNERS, to=CORNERS[:3]),
                  dict(vertices=([0], [[0, 0]]), tolerance=1), dict(points=CORNERS, to=CORNERS, sliding=[0]),
                  dict(points=CORNERS, to=CORNERS, cell_stiffness=[1]), dict(points=CORNERS, to=CORNERS, model="stiff"),
                  dict(points=CORNERS, to=CORNERS, box=[0, 1]),
                  dict(points=CORNERS, to=CORNERS, domain=FIGURE, mesh=grid(1, 1)), dict(domain=FIGURE, sliding=[99])):
        with pytest.raises(ValueError):
            libicc.fit(**wrong)
    with pytest.raises(libicc.ArgumentError) as error:
        libicc.fit([*CORNERS, CORNERS[1]], [*CORNERS, [4, 1]])
    assert error.value.item == "point" and error.value.index in (1, 4)
    with pytest.raises(libicc.ArgumentError):
        libicc.fit(CORNERS, CORNERS * [1, -1])
    with pytest.raises(libicc.OutsideError):
        libicc.fit([[500, 500]], [[0, 0]], FIGURE)
    with pytest.raises(libicc.Cancelled):
        libicc.fit(PINS, UP, FIGURE, progress=lambda *_: True)
    with pytest.raises(TypeError, match="libicc.fit"):
        libicc.Fit(CORNERS, CORNERS)


def test_nearest():
    vertices, triangles = grid(6, 6)
    same = libicc.nearest(vertices, triangles, vertices * 2)
    assert np.array_equal(same.mesh()[1], vertices * 2) and same.report.repair == "none" and same.report.moved == 0
    folded = vertices.copy()
    folded[24] += [1.4, 0.3]
    mapping = libicc.nearest(vertices, triangles, folded)
    assert mapping.certified and mapping.report.repair == "patches" and mapping.report.n_folded > 0
    assert 0 < mapping.report.changed < 1 and mapping.report.n_patches == 1
    held = libicc.nearest(vertices, triangles, folded, held=[24])
    assert np.allclose(held(vertices[24]), folded[24])
    with pytest.raises(libicc.ArgumentError):
        libicc.nearest(vertices, triangles, vertices * [1, -1])
    with pytest.raises(ValueError, match="images"):
        libicc.nearest(vertices, triangles, vertices[:5])
