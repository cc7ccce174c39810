"""Kernel coordinates: smooth blending weights for handles, without a mesh."""

from __future__ import annotations

import ctypes
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, List, Literal, Optional, Sequence, Tuple, Union, overload

import numpy as np

from ._abi import lib, new
from ._core import (
    Call,
    Handle,
    Progress,
    Saved,
    address,
    bulk,
    choose,
    create,
    fields,
    floats,
    indices,
    name_of,
    points_of,
)
from ._domain import as_domain
from ._errors import check

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats, ShapeLike

__all__ = ["Binding", "Weights", "Pose", "Sampling", "Shape"]

SAMPLINGS = {"grid": 1, "blue": 2, "points": 3}
KERNELS = {"wendland": 1, "gauss": 2}
INITIALS = {"heat": 1, "edges": 2, "inverse": 3, "given": 4}
METHODS = {"qp": 1, "equality": 2, "l1": 3, "biharmonic": 4}


class _Line(ctypes.Structure):
    _fields_ = [("first", ctypes.c_double * 3), ("last", ctypes.c_double * 3),
                ("parallel", ctypes.c_int32)]


class Shape(Handle):
    """A shape to be deformed: filled regions and curves, in 2-D or 3-D.

    Args:
        regions: Domains, or anything that `libicc.as_domain` takes; one may lie within another
        vertices: (n, dim) vertices of the curves
        segments: (m, 2) vertex indices
    """

    _free = "shape_free"
    _dim: int

    def __init__(self, regions: Sequence[ShapeLike] = (), vertices: Optional[ArrayLike] = None,
                 segments: Optional[ArrayLike] = None):
        domains = [as_domain(region) for region in regions]
        if vertices is not None:
            vertices = np.ascontiguousarray(vertices, dtype=np.float64)
        dim = domains[0].dim if domains else 2 if vertices is None else vertices.shape[1]
        vertices = None if vertices is None else points_of(vertices, dim)
        segments = None if segments is None else indices(segments, 2, "segments")
        self._dim = dim
        handles = (ctypes.c_void_p * max(len(domains), 1))(*[d._handle for d in domains])
        self._take(create(lib.shape_create, dim, len(domains), ctypes.addressof(handles),
                          0 if vertices is None else len(vertices), address(vertices),
                          0 if segments is None else len(segments), address(segments)))


