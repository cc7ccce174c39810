#!/bin/sh
# Skins of glTF: joints move with the mesh, inverse bind matrices and animations follow, and what stays is said.
# usage: test_gltf_skins.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
if ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    echo "skipped: NumPy is missing"
    exit 77
fi
cp "$here/gltf_scene.py" scene.py
printf '%s\n' "$tool" >tool

cat >case.py <<'END2'
from scene import *

rng = np.random.RandomState(5)
v, f, normals, tangents = ball(6)
weights = rng.rand(len(v), 4)
weights /= weights.sum(1)[:, None]
joints = rng.randint(0, 4, (len(v), 4))
turned = {'rotation': [.1, .2, .3, .9], 'scale': [1.1, .9, 1]}


def figure(bind=np.eye(4), arm=(0, 1, .5), hand=(.5, .25, -.5), unit=1, root=None, matrices=True, pose=None):
    """Four joints in two chains, a mesh bound to them and a sword on the last joint; `bind` places the mesh in the scene."""
    s = Scene()
    s.mesh(v, f, normals)
    part = s.tree['meshes'][0]['primitives'][0]
    part['attributes'].update(WEIGHTS_0=s.array(weights), JOINTS_0=s.array(joints, '<u2'))
    s.mesh(v / 5, f)
    s.node(mesh=0, skin=0, name='body', translation=[70, 0, 0])
    s.node(name='root', children=[2, 6], **(root or {}))
    s.node(name='hip', children=[3, 5], translation=[.1 * unit, -.5 * unit, 0], **turned)
    s.node(name='arm', children=[4, 8], translation=[x * unit for x in arm])
    s.node(name='hand', children=[7], matrix=[1, 0, 0, 0, 0, .8, .6, 0, 0, -.6, .8, 0, *(x * unit for x in hand), 1])
    s.node(name='leg', translation=[.3 * unit, -.4 * unit, .1 * unit])
    s.node(name='lamp', translation=[3, 3, 3])
    s.node(name='sword', mesh=1)
    s.node()
    s.tree['scenes'][0]['nodes'] = [0, 1]
    m = placed(s.tree)
    inverses = [(np.linalg.inv(m[j]) @ bind).T.ravel() for j in (2, 3, 4, 5)]
    s.tree['skins'] = [{'joints': [2, 3, 4, 5], 'skeleton': 1}]
    if matrices:
        s.tree['skins'][0]['inverseBindMatrices'] = s.array(inverses, bounds=True)
    if pose:
        s.tree['nodes'][3].update(pose)
    return s


def animate(s):
    """A step in the hip, in the scale of the arm, and twice in the leg, once by cubic pieces."""
    time = s.array(np.arange(3.), bounds=True)
    keys = [s.array(rng.rand(3, 3), bounds=True), s.array(1 + rng.rand(3, 3)), s.array(rng.rand(9, 3))]
    s.tree['animations'] = [{'samplers': [{'input': time, 'output': keys[0]}, {'input': time, 'output': keys[1]},
                                          {'input': time, 'output': keys[2], 'interpolation': 'CUBICSPLINE'}],
                             'channels': [{'sampler': 0, 'target': {'node': 2, 'path': 'translation'}},
                                          {'sampler': 1, 'target': {'node': 3, 'path': 'scale'}},
                                          {'sampler': 2, 'target': {'node': 5, 'path': 'translation'}}]}]
    return keys


def carry(s, target, *more, code=0, name='in.glb'):
    s.write(name)
    err = run(code, 'mesh', '-s', 'box.obj', '-t', target, *more, name, 'out.glb')[1]
    return Read(name), Read('out.glb'), err


# The mesh in the scene is mapped, as drawn by its skin; joints are where the map takes them; nothing else moves.
big = matrix({'scale': [2, 2, 2], 'rotation': [1, 0, 0, 1], 'translation': [0, .5, 0]})
for bind in (np.eye(4), big):
    for root in ({}, {'scale': [-1, 1, 1]}, {'translation': [0, 0, 1], 'scale': [.01, .01, .01], 'rotation': [1, 0, 0, 1]}):
        s = figure(bind, unit=1 / abs(root.get('scale', [1])[0]), root=root)
        keys = animate(s)
        for target in ('sheared.obj', 'bent.obj'):
            before, after, err = carry(s, target)
            assert err == '', err
            want = mapped(target, apply(bind, v.astype('f4').astype(float)))
            assert np.abs(skinned(before, 0) - apply(bind, v)).max() < 1e-5
            assert np.abs(skinned(after, 0) - want).max() < 1e-5, np.abs(skinned(after, 0) - want).max()
            old, new = placed(before.tree), placed(after.tree)
            for i, (a, b) in enumerate(zip(old, new)):
                place = mapped(target, a[None, :3, 3])[0] if i in (2, 3, 4, 5) else a[:3, 3]
                assert np.abs(b[:3, 3] - place).max() < 1e-5 and np.abs(b[:3, :3] - a[:3, :3]).max() < 1e-6, (i, a, b)
            # Each joint alone places the mesh, so any weights do.
            inverses = after.array(after.tree['skins'][0]['inverseBindMatrices']).reshape(-1, 4, 4).transpose(0, 2, 1)
            for j, b in zip((2, 3, 4, 5), inverses):
                assert np.abs(new[j] @ b - bind).max() < 1e-5
            # The sword is mapped where it hangs, and hangs there as before.
            sword = before.array(before.part(1)['attributes']['POSITION']), after.array(after.part(1)['attributes']['POSITION'])
            assert np.abs(apply(new[7], sword[1]) - mapped(target, apply(old[7], sword[0]))).max() < 1e-5
            # Key frames of translations move with the joints, tangents and other key frames stay.
            for i, node, part in ((keys[0], 2, slice(None)), (keys[2], 5, slice(1, None, 3))):
                step = matrix(after.tree['nodes'][node])[:3, 3] - matrix(before.tree['nodes'][node])[:3, 3]
                assert np.abs(step).max() > .01
                want = before.array(i)
                want[part] += step
                assert np.abs(after.array(i) - want).max() < 1e-5 * max(1, np.abs(want).max())
            assert np.array_equal(after.array(keys[1]), before.array(keys[1]))
            # There and back.
            run(0, 'mesh', '-i', '-s', 'box.obj', '-t', target, 'out.glb', 'back.glb')
            back = Read('back.glb')
            assert np.abs(skinned(back, 0) - skinned(before, 0)).max() < 3e-5
            assert all(np.abs(a - b).max() < 3e-5 for a, b in zip(placed(back.tree), old))

