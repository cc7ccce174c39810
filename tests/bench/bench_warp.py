#!/usr/bin/env python3
"""Warps beside cv2.remap, which interpolates bilinearly and averages nowhere; it gets the map's places as a table that
is not part of its time. Processor time in ms, least and median, by turns. Without OpenCV (Debian: python3-opencv) ours
alone.

usage: PYTHONPATH=bindings/python LIBICC_LIBRARY=build/release/lib/libicc.so bench_warp.py [SIZE...]

Bar: at most 1.5 times cv2.remap at 1024 x 1024, four channels."""
import ctypes
import statistics
import sys
import time

import libicc
import numpy as np
from libicc._abi import lib
from libicc._core import Call
from libicc._image import _picture

try:
    import cv2
except ImportError:
    cv2 = None

REPEATS = 15


def cages(size):
    """A round cage with six waves that turns into one with five, turned a little."""
    angle = 2 * np.pi * np.arange(66) / 66
    before, after = 0.42 * (1 + 0.12 * np.cos(6 * angle)), 0.41 * (1 + 0.16 * np.cos(5 * angle + 1))
    return [size * (0.5 + radius[:, None] * np.stack([np.cos(turned), np.sin(turned)], 1))
            for radius, turned in ((before, angle), (after, angle + 0.3))]


def picture(size, channels):
    """Smooth, and opaque."""
    y, x = np.mgrid[0:size, 0:size]
    return np.ascontiguousarray(np.dstack([x, y, 7 * x, np.full_like(x, 255)])[:, :, :channels].astype(np.uint8))


def places(mapping, size):
    """Where the centre of every pixel comes from, for cv2.remap; beyond the picture outside the cage."""
    y, x = np.mgrid[0:size, 0:size] + 0.5
    points, status = mapping.apply_inverse(np.stack([x.ravel(), y.ravel()], 1), status=True)
    points[status != 0] = -9
    return [np.ascontiguousarray((points[:, k] - 0.5).reshape(size, size).astype(np.float32)) for k in range(2)]


def measure(jobs):
    """The processor times of jobs that take turns."""
    times = {name: [] for name in jobs}
    for _ in range(REPEATS):
        for name, job in jobs.items():
            begin = time.process_time()
            job()
            times[name].append(1e3 * (time.process_time() - begin))
    return {name: (min(t), statistics.median(t)) for name, t in times.items()}


def compare(size, channels):
    mapping = libicc.Map(*cages(size))
    image = picture(size, channels)
    out, theirs = np.zeros_like(image), np.zeros_like(image)
    source, target = _picture(image, channels == 4), _picture(out, channels == 4)

    def warp():
        call = Call(None, 1)
        call.check(lib.map_warp(mapping, ctypes.addressof(source), ctypes.addressof(target), None, call.env, call.err))

    jobs = {"libicc": warp}
    if cv2:
        table = places(mapping, size)
        fixed = cv2.convertMaps(*table, cv2.CV_16SC2)
        jobs["cv2.remap float"] = lambda: cv2.remap(image, *table, cv2.INTER_LINEAR, theirs)
        jobs["cv2.remap fixed"] = lambda: cv2.remap(image, *fixed, cv2.INTER_LINEAR, theirs)
    times = measure(jobs)
    ours = times["libicc"]
    for name, (least, median) in times.items():
        print(f"{size:5d} {channels:8d} {name:16s} {least:8.2f} {median:8.2f}   {ours[0] / least:6.2f} {ours[1] / median:6.2f}")


def main():
    if cv2:
        cv2.setNumThreads(1)
    print(f"{'size':>5s} channels {'':16s} {'least':>8s} {'median':>8s}   ours / theirs")
    for size in [int(a) for a in sys.argv[1:]] or [512, 1024, 4096]:
        for channels in (4, 3, 1):
            compare(size, channels)


main()
