"""Scenes of glTF for tests: made and looked at with NumPy alone. The command stands in the file `tool`."""
import base64
import json
import os
import struct
import subprocess
from urllib.parse import quote
import numpy as np

tool = open('tool').read().strip()
corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
box = (corners - .5) * 8
box_faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
shear = np.array([[1.2, .1, .4], [0, .9, -.2], [.1, 0, 1.1]])
bent = np.c_[box[:, 0] + .05 * box[:, 2] ** 2 * np.sign(box[:, 1]), box[:, 1] * (1 + .05 * box[:, 0]), box[:, 2] + .1 * box[:, 0]]


def obj(name, v):
    with open(name, 'w') as f:
        f.writelines('v %.17g %.17g %.17g\n' % tuple(x) for x in v)
        f.writelines('f %d %d %d\n' % tuple(i + 1 for i in x) for x in box_faces)


obj('box.obj', box), obj('sheared.obj', box @ shear.T), obj('bent.obj', bent)


def run(expected, *arguments, text=''):
    r = subprocess.run([tool, *arguments], input=text, capture_output=True, text=True)
    assert r.returncode == expected, (arguments, r.returncode, r.stderr)
    return r.stdout, r.stderr


def mapped(target, p, *more):
    out = run(0, 'map', '-s', 'box.obj', '-t', target, *more, text=''.join('%.17g %.17g %.17g\n' % tuple(x) for x in p))[0]
    return np.array([x.split() for x in out.split('\n') if x], float)


def unit(v):
    return v / np.linalg.norm(v, axis=1)[:, None]


def ball(n=7):
    """A ball of n rings, its triangles, normals that are not quite its own, and tangents."""
    a, b = np.meshgrid(np.linspace(0, 2 * np.pi, n, endpoint=False) + .1, np.linspace(.3, 2.8, n), indexing='ij')
    v = np.stack([np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)], -1).reshape(-1, 3)
    f = [t for i in range(n) for j in range(n - 1) for p, q, r, s in [(i * n + j, (i + 1) % n * n + j, (i + 1) % n * n + j + 1, i * n + j + 1)]
         for t in ((p, r, q), (p, s, r))]
    normals = unit(v + [.1, -.2, .05])
    tangents = unit(np.cross(normals, [.3, 1, .2]))
    return v, np.array(f), normals, np.c_[tangents, np.sign(v[:, :1] + 9)]


def data_uri(data):
    return 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()


class Scene:
    """A glTF file in the making: its JSON is `tree`, its bytes `body`."""
    def __init__(self):
        self.body, self.gap = b'xyz!', b'\1\2\3\4'
        self.tree = {'asset': {'version': '2.0', 'generator': 'é'}, 'scene': 0, 'scenes': [{'nodes': [0]}], 'nodes': [], 'meshes': [], 'accessors': [], 'bufferViews': []}

    def array(self, a, kind='<f4', bounds=False, **more):
        a = np.asarray(a, kind)
        self.tree['bufferViews'].append({'buffer': 0, 'byteOffset': len(self.body), 'byteLength': a.nbytes})
        self.body += a.tobytes() + b'\0' * (-a.nbytes % 4) + self.gap
        names = {1: 'SCALAR', 3: 'VEC3', 4: 'VEC4', 16: 'MAT4'}
        accessor = {'bufferView': len(self.tree['bufferViews']) - 1, 'componentType': 5126 if kind == '<f4' else 5123, 'count': len(a),
                    'type': names[a.shape[1] if a.ndim > 1 else 1]}
        if bounds:
            accessor.update(min=a.min(0).tolist(), max=a.max(0).tolist())
        self.tree['accessors'].append({**accessor, **more})
        return len(self.tree['accessors']) - 1

    def mesh(self, v, f, normals=None, tangents=None, targets=()):
        p = {'attributes': {'POSITION': self.array(v, bounds=True)}, 'indices': self.array(np.ravel(f), '<u2')}
        if normals is not None:
            p['attributes']['NORMAL'] = self.array(normals)
        if tangents is not None:
            p['attributes']['TANGENT'] = self.array(tangents, bounds=True)
        if len(targets):
            p['targets'] = [{k: self.array(x, bounds=k == 'POSITION') for k, x in t.items()} for t in targets]
        self.tree['meshes'].append({'primitives': [p]})
        return len(self.tree['meshes']) - 1

    def node(self, **what):
        self.tree['nodes'].append(what)
        return len(self.tree['nodes']) - 1

    def write(self, name, text=None):
        self.tree['buffers'] = [{'byteLength': len(self.body)}]
        if name.endswith('.gltf'):
            self.write_json(name)
            return
        text = (text or json.dumps(self.tree)).encode()
        text += b' ' * (-len(text) % 4)
        body = self.body + b'\0' * (-len(self.body) % 4)
        with open(name, 'wb') as f:
            f.write(struct.pack('<4sII', b'glTF', 2, 28 + len(text) + len(body)) + struct.pack('<I4s', len(text), b'JSON') + text +
                    struct.pack('<I4s', len(body), b'BIN\0') + body)


    def write_json(self, name, files=(), cuts=()):
        """The bytes stand in a data: URI, or in files that begin where `cuts` says. One that is None is inside."""
        pieces = [self.body[a:b] for a, b in zip((0, *cuts), (*cuts, len(self.body)))]
        tree = json.loads(json.dumps(self.tree))
        tree['buffers'] = [{'byteLength': len(x), 'uri': data_uri(x) if file is None else quote(file)}
                           for x, file in zip(pieces, files or [None] * len(pieces))]
        for view in tree['bufferViews']:
            view['buffer'] = sum(view['byteOffset'] >= x for x in cuts)
            view['byteOffset'] -= (0, *cuts)[view['buffer']]
            if view['byteOffset'] == 0:
                del view['byteOffset']
        for x, file in zip(pieces, files):
            if file is not None:
                os.makedirs(os.path.dirname(file) or '.', exist_ok=True)
                open(file, 'wb').write(x + b'more')
        with open(name, 'w', encoding='utf-8-sig' if cuts else 'utf-8') as f:
            json.dump(tree, f, indent=1)


