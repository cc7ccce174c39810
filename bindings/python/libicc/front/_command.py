"""The commands warp, map, mesh, check and match, with the options and exit codes of the command libicc."""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from .._domain import Domain, as_domain
from .._errors import Error
from .._map import Map
from .._match import Match
from . import formats, layer, mesh
from ._tally import Tally
from .formats import FileError
from .points import Points

OK, FAILED, USAGE, PARTLY = 0, 1, 2, 4

CAGES = ("layer", "points", "mesh", "volume")
"""The kinds of files that hold shapes."""

_MOVES: Dict[str, Tuple[Tuple[str, ...], str]] = {
    "warp": (("picture", "volume"), "warp a picture, a raster or a volume of voxels"),
    "map": (("layer", "points"), "move a layer or points"),
    "mesh": (("mesh", "points"), "move the vertices of a mesh, and check its cells"),
}


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m libicc", description="Moves what the files of other programs hold "
                                     "along with a cage. The manual page libicc(1) describes the options.")
    parser.add_argument("--formats", action="store_true", help="list the formats")
    commands = parser.add_subparsers(dest="command", metavar="warp|map|mesh|check|match")
    for name, (_, text) in _MOVES.items():
        one = commands.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        one.add_argument("input", metavar="IN")
        one.add_argument("output", metavar="OUT")
        _options(one, target_required=True)
        one.add_argument("--outside", choices=("keep", "null", "fail"), default="null" if name == "map" else "keep",
                         help="what lies outside the cage: keep it, clear it, or fail")
        if name == "map":
            one.add_argument("-i", "--inverse", action="store_true", help="map from target to source")
            one.add_argument("--tolerance", type=float, metavar="LENGTH", help="maximum distance of a line from its image")
            one.add_argument("--exact", action="store_true", help="exact images of lines")
        if name == "warp":
            one.add_argument("--resampling", choices=("nearest", "linear", "cubic"), default="linear")
            one.add_argument("--nodata", type=float, metavar="VALUE", help="pixels of this value are missing")
            one.add_argument("--background", metavar="RRGGBB[AA]", help="colour of uncovered pixels")
        if name == "mesh":
            one.add_argument("--untangle", action="store_true", help="move inner vertices until no cell is inverted")
            one.add_argument("--rotate-vectors", action="store_true",
                             help="rotate the vectors at points and in cells with the map; they keep their length")
    _options(commands.add_parser("check", help="check cages, and prove the map between them one-to-one"))
    match = commands.add_parser("match", help="pair two outlines or surfaces")
    _options(match, target_required=True)
    match.add_argument("-o", "--output", metavar="FILE", required=True, help="the source with the common vertices")
    match.add_argument("--target-output", metavar="FILE", required=True, help="the target with the common vertices")
    return parser


def _options(one: argparse.ArgumentParser, target_required: bool = False) -> None:
    one.add_argument("-s", "--source", metavar="FILE", required=True, help="the cage before; FILE#name=Kent takes one "
                     "shape of several")
    one.add_argument("-t", "--target", metavar="FILE", required=target_required, help="the cage after")
    one.add_argument("--match", metavar="auto|arc|FILE", help="pair two outlines that do not correspond")
    one.add_argument("--landmarks", metavar="FILE", help="with --match: lines 'x y X Y' of source and target")
    one.add_argument("--require", choices=("certified",), help="fail unless the result is certified")
    one.add_argument("-m", "--method", help="how to make coordinates")
    one.add_argument("--map", choices=("mesh", "curves"), dest="map_kind")
    one.add_argument("--improve", type=int, metavar="N", help="maximum number of improvement steps")
    one.add_argument("-n", "--cells", type=int, metavar="N")
    one.add_argument("-j", "--threads", type=int, metavar="N")
    one.add_argument("-q", "--quiet", action="store_true", help="accepted, there is no progress bar")


def _cage(path: str, side: str) -> Domain:
    """A cage from a file. Errors name the file and the side."""
    try:
        return as_domain(formats.read(path, CAGES).outline())
    except (Error, ValueError, TypeError) as error:
        raise FileError(f"{path}: no valid {side}: {error}") from error


def _match_of(args: Any) -> Any:
    """What `Map` and `Match` take for --match and --landmarks."""
    file = args.landmarks or (args.match if args.match not in (None, "auto", "arc") else None)
    if file is not None:
        return formats.read(file, ("points",)).points
    return {"auto": True, None: None}.get(args.match, args.match)


def _map(args: Any) -> Map:
    args.source_domain, args.target_domain = _cage(args.source, "source"), _cage(args.target, "target")
    if args.source_domain.dim != args.target_domain.dim:
        raise FileError(f"{args.target}: {args.target_domain.dim} dimensions, but the source {args.source} has "
                        f"{args.source_domain.dim}")
    try:
        return Map(args.source_domain, args.target_domain, args.map_kind, match=_match_of(args), method=args.method,
                   improve=args.improve, cells=args.cells, threads=args.threads)
    except (Error, ValueError) as error:
        side = {1: args.source, 2: args.target}.get(getattr(error, "side", 0), f"{args.source}, {args.target}")
        raise FileError(f"{side}: {error}") from error


