#!/usr/bin/env python3
"""pose --pins: a figure in a picture is posed by pins. Its colours tell where each place comes from, and the skeleton of
Spine is played by hand and compared with the picture.

usage: test_pins.py LIBICC SCRATCH
"""
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import zlib

TOOL, SCRATCH = os.path.abspath(sys.argv[1]), sys.argv[2]
WIDTH, HEIGHT = 120, 140
LIMBS = [((60, 26), (60, 26), 17), ((60, 40), (60, 90), 17), ((48, 56), (14, 84), 7), ((72, 56), (106, 84), 7),
         ((50, 92), (42, 126), 9), ((70, 92), (78, 126), 9)]
PINS = [("head", (60, 24), (60, 24)), ("belly", (60, 84), (60, 84)), ("left hand", (16, 82), (14, 30)),
        ("right hand", (104, 82), (100, 108)), ("left foot", (43, 124), (43, 124)), ("right foot", (77, 124), (77, 124))]
N_FAILED = 0


def complain(text):
    global N_FAILED
    N_FAILED += 1
    print("FAILED:", text, file=sys.stderr)


def check(good, text):
    if not good:
        complain(text)


def run(expected, *words):
    got = subprocess.run([TOOL, "pose", *words], capture_output=True, text=True, check=False)
    if got.returncode != expected:
        complain(f"exit {got.returncode} instead of {expected}: libicc pose {' '.join(words)}\n    {got.stderr}")
    return got


def refused(*words, says, rc=1):
    got = run(rc, *words)
    check(got.stderr.startswith("libicc: ") and got.stderr.count("\n") == 1 and says in got.stderr, f"'{says}' is not in: {got.stderr}")
    check(not os.path.exists("no.png"), "a picture was written in spite of an error")


# ---- pictures: rows of pixels, each [red, green, blue, alpha]

def save(name, rows, channels=4):
    kinds = {3: 2, 4: 6}
    data = zlib.compress(b"".join(b"\0" + bytes(v for pixel in row for v in pixel[:channels]) for row in rows))
    with open(name, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n")
        for kind, part in ((b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, kinds[channels], 0, 0, 0)), (b"IDAT", data), (b"IEND", b"")):
            out.write(struct.pack(">I", len(part)) + kind + part + struct.pack(">I", zlib.crc32(kind + part)))


def load(name):
    """A PNG of 8 bits and four channels."""
    data, at, idat = open(name, "rb").read(), 8, b""
    while at < len(data):
        n, kind = struct.unpack(">I4s", data[at:at + 8])
        part = data[at + 8:at + 8 + n]
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", part[:10])
            assert (depth, colours) == (8, 6), (depth, colours)
        idat += part if kind == b"IDAT" else b""
        at += 12 + n
    raw, stride, rows, before = zlib.decompress(idat), 4 * width, [], bytes(4 * width)
    for y in range(height):
        method, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride if method else 0):
            a, b, c = line[i - 4] if i >= 4 else 0, before[i], before[i - 4] if i >= 4 else 0
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[i] = line[i] + (0, a, b, (a + b) // 2, nearest)[method] & 255
        rows.append([list(line[4 * x:4 * x + 4]) for x in range(width)])
        before = line
    return rows


def to_limb(x, y, limb):
    (x0, y0), (x1, y1), radius = limb
    dx, dy = x1 - x0, y1 - y0
    along = min(max(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy or 1), 0), 1)
    return math.hypot(x - x0 - along * dx, y - y0 - along * dy) - radius


def colour_of(x, y):
    return [40 + 1.5 * x, 40 + 1.5 * y]


def draw(limbs, holes=(), width=WIDTH, height=HEIGHT):
    """Soft edges, and colours by which a place is known."""
    rows = []
    for y in range(height):
        rows.append([])
        for x in range(width):
            d = min(to_limb(x + 0.5, y + 0.5, limb) for limb in limbs)
            for hole in holes:
                d = max(d, -to_limb(x + 0.5, y + 0.5, hole))
            red, green = colour_of(x + 0.5, y + 0.5)
            rows[-1].append([round(red), round(green), 90, round(255 * min(max(0.5 - d, 0), 1))])
    return rows


def sample(rows, x, y):
    """The pixel around a place."""
    return rows[int(y)][int(x)] if 0 <= y < len(rows) and 0 <= x < len(rows[0]) else [0, 0, 0, 0]


def comes_from(rows, at, place, text, tolerance=5):
    got, wanted = sample(rows, *at), colour_of(*place)
    check(got[3] == 255 and max(abs(g - w) for g, w in zip(got, wanted)) <= tolerance, f"{text}: {got} at {at} instead of {wanted}")


