#!/bin/sh
# Surfaces as other programs write them: STL, PLY and OFF of meshio, binary glTF of assimp; and what those read of ours.
# usage: test_surface_files.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
if ! /usr/bin/python3 -c 'import meshio' 2>/dev/null; then
    echo "skipped: meshio is missing"
    exit 77
fi
make_cubes
printf '0.25 0.5 0.75\n0.5 0.5 0.5\n0.9 0.1 0.3\n' >points.txt

# meshio FORMAT: what becomes of cube.obj and moved.obj, as cube.FORMAT and moved.FORMAT.
meshio_writes() {
    /usr/bin/python3 - "$@" <<'END' || complain "meshio writes no $1"
import sys
import meshio
for name in ('cube', 'moved'):
    mesh = meshio.read(name + '.obj')
    mesh = meshio.Mesh(mesh.points, [('triangle', mesh.cells_dict['triangle'].astype('int32'))])
    meshio.write(name + '.' + sys.argv[1], mesh, file_format=sys.argv[2], **eval(sys.argv[3]))
END
}
meshio_writes text.stl stl 'dict(binary=False)'
meshio_writes binary.stl stl 'dict(binary=True)'
meshio_writes text.ply ply 'dict(binary=False)'
meshio_writes binary.ply ply 'dict(binary=True)'
meshio_writes off off 'dict()'

# The same cage, whatever the file: STL when its corners are joined, in which order they come there does not matter.
run 0 map -s cube.obj -t moved.obj -m field -n 8 -p points.txt
cp out expected
for kind in text.ply binary.ply off text.stl binary.stl; do
    run 0 map -s cube.$kind -t moved.$kind -m field -n 8 -p points.txt --weld
    close_to out expected 1e-12
done
run 0 mesh --fill --weld cube.binary.stl filled.mesh
holds filled.mesh 'Tetrahedra'

# Without --weld it is said what is missing; in the plane there is nothing to join.
run 1 map -s cube.text.stl -t moved.text.stl -m field -n 8 -p points.txt
says '28 vertices coincide with others, as those of STL do: --weld joins them'
printf '0 0\n1 0\n1 1\n' >plane.txt
run 1 map -s plane.txt -t plane.txt --weld -p points.txt
says 'libicc: plane.txt: this is not a surface in space; --weld needs one'
run 2 map -s plane.txt -t plane.txt --weld=-1 -p points.txt
run 2 map -s plane.txt -t plane.txt --weld=x -p points.txt

# Corners that are nearly at one place, as rounding leaves them.
awk '/vertex/ { print "vertex", $2 + 1e-7 * (NR % 3), $3 - 1e-7 * (NR % 2), $4; next } { print }' cube.text.stl >rough.stl
run 1 info -s rough.stl -m field -n 8 --weld
run 1 info -s rough.stl -m field -n 8 --weld=1e-8
run 0 info -s rough.stl -m field -n 8 --weld=1e-6
holds out 'cage        8 vertices, 12 facets'
run 1 info -s rough.stl -m field -n 8 --weld=2

# What mends a surface writes each format; all hold the same doubles.
printf 'v 0.1 0 0\nv 1 0 0\nv 0 0.3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >thirds.obj
printf '0.2 0.1 0.2\n' >inner.txt
run 0 map -s thirds.obj -t thirds.obj -m field -n 8 -p inner.txt
cp out expected
for kind in obj off ply stl; do
    "$tool" check -s thirds.obj --method field -n 8 --repair mended.$kind >out 2>err
    run 0 map -s mended.$kind -t mended.$kind -m field -n 8 -p inner.txt --weld
    same out expected "mended.$kind"
    /usr/bin/python3 -c "import meshio; m = meshio.read('mended.$kind'); assert len(m.cells_dict['triangle']) == 4" ||
        complain "meshio does not read mended.$kind"
done
run 0 map -s cube.obj -t moved.obj -m field -n 8 -p points.txt
cp out expected