def _move(args: Any) -> int:
    for name in (args.source, args.target, args.input):
        same = Path(args.output).resolve() == formats.split_choice(name)[0].resolve()
        if same and not (args.command == "map" and name == args.input):
            raise FileError(f"{args.output}: is read as well; write another file")
    thing = formats.read(args.input, _MOVES[args.command][0])
    formats.format_of(args.output, (thing.kind,), write=True)
    mapping = _map(args)
    for name, value in (("inverse", False), ("untangle", False), ("rotate_vectors", False)):
        vars(args).setdefault(name, value)
    try:
        tally = thing.carry(mapping, args)
    except (Error, ValueError) as error:
        raise FileError(f"{args.input}: {error}") from error
    if tally.text:
        print(tally.text)
    return _finish(args, thing, mapping, tally)


def _finish(args: Any, thing: Any, mapping: Map, tally: Tally) -> int:
    """Writes the result unless an option or a vertex outside forbids it."""
    certified = mapping.certified and tally.certified and tally.n_bad == 0
    if args.require == "certified" and not certified:
        raise FileError(f"{args.output}: not written, because the result is not certified one-to-one")
    if tally.n_lost and (args.outside == "fail" or thing.kind == "mesh"):
        message = f"{args.output}: not written, because of {args.input} not all lies in the cage {args.source}"
        if thing.kind != "mesh":
            raise FileError(message)
        print(f"libicc: {message}", file=sys.stderr)
        return PARTLY
    formats.write(thing, args.output)
    return PARTLY if tally.n_lost or tally.n_bad else OK


def _check(args: Any) -> int:
    if args.target is None:
        domain = _cage(args.source, "source")
        info = domain.info
        print(f"{args.source}: a valid shape of {info.dim} dimensions, {info.n_vertices} vertices, {info.n_facets} facets, "
              f"measure {info.measure:.12g}")
        return OK
    mapping = _map(args)
    if mapping.certified:
        print("one-to-one: yes, certified")
        return OK
    print(f"one-to-one: not proved: the {mapping.info.kind} map is not certified")
    return FAILED


def _pair(args: Any) -> int:
    try:
        source, target = _cage(args.source, "source"), _cage(args.target, "target")
        how = _match_of(args)
        between = "arc" if isinstance(how, str) else None
        found = Match(source, target, how if isinstance(how, np.ndarray) else None, between=between)
    except (Error, ValueError) as error:
        raise FileError(f"{args.source}, {args.target}: {error}") from error
    for domain, path in ((found.source, args.output), (found.target, args.target_output)):
        _write_shape(domain, path)
    print(f"common      {found.info.n_vertices} vertices")
    return OK


def _write_shape(domain: Domain, path: str) -> None:
    """Writes a cage as a surface, a polygon, or a list of vertices."""
    kind = formats.format_of(path, ("mesh",) if domain.dim == 3 else ("layer", "points"), write=True).kind
    if kind == "mesh":
        mesh.write_shape(domain, Path(path))
    elif kind == "points":
        formats.write(Points(domain.vertices), path)
    else:
        geopandas = formats.use("geopandas", path, "a layer")
        from shapely.geometry import Polygon

        frame = geopandas.GeoDataFrame({"id": [1]}, geometry=[Polygon(domain.vertices)])
        formats.write(layer.Layer(frame, Path(path)), path)


def _is_scene(path: str) -> bool:
    return path.lower().endswith((".glb", ".gltf"))


def _hand_over(argv: List[str]) -> int:
    """glTF scenes are moved by the command libicc."""
    command = shutil.which("libicc")
    if command is None:
        raise FileError(f"{next(filter(_is_scene, argv))}: only the command libicc moves glTF scenes; install it "
                        "(Debian: 'apt install libicc-tools')")
    done = subprocess.run([command, *argv], capture_output=True, text=True)
    print(done.stdout, end="")
    print(done.stderr, end="", file=sys.stderr)
    return done.returncode


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Runs a command, and returns its exit code: 0 done, 1 failed, 2 wrong usage, 4 done, but not all is good."""
    words = list(sys.argv[1:] if argv is None else argv)
    parser = _parser()
    args = parser.parse_args(words)
    if args.formats:
        for row in formats.FORMATS:
            print(f"{row.kind:8} {row.endings or '-':36} {row.library or 'NumPy':12} {row.name}"
                  + ("" if row.writes else " (only read)"))
        return OK
    if args.command is None:
        parser.print_usage(sys.stderr)
        return USAGE
    run = {"check": _check, "match": _pair}.get(args.command, _move)
    try:
        if args.command == "mesh" and _is_scene(args.input):
            return _hand_over(words)
        return run(args)
    except FileError as error:
        print(f"libicc: {error}", file=sys.stderr)
        return FAILED
