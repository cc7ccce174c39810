"""Pictures and rasters. Pillow reads and writes pictures, rasterio those that have a place in the world."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from typing import Any, List

import numpy as np

from .. import _image
from ..raster import Grid, warp_raster
from ._tally import Tally
from .formats import FileError, Format, use

_KEPT = ("L", "LA", "RGB", "RGBA", "CMYK", "I;16")
"""Modes of Pillow whose channels are warped as they are. Other pictures become RGB, with alpha if they have it."""


class Picture:
    """The frames of a picture, in pixels: x to the right, y down."""

    kind = "picture"

    def __init__(self, frames: List[Any], mode: str, about: Any):
        self.frames, self._mode, self._about = frames, mode, about

    def outline(self) -> Any:
        raise FileError("a picture is no cage; draw its outline, for example as SVG, or give the corners as text")

    def carry(self, mapping: Any, how: Any) -> Tally:
        self.frames = [_image.warp_image(frame, mapping, self._under(frame, how),
                                         alpha=self._mode in ("LA", "RGBA") and how.resampling == "linear",
                                         interpolation=how.resampling) for frame in self.frames]
        return Tally()

    def _under(self, frame: Any, how: Any) -> Any:
        """What the warped picture is drawn onto."""
        if how.background is not None:
            colour = tuple(bytes.fromhex(how.background))
            n = frame.shape[2] if frame.ndim == 3 else 1
            wanted = (colour + (255,))[:n] if n >= 3 and self._mode != "CMYK" else None
            if wanted is None:
                raise FileError(f"--background: the picture's mode is {self._mode}; only RGB has a background")
            return np.broadcast_to(np.array(wanted, frame.dtype), frame.shape)
        return np.zeros_like(frame) if how.outside == "null" else frame

    def save(self, path: Path, row: Format) -> None:
        Image = use("PIL.Image", path, row.name)
        images = [Image.fromarray(frame, self._mode) for frame in self.frames]
        if row.driver in ("JPEG", "PPM", "BMP") and self._mode in ("LA", "RGBA"):
            images = [image.convert(self._mode[:-1]) for image in images]
        elif self._mode == "CMYK" and row.driver not in ("JPEG", "GTiff"):
            images = [image.convert("RGB") for image in images]
        options = {key: value for key, value in self._about.items()
                   if key in ("icc_profile", "exif", "dpi", "duration", "loop")}
        if row.driver == "WEBP":
            options["lossless"] = True
        if len(images) > 1 and row.driver in ("GIF", "WEBP", "PNG"):
            options.update(save_all=True, append_images=images[1:])
        images[0].save(path, format={"GTiff": "TIFF"}.get(row.driver, row.driver), **options)


class Raster:
    """The bands of a raster in the world's coordinates."""

    kind = "picture"

    def __init__(self, bands: Any, profile: Any, about: Any):
        self.bands, self._profile, self._about = bands, profile, about
        self._grid = Grid(tuple(profile["transform"])[:6], *bands.shape[1:])

    def outline(self) -> Any:
        raise FileError("a raster is no cage; give the corners as text")

    def carry(self, mapping: Any, how: Any) -> Tally:
        nodata = self._profile.get("nodata") if how.nodata is None else how.nodata
        fill = 0 if nodata is None else nodata
        images = warp_raster(self.bands, self._grid, mapping, resampling=how.resampling, nodata=nodata, fill=fill)
        if how.outside == "keep":
            outside = np.isnan(mapping.inverse(self._grid.centres())[..., 0])
            images[:, outside] = self.bands[:, outside]
        self.bands = images
        return Tally()

    def save(self, path: Path, row: Format) -> None:
        if row.driver != "GTiff":
            if len(self.bands) not in (1, 3, 4) or self.bands.dtype != np.uint8:
                raise FileError(f"{path}: {len(self.bands)} bands of {self.bands.dtype} are no picture; write .tif")
            frame = np.ascontiguousarray(self.bands.transpose(1, 2, 0))
            mode = {1: "L", 3: "RGB", 4: "RGBA"}[len(self.bands)]
            Picture([frame[:, :, 0] if mode == "L" else frame], mode, {}).save(path, row)
            return
        rasterio = use("rasterio", path, row.name)
        with rasterio.open(path, "w", **{**self._profile, "driver": "GTiff"}) as target:
            target.write(self.bands)
            target.update_tags(**self._about["tags"])
            target.colorinterp = self._about["colours"]


def _picture(image: Any) -> Picture:
    from PIL import ImageSequence

    mode = image.mode
    if mode not in _KEPT:
        mode = "RGBA" if mode in ("PA", "RGBa") or "transparency" in image.info else "L" if mode == "1" else "RGB"
    if getattr(image, "n_frames", 1) > 1 and image.format in ("GIF", "WEBP", "PNG"):
        # Frames of a film differ in their palettes.
        mode = "RGBA"
        frames = [np.asarray(frame.convert(mode)) for frame in ImageSequence.Iterator(image)]
    elif mode == "RGB" and image.mode == "I":  # 16 bits of grey, as Pillow reads them
        mode, frames = "I;16", [np.asarray(image).astype(np.uint16)]
    else:
        frames = [np.asarray(image if image.mode == mode else image.convert(mode))]
    return Picture(frames, mode, dict(image.info))


def image(path: Path, choice: str, row: Format) -> Picture:
    Image = use("PIL.Image", path, row.name)
    if row.library == "pillow_heif":
        use(row.library, path, row.name).register_heif_opener()
    return _picture(Image.open(path))


def merged(path: Path, choice: str, row: Format) -> Picture:
    """The picture of all layers that an OpenRaster file holds."""
    Image = use("PIL.Image", path, row.name)
    with zipfile.ZipFile(path) as archive:
        return _picture(Image.open(io.BytesIO(archive.read("mergedimage.png"))))


def raster(path: Path, choice: str, row: Format) -> Raster:
    import warnings

    rasterio = use("rasterio", path, row.name)
    with warnings.catch_warnings():
        # A TIFF picture without a place lies in pixels.
        warnings.simplefilter("ignore", getattr(rasterio.errors, "NotGeoreferencedWarning", Warning))
        with rasterio.open(path) as source:
            return Raster(source.read(), source.profile, {"tags": source.tags(), "colours": source.colorinterp})