# Carried along: the corners move, the normals are computed again, colours and names stay.
sed 's/^solid.*/solid a name # of two/; s/^endsolid.*/endsolid of two/' cube.text.stl >name.stl
run 0 mesh -s cube.obj -t moved.obj -m field -n 8 name.stl out.stl
head -n 1 out.stl | cmp -s - name.head 2>/dev/null || head -n 1 out.stl | grep -qx 'solid a name # of two' ||
    complain "the name of the solid has changed"
tail -n 1 out.stl | grep -qx 'endsolid of two' || complain "the end has changed"
run 0 mesh -s cube.obj -t moved.obj -m field -n 8 cube.binary.stl out.binary.stl
run 2 mesh -s cube.obj -t moved.obj cube.binary.stl out.obj
run 2 mesh -s cube.obj -t moved.obj cube.obj out.stl
/usr/bin/python3 - <<'END' || complain "meshio reads something else than the moved cube"
import meshio
import numpy as np
moved = meshio.read('moved.obj')
triangles = moved.points[moved.cells_dict['triangle']]
normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
normals /= np.linalg.norm(normals, axis=1)[:, None]
for name in 'out.stl', 'out.binary.stl':
    mesh = meshio.read(name)
    got = mesh.points[mesh.cells_dict['triangle']]
    assert np.abs(got - triangles).max() < 1e-6, (name, np.abs(got - triangles).max())
data = open('out.binary.stl', 'rb').read()
assert len(data) == 84 + 50 * 12 and data[:84] == open('cube.binary.stl', 'rb').read()[:84]
records = np.frombuffer(data[84:], dtype=[('n', '<f4', 3), ('p', '<f4', (3, 3)), ('c', '<u2')])
assert np.abs(records['n'] - normals).max() < 1e-6
text = [line.split()[2:] for line in open('out.stl') if 'normal' in line]
assert np.abs(np.array(text, dtype=float) - normals).max() < 1e-6
END

# What is wrong with a file, and where.
rejects() { # MESSAGE
    cat >bad.stl
    run 1 info -s bad.stl --weld
    says "libicc: bad.stl:$1"
}
sed '4s/0.0/x/' cube.text.stl | rejects "4: 'x' is not a finite number"
sed '2s/normal.*/normal 0 1/' cube.text.stl | rejects '2: a normal has three numbers'
sed '3d' cube.text.stl | rejects "3: 'vertex' where 'outer' is expected"
sed '$d' cube.text.stl | rejects "86: the file ends early"
sed '6d' cube.text.stl | rejects "6: 'endloop' where 'vertex' is expected"
{ head -c 96 cube.binary.stl && bytes 0 0 192 127 && tail -c +101 cube.binary.stl; } |
    rejects ' byte 96: a corner of triangle 0 (from 0) is not finite'

# Images beyond the range of floats are refused; doubles hold them.
printf '0 0\n1 0\n1 1\n0 1\n' >small.txt
printf '0 0\n1e39 0\n1e39 1e39\n0 1e39\n' >large.txt
printf 'solid\nfacet normal 0 0 1\nouter loop\nvertex .2 .2 7\nvertex .8 .2 7\nvertex .2 .8 7\nendloop\nendfacet\nendsolid\n' >one.stl
run 0 mesh -s small.txt -t large.txt one.stl out.stl
holds out '1 triangles: 1 keep their orientation'
[ "$(grep -c 'vertex .* 7$' out.stl)" = 3 ] || complain "z has changed"
{ head -c 80 cube.binary.stl && bytes 1 0 0 0 && head -c 134 cube.binary.stl | tail -c 50; } >one.binary.stl
run 1 mesh -s small.txt -t large.txt --outside keep one.binary.stl out.binary.stl
says 'is too large for STL'

