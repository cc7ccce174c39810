#!/usr/bin/env python3
"""Maps ten million points in several processes, and checks that one process gets the same, bit for bit.

    python3 examples/distributed.py [--points N] [--workers N] [--shards N] [--kind mesh|curves]

Needs libicc for Python, NumPy and Dask's distributed scheduler (Debian: python3-numpy and
python3-distributed). The map is made once and sent to every worker as bytes; it answers there as it does
here, on any machine. The points lie in a file that all workers see, and so do their images: a worker reads
its shard of the one and fills its part of the other.

Sharing pays when points are expensive (kind curves: some microseconds each, more in space) or too many for
one machine. With the default, kind mesh, a point takes a tenth of a microsecond: less than to read and write it.
"""

import argparse
import os
import pathlib
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
# This file has the name of Dask's package and must not be found in its place.
sys.path[:] = [place for place in sys.path if pathlib.Path(place).resolve() != HERE]

import libicc
import numpy as np
from distributed import Client, LocalCluster


def start_workers(n, folder):
    """Processes on this machine; to use others, give Client the address of your scheduler instead."""
    return LocalCluster(n_workers=n, threads_per_worker=1, processes=True, dashboard_address=None,
                        local_directory=folder)


def map_shard(mapping, points_file, images_file, first, last):
    """Maps points first..last; runs in a worker, which has one thread."""
    points = np.load(points_file, mmap_mode="r")[first:last]
    images = np.load(images_file, mmap_mode="r+")
    images[first:last] = mapping(points, threads=1)
    images.flush()
    return len(points)


def map_in_workers(client, mapping, points_file, images_file, n_points, n_shards):
    # The map goes out once to each worker, not once with each shard.
    there = client.scatter(mapping, broadcast=True)
    limits = np.linspace(0, n_points, n_shards + 1).astype(int)
    shards = [client.submit(map_shard, there, points_file, images_file, int(first), int(last))
              for first, last in zip(limits[:-1], limits[1:])]
    return sum(client.gather(shards))


def make_map(kind):
    """What lies in a picture goes along when its frame is bent."""
    before, after = (np.loadtxt(HERE / "data" / f"chelsea.{side}.txt") for side in ("src", "tgt"))
    return before, libicc.Map(before, after, kind, method="foliation")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=10_000_000)
    parser.add_argument("--workers", type=int, default=max(2, os.cpu_count() or 2), help="processes")
    parser.add_argument("--shards", type=int, default=64)
    parser.add_argument("--kind", choices=("mesh", "curves"), default="mesh")
    return parser.parse_args()


def main():
    wanted = arguments()
    before, mapping = make_map(wanted.kind)
    print(f"{wanted.points} points in {wanted.shards} shards, {mapping}, {len(mapping.to_bytes())} bytes")

    with tempfile.TemporaryDirectory() as folder:
        points_file, images_file = os.path.join(folder, "points.npy"), os.path.join(folder, "images.npy")
        points = np.random.default_rng(1).uniform(before.min(0), before.max(0), (wanted.points, 2))
        np.save(points_file, points)
        np.lib.format.open_memmap(images_file, "w+", points.dtype, points.shape).flush()

        with start_workers(wanted.workers, folder) as cluster, Client(cluster) as client:
            start = time.perf_counter()
            done = map_in_workers(client, mapping, points_file, images_file, wanted.points, wanted.shards)
            print(f"{wanted.workers} workers: {done} points in {time.perf_counter() - start:.2f} s")

        start = time.perf_counter()
        alone = mapping(points, threads=1)
        print(f"one process: {len(alone)} points in {time.perf_counter() - start:.2f} s")

        # As integers: equal numbers may differ in their bits, and NaN (no image) is not equal to itself.
        together = np.load(images_file, mmap_mode="r")
        if done != wanted.points or not np.array_equal(together.view(np.uint64), alone.view(np.uint64)):
            print("the results differ")
            return 1
    print("identical")
    return 0


if __name__ == "__main__":
    sys.exit(main())
