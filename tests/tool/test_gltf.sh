#!/bin/sh
# Scenes of glTF that are carried along: what nodes do, morph targets, normals and tangents, skins; and normals of OBJ, PLY and
# VTK. Files are made and looked at with NumPy alone.
# usage: test_gltf.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
if ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    echo "skipped: NumPy is missing"
    exit 77
fi

printf '%s\n' "$tool" >tool
cp "$here/gltf_scene.py" scene.py
/usr/bin/python3 -c 'import scene' || complain "no cages"
python() {
    { printf 'from scene import *\n' && cat; } >case.py
    /usr/bin/python3 case.py || complain "$1"
}

python 'nodes, morph targets, normals and tangents' <<'END'
v, f, normals, tangents = ball()
rng = np.random.RandomState(3)
deltas = [np.where(v[:, :1] > 0, [0, .3, .2], 0), .2 * v * rng.rand(len(v), 1)]
turned = [unit(normals + .3 * rng.randn(len(v), 3)) - normals for _ in deltas]
twisted = [.1 * rng.randn(len(v), 3) for _ in deltas]
child = {'matrix': [.8, 0, .1, 0, 0, 1.1, 0, 0, -.2, 0, .9, 0, .3, -.2, .1, 1]}
for parent in ({}, {'translation': [1, -.5, .25]}, {'rotation': [0, 0, 3, 4], 'scale': [1, 2, .5], 'translation': [.2, .1, 0]}, {'scale': [-1, 1, 1]}, {'scale': [1e-3] * 3}):
    for inner in ({}, child, {'scale': [1e3, 900, 1e3]}):
        m = matrix(parent) @ matrix(inner)
        if not .1 < np.linalg.norm(m[:3, :3], 2) < 3:
            continue
        s = Scene()
        s.mesh(v, f, normals, tangents, [{'POSITION': d, 'NORMAL': t, 'TANGENT': w} for d, t, w in zip(deltas, turned, twisted)])
        s.node(name='up', children=[1], **parent), s.node(mesh=0, **inner)
        s.write('in.glb')
        before = Read('in.glb')
        p = before.part()
        old = {k: before.array(i) for k, i in p['attributes'].items()}
        for target, linear in (('sheared.obj', True), ('bent.obj', False)):
            out, err = run(0, 'mesh', '-s', 'box.obj', '-t', target, 'in.glb', 'out.glb')
            assert err == '', err
            after = Read('out.glb')
            assert after.part() == p and after.tree['nodes'] == before.tree['nodes']
            new = {k: after.array(i) for k, i in p['attributes'].items()}
            scene = apply(m, old['POSITION'])
            assert np.abs(apply(m, new['POSITION']) - mapped(target, scene)).max() < 3e-6
            for k, t in enumerate(p['targets']):
                want = mapped(target, apply(m, old['POSITION'] + before.array(t['POSITION'])))
                assert np.abs(apply(m, new['POSITION'] + after.array(t['POSITION'])) - want).max() < 3e-6, (parent, inner)
            still = (before.array(p['targets'][0]['POSITION']) == 0).all(1)
            assert still.any() and (after.array(p['targets'][0]['POSITION'])[still] == 0).all()
            # Directions: those of finite differences, away from kinks, from the map of tangent vectors.
            l, inverse = m[:3, :3], np.linalg.inv(m[:3, :3])
            def derivative(q):
                h = 1e-6
                return np.stack([(mapped(target, q + h * e) - mapped(target, q - h * e)) / (2 * h) for e in np.eye(3)], -1)
            def directions(q, n, t):
                j = derivative(q)
                n = np.einsum('nji,nj->ni', np.linalg.inv(j), n @ inverse)
                t = np.einsum('nij,nj->ni', j, t @ l.T)
                return unit(n @ l), unit(t @ inverse.T)
            def near(got, want):
                off = np.linalg.norm(unit(got) - want, axis=1)
                assert (off.max() if linear else np.quantile(off, .85)) < 2e-5, (parent, inner, target, off)
            n, t = directions(scene, old['NORMAL'], old['TANGENT'][:, :3])
            near(new['NORMAL'], n), near(new['TANGENT'][:, :3], t)
            assert np.abs(np.linalg.norm(new['NORMAL'], axis=1) - 1).max() < 1e-6 and (new['TANGENT'][:, 3] == old['TANGENT'][:, 3]).all()
            for x in p['targets']:
                n, t = directions(apply(m, old['POSITION'] + before.array(x['POSITION'])), old['NORMAL'] + before.array(x['NORMAL']),
                                  old['TANGENT'][:, :3] + before.array(x['TANGENT']))
                near(new['NORMAL'] + after.array(x['NORMAL']), n), near(new['TANGENT'][:, :3] + after.array(x['TANGENT']), t)
            # There and back.
            run(0, 'mesh', '-i', '-s', 'box.obj', '-t', target, 'out.glb', 'back.glb')
            back = Read('back.glb')
            for i in (*p['attributes'].values(), *(i for x in p['targets'] for i in x.values())):
                off = np.abs(back.array(i) - before.array(i)).max(1)
                scale = 1 / np.linalg.norm(l, 2)
                assert (off.max() if linear else np.quantile(off, .8)) < 3e-5 * max(1, scale), (i, off)
            # All other bytes are as they were.
            mask = np.ones(len(before.body), bool)
            for i in (*p['attributes'].values(), *(i for x in p['targets'] for i in x.values())):
                view = before.tree['bufferViews'][before.tree['accessors'][i]['bufferView']]
                mask[view['byteOffset']:view['byteOffset'] + view['byteLength']] = False
            a, b = np.frombuffer(before.body, 'u1'), np.frombuffer(after.body, 'u1')
            assert len(a) == len(b) and (a[mask] == b[mask]).all()