def pieces(rows, opaque):
    """The number of connected pieces of what is opaque, or of what is not."""
    width, height, seen, n = len(rows[0]), len(rows), set(), 0
    inside = [[(pixel[3] >= 128) == opaque for pixel in row] for row in rows]
    for y in range(height):
        for x in range(width):
            if not inside[y][x] or (x, y) in seen:
                continue
            n += 1
            todo = [(x, y)]
            seen.add((x, y))
            while todo:
                u, v = todo.pop()
                for p in ((u + 1, v), (u - 1, v), (u, v + 1), (u, v - 1)):
                    if 0 <= p[0] < width and 0 <= p[1] < height and inside[p[1]][p[0]] and p not in seen:
                        seen.add(p)
                        todo.append(p)
    return n


def area(rows):
    return sum(pixel[3] for row in rows for pixel in row) / 255


def write_pins(name, pins, **more):
    with open(name, "w", encoding="utf-8") as out:
        json.dump({"pins": pins} | more, out)


def pin(name, at, to=None, **more):
    return {"name": name, "at": at} | ({"to": to} if to else {}) | more


def pose(pins, picture="hero.png", out="out.png", *options, rc=0, bones=()):
    write_pins("now.json", pins, **({"bones": bones} if bones else {}))
    run(rc, "--pins", "now.json", picture, out, "--json=report.json", *options)
    with open("report.json", encoding="utf-8") as file:
        return load(out) if out.endswith(".png") and os.path.exists(out) else None, json.load(file)


# ---- Spine, as its documentation says

def play(skeleton, slot, time):
    """The vertices of a slot's mesh at a time, and the mesh. A key adds to the vertices; between keys it is linear."""
    mesh = next(iter(skeleton["skins"][0]["attachments"][slot].values()))
    rest = mesh["vertices"]
    keys = next(iter(skeleton["animations"]["pose"]["attachments"]["default"][slot].values()))["deform"]
    times = [key.get("time", 0) for key in keys]
    deltas = [key.get("vertices", [0] * len(rest)) for key in keys]
    k = max(i for i, t in enumerate(times) if t <= time)
    share = 0 if k + 1 == len(keys) else (time - times[k]) / (times[k + 1] - times[k])
    later = deltas[min(k + 1, len(keys) - 1)]
    moved = [r + (1 - share) * a + share * b for r, a, b in zip(rest, deltas[k], later)]
    return list(zip(moved[::2], moved[1::2])), mesh


def turn_of(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def check_spine(skeleton, rows, report, time):
    """The skeleton at rest is the picture, and at the time the posed picture."""
    bones = {bone["name"]: bone for bone in skeleton["bones"]}
    slot = skeleton["slots"][0]["name"]
    check(skeleton["slots"][0]["attachment"] == "hero" and skeleton["skeleton"]["spine"].startswith("4."), "the head of the skeleton")
    rest, mesh = play(skeleton, slot, 0)
    posed, _ = play(skeleton, slot, time)
    uvs = list(zip(mesh["uvs"][::2], mesh["uvs"][1::2]))
    corners = mesh["triangles"]
    triangles = list(zip(corners[::3], corners[1::3], corners[2::3]))
    check(len(uvs) == len(rest) and len(triangles) == report["triangles"], "the mesh is incomplete")
    check(all(math.dist((u * WIDTH - WIDTH / 2, HEIGHT - v * HEIGHT), p) < 1e-6 for (u, v), p in zip(uvs, rest)), "uvs are not at the vertices")
    check(all(0 <= c <= 1 for uv in uvs for c in uv), "uvs leave the picture")
    # All triangles keep their orientation, and the first vertices are the boundary, in its order.
    signs = {turn_of(*(where[v] for v in t)) > 0 for where in (rest, posed) for t in triangles}
    check(len(signs) == 1, "a triangle is turned over")
    edges = {edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))}
    rim = {(a, b) for a, b in edges if (b, a) not in edges}
    hull = mesh["hull"]
    check(rim == {(i, (i + 1) % hull) for i in range(hull)}, "the hull is not the boundary")
    # Places of the posed picture have the colours of the picture at the uvs.
    x, y = report["corner"]
    n = 0
    for t in triangles:
        u, v = (sum(uvs[k][c] for k in t) / 3 for c in (0, 1))
        at = sum(posed[k][0] for k in t) / 3 + WIDTH / 2 - x, HEIGHT - sum(posed[k][1] for k in t) / 3 - y
        place = u * WIDTH, v * HEIGHT
        if min(to_limb(*place, limb) for limb in LIMBS) < -2:
            n += 1
            comes_from(rows, at, place, "the skeleton", tolerance=6)
    check(n > 50, f"only {n} triangles were compared")
    for name, at, to in PINS:
        move = skeleton["animations"]["pose"]["bones"][name]["translate"]
        check(math.dist((bones[name]["x"], bones[name]["y"]), (at[0] - WIDTH / 2, HEIGHT - at[1])) < 1e-9, f"bone {name} at rest")
        check(math.dist((move[-1]["x"], move[-1]["y"]), (to[0] - at[0], at[1] - to[1])) < 1e-9, f"bone {name} in the pose")
        nearest = min(math.dist(p, (to[0] - WIDTH / 2, HEIGHT - to[1])) for p in posed)
        check(nearest < 1e-4, f"no vertex is where pin {name} goes, {nearest}")