# Binary glTF. glb.py NAME [CHANGE]: cube.obj or moved.obj as two primitives, whose corners lie between normals; CHANGE is
# Python that may spoil the parts of the file.
cat >glb.py <<'END'
import json
import struct
import sys
import numpy as np
corners = [list(map(float, line.split()[1:])) for line in open(sys.argv[1] + '.obj') if line[0] == 'v']
faces = np.array([list(map(int, line.split()[1:])) for line in open(sys.argv[1] + '.obj') if line[0] == 'f']) - 1
n, half = len(corners), len(faces) // 2
data = b'12345678' + np.hstack([corners, np.zeros((n, 3))]).astype('<f4').tobytes()
at = len(data)
data += faces[:half].astype('<u2').tobytes() + faces[half:].astype('u1').tobytes() + b'\0\0'
view = lambda at, n, **more: {'buffer': 0, 'byteOffset': at, 'byteLength': n, **more}
points = lambda at: {'bufferView': 0, 'byteOffset': at, 'componentType': 5126, 'count': n, 'type': 'VEC3'}
indices = lambda view, kind: {'bufferView': view, 'componentType': kind, 'count': 3 * half, 'type': 'SCALAR'}
part = lambda k: {'attributes': {'POSITION': 0, 'NORMAL': 1}, 'indices': k}
gltf = {'asset': {'version': '2.0', 'extras': {'note': 'é "kept"'}}, 'buffers': [{'byteLength': len(data)}],
        'bufferViews': [view(8, at - 8, byteStride=24), view(at, 6 * half), view(at + 6 * half, 3 * half)],
        'accessors': [points(0) | {'min': [0, 0, 0], 'max': [1, 1, 1]}, points(12), indices(1, 5123), indices(2, 5121)],
        'meshes': [{'primitives': [part(2), part(3)]}], 'scene': 0, 'scenes': [{'nodes': [1]}],
        'nodes': [{'mesh': 0, 'name': 'a cube'}, {'children': [0]}]}
accessors, views, nodes, parts = gltf['accessors'], gltf['bufferViews'], gltf['nodes'], gltf['meshes'][0]['primitives']
version = 2
exec(sys.argv[2] if len(sys.argv) > 2 else '')
text = json.dumps(gltf, indent=1).encode()
text += b' ' * (-len(text) % 4)
chunk = lambda kind, data: struct.pack('<I4s', len(data), kind) + data
chunks = chunk(b'JSON', text) + chunk(b'BIN\0', data)
sys.stdout.buffer.write(struct.pack('<4sII', b'glTF', version, 12 + len(chunks)) + chunks)
END
glb() { /usr/bin/python3 glb.py "$@" || complain "no glTF file was made: $*"; }
glb cube >cube.glb
glb moved >moved.glb
run 0 map -s cube.glb -t moved.glb -m field -n 8 -p points.txt
same out expected 'glTF'
run 0 mesh -s cube.obj -t moved.obj -m field -n 8 cube.glb out.glb
run 0 mesh -s cube.obj -t moved.obj -m field -n 8 - - <cube.glb
same out out.glb 'glTF through pipes'
/usr/bin/python3 - <<'END' || complain "a glTF file that was carried along is not what it should be"
import json
import struct
import numpy as np
def parts(name):
    data = open(name, 'rb').read()
    magic, version, total, n = struct.unpack('<4sIII', data[:16])
    assert magic == b'glTF' and total == len(data) and n % 4 == 0
    n_bin, kind = struct.unpack('<I4s', data[20 + n:28 + n])
    assert kind == b'BIN\0' and n_bin == len(data) - n - 28
    return json.loads(data[20:20 + n]), data[28 + n:]
old, before = parts('cube.glb')
new, after = parts('out.glb')
moved = np.loadtxt('moved.txt').astype('f4')
got = np.frombuffer(after[8:200], '<f4').reshape(8, 6)
assert np.abs(got[:, :3] - moved).max() < 1e-6 and not got[:, 3:].any()
assert after[:8] == before[:8] and after[200:] == before[200:] and len(after) == len(before)
assert new['accessors'][0].pop('min') == got[:, :3].min(axis=0).tolist()
assert new['accessors'][0].pop('max') == got[:, :3].max(axis=0).tolist()
del old['accessors'][0]['min'], old['accessors'][0]['max']
assert new == old
END