END

python 'the text of the JSON stays, but for bounds' <<'END'
import re
v, f, *_ = ball()
for missing in ((), ('min',), ('max',), ('min', 'max')):
    s = Scene()
    s.mesh(v, f), s.node(mesh=0, extras={'price': 0, 'name': 'é'})
    for side in missing:
        del s.tree['accessors'][0][side]
    s.write('in.glb')
    before = json.dumps(s.tree, indent=1).replace('"price": 0', '"price": 1.10')
    s.write('in.glb', before)
    run(0, 'mesh', '-s', 'box.obj', '-t', 'sheared.obj', 'in.glb', 'out.glb')
    after = Read('out.glb')
    assert after.tree['accessors'][0].keys() >= {'min', 'max'}
    after.array(0)
    raw = open('out.glb', 'rb').read()
    after = raw[20:20 + struct.unpack('<I', raw[12:16])[0]].decode().rstrip()
    bare = [re.sub(r'("(?:min|max)": )\[[^]]*\]', r'\1', re.sub(r',"(?:min|max)":\[[^]]*\]', '', text)) for text in (before, after)]
    assert bare[0] == bare[1] and before != after, bare
END

python 'a cage that nodes place is a cage in the scene, whichever way they turn it' <<'END'
points = np.array([[.1, .2, .3], [-1, 2, 1], [3, -3, 2]])
for node in ({'scale': [2, 3, 4], 'translation': [1, 1, 1]}, {'scale': [-2, 3, 4]}, {'rotation': [1, 0, 0, 1]}):
    s = Scene()
    inner = np.linalg.inv(matrix(node))
    s.mesh(apply(inner, box), box_faces if np.linalg.det(inner[:3, :3]) > 0 else [(a, c, b) for a, b, c in box_faces])
    s.node(mesh=0, **node)
    s.write('cage.glb')
    out = run(0, 'check', '-s', 'cage.glb', '-m', 'foliation')[0]
    assert 'facing outward, volume 51' in out, out
    got = run(0, 'map', '-s', 'cage.glb', '-t', 'sheared.obj', text=''.join('%g %g %g\n' % tuple(x) for x in points))[0]
    got = np.array([x.split() for x in got.split('\n') if x], float)
    assert np.abs(got - points @ shear.T).max() < 1e-5, got
END