# ---- the tests

def test_pose(hero):
    got, report = pose([pin(*p) for p in PINS], "hero.png", "out.png", "--spine", "rig.json", "--require", "certified")
    check(report["certified"] is True and report["pins_off"] == 0 and report["parts"] == 1, "the report of a pose")
    check([p["name"] for p in report["pins"]] == [p[0] for p in PINS] and all(p["reached"] for p in report["pins"]), "the pins of the report")
    check((report["width"], report["height"], report["corner"]) == (WIDTH, HEIGHT, [0, 0]), "the picture grew for nothing")
    check(pieces(got, True) == 1 and pieces(got, False) == pieces(hero, False), "the posed picture has holes or crumbs")
    check(abs(area(got) / area(hero) - 1) < 0.1, f"areas {area(got)} and {area(hero)}")
    for name, at, to in PINS:
        comes_from(got, to, at, f"pin {name}")
    with open("rig.json", encoding="utf-8") as file:
        check_spine(json.load(file), got, report, 1)
    # Lines of text are pins as well.
    with open("pins.txt", "w", encoding="utf-8") as out:
        out.writelines(f"{a[0]} {a[1]} {b[0]} {b[1]}\n" for _, a, b in PINS)
    said = run(0, "--pins", "pins.txt", "hero.png", "same.png").stdout
    check(load("same.png") == got and "one-to-one: yes, certified; 1 part" in said and "6 of 6 pins are at their places" in said, "pins in a text")
    run(0, "--pins", "pins.txt", "--background", "0000ff", "hero.png", "blue.png")
    blue = load("blue.png")
    check(all(p[3] == 255 for row in blue for p in row) and blue[0][0] == [0, 0, 255, 255], "the background")
    # Soft edges are soft in the pose, too.
    check(sum(0 < p[3] < 255 for row in got for p in row) > 0.7 * sum(0 < p[3] < 255 for row in hero for p in row), "the edges are hard")


def test_frames(hero):
    pins = [pin(*p) for p in PINS]
    _, report = pose(pins, "hero.png", "film.apng", "--frames", "5", "--rate", "10", "--spine", "film.json")
    data = open("film.apng", "rb").read()
    check(data.count(b"fcTL") == 6 and report["certified"], "a film of 6 frames")
    pose(pins, "hero.png", "frame.png", "--frames", "5")
    names = [f"frame-{k:04}.png" for k in range(6)]
    check(all(map(os.path.exists, names)), "numbered frames")
    first = load(names[0])
    check(all(p == q or p[3] == q[3] == 0 for r, s in zip(first, hero) for p, q in zip(r, s)), "the first frame is not the picture")
    with open("film.json", encoding="utf-8") as file:
        check_spine(json.load(file), load(names[5]), report, 0.5)


def test_growth():
    high = [pin(name, at, (30, -30) if name == "left hand" else to) for name, at, to in PINS]
    got, report = pose(high)
    x, y = report["corner"]
    check(report["certified"] and x <= 0 and y < -30 and report["height"] >= HEIGHT - y, f"the picture did not grow: {report['corner']}")
    check((len(got[0]), len(got)) == (report["width"], report["height"]), "the size of the picture")
    comes_from(got, (30 - x, -30 - y), (16, 82), "the raised hand")
    check(max(p[3] for p in got[0] + got[-1]) < 128 and pieces(got, True) == 1, "the pose is cut off")


