import pickle

import libicc
import numpy as np
import pytest
from libicc import kernel

SQUARE = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], float)
HANDLES = np.array([[1, 1], [9, 1], [9, 9], [1, 9], [5, 5]], float)


@pytest.fixture(scope="module")
def weights():
    return kernel.Weights(kernel.Sampling(SQUARE, spacing=0.4, seed=3), HANDLES)


@pytest.fixture
def points():
    return np.random.default_rng(2).uniform(0.5, 9.5, (500, 2))


def test_weights(weights, points):
    w, slopes = weights.weights(points, gradients=True)
    assert np.abs(w.sum(axis=1) - 1).max() < 1e-11
    assert np.abs(w @ HANDLES - points).max() < 1e-10
    step = 1e-6
    for axis in range(2):
        move = np.eye(2)[axis] * step
        difference = (weights.weights(points + move) - weights.weights(points - move)) / (2 * step)
        assert np.abs(difference - slopes[:, :, axis]).max() < 1e-6
    report = weights.report(points)
    assert report.lagrange < 1e-9 and report.unity < 1e-11
    nodes = weights.nodes()
    assert nodes.weights.shape == (weights.info.n_nodes, 5) and nodes.points.shape[1] == 2


def test_a_shape_is_no_sampling():
    with pytest.raises(TypeError, match="must be a libicc.kernel.Sampling, not ndarray"):
        kernel.Weights(SQUARE, HANDLES)


def test_poses(weights, points):
    binding, pose = weights.bind(points, derivatives=True), kernel.Pose(HANDLES)
    assert np.array_equal(binding.pose(pose), points)
    for handle in range(5):
        pose.move(handle, [1, -2])
    images, slopes = binding.pose(pose, jacobians=True)
    assert np.abs(images - points - [1, -2]).max() < 1e-10
    assert np.abs(slopes - np.eye(2)).max() < 1e-8
    pose.reset()
    pose.turn(4, 0.5)
    assert np.abs(pose.transforms[4, :, :2] @ [5, 5] + pose.transforms[4, :, 2] - [5, 5]).max() < 1e-12
    again = kernel.Binding.from_bytes(binding.to_bytes())
    assert np.array_equal(again.pose(pose), binding.pose(pose))
    assert np.array_equal(again.handles, HANDLES)


def test_painting(weights):
    painted = weights.paint(4, [3, 3], 1.5, 0.3)
    before, after = weights.weights([[3.0, 3.0]]), painted.weights([[3.0, 3.0]])
    assert after[0, 4] > before[0, 4]
    node = np.flatnonzero(weights.nodes().status == 0)[-1]
    dual = weights.dual(node, weights.nodes().points)
    assert abs(dual - (np.arange(len(dual)) == node)).max() < 1e-9
    same = weights.repaint([node], weights.nodes().weights[[node]])
    assert np.abs(same.nodes().weights - weights.nodes().weights).max() < 1e-12
    assert weights.with_method("equality").info.method == "equality"
    inside = np.flatnonzero(np.hypot(*(weights.nodes().points - [5, 3]).T) < 1)
    _, energy = weights.stiffen(inside)
    assert energy[1] <= energy[0]


def test_samplings(weights):
    sampling = kernel.Sampling(SQUARE, "grid", spacing=1.0)
    assert sampling.info.kind == "grid" and sampling.points.shape == (sampling.info.n_samples, 2)
    copy = pickle.loads(pickle.dumps(sampling))
    assert np.array_equal(copy.points, sampling.points)
    with pytest.raises(libicc.FormatError):
        kernel.Sampling.from_bytes(b"nonsense")
    own = kernel.Sampling.from_points(SQUARE, sampling.points)
    assert own.info.n_samples == sampling.info.n_samples


def test_curves_lines_and_edges():
    stick = kernel.Shape(vertices=[[0, 0], [5, 0], [9, 3]], segments=[[0, 1], [1, 2]])
    handles = [[0, 0], [5, 0], [9, 3]]
    made = kernel.Weights(kernel.Sampling(stick, spacing=0.5), handles, edges=[[0, 1], [1, 2]])
    assert np.abs(made.weights([[2.5, 0]]) - [0.5, 0.5, 0]).max() < 0.05
    sampling = kernel.Sampling(SQUARE, spacing=0.5)
    lined = kernel.Weights(sampling, HANDLES, lines=[([3, 3], [7, 3]), ([3, 7], [7, 7], 0)])
    assert lined.info.n_nodes > 5


def test_errors():
    sampling = kernel.Sampling(SQUARE, spacing=1.0)
    with pytest.raises(libicc.OutsideError) as caught:
        kernel.Weights(sampling, [[1, 1], [9, 1], [20, 20]])
    assert caught.value.index == 2
    with pytest.raises(libicc.ArgumentError):
        kernel.Weights(sampling, [[1, 1], [2, 2], [3, 3]])
    with pytest.raises(libicc.SolverError):
        kernel.Weights(kernel.Sampling(SQUARE, "grid", spacing=0.5), HANDLES, kernel="gauss", sigma=1.5)


def test_points_of_the_wrong_dimension():
    """Refused before the library reads beyond them."""
    with pytest.raises(ValueError, match="shape"):
        kernel.Sampling(SQUARE, spacing=1.0, fixed=np.ones((4, 3)))
    with pytest.raises(ValueError, match="shape"):
        kernel.Sampling.from_points(SQUARE, np.ones(5))