python 'a mesh at several places is copied' <<'END'
v, f, normals, tangents = ball(4)
places = [{}, {'translation': [1, -1, 2]}, {'scale': [-1, 1, .5]}, {}, {'translation': [1, -1, 2]}, {'rotation': [0, 0, 3, 4]}]
for form in ('in.glb', 'in.gltf'):
    s = Scene()
    s.mesh(v, f, normals, tangents, [{'POSITION': .1 * v, 'TANGENT': .1 * v}])
    # Another mesh with the same positions, and one apart.
    s.tree['meshes'].append(s.tree['meshes'][0])
    s.mesh(v / 2, f)
    for x in places:
        s.node(mesh=0, **x)
    s.node(mesh=1), s.node(mesh=1, scale=[2, 2, 2]), s.node(mesh=2)
    s.write(form)
    for target in ('sheared.obj', 'bent.obj'):
        err = run(0, 'mesh', '-s', 'box.obj', '-t', target, form, 'out.glb')[1]
        assert err == 'libicc: %s: nodes draw one mesh at several places, so 4 copies of meshes were made\n' % form, err
        before, after = Read(form), Read('out.glb')
        meshes = [x['mesh'] for x in after.tree['nodes']]
        assert meshes == [0, 3, 4, 0, 3, 5, 1, 6, 2], meshes
        for old, new in zip(before.tree['nodes'], after.tree['nodes']):
            m, p, q = matrix(old), before.part(old['mesh']), after.part(new['mesh'])
            assert matrix(new).tolist() == m.tolist() and p['indices'] == q['indices']
            a, b = before.array(p['attributes']['POSITION']), after.array(q['attributes']['POSITION'])
            assert np.abs(apply(m, b) - mapped(target, apply(m, a))).max() < 3e-6
            if 'targets' in p:
                a, b = a + before.array(p['targets'][0]['POSITION']), b + after.array(q['targets'][0]['POSITION'])
                assert np.abs(apply(m, b) - mapped(target, apply(m, a))).max() < 3e-6
                l = m[:3, :3]
                if target == 'sheared.obj':
                    want = unit(unit(before.array(p['attributes']['NORMAL']) @ np.linalg.inv(l) @ np.linalg.inv(shear)) @ l)
                    assert np.abs(unit(after.array(q['attributes']['NORMAL'])) - want).max() < 2e-5
                    want = unit(before.array(p['attributes']['TANGENT'])[:, :3] @ l.T @ shear.T @ np.linalg.inv(l).T)
                    assert np.abs(after.array(q['attributes']['TANGENT'])[:, :3] - want).max() < 2e-5
        # The result has a mesh for each place, so nothing is copied again.
        assert run(0, 'mesh', '-i', '-s', 'box.obj', '-t', target, 'out.glb', 'back.gltf')[1] == ''
        assert len(Read('back.gltf').tree['meshes']) == 7
END

python 'what is refused, by name' <<'END'
v, f, normals, tangents = ball(4)
def refused(message, make, code=1, command=('check', '-s', 'bad.glb')):
    s = Scene()
    s.mesh(v, f, normals)
    make(s)
    s.write('bad.glb')
    err = run(code, *command)[1]
    assert message in err and err.count('\n') == 1, err
mesh = ('mesh', '-s', 'box.obj', '-t', 'sheared.obj', 'bad.glb', 'no.glb')
one = {'mesh': 0, 'name': 'one'}
refused("nodes[1] ('one') flattens its mesh", lambda s: (s.node(scale=[1, 0, 1], children=[1]), s.node(**one)))
refused("nodes[0] ('one') flattens its mesh", lambda s: s.node(**one, matrix=[1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0, 0, 0, 0, 1]))
refused('nodes[0] is among its own children', lambda s: (s.node(**one, children=[1]), s.node(children=[0])))
refused('nodes[2] is a child twice', lambda s: (s.node(children=[2]), s.node(children=[2]), s.node(**one)))
refused("nodes[0] ('one') stands for many copies", lambda s: s.node(**one, extensions={'EXT_mesh_gpu_instancing': {}}))
refused('nodes[0].rotation is not a rotation', lambda s: s.node(**one, rotation=[0, 0, 0, 0]))
refused('nodes[0].scale is not a list of 3 finite numbers', lambda s: s.node(**one, scale=[1, 2]))
refused('mesh must be a glTF mesh, a whole number from 0 to 0', lambda s: s.node(mesh=1))
refused('children must be a glTF node, a whole number from 0 to 0', lambda s: s.node(**one, children=[1]))
def sparse(s):
    s.tree['meshes'][0]['primitives'][0]['targets'] = [{'POSITION': s.array(v, sparse={})}]
    s.node(**one)