class Sampling(Saved):
    """Points spread over a shape.

    Args:
        shape: a Shape, or one region
        kind: "blue" (default) or "grid"
        spacing: distance of neighbours; None: 1/100 of the longest side, in 3-D 1/20
        steps: steps of relaxation (blue); None: 60
        margin: how far a grid extends beyond the regions, in spacings
        seed: seed of the random numbers
        fixed: points (n, dim) that must be samples (blue)
        progress, threads: as for `libicc.Domain`
    """

    _free = "sampling_free"
    _name = "sampling"

    def __init__(self, shape: Union[Shape, ShapeLike], kind: Optional[str] = None, *,
                 spacing: Optional[float] = None, steps: Optional[int] = None, margin: float = 0,
                 seed: int = 0, fixed: Optional[ArrayLike] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        shape = shape if isinstance(shape, Shape) else Shape([shape])
        options = new("sampling_options", kind=choose(kind, SAMPLINGS, "kind"), spacing=spacing or 0,
                      steps=0 if steps is None else steps or -1, margin=margin, seed=seed)
        if fixed is not None:
            fixed = points_of(fixed, shape._dim)
            options.n_fixed, options.fixed = len(fixed), fixed.ctypes.data
        self._take(create(lib.sampling_create, shape, ctypes.addressof(options),
                          progress=progress, threads=threads))

    @classmethod
    def from_points(cls, shape: Union[Shape, ShapeLike], points: ArrayLike) -> "Sampling":
        """A sampling from your own points (n, dim)."""
        shape = shape if isinstance(shape, Shape) else Shape([shape])
        points = points_of(points, shape._dim)
        return cls._wrap(create(lib.sampling_create_from_points, shape, len(points),
                                address(points)))

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_sampling_info``. The kind is given by name."""
        result = fields(self._info("sampling_get_info", "sampling_info"))
        result.kind = name_of(result.kind, SAMPLINGS)
        return result

    @property
    def points(self) -> Floats:
        """The samples, (n, dim)."""
        info = self._info("sampling_get_info", "sampling_info")
        points = np.empty((info.n_samples, info.dim))
        check(lib.sampling_get_points(self, address(points)))
        return points


def _lines(lines: Sequence[Any], dim: int) -> Any:
    """Each line is (from, to) or (from, to, number of an earlier line to stay parallel to)."""
    array = (_Line * len(lines))()
    for item, line in zip(array, lines):
        first, last, *parallel = line
        item.first[:dim], item.last[:dim] = list(map(float, first)), list(map(float, last))
        item.parallel = parallel[0] + 1 if parallel and parallel[0] is not None else 0
    return array


class Weights(Handle):
    """Weights of handles everywhere in a shape.

    Args:
        sampling: a Sampling
        handles: (n, dim), at least dim + 1, in the shape
        edges: (m, 2) handle indices: along them weights are linear
        lines: segments to keep straight: (from, to) or (from, to, k), parallel to the earlier line k
        kernel: "wendland" (default) or "gauss"
        sigma: width of the kernel; None: as the sampling suggests
        cutoff: radius of a Gauss kernel in units of sigma; None: 5
        initial: "heat", "edges", "inverse" or "given"; None: "edges" if there are any, else "heat"
        steps: steps of diffusion; None: 5
        method: "qp" (default), "equality", "l1" or "biharmonic" (in the plane; slow, points are not reproduced)
        affine_tail: whether an affine function makes sums and reproduction exact between the samples
        within_shape: whether diffusion stays inside the shape
        initial_weights: (n_samples, n_handles), for initial "given"
        progress, threads: as for `libicc.Domain`

    Raises:
        OutsideError: a handle or line is outside; ArgumentError: the handles cannot reproduce points; SolverError:
            sigma is too large
    """

    _free = "weights_free"

    def __init__(self, sampling: Sampling, handles: ArrayLike, *, edges: Optional[ArrayLike] = None,
                 lines: Sequence[Any] = (), kernel: Optional[str] = None, sigma: Optional[float] = None,
                 cutoff: Optional[float] = None, initial: Optional[str] = None,
                 steps: Optional[int] = None, method: Optional[str] = None, affine_tail: bool = True,
                 within_shape: bool = True, initial_weights: Optional[ArrayLike] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        if not isinstance(sampling, Sampling):
            raise TypeError(f"sampling must be a libicc.kernel.Sampling, not {type(sampling).__name__}")
        handles = points_of(handles, sampling._info("sampling_get_info", "sampling_info").dim)
        keep: List[Any] = [handles]
        options = new("weights_options", kernel=choose(kernel, KERNELS, "kernel"),
                      initial=choose(initial, INITIALS, "initial"),
                      method=choose(method, METHODS, "method"), steps=steps or 0,
                      affine_tail=1 if affine_tail else -1, within_shape=1 if within_shape else -1, sigma=sigma or 0,
                      cutoff=cutoff or 0)
        if edges is not None:
            keep.append(indices(edges, 2, "edges"))
            options.n_edges, options.edges = len(keep[-1]), keep[-1].ctypes.data
        if len(lines) > 0:
            keep.append(_lines(lines, handles.shape[1]))
            options.n_lines, options.lines = len(lines), ctypes.addressof(keep[-1])
        if initial_weights is not None:
            n = sampling._info("sampling_get_info", "sampling_info").n_samples
            keep.append(floats(initial_weights, (n, len(handles)), "initial_weights"))
            options.initial_weights = keep[-1].ctypes.data
        self._take(create(lib.weights_create, sampling, len(handles), address(handles),
                          ctypes.addressof(options), progress=progress, threads=threads))

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_weights_info``. Kernel, initial and method are given by name."""
        result = fields(self._info("weights_get_info", "weights_info"))
        result.kernel = name_of(result.kernel, KERNELS)
        result.initial = name_of(result.initial, INITIALS)
        result.method = name_of(result.method, METHODS)
        return result

    @property
    def timings(self) -> SimpleNamespace:
        """Seconds for each step of making the weights: the members of ``icc_weights_timings``."""
        return fields(self._info("weights_get_timings", "weights_timings"))

    def nodes(self) -> SimpleNamespace:
        """The nodes: points (n, dim), initial weights and weights (n, n_handles), and status (n,)."""
        info = self._info("weights_get_info", "weights_info")
        n, m = info.n_nodes, info.n_handles
        points, initial, weights = np.empty((n, info.dim)), np.empty((n, m)), np.empty((n, m))
        status = np.empty(n, dtype=np.int32)
        check(lib.weights_get_nodes(self, address(points), address(initial), address(weights),
                                   address(status)))
        return SimpleNamespace(points=points, initial=initial, weights=weights, status=status)

    def paint(self, handle: int, centre: ArrayLike, radius: float, amount: float, *,
              progress: Optional[Progress] = None, threads: Optional[int] = None) -> "Weights":
        """New weights: raises the weight of one handle around a place (dim,) and optimises again. The change is
        `amount` at the centre and falls smoothly to 0 at the radius."""
        centre = points_of(centre, self._info("weights_get_info", "weights_info").dim)
        return Weights._wrap(create(lib.weights_paint, self, handle, address(centre), radius,
                                   amount, progress=progress, threads=threads))

    def repaint(self, nodes: ArrayLike, weights: ArrayLike, *, progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> "Weights":
        """New weights, which start at some nodes (n,) from your own values (n, n_handles)."""
        nodes = np.ascontiguousarray(nodes, dtype=np.uint32)
        m = self._info("weights_get_info", "weights_info").n_handles
        weights = floats(weights, (len(nodes), m), "weights")
        return Weights._wrap(create(lib.weights_repaint, self, len(nodes), address(nodes),
                                   address(weights), progress=progress, threads=threads))

    def with_method(self, method: str, *, progress: Optional[Progress] = None,
                    threads: Optional[int] = None) -> "Weights":
        """New weights with the same nodes and initial weights but another method. Painting is lost."""
        return Weights._wrap(create(lib.weights_with_method, self,
                                   choose(method, METHODS, "method"), progress=progress,
                                   threads=threads))

    def stiffen(self, nodes: ArrayLike, rigidity: Optional[ArrayLike] = None, *,
                progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Tuple["Weights", Floats]:
        """New weights that are as rigid as possible at some nodes (n,). Each node may have its own positive rigidity
        (n,). Also returns half the weighted sum of squared derivatives there, before and after, (2,). The weights are
        the optimum of one quadratic program for these nodes and those around them: ``info.residual``."""
        nodes, energy = np.ascontiguousarray(nodes, dtype=np.uint32), np.empty(2)
        if rigidity is not None:
            rigidity = floats(rigidity, (len(nodes),), "rigidity")
        weights = create(lib.weights_stiffen, self, len(nodes), address(nodes),
                         address(rigidity), address(energy), progress=progress, threads=threads)
        return Weights._wrap(weights), energy

    @overload
    def weights(self, points: ArrayLike, *, gradients: Literal[False] = ...,
                progress: Optional[Progress] = ..., threads: Optional[int] = ...) -> Floats: ...
    @overload
    def weights(self, points: ArrayLike, *, gradients: Literal[True], progress: Optional[Progress] = ...,
                threads: Optional[int] = ...) -> Tuple[Floats, Floats]: ...

    def weights(self, points: ArrayLike, *, gradients: bool = False, progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Any:
        """Weights (n, n_handles) at points (n, dim), and with ``gradients`` their derivatives
        (n, n_handles, dim)."""
        info = self._info("weights_get_info", "weights_info")
        points = points_of(points, info.dim)
        n = len(points)
        weights = np.empty((n, info.n_handles))
        slopes = np.empty((n, info.n_handles, info.dim)) if gradients else None
        env, done = bulk(n, progress, threads)
        done(lib.weights_evaluate(self, n, address(points), address(weights), address(slopes),
                                None, None, env))
        return (weights, slopes) if gradients else weights

    def dual(self, node: int, points: ArrayLike, *, progress: Optional[Progress] = None,
             threads: Optional[int] = None) -> Floats:
        """The dual function of a node: 1 there, 0 at all other nodes, interpolated as weights are. Returns (n,) values
        at points (n, dim)."""
        points = points_of(points, self._info("weights_get_info", "weights_info").dim)
        call, values = Call(progress, threads), np.empty(len(points))
        call.check(lib.weights_get_dual(self, int(node), len(points), address(points), address(values),
                                       call.env, call.err))
        return values

    def report(self, points: ArrayLike, *, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> SimpleNamespace:
        """Measures the quality of the weights at points: see ``icc_weights_report``."""
        points = points_of(points, self._info("weights_get_info", "weights_info").dim)
        call, report = Call(progress, threads), new("weights_report")
        call.check(lib.weights_get_report(self, len(points), address(points),
                                         ctypes.addressof(report), call.env, call.err))
        return fields(report)

    def bind(self, points: ArrayLike, *, derivatives: bool = False, progress: Optional[Progress] = None,
             threads: Optional[int] = None) -> "Binding":
        """Binds points (n, dim) to the handles, for repeated poses."""
        points = points_of(points, self._info("weights_get_info", "weights_info").dim)
        return Binding._wrap(create(lib.binding_create, self, len(points), address(points),
                                    int(derivatives), progress=progress, threads=threads))


class Binding(Saved):
    """Points with their weights; made by `Weights.bind`."""

    _free = "binding_free"
    _name = "binding"

    def _counts(self) -> Tuple[int, int, int]:
        n, m, dim = ctypes.c_size_t(), ctypes.c_size_t(), ctypes.c_int32()
        check(lib.binding_get_counts(self, ctypes.addressof(n), ctypes.addressof(m),
                                     ctypes.addressof(dim)))
        return n.value, m.value, dim.value

    @property
    def handles(self) -> Floats:
        """The handles' positions, (n_handles, dim)."""
        _, m, dim = self._counts()
        handles = np.empty((m, dim))
        check(lib.binding_get_weights(self, address(handles), None))
        return handles

    @property
    def weights(self) -> Floats:
        """The weights, (n, n_handles)."""
        n, m, _ = self._counts()
        weights = np.empty((n, m))
        check(lib.binding_get_weights(self, None, address(weights)))
        return weights

    @overload
    def pose(self, transforms: Union["Pose", ArrayLike], *, jacobians: Literal[False] = ...,
             progress: Optional[Progress] = ..., threads: Optional[int] = ...) -> Floats: ...
    @overload
    def pose(self, transforms: Union["Pose", ArrayLike], *, jacobians: Literal[True],
             progress: Optional[Progress] = ..., threads: Optional[int] = ...) -> Tuple[Floats, Floats]: ...

    def pose(self, transforms: Union["Pose", ArrayLike], *, jacobians: bool = False,
             progress: Optional[Progress] = None, threads: Optional[int] = None) -> Any:
        """Images (n, dim) of the points under affine transforms (n_handles, dim, dim + 1), see `Pose`. With
        ``jacobians`` it also returns derivatives (n, dim, dim), if the binding has them."""
        n, m, dim = self._counts()
        if isinstance(transforms, Pose):
            transforms = transforms.transforms
        transforms = floats(transforms, (m, dim, dim + 1), "transforms")
        images = np.empty((n, dim))
        slopes = np.empty((n, dim, dim)) if jacobians else None
        env, done = bulk(n, progress, threads)
        done(lib.binding_pose(self, address(transforms), address(images), address(slopes),
                              env))
        return (images, slopes) if jacobians else images


class Pose:
    """An affine transform for every handle; starts at rest.

    Args:
        handles: positions (n_handles, dim), such as `Binding.handles`
    """

    def __init__(self, handles: ArrayLike):
        self.handles = np.array(handles, dtype=np.float64, order="C")
        if self.handles.ndim != 2 or self.handles.shape[1] not in (2, 3):
            raise ValueError(f"handles must have the shape (n, 2 or 3), not {self.handles.shape}")
        n, dim = self.handles.shape
        self._transforms = np.empty((n, dim, dim + 1))
        self.reset()

    @property
    def transforms(self) -> Floats:
        """The transforms, (n_handles, dim, dim + 1): per handle the rows of (A | b), which take x to A x + b. You may
        write to this array."""
        return self._transforms

    def reset(self) -> None:
        """Back to rest."""
        n, dim = self.handles.shape
        check(lib.pose_reset(dim, n, address(self.transforms)))

    def move(self, handle: int, offset: ArrayLike) -> None:
        """Moves a handle by an offset (dim,)."""
        dim = self.handles.shape[1]
        offset = floats(offset, (dim,), "offset")
        check(lib.pose_move(dim, address(self.transforms[handle]), address(offset)))

    def turn(self, handle: int, angle: float, axis: Optional[ArrayLike] = None) -> None:
        """Turns a handle about its present position, by an angle in radians; in 3-D about an axis (3,)."""
        dim = self.handles.shape[1]
        axis = None if axis is None else floats(axis, (3,), "axis")
        check(lib.pose_turn(dim, address(self.transforms[handle]), address(self.handles[handle]),
                            address(axis), angle))
