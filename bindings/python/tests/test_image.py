import libicc
import numpy as np
import pytest


@pytest.fixture
def picture():
    y, x = np.mgrid[0:60, 0:80]
    return np.stack([x * 3, y * 4, (x + y) % 256], -1).astype(np.uint8)


def test_identity_copies(picture):
    cage = libicc.picture_cage(picture.shape)
    assert np.array_equal(libicc.warp_image(picture, libicc.Map(cage, cage)), picture)


@pytest.mark.parametrize("dtype, channels", [(np.uint8, 1), (np.uint16, 2), (np.uint8, 4)])
def test_kinds_of_pictures(picture, dtype, channels):
    image = np.repeat(picture[:, :, :1], channels, axis=2).astype(dtype)
    cage = libicc.picture_cage(image.shape)
    target = cage * 0.5 + 10
    result = libicc.warp_image(image, libicc.Map(cage, target), np.zeros_like(image))
    assert result.dtype == dtype and result.shape == image.shape
    assert (result[:9] == 0).all() and result[12:38, 12:48].any()
    flat = libicc.warp_image(image[:, :, 0], libicc.Map(cage, cage))
    assert np.array_equal(flat, image[:, :, 0])


def test_one_row():
    """What NumPy calls contiguous though rows are no bytes apart."""
    image = np.broadcast_to(np.arange(4, dtype=np.uint8), (1, 4))
    cage = libicc.picture_cage(image.shape)
    assert np.array_equal(libicc.warp_image(image, libicc.Map(cage, cage)), image)


def test_wrong_pictures(picture):
    cage = libicc.picture_cage(picture.shape)
    with pytest.raises(ValueError, match="65 channels; there must be 1 to 64"):
        libicc.warp_image(np.zeros((9, 9, 65), np.uint8), libicc.Map(cage, cage))
    with pytest.raises(ValueError, match="it must be 0, or 1 with at least two channels"):
        libicc.warp_image(picture[:, :, 0], libicc.Map(cage, cage), alpha=True)
    with pytest.raises(ValueError, match="uint8"):
        libicc.warp_image(picture.astype(int), libicc.Map(cage, cage))
    with pytest.raises(ValueError, match="one of nearest, linear, cubic"):
        libicc.warp_image(picture, libicc.Map(cage, cage), interpolation="bilinear")
    with pytest.raises(ValueError, match="alpha needs"):
        libicc.warp_image(picture, libicc.Map(cage, cage), interpolation="cubic", alpha=True)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32, np.float64])
@pytest.mark.parametrize("interpolation", ["nearest", "linear", "cubic"])
def test_values(dtype, interpolation):
    """Many bands, floats and missing values through a shift by a quarter of a pixel; a plane is what it was but shifted."""
    y, x = np.mgrid[:20, :30]
    bands = np.stack([4 * x + 2 * y + k for k in range(7)], axis=2).astype(dtype)
    cage = libicc.picture_cage(bands.shape)
    assert np.array_equal(libicc.warp_image(bands, libicc.Map(cage, cage), interpolation=interpolation), bands)
    shifted = libicc.warp_image(bands, libicc.Map(cage, cage + 0.25), interpolation=interpolation)
    off = 0 if interpolation == "nearest" else -1.5
    inner = np.s_[3:-3, 3:-3]
    np.testing.assert_allclose(shifted[inner], np.round(bands[inner] + off + 1e-9) if bands.dtype.kind == "u"
                               else bands[inner] + off, atol=1e-4)


@pytest.mark.parametrize("nodata", [np.nan, -9999.0])
def test_missing(nodata):
    heights = np.full((20, 30), 7.0)
    heights[5:9, 10:20] = nodata
    cage = libicc.picture_cage(heights.shape)
    result = libicc.warp_image(heights, libicc.Map(cage, cage + 0.25), nodata=nodata)[1:, 1:]
    missing = np.isnan(result) if np.isnan(nodata) else result == nodata
    assert missing.sum() == 40 and np.allclose(result[~missing], 7)


def test_scikit_image(picture, neighbour):
    transform = neighbour("skimage.transform")
    cage = libicc.picture_cage(picture.shape)
    moved = cage + [[3, 2], [-4, 5], [-2, -6], [7, -3]]
    mapping = libicc.Map(cage, moved)
    ours = libicc.warp_image(picture, mapping, np.zeros_like(picture))
    pixels = libicc.PixelTransform(mapping, outside="blank")
    theirs = transform.warp(picture, pixels, order=1, preserve_range=True)
    solid = np.zeros(picture.shape[:2], bool)
    solid[10:50, 10:70] = True
    assert np.abs(ours.astype(float) - theirs)[solid].mean() < 3
    points = np.array([[20.0, 20.0], [40.5, 30.25]])
    assert np.abs(pixels(pixels.inverse(points)) - points).max() < 1e-9