refused("for a morph target's POSITION, is sparse", sparse, 1, mesh)
def shared(s):
    s.mesh(v + 1, f)
    d = s.array(.1 * v)
    for m in s.tree['meshes']:
        m['primitives'][0]['targets'] = [{'POSITION': d}]
    s.node(**one), s.node(mesh=1)
refused('displaces several meshes, whose images differ', shared, 1, mesh)
def overlapping(s):
    p = s.tree['meshes'][0]['primitives'][0]['attributes']
    s.array(v)
    s.tree['accessors'][-1]['bufferView'] = s.tree['accessors'][p['NORMAL']]['bufferView']
    p['TANGENT'] = s.array(tangents)
    s.tree['accessors'][-1].update(bufferView=s.tree['accessors'][p['POSITION']]['bufferView'], count=len(v) // 2)
    s.tree['meshes'][0]['primitives'][0]['targets'] = [{'POSITION': len(s.tree['accessors']) - 2}]
    s.node(**one)
refused('shares bytes with another one', overlapping, 1, mesh)
def indices(name):
    def make(s):
        p = s.tree['meshes'][0]['primitives'][0]
        p['attributes']['TANGENT'] = s.array(np.zeros((len(v), 4)))
        s.tree['accessors'][p['indices']].update(bufferView=s.tree['accessors'][p['attributes'][name]]['bufferView'], count=3)
        s.node(**one)
    return make
refused('accessors[1], for indices, shares bytes with vertices', indices('POSITION'))
refused('accessors[1], for indices, shares bytes with vertices', indices('TANGENT'), 1, mesh)
def far(s):
    s.tree['meshes'][0]['primitives'][0]['targets'] = [{'POSITION': s.array(9 * v)}]
    s.node(**one)
refused('morph targets move', far, 4, mesh)
import os
assert not os.path.exists('no.glb')
err = run(4, *mesh, '--outside', 'keep')[1]
assert 'these stay there' in err and os.path.exists('no.glb'), err
END

python 'what stays, and is said to' <<'END'
v, f, normals, tangents = ball(5)
# A skin without inverse bind matrices: its joint moves it and stays.
s = Scene()
s.mesh(v, f, normals)
s.node(mesh=0, skin=0, children=[1], translation=[90, 0, 0]), s.node(translation=[-90, .5, 0])
s.tree['skins'] = [{'joints': [1]}]
s.tree['animations'] = [{'channels': [{'sampler': 0, 'target': {'node': 1, 'path': 'rotation'}}], 'samplers': []}]
s.write('in.glb')
out, err = run(0, 'mesh', '-s', 'box.obj', '-t', 'sheared.obj', 'in.glb', 'out.glb')
assert err == 'libicc: in.glb: skins[0] stays as it is (joints and inverse bind matrices): it has no inverse bind matrices\nlibicc: in.glb: animations of nodes stay as they are\n', err
assert np.abs(Read('out.glb').array(0) + [0, .5, 0] - (v + [0, .5, 0]) @ shear.T).max() < 2e-6
# Two nodes that do the same draw one mesh; a mesh that none draws is where its positions are.
s = Scene()
s.mesh(v, f), s.mesh(v / 2, f)
s.node(mesh=0, scale=[2, 2, 2]), s.node(mesh=0, scale=[2, 2, 2])
s.write('in.glb')
assert run(0, 'mesh', '-s', 'box.obj', '-t', 'sheared.obj', 'in.glb', 'out.glb')[1] == ''
for mesh, p in ((0, v), (1, v / 2)):
    got = Read('out.glb')
    assert np.abs(got.array(got.part(mesh)['attributes']['POSITION']) - p @ shear.T).max() < 2e-6
# Normals of two meshes, or of bytes.
s = Scene()
s.mesh(v, f, normals), s.mesh(v / 2, f)
s.tree['meshes'][1]['primitives'][0]['attributes']['NORMAL'] = s.tree['meshes'][0]['primitives'][0]['attributes']['NORMAL']
s.node(mesh=0), s.node(mesh=1)
s.write('in.glb')
err = run(0, 'mesh', '-s', 'box.obj', '-t', 'sheared.obj', 'in.glb', 'out.glb')[1]
assert err == 'libicc: in.glb: some normals or tangents stay as they are\n', err
assert np.array_equal(Read('out.glb').array(2), Read('in.glb').array(2))
# On the boundary, where there is no derivative, it is taken beside it.
s = Scene()
s.mesh(box, box_faces, unit(box), targets=[{'POSITION': -.1 * box}])
s.node(mesh=0)
s.write('in.glb')
assert run(0, 'mesh', '-s', 'box.obj', '-t', 'sheared.obj', 'in.glb', 'out.glb')[1] == ''
got = Read('out.glb')
assert np.abs(got.array(2) - unit(unit(box) @ np.linalg.inv(shear))).max() < 1e-5
assert np.abs(got.array(3) + .1 * box @ shear.T).max() < 1e-5
END

python 'normals of OBJ, PLY and VTK' <<'END'
v, f, normals, _ = ball(5)
want = unit(normals @ np.linalg.inv(shear))
carry = lambda a, b, target='sheared.obj': run(0, 'mesh', '-s', 'box.obj', '-t', target, a, b)[1]
def numbers(name, begin):
    return np.array([x.split()[1:4] for x in open(name) if x.startswith(begin)], float)
# OBJ: by slashes, from 1 or backwards, before or behind the vertices, of another length; one that no face has stays.
for form in ('%d//%d', '%d/7/%d'):
    for back in (False, True):
        for first in (False, True):
            n = ['vn %.9g %.9g %.9g # normal\n' % tuple(3 * x) for x in normals] + ['vn 0 0 5\n', 'vn nan x\n']
            p = ['v %.9g %.9g %.9g\n' % tuple(x) for x in v]
            corner = lambda i: form % ((i - len(v), i - len(normals) - 2) if back else (i + 1, i + 1))
            with open('in.obj', 'w') as o:
                o.writelines(['# a ball\n', *(n + p if first else p + n), 'vt 0 0\n' * 7, 'usemtl a\n', *('f ' + ' '.join(map(corner, t)) + '\n' for t in f)])
            assert carry('in.obj', 'out.obj') == ''
            a, b = open('in.obj').read().split('\n'), open('out.obj').read().split('\n')
            assert len(a) == len(b) and all(x == y for x, y in zip(a, b) if not x.startswith('v ') and not x.startswith('vn ')) and 'vn 0 0 5' in b and 'vn nan x' in b
            got = np.array([x.split()[1:4] for x in b if x.startswith('vn ') and 'normal' in x], float)
            assert all(x.endswith(' # normal') for x in b if x.startswith('vn ') and 'nan' not in x and x != 'vn 0 0 5')
            assert np.abs(got - 3 * want).max() < 1e-7 and np.abs(numbers('out.obj', 'v ') - v @ shear.T).max() < 1e-7
# One of many vertices: the mean, and how far off.
with open('in.obj', 'w') as o:
    o.writelines(['v %.9g %.9g %.9g\n' % tuple(x) for x in v] + ['vn 0 0 1\n'] + ['f ' + ' '.join('%d//1' % (i + 1) for i in t) + '\n' for t in f])
assert carry('in.obj', 'out.obj') == ''
assert np.abs(numbers('out.obj', 'vn ') - unit(np.array([[0, 0, 1]]) @ np.linalg.inv(shear))).max() < 1e-9
err = carry('in.obj', 'out.obj', 'bent.obj')
assert 'normals of several vertices become the mean of their images, off by up to ' in err, err
with open('in.obj', 'a') as o:
    o.write('\n')
open('bare.obj', 'w').write(open('in.obj').read().replace('//1', ''))
assert 'stay as they are' in carry('bare.obj', 'out.obj')
# PLY as text and as binary of both orders, in any order of properties.
for form, order in (('ascii', ''), ('binary_little_endian', '<'), ('binary_big_endian', '>')):
    for kind, names in (('float', 'x y z nx ny nz'), ('double', 'nz x nx y ny red z')):
        names = names.split()
        head = 'ply\nformat %s 1.0\nelement vertex %d\n' % (form, len(v)) + ''.join('property %s %s\n' % ('uchar' if x == 'red' else kind, x) for x in names)
        head += 'element face %d\nproperty list uchar int vertex_indices\nend_header\n' % len(f)
        column = dict(zip('x y z nx ny nz'.split(), np.c_[v, normals].T), red=np.full(len(v), 7))
        types = np.dtype([(x, 'u1' if x == 'red' else (order or '<') + ('f4' if kind == 'float' else 'f8')) for x in names])
        rows = np.zeros(len(v), types)
        for x in names:
            rows[x] = column[x]
        faces = np.zeros(len(f), np.dtype([('n', 'u1'), ('i', (order or '<') + 'i4', 3)]))
        faces['n'], faces['i'] = 3, f
        with open('in.ply', 'wb') as o:
            o.write(head.encode())
            o.write(rows.tobytes() + faces.tobytes() if order else ''.join(' '.join(repr(float(x)) if n != 'red' else '7' for n, x in zip(names, r)) + '\n' for r in rows).encode() +
                    ''.join('3 %d %d %d\n' % tuple(t) for t in f).encode())
        assert carry('in.ply', 'out.ply') == ''
        raw = open('out.ply', 'rb').read()
        head, body = raw[:raw.index(b'end_header\n') + 11], raw[raw.index(b'end_header\n') + 11:]
        assert all(b'property %s %s\n' % (kind.encode(), x.encode()) in head for x in ('nx', 'ny', 'nz')) and b'property double x\n' in head
        if order:
            after = np.frombuffer(body, np.dtype([(x, t if x[0] == 'n' or x == 'red' else order + 'f8') for x, (t, _) in types.fields.items()]), len(v))
            assert body[after.nbytes:] == faces.tobytes()
        else:
            after = {x: c for x, c in zip(names, np.array([x.split() for x in body.decode().split('\n')[:len(v)]], float).T)}
        got = np.stack([after[x] for x in ('nx', 'ny', 'nz')], 1)
        assert np.abs(got - want).max() < 1e-6 and ('red' not in names or (after['red'] == 7).all())
        assert np.abs(np.stack([after[x] for x in 'xyz'], 1) - v @ shear.T).max() < 1e-6
# Without one of them, or as whole numbers, they stay, and it is said.
text = 'ply\nformat ascii 1.0\nelement vertex 3\n' + ''.join('property float %s\n' % x for x in 'xyz') + 'property %s nx\nproperty %s ny\nproperty %s %s\n' + \
    'element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2\n'
for kinds in (('float', 'float', 'float', 'w'), ('char', 'char', 'char', 'nz'), ('float', 'double', 'float', 'nz')):
    open('in.ply', 'w').write(text % kinds)
    assert 'stay as they are' in carry('in.ply', 'out.ply'), kinds
    assert open('out.ply').read().count(' 1 0 0\n') == 3
# VTK.
open('in.vtk', 'w').write('# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n'
                          'POINT_DATA 4\nNORMALS n float\n' + '0 0 1\n' * 4)
assert 'libicc: in.vtk: some normals or tangents stay as they are\n' == carry('in.vtk', 'out.vtk')
# In the plane: what stands upright stays.
open('a.txt', 'w').write('-9 -9\n9 -9\n9 9\n-9 9\n'), open('b.txt', 'w').write('-9 -9\n18 -9\n18 9\n-9 9\n')
open('in.obj', 'w').write('v 0 0 5\nv 1 0 5\nv 0 1 5\nvn 0 0 1\nvn 0.6 0.8 0\nf 1//1 2//1 3//2\n')
assert run(0, 'mesh', '-s', 'a.txt', '-t', 'b.txt', 'in.obj', 'out.obj')[1] == ''
got = numbers('out.obj', 'vn ')
assert np.abs(got - [[0, 0, 1], unit(np.array([[.6 / 1.5, .8, 0]]))[0]]).max() < 1e-4, got
END
finish