class Read:
    def __init__(self, name):
        raw = open(name, 'rb').read()
        if name.endswith('.gltf'):
            self.tree, self.body = json.loads(raw), b''
            if self.tree.get('buffers'):
                self.body = base64.b64decode(self.tree['buffers'][0]['uri'].partition(',')[2], validate=True)
                assert len(self.tree['buffers']) == 1 and len(self.body) == self.tree['buffers'][0]['byteLength']
            return
        n = struct.unpack('<I', raw[12:16])[0]
        self.tree, self.body = json.loads(raw[20:20 + n]), raw[28 + n:]
        assert struct.unpack('<I', raw[8:12])[0] == len(raw)

    def array(self, i):
        a = self.tree['accessors'][i]
        view = self.tree['bufferViews'][a['bufferView']]
        n = {'SCALAR': 1, 'VEC3': 3, 'VEC4': 4, 'MAT4': 16}[a['type']]
        at = view.get('byteOffset', 0) + a.get('byteOffset', 0)
        kind = {5126: '<f4', 5123: '<u2'}[a['componentType']]
        step = view.get('byteStride', np.dtype(kind).itemsize * n)
        out = np.array([np.frombuffer(self.body, kind, n, at + k * step) for k in range(a['count'])], float)
        if 'min' in a:
            assert np.array_equal([out.min(0), out.max(0)], np.array([a['min'], a['max']], 'f4')), (i, a)
        return out

    def part(self, mesh=0):
        return self.tree['meshes'][mesh]['primitives'][0]


def matrix(node):
    if 'matrix' in node:
        return np.array(node['matrix'], float).reshape(4, 4).T
    x, y, z, w = np.array(node.get('rotation', [0, 0, 0, 1]), float) / np.linalg.norm(node.get('rotation', [0, 0, 0, 1]))
    u = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    m = np.eye(4)
    m[:3, :3] = (np.eye(3) + 2 * w * u + 2 * u @ u) * node.get('scale', [1, 1, 1])
    m[:3, 3] = node.get('translation', [0, 0, 0])
    return m


def placed(tree):
    """The matrices of all nodes in the scene."""
    nodes, out = tree['nodes'], {}
    above = {c: i for i, x in enumerate(nodes) for c in x.get('children', ())}
    def find(i):
        if i not in out:
            out[i] = (find(above[i]) if i in above else np.eye(4)) @ matrix(nodes[i])
        return out[i]
    return [find(i) for i in range(len(nodes))]


def skinned(scene, node):
    """The vertices that a node with a skin draws, in the scene."""
    x, m = scene.tree['nodes'][node], placed(scene.tree)
    part, skin = scene.part(x['mesh'])['attributes'], scene.tree['skins'][x['skin']]
    v, w = scene.array(part['POSITION']), scene.array(part['WEIGHTS_0'])
    k = scene.array(part['JOINTS_0']).astype(int)
    bind = scene.array(skin['inverseBindMatrices']).reshape(-1, 4, 4).transpose(0, 2, 1)
    at = np.array([m[j] @ b for j, b in zip(skin['joints'], bind)])
    return np.einsum('vk,vkij,vj->vi', w, at[k], np.c_[v, np.ones(len(v))])[:, :3]


def apply(m, p):
    return p @ m[:3, :3].T + m[:3, 3]
