"""Warps pictures, and turns maps into transforms for scikit-image."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Optional, Tuple

import numpy as np

from ._abi import lib, new
from ._core import Call, Progress
from ._map import Map
from ._transform import Transform

if TYPE_CHECKING:
    from ._types import Array, ArrayLike, Floats


_INTERPOLATIONS = {"nearest": 1, "linear": 2, "cubic": 3}


def _picture(image: Array, alpha: bool, **more: Any) -> Any:
    height, width, channels = image.shape
    size = image.dtype.itemsize
    return new("picture", width=width, height=height, channels=channels, bytes=size,
               alpha=int(alpha), stride=width * channels * size,
               pixels=image.ctypes.data, **more)


def warp_image(image: ArrayLike, mapping: Map, out: Optional[ArrayLike] = None, *,
               alpha: Optional[bool] = None, interpolation: str = "linear", nodata: Optional[float] = None,
               progress: Optional[Progress] = None, threads: Optional[int] = None) -> Array:
    """Warps a picture by a 2-D map.

    >>> image = numpy.array([[10, 20], [30, 40]], dtype=numpy.uint8)
    >>> frame = libicc.picture_cage(image.shape)
    >>> libicc.warp_image(image, libicc.Map(frame, frame[[1, 2, 3, 0]]))
    array([[30, 10],
           [40, 20]], dtype=uint8)

    Args:
        image: (height, width) or (height, width, channels), uint8, uint16, float32 or float64, up to 64
            channels. Pixel [j, i] covers [i, i + 1] x [j, j + 1] in the coordinates of the map's domains.
        mapping: from places in the picture to places in the result
        out: a picture to draw onto, of any size, with as many channels. Its pixels outside the target stay. None: a
            copy of `image`.
        alpha: whether the last channel is opacity. None: yes if there are 2 or 4 channels of whole numbers,
            interpolation is linear and no samples are missing
        interpolation: "nearest", "linear" or "cubic"
        nodata: the value of missing samples, which may be NaN; None: none are missing
        progress, threads: see `libicc.Progress`

    Returns:
        the warped picture, a new array of the shape of `out`
    """
    image = np.asarray(image)
    if image.dtype not in (np.uint8, np.uint16, np.float32, np.float64):
        raise ValueError(f"pictures are uint8, uint16, float32 or float64, not {image.dtype}")
    if interpolation not in _INTERPOLATIONS:
        raise ValueError(f"interpolation must be one of {', '.join(_INTERPOLATIONS)}")
    if image.ndim not in (2, 3):
        raise ValueError(f"pictures have the shape (height, width[, channels]), not {image.shape}")
    result = np.array(image if out is None else out, dtype=image.dtype, order="C")
    flat = result if result.ndim == 3 else result[:, :, None]
    source = np.ascontiguousarray(image if image.ndim == 3 else image[:, :, None])
    if flat.shape[2] != source.shape[2]:
        raise ValueError("both pictures must have the same channels")
    if alpha is None:
        alpha = (source.shape[2] in (2, 4) and image.dtype.kind == "u" and interpolation == "linear"
                 and nodata is None)
    before = _picture(source, alpha, interpolation=_INTERPOLATIONS[interpolation],
                      has_nodata=int(nodata is not None), nodata=nodata or 0.0)
    after = _picture(flat, alpha)
    call = Call(progress, threads)
    call.check(lib.map_warp(mapping, ctypes.addressof(before), ctypes.addressof(after), None,
                            call.env, call.err))
    return result


class _Pixels(Transform):
    """A transform of scikit-image as the map of a `PixelTransform`: from places in the picture to places in the result,
    where pixel [j, i] covers [i, i + 1] x [j, j + 1]."""

    dim, certified = 2, False

    def __init__(self, transform: Any):
        self._transform = transform

    def apply(self, points: ArrayLike, **_: Any) -> Floats:
        return self._moved(self._transform.inverse, points)

    def apply_inverse(self, points: ArrayLike, **_: Any) -> Floats:
        return self._moved(self._transform, points)

    def _moved(self, transform: Any, points: ArrayLike) -> Floats:
        places = np.asarray(points, dtype=np.float64) - 0.5
        return np.asarray(transform(places.reshape(-1, 2))).reshape(places.shape) + 0.5


class PixelTransform:
    """A 2-D map for ``skimage.transform.warp``. It goes from places in the result to places in the picture. Both are
    (column, row), with whole numbers at the centres of pixels.

    >>> frame = libicc.picture_cage((20, 30))
    >>> libicc.PixelTransform(libicc.Map(frame, frame * 2))([[9.5, 19.5]]).round(6)
    array([[4.5, 9.5]])

    Use it as ``skimage.transform.warp(image, PixelTransform(mapping))``. Pixels outside the target cage stay where they
    are. With ``outside="blank"`` they are left blank.
    """

    def __init__(self, mapping: Transform, outside: str = "keep"):
        if outside not in ("keep", "blank"):
            raise ValueError("outside must be 'keep' or 'blank'")
        self.map, self.outside = mapping, outside

    @classmethod
    def from_estimate(cls, src: ArrayLike, dst: ArrayLike, outside: str = "keep", **options: Any) -> "PixelTransform":
        """The transform that takes pixels `src` (n, 2) of the result to pixels `dst` of the picture. `libicc.fit` makes
        it, and takes the other options."""
        from ._fit import fit

        return cls(fit(np.add(dst, 0.5), np.add(src, 0.5), **options), outside)

    def __call__(self, coords: ArrayLike) -> Floats:
        """Result -> picture, (n, 2)."""
        coords = np.asarray(coords, dtype=np.float64)
        images: Floats = self.map.apply_inverse(coords + 0.5) - 0.5
        lost = np.isnan(images[..., 0])
        images[lost] = coords[lost] if self.outside == "keep" else -1e6
        return images

    @property
    def inverse(self) -> "PixelTransform":
        """Picture -> result."""
        return PixelTransform(self.map.inverse, self.outside)

    def __add__(self, then: Any) -> "PixelTransform":
        """This transform, then another one, which may be one of scikit-image's. A pixel that either has no image for is
        outside."""
        if not isinstance(then, PixelTransform) and not (callable(then) and hasattr(then, "inverse")):
            return NotImplemented
        return PixelTransform(self.map @ (then.map if isinstance(then, PixelTransform) else _Pixels(then)), self.outside)

    def residuals(self, src: ArrayLike, dst: ArrayLike) -> Floats:
        """Distances (n,) of the images of `src` from `dst`."""
        off: Floats = self(src) - np.asarray(dst, dtype=np.float64)
        return np.sqrt((off**2).sum(axis=-1))


def picture_cage(shape: Tuple[int, ...]) -> Floats:
    """The outline of a picture of the given shape as a cage, (4, 2).

    >>> libicc.picture_cage((20, 30)).tolist()
    [[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]]
    """
    height, width = shape[:2]
    return np.array([[0, 0], [width, 0], [width, height], [0, height]], dtype=np.float64)
