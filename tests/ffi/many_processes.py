#!/usr/bin/env python3
"""libicc.dask with processes: points and a raster, bit for bit what one process makes of them.

    python3 tests/ffi/many_processes.py [--points N] [--side N] [--workers N] [--memory BYTES] [--folder FOLDER]

Workers are ended by Dask when they take more than `--memory`, which a large raster or many points do not fit into. What is
printed are seconds and the most memory that a worker held.
"""

import argparse
import os
import resource
import tempfile
import time

import dask
import dask.array as da
import libicc
import numpy as np
import zarr
from distributed import Client, LocalCluster
from libicc.dask import Raster, map_npy, map_points, warp_raster, write_tiff
from libicc.raster import Grid, Sampling, Window, pull

BEFORE = np.array([[0, 0], [10, 0], [10, 5], [5, 5], [5, 10], [0, 10]], dtype=float)
AFTER = np.array([[0, 0], [12, 1], [12, 6], [6.5, 7], [5, 12], [-1, 10]], dtype=float)


def listen():
    """In a worker: counts the maps that it is sent."""
    whole = libicc.Map._unpickle.__func__

    def counted(cls, data):
        libicc.Map.n_sent += 1
        return whole(cls, data)

    counted.__name__ = "_unpickle"  # by which pickles of maps refer to it
    libicc.Map.n_sent, libicc.Map._unpickle = 0, classmethod(counted)


def heard():
    """How often, and the most memory that the worker has held."""
    n, libicc.Map.n_sent = libicc.Map.n_sent, 0
    return n, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


class Stopwatch:
    def __init__(self, client):
        self.client = client

    def __enter__(self):
        self.client.run(heard)
        self.start = time.perf_counter()

    def __exit__(self, *failure):
        if failure[0] is None:
            self.seconds = time.perf_counter() - self.start
            told = self.client.run(heard).values()
            self.memory = max(most for _, most in told) >> 10
            assert max(n for n, _ in told) <= 1, "the map goes to a worker more than once"


def write_points(path, n):
    """Evenly spread, part by part."""
    file = np.lib.format.open_memmap(path, "w+", np.float64, (n, 2))
    rng = np.random.default_rng(1)
    for first in range(0, n, 1 << 22):
        file[first:first + (1 << 22)] = rng.uniform(-0.2, 10.2, (min(1 << 22, n - first), 2))
    file.flush()


def compare(mapping, source, target):
    """Seconds that one process takes for what the workers have made."""
    points, images, seconds = np.load(source, mmap_mode="r"), np.load(target, mmap_mode="r"), 0.0
    for first in range(0, len(points), 1 << 22):
        start = time.perf_counter()
        own = mapping(points[first:first + (1 << 22)], threads=1)
        seconds += time.perf_counter() - start
        assert own.tobytes() == images[first:first + (1 << 22)].tobytes(), f"the images from {first} on differ"
    return seconds


def test_points(mapping, watch, folder, n):
    source, target = os.path.join(folder, "points.npy"), os.path.join(folder, "images.npy")
    write_points(source, n)
    with watch:
        assert map_npy(mapping, source, target) == n
    alone = compare(mapping, source, target)
    print(f"{n} points, .npy: {watch.seconds:.2f} s, {watch.memory} MiB a worker at most; mapping alone {alone:.2f} s",
          flush=True)
    with watch:
        points = da.from_array(np.load(source, mmap_mode="r")[:n // 10], chunks=(1 << 18, 2))
        points.to_zarr(os.path.join(folder, "points.zarr"))
        images = map_points(mapping, da.from_zarr(os.path.join(folder, "points.zarr")))
        images.to_zarr(os.path.join(folder, "images.zarr"))
    mapped = zarr.open(os.path.join(folder, "images.zarr"), mode="r")
    whole = np.load(target, mmap_mode="r")
    for first in range(0, len(mapped), 1 << 22):
        last = min(first + (1 << 22), len(mapped))
        assert mapped[first:last].tobytes() == whole[first:last].tobytes()
    print(f"{len(mapped)} points, zarr: {watch.seconds:.2f} s", flush=True)


def write_raster(path, side):
    """Rows of a pattern, part by part."""
    file = zarr.open(path, mode="w", shape=(side, side), chunks=(1024, 1024), dtype=np.uint8)
    for row in range(0, side, 1024):
        y, x = np.ogrid[row:min(row + 1024, side), 0:side]
        file[row:row + 1024] = ((x // 7) ^ (y // 5)).astype(np.uint8)


def test_raster(mapping, watch, folder, side):
    pixel = 13.5 / side
    grid = Grid((pixel, 0, -1.2, 0, -pixel, 12.3), side, side)
    source = os.path.join(folder, "in.zarr")
    write_raster(source, side)
    raster = Raster.open(source, grid)
    with watch:
        warped = warp_raster(mapping, raster, chunk=min(1024, side // 3), max_pixels=1 << 22)
        warped.to_zarr(os.path.join(folder, "out.zarr"))
    print(f"{side} x {side} pixels, zarr: {watch.seconds:.2f} s, {watch.memory} MiB a worker at most", flush=True)
    made = zarr.open(os.path.join(folder, "out.zarr"), mode="r")
    rows = range(0, side, 250)
    chosen = rows[::max(1, len(rows) // 16)]  # of a large raster not all, which one process would take long for
    start = time.perf_counter()
    for row in chosen:
        window = Window(row, min(row + 250, side), 0, side)
        own = pull(raster.read, grid, mapping, grid, window, 1, np.uint8, Sampling("linear", 0, None), threads=1)
        assert own.tobytes() == made[:, row:row + 250].tobytes(), f"the rows from {row} on differ"
    print(f"one process: {time.perf_counter() - start:.2f} s for {len(chosen)} of {len(rows)} windows", flush=True)
    with watch:
        write_tiff(da.from_zarr(os.path.join(folder, "out.zarr")), os.path.join(folder, "out.tif"), grid)
    print(f"to GeoTIFF: {watch.seconds:.2f} s", flush=True)
    again = Raster.open(os.path.join(folder, "out.tif"))
    for row in rows:
        window = Window(row, min(row + 250, side), 0, side)
        assert again.read(window).tobytes() == made[:, row:row + 250].tobytes()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--side", type=int, default=700)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--memory", default="600MB", help="of a worker")
    parser.add_argument("--folder", help="where the files go for a while")
    wanted = parser.parse_args()
    mapping = libicc.Map(BEFORE, AFTER)
    # What a worker holds is not put on the disk: maps that come back from there would count as sent.
    dask.config.set({"distributed.worker.memory.target": False, "distributed.worker.memory.spill": False})
    with tempfile.TemporaryDirectory(dir=wanted.folder) as folder, \
            LocalCluster(n_workers=wanted.workers, threads_per_worker=1, processes=True, dashboard_address=None,
                         local_directory=folder, memory_limit=wanted.memory) as cluster, Client(cluster) as client:
        client.run(listen)
        watch = Stopwatch(client)
        test_points(mapping, watch, folder, wanted.points)
        test_raster(mapping, watch, folder, wanted.side)


if __name__ == "__main__":
    main()
