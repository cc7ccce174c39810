#!/bin/sh
# Scenes of glTF in JSON: bytes inside and in files beside it, several buffers, both forms as output; what is refused.
# usage: test_gltf_json.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
if ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    echo "skipped: NumPy is missing"
    exit 77
fi
cp "$here/gltf_scene.py" scene.py
printf '%s\n' "$tool" >tool

cat >case.py <<'END2'
import io
import shutil
from scene import *

v, f, normals, tangents = ball(5)
s = Scene()
s.mesh(v, f, normals), s.mesh(v / 3 + 1, f, targets=[{'POSITION': .1 * v}])
s.node(mesh=0, name='é "1"', scale=[2, 1, 1]), s.node(mesh=1, rotation=[0, 0, 3, 4], translation=[.2, 0, 0])
s.tree['scenes'][0]['nodes'] = [0, 1]
s.tree['images'] = [{'uri': 'wood.png'}]
s.write('in.glb')
cages = ('-s', 'box.obj', '-t', 'bent.obj')
run(0, 'mesh', *cages, 'in.glb', 'want.glb')
want = Read('want.glb')


def same(name):
    """All numbers as in the binary form, and the JSON as it was but for buffers and bounds."""
    got = Read(name)
    for i, a in enumerate(want.tree['accessors']):
        if a['type'] != 'SCALAR':
            assert np.array_equal(got.array(i), want.array(i)), (name, i)
    for key in ('nodes', 'meshes', 'images', 'scenes', 'accessors', 'asset'):
        assert got.tree[key] == want.tree[key], (name, key)


# Bytes inside, one file, several files and both, also in a folder and with names that need escapes; both forms of output.
os.mkdir('far')
middle = s.tree['bufferViews'][2]['byteOffset'], s.tree['bufferViews'][4]['byteOffset']
for folder in ('', 'far/'):
    for files, cuts in ((), ()), (['one.bin'], ()), (['a b/ü%.bin', None, 'c.bin'], middle), ([None] * 3, middle):
        s.write_json(folder + 'in.gltf', [x and folder + x for x in files], cuts)
        if folder and files:
            text = open('far/in.gltf', encoding='utf-8-sig').read().replace('far/', '')
            open('far/in.gltf', 'w').write(text)
        for out in ('out.gltf', 'out.glb', 'far/out.GLTF'):
            assert run(0, 'mesh', *cages, folder + 'in.gltf', out)[1] == ''
            if out == 'far/out.GLTF':
                shutil.move(out, out := 'far/low.gltf')
            same(out)
run(0, 'mesh', *cages, 'in.glb', 'out.gltf'), same('out.gltf')
run(0, 'mesh', *cages, 'out.gltf', 'back.glb')
# There and back, and a second time: the form alone does not change a byte.
run(0, 'mesh', '-s', 'box.obj', '-t', 'box.obj', 'out.gltf', 'a.gltf'), run(0, 'mesh', '-s', 'box.obj', '-t', 'box.obj', 'a.gltf', 'b.gltf')
assert open('a.gltf').read() == open('b.gltf').read()
# Through pipes.
s.write_json('in.gltf')
got = subprocess.run([tool, 'mesh', *cages, '-', '-'], stdin=open('in.gltf'), capture_output=True)
open('piped.glb', 'wb').write(got.stdout), same('piped.glb')

# A cage.
c = Scene()
c.mesh(box, box_faces), c.node(mesh=0)
c.write_json('cage.gltf', ['cage.bin'])
out = run(0, 'check', '-s', 'cage.gltf', '-m', 'foliation')[0]
assert 'volume 512' in out, out


def refused(message, change, *more):
    tree = json.load(open('in.gltf'))
    change(tree)
    json.dump(tree, open('bad.gltf', 'w'))
    for words in (('check', '-s', 'bad.gltf'), ('mesh', *cages, 'bad.gltf', 'no.gltf')):
        err = run(1, *words)[1]
        assert message in err and err.startswith('libicc: ') and err.count('\n') == 1, (message, err)
    assert not os.path.exists('no.gltf')


def uri(text):
    return lambda t: t['buffers'][0].update(uri=text)


n = len(s.body)
open('short.bin', 'wb').write(s.body[:-8])
refused('buffers[0] should have %d bytes, but it has %d' % (n, n - 8), uri('short.bin'))
refused('buffers[0] should have %d bytes, but it has %d' % (n, n - 3), uri(data_uri(s.body[:-3])))
refused('libicc: none.bin: cannot be opened', uri('none.bin'))
refused('is not base64', uri('data:;base64,ab*c'))
refused('is not base64', uri('data:;base64,abcde'))
refused('has data that are not in base64', uri('data:text/plain,abc'))
for outside in ('/etc/passwd', '../x.bin', 'a/../../x.bin', 'a/..', 'http://x/y.bin', 'file:x', 'C:/x', '%2e%2e/x', 'a%5Cb', '%00', '%4', 'a%zz', ''):
    refused('only files in the scene\'s folder or below it are read', uri(outside))
refused('buffers[0] has no uri', lambda t: t['buffers'][0].pop('uri'))
refused('buffers[0].byteLength must be a number of bytes', lambda t: t['buffers'][0].update(byteLength=-1))
refused('buffers[1] is compressed', lambda t: t['buffers'].append({'byteLength': 4, 'extensions': {'EXT_meshopt_compression': {'fallback': True}}}))
refused('buffers is not a list', lambda t: t.update(buffers={}))
refused('bufferViews[1].buffer must be a glTF buffer, a whole number from 0 to 0', lambda t: t['bufferViews'][1].update(buffer=1))
refused('bufferViews[1].byteOffset must be a number', lambda t: t['bufferViews'][1].update(byteOffset=-4))
refused('bufferViews[0] has bytes', lambda t: t['bufferViews'][0].update(byteLength=10 ** 6))
refused('this is glTF version 1.0; libicc reads version 2', lambda t: t['asset'].update(version='1.0'))
refused('this is glTF version ?', lambda t: t['asset'].pop('version'))
refused('nodes[0] is among its own children', lambda t: (t['nodes'][0].update(children=[1]), t['nodes'][1].update(children=[0])))
refused('index 0 of accessors[1] is 65535; there are 25', lambda t: uri(data_uri(s.body.replace(np.asarray(f[0], '<u2').tobytes(), b'\xff' * 6, 1)))(t))
text = open('in.gltf').read()
open('bad.gltf', 'w').write(text[:len(text) // 2])
assert 'bad.gltf:' in run(1, 'check', '-s', 'bad.gltf')[1]
s.write_json('in.gltf', ['a.bin'])
r = subprocess.run([tool, 'check', '-s', '-'], stdin=open('in.gltf'), capture_output=True, text=True)
assert r.returncode == 1 and "'a.bin', but standard input has no folder; name the scene's file" in r.stderr, r.stderr
END2
/usr/bin/python3 case.py || complain "scenes in JSON"
finish