# In JSON, with the same numbers.
s = figure()
before, after, err = carry(s, 'bent.obj')
other = carry(s, 'bent.obj', name='in.gltf')[1]
assert other.tree['nodes'] == after.tree['nodes'] and np.array_equal(skinned(other, 0), skinned(after, 0))
# A joint outside stays, and those that hang on it are moved all the same.
s = figure(arm=(0, 9, 0), hand=(0, -9, 0))
before, after, err = carry(s, 'bent.obj')
assert err == 'libicc: in.glb: 1 of 4 joints have no image and stay where they are\n', err
old, new = placed(before.tree), placed(after.tree)
assert np.abs(new[3] - old[3]).max() < 1e-5
assert np.abs(new[4][:3, 3] - mapped('bent.obj', old[4][None, :3, 3])[0]).max() < 2e-5
assert np.abs(skinned(after, 0) - mapped('bent.obj', v)).max() < 1e-4


def stays(why, s, *more):
    before, after, err = carry(s, 'bent.obj', *more)
    assert why in err, err
    assert before.tree['nodes'] == after.tree['nodes'] and before.tree['skins'] == after.tree['skins']
    if 'inverseBindMatrices' in s.tree['skins'][0]:
        i = s.tree['skins'][0]['inverseBindMatrices']
        assert np.array_equal(before.array(i), after.array(i))
    return before, after


# Posed, so that vertices are mapped as they were bound.
before, after = stays('skins[0] stays as it is (joints and inverse bind matrices): it does not stand as it was bound; save it in its rest pose',
                      figure(pose={'rotation': [0, 0, 1, 1]}))
assert np.abs(after.array(0) - mapped('bent.obj', before.array(0))).max() < 1e-5
stays('it has no inverse bind matrices', figure(matrices=False))
s = figure()
s.tree['nodes'][5]['mesh'] = 1
del s.tree['nodes'][7]['mesh']
stays('one of its joints draws a mesh', s)
s = figure()
keys = animate(s)
s.tree['animations'][0]['samplers'][2] = {'input': s.tree['animations'][0]['samplers'][0]['input'], 'output': keys[0]}
stays('key frames of a joint are shared or compressed', s)
s = figure()
animate(s)
s.tree['animations'][0]['samplers'][1]['output'] = keys[0]
stays('key frames of a joint are shared or compressed', s)
s = figure()
s.tree['accessors'].append(dict(s.tree['accessors'][s.tree['skins'][0]['inverseBindMatrices']]))
s.tree['skins'].append({'joints': [5, 4, 3, 2], 'inverseBindMatrices': len(s.tree['accessors']) - 1})
stays('its numbers are shared with something else', s)
# Two equal skins share their matrices; a second skin with others is moved, too.
s = figure()
s.tree['skins'].append(s.tree['skins'][0])
s.node(mesh=0, skin=1)
before, after, err = carry(s, 'bent.obj')
assert err == '' and np.abs(skinned(after, 0) - skinned(after, 9)).max() == 0
assert np.abs(skinned(after, 0) - mapped('bent.obj', v)).max() < 1e-5


def refused(message, change):
    s = figure()
    change(s.tree)
    s.write('bad.glb')
    err = run(1, 'check', '-s', 'bad.glb')[1]
    assert message in err and err.count('\n') == 1, err


refused('skins[0].joints must be a glTF node, a whole number from 0 to 8', lambda t: t['skins'][0].update(joints=[2, 9]))
refused('skins[0] has no joints', lambda t: t['skins'][0].update(joints=[]))
refused('skins[0] has 5 joints, but 4 inverse bind matrices', lambda t: t['skins'][0].update(joints=[2, 3, 4, 5, 6]))
refused('nodes[0].skin must be a glTF skin, a whole number from 0 to 0', lambda t: t['nodes'][0].update(skin=1))
refused('for skins[0].inverseBindMatrices, is not of matrices of floats', lambda t: t['skins'][0].update(inverseBindMatrices=0))
refused('nodes[2] is among its own children', lambda t: (t['nodes'][1].pop('children'), t['nodes'][4].update(children=[2])))
END2
/usr/bin/python3 case.py || complain "skins"
finish