def test_turns_and_bones():
    got, report = pose([pin("head", (60, 24), (64, 24), turn=40), pin("belly", (60, 84)), pin("left foot", (43, 124)), pin("right foot", (77, 124))])
    check(report["certified"] and report["pins_off"] == 0, "a turned head")
    c, s = 4 * math.cos(math.radians(40)), 4 * math.sin(math.radians(40))
    for u, v in ((1, 0), (0, 1), (-1, 0), (0, -1)):
        comes_from(got, (64 + c * u - s * v, 24 + s * u + c * v), (60 + 4 * u, 24 + 4 * v), "a turned head")
    bones = [pin("shoulder", (46, 58), (46, 56)), pin("hand", (18, 81), (20, 30)), pin("belly", (60, 84)), pin("foot", (43, 124))]
    got, report = pose(bones, bones=[[0, 1]])
    check(report["certified"] and report["pins_off"] == 0, "a bone")
    for k in range(5):
        comes_from(got, (46 - 26 * k / 4, 56 - 26 * k / 4), (46 - 28 * k / 4, 58 + 23 * k / 4), "a bone")
    # An arm that turns by 140 degrees keeps its length on the way.
    swung = [pin("shoulder", (48, 58)), pin("elbow", (32, 70), (30, 48)), pin("hand", (16, 82), (44, 34)), pin("belly", (60, 84)), pin("foot", (43, 124))]
    _, report = pose(swung, "hero.png", "swing.png", "--frames", "4", "--spine", "swing.json", bones=[[1, 2], [0, 1]])
    with open("swing.json", encoding="utf-8") as file:
        skeleton = json.load(file)
    rest = {bone["name"]: (bone.get("x", 0), bone.get("y", 0)) for bone in skeleton["bones"]}
    moves = {name: bone["translate"] for name, bone in skeleton["animations"]["pose"]["bones"].items()}
    check(report["certified"] and report["pins_off"] == 0, "an arm that swings")
    for a, b, last in (("shoulder", "elbow", math.dist((48, 58), (30, 48))), ("elbow", "hand", math.dist((30, 48), (44, 34)))):
        lengths = [math.dist([r + m[c] for r, c in zip(rest[a], "xy")], [r + n[c] for r, c in zip(rest[b], "xy")]) for m, n in zip(moves[a], moves[b])]
        first = math.dist(rest[a], rest[b])
        check(all(abs(l - (first + k / 4 * (last - first))) < 1e-6 for k, l in enumerate(lengths)), f"lengths of a bone: {lengths}")


def test_parts():
    """Two parts. One has a hole and a pin; the other one stays. An arm is two pixels from the trunk."""
    limbs = [((20, 20), (20, 70), 12), ((20, 16), (38, 18), 5), ((38, 18), (38, 70), 4), ((80, 60), (90, 60), 14)]
    rows = draw(limbs, holes=[((20, 50), (20, 54), 4), ((88, 60), (88, 60), 4)], width=110, height=90)
    save("parts.png", rows)
    check((pieces(rows, True), pieces(rows, False)) == (2, 3), "the picture of two parts")
    got, report = pose([pin("trunk", (20, 75)), pin("neck", (20, 20)), pin("hand", (38, 70), (62, 30))], "parts.png")
    check(report["certified"] and report["parts"] == 2 and report["pins_off"] == 0, "two parts")
    check((pieces(got, True), pieces(got, False)) == (2, 3), f"pieces {pieces(got, True)}, {pieces(got, False)}")
    x, y = report["corner"]
    same = all(got[v - y][u - x] == rows[v][u] for v in range(46, 75) for u in range(66, 106) if rows[v][u][3] > 0)
    check(same, "a part without pins does not stay")
    comes_from(got, (62 - x, 30 - y), (38, 70), "the hand of one part")


def test_outline():
    """A picture without a transparent ground needs an outline. What is outside stays away."""
    save("scene.png", [[pixel[:3] + [255] for pixel in row] for row in draw([((0, 0), (0, 0), 1)])], channels=3)
    with open("outline.txt", "w", encoding="utf-8") as out:
        out.write("40 20\n80 20\n80 60\n116 60\n116 80\n80 80\n80 130\n40 130\n")
    write_pins("arm.json", [pin("head", (60, 30)), pin("foot", (60, 120)), pin("arm", (110, 70), (100, 20))])
    run(0, "--pins", "arm.json", "--source", "outline.txt", "scene.png", "arm.png", "--json=report.json")
    got = load("arm.png")
    with open("report.json", encoding="utf-8") as file:
        report = json.load(file)
    x, y = report["corner"]
    check(report["certified"] and report["pins_off"] == 0, "a drawn outline")
    comes_from(got, (100 - x, 20 - y), (110, 70), "an arm in a drawn outline")
    check(got[5 - y][5 - x][3] == 0 and pieces(got, True) == 1, "the outside is not transparent")
    refused("--pins", "arm.json", "--source", "missing.txt", "scene.png", "no.png", says="missing.txt")
    write_pins("far.json", [pin("far", (100, 120))])
    refused("--pins", "far.json", "--source", "outline.txt", "scene.png", "no.png", says='pin "far" at 100, 120 is 20 pixels outside of the figure')