# Strips and fans are triangles as well; points and lines have none.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >four.obj
printf '0.1 0.1 0.1\n' >inside.txt
run 0 map -s four.obj -t four.obj -m field -n 8 -p inside.txt
cp out expected
add="def add(corners, mode):
    global data
    views.append(view(len(data), 2 * len(corners)))
    data += np.array(corners, '<u2').tobytes()
    accessors.append(indices(len(views) - 1, 5123) | {'count': len(corners)})
    return part(len(accessors) - 1) | {'mode': mode}
gltf['meshes'][0]['primitives'] ="
glb four "$add [add([0, 3, 2, 1, 0, 3], 5), add([0, 1], 1)]" >strip.glb
glb four "$add [add([0, 3, 2, 1, 3], 6), add([1, 2, 3], 4), add([1], 0)]" >fan.glb
for name in strip fan; do
    run 0 map -s $name.glb -t $name.glb -m field -n 8 -p inside.txt
    close_to out expected 1e-12
done

refuses() { # MESSAGE CHANGE
    glb cube "$2" >bad.glb
    run 1 info -s bad.glb
    says 'libicc: bad.glb: '
    says "$1"
}
refuses 'byte 4: this is glTF version 1; libicc reads version 2' 'version = 1'
refuses "nodes[0].matrix has a last row that is not 0 0 0 1" "nodes[0]['matrix'] = [2] + 15 * [0]"
refuses 'accessors[0], for POSITION, is not of three floats' "accessors[0]['componentType'] = 5123"
refuses 'accessors[2], for indices, is not of whole numbers' "accessors[2]['type'] = 'VEC2'"
refuses 'accessors[0], for POSITION, is sparse or compressed' "accessors[0]['sparse'] = {}"
refuses 'accessors[0] has 9 items from byte 0 on, which bufferViews[0] has not' "accessors[0]['count'] = 9"
refuses 'bufferViews[1] has bytes' "views[1]['byteLength'] = 1000"
refuses 'bufferViews[0] is not in the file' "views[0]['buffer'] = 1"
refuses 'bufferViews[0] is compressed' "views[0]['extensions'] = {'EXT_meshopt_compression': {}}"
refuses 'a mesh is compressed (Draco)' "parts[0]['extensions'] = {'KHR_draco_mesh_compression': {}}"
refuses 'a primitive has no POSITION' "del parts[1]['attributes']['POSITION']"
refuses 'a primitive of triangles has 17 corners' "accessors[2]['count'] = 17"
refuses 'POSITION must be a glTF accessor, a whole number from 0 to 3' "parts[0]['attributes']['POSITION'] = 4"
refuses 'accessors[0] and accessors[1] overlap' "parts[1]['attributes']['POSITION'] = 1"
refuses 'index 0 of accessors[2] is 65535; there are 8' "data = data[:at] + b'\377\377' + data[at + 2:]"
refuses 'vertex 0 of accessors[0] is not finite' "data = data[:8] + struct.pack('<f', np.inf) + data[12:]"
head -c 300 cube.glb >bad.glb
run 1 info -s bad.glb
says 'byte 8: the file should have'
printf '{"asset":{"version":"2.0"},"meshes":[]}' >bad.gltf
run 1 info -s bad.gltf
says 'there are no vertices'

# assimp reads what was carried along, and what it writes is read.
if command -v assimp >/dev/null; then
    assimp export cube.obj assimp.glb >log || complain "assimp writes no glTF: $(cat log)"
    assimp export out.glb assimp.obj >log || complain "assimp does not read glTF of ours: $(cat log)"
    run 0 info -s assimp.glb -m field -n 8 --weld
    holds out 'cage        8 vertices, 12 facets'
    grep '^v ' assimp.obj | cut -d ' ' -f 2- | sort -u >got
    awk '{ print $1 + 0, $2 + 0, $3 + 0 }' got | sort -u >got.sorted
    awk '{ print $1 + 0, $2 + 0, $3 + 0 }' moved.txt | sort -u >moved.sorted
    close_to got.sorted moved.sorted 1e-6
fi
finish