def test_trouble():
    at = [pin(*p) for p in PINS]
    write_pins("good.json", at)
    write_pins("outside.json", at + [pin("tail", (4, 4))])
    refused("--pins", "outside.json", "hero.png", "no.png", says='outside.json:1: pin "tail" at 4, 4 is ')
    check("outside of the figure; move it towards " in run(1, "--pins", "outside.json", "hero.png", "no.png").stderr, "no remedy for a pin outside")
    write_pins("twice.json", at + [pin("nose", PINS[0][1])])
    refused("--pins", "twice.json", "hero.png", "no.png", says='pin "nose" is at the place of pin "head"; remove one, or move it')
    save("opaque.png", draw(LIMBS), channels=3)
    refused("--pins", "good.json", "opaque.png", "no.png", says="opaque.png: the picture has no transparent ground")
    save("empty.png", [[[0, 0, 0, 0]] * 9] * 9)
    refused("--pins", "good.json", "empty.png", "no.png", says="transparent everywhere")
    for text, says in (('{"pins": [{"at": [1, 2]}', "the JSON ends early"), ('{"pins": [{"to": [1, 2]}]}', "pins[0].at is not a list of 2 finite numbers"),
                       ('{"pins": [{"at": [60, 24], "too": [1, 2]}]}', "it may have: name, at, to, turn"), ('{"pins": {}}', "pins is not a list"),
                       ('{"pin": []}', 'pins are {"pins": [{"at": [x, y], "to": [x, y]}'), ('{"pins": []}', "there are no pins"),
                       ('{"pins": [{"at": [60, 24], "name": 3}]}', "pins[0].name is not a string"),
                       ('{"pins": [{"at": [60, 24]}], "bones": [[0, 1]]}', "must be a pin, a whole number from 0 to 0"),
                       ('{"pins": [{"at": [60, 24]}], "bones": [[0, 0]]}', "bones[0] begins and ends at one pin"),
                       ('{"pins": [{"at": [60, 24], "turn": 3}, {"at": [60, 84]}], "bones": [[0, 1]]}', "a turn and a bone"),
                       ('{"pins": [{"at": [60, 24], "to": [1e9, 3]}]}', "move them less far")):
        with open("bad.json", "w", encoding="utf-8") as out:
            out.write(text)
        refused("--pins", "bad.json", "hero.png", "no.png", says=says)
    refused("--pins", "missing.json", "hero.png", "no.png", says="missing.json")
    refused("hero.png", "no.png", says="--pose FILE is missing, or --pins FILE", rc=2)
    refused("--pins", "good.json", "--certified", "hero.png", "no.png", says="--certified does not go with --pins", rc=2)
    refused("--handles", "good.json", "--pose", "good.json", "--frames", "3", "hero.png", "no.png", says="--frames goes with --pins", rc=2)
    refused("--pins", "good.json", "--rate", "3", "hero.png", "no.png", says="--rate goes with --frames", rc=2)
    refused("--pins", "good.json", "--spine", "good.json", "hero.png", "no.png", says="over an input", rc=2)
    refused("--pins", "good.json", "hero.png", "hero.png", says="over an input", rc=2)
    # The same file is control points of a fit, but for turns and bones.
    for text, rc in (({"pins": at}, 0), ({"pins": at + [pin("chin", (60, 36), turn=3)]}, 1)):
        with open("fit.json", "w", encoding="utf-8") as out:
            json.dump(text, out)
        got = subprocess.run([TOOL, "fit", "fit.json"], capture_output=True, text=True, check=False)
        check(got.returncode == rc and ("point left hand" in got.stdout if rc == 0 else "takes turns and bones" in got.stderr), f"fit: {got.stderr}")
    # Pins that cannot be reached are told, and the picture is certified all the same.
    clash = [pin(name, at, (60, 60) if "hand" in name else to) for name, at, to in PINS]
    _, report = pose(clash, rc=4)
    check(report["certified"] and report["pins_off"] >= 2 and report["pins"][2]["off"] > 1, "two pins that go to one place")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    hero = draw(LIMBS)
    save("hero.png", hero)
    test_pose(hero)
    test_frames(hero)
    test_growth()
    test_turns_and_bones()
    test_parts()
    test_outline()
    test_trouble()
    if N_FAILED == 0:
        os.chdir("/")
        shutil.rmtree(SCRATCH)
    return min(N_FAILED, 1)


if __name__ == "__main__":
    sys.exit(main())
