"""Draws solids with things inside: as if the outer surface were of glass, and cut by a plane."""

import numpy as np

SUN = np.array([-.45, -.65, .61])


def normals_of(vertices, faces):
    """The normal of each vertex, outward."""
    corners = vertices[faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, faces[:, k], flat)
    volume = np.einsum("ij,ij->", corners[:, 0], flat)
    return np.sign(volume) * normals / np.linalg.norm(normals, axis=1)[:, None]


class Eye:
    """Parallel rays along a direction onto a picture as high as told, which shows all given places."""

    def __init__(self, toward, places, height, margin=.02):
        self.toward = np.array(toward, float) / np.linalg.norm(toward)
        self.right = np.cross([0, 0, 1], self.toward)
        self.right /= np.linalg.norm(self.right)
        self.up = np.cross(self.toward, self.right)
        flat = places @ np.column_stack([self.right, self.up])
        edge = margin * np.ptp(flat[:, 1])
        self.low, (width, high) = flat.min(0) - edge, np.ptp(flat, axis=0) + 2 * edge
        self.scale = height / high
        self.shape = height, int(round(width * self.scale))

    def flat(self, places):
        """Pixels, and how near to the eye."""
        x = (places @ self.right - self.low[0]) * self.scale
        y = self.shape[0] - (places @ self.up - self.low[1]) * self.scale
        return np.stack([x, y], -1), places @ self.toward

    def seen(self, vertices, faces, normals, front=True, attributes=None):
        """For each pixel the nearest surface: how near, its normal, and its attributes. The back shows if not front."""
        at, near = self.flat(vertices)
        values = normals if attributes is None else np.hstack([normals, attributes])
        depth, result = np.full(self.shape, -np.inf), np.zeros((*self.shape, values.shape[1]))
        for face in faces:
            if ((normals[face].sum(0) @ self.toward) > 0) != front:
                continue
            a, b, c = at[face]
            area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            low = np.maximum(np.floor(at[face].min(0)).astype(int), 0)
            high = np.minimum(np.ceil(at[face].max(0)).astype(int) + 1, self.shape[::-1])
            if area == 0 or (high <= low).any():
                continue
            x, y = np.meshgrid(np.arange(low[0], high[0]) + .5, np.arange(low[1], high[1]) + .5)
            u = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area
            v = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
            weights = np.stack([1 - u - v, u, v], -1)
            here = weights @ near[face]
            box = slice(low[1], high[1]), slice(low[0], high[0])
            new = (weights.min(-1) > -1e-9) & (here > depth[box])
            depth[box][new] = here[new]
            result[box][new] = (weights @ values[face])[new]
        return depth, result

    def lit(self, normals):
        """The shade of a dull surface with a faint gloss."""
        normals = normals / np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-12)
        gloss = (SUN + self.toward) / np.linalg.norm(SUN + self.toward)
        return .52 + .48 * np.clip(normals @ SUN, 0, 1), .35 * np.clip(normals @ gloss, 0, 1) ** 30


def tube(line, radius, n=10):
    """A tube around a line, and normals."""
    ways = np.gradient(line, axis=0)
    side = np.cross(ways, [0, 1, 0] if abs(ways[:, 1]).max() < np.linalg.norm(ways, axis=1).min() else [0, 0, 1])
    side /= np.linalg.norm(side, axis=1)[:, None]
    other = np.cross(ways, side) / np.linalg.norm(ways, axis=1)[:, None]
    angle = np.linspace(0, 2 * np.pi, n, endpoint=False)
    normals = side[:, None] * np.cos(angle)[:, None] + other[:, None] * np.sin(angle)[:, None]
    vertices = (line[:, None] + radius * normals).reshape(-1, 3)
    k = np.arange(len(vertices)).reshape(-1, n)
    right = np.roll(k, -1, 1)
    faces = np.concatenate([np.stack([k[:-1], k[1:], right[1:]], -1), np.stack([k[:-1], right[1:], right[:-1]], -1)])
    return vertices, faces.reshape(-1, 3), normals.reshape(-1, 3)


def glass(eye, outer, inner, glass_colour=(.36, .46, .58)):
    """A picture of things seen through an outer surface. `inner`: pairs of a colour and (vertices, faces, normals)."""
    picture = np.ones((*eye.shape, 3))
    normals = normals_of(*outer)
    layers = [eye.seen(*outer, normals, front) for front in (False, True)]

    def film(layer, strength):
        depth, normal = layer
        facing = np.abs(normal @ eye.toward) / np.maximum(np.linalg.norm(normal, axis=-1), 1e-12)
        alpha = np.where(depth > -np.inf, .06 + strength * (1 - facing) ** 2.2, 0)[..., None]
        return alpha, np.array(glass_colour)
    alpha, colour = film(layers[0], .35)
    picture = (1 - alpha) * picture + alpha * colour
    nearest = np.full(eye.shape, -np.inf)
    for paint, (vertices, faces, own) in inner:
        depth, normal = eye.seen(vertices, faces, own)
        shade, gloss = eye.lit(normal)
        new = depth > nearest
        nearest[new] = depth[new]
        picture[new] = np.clip(np.array(paint) * shade[..., None] + gloss[..., None], 0, 1)[new]
    alpha, colour = film(layers[1], .8)
    return (1 - alpha) * picture + alpha * colour


def section(vertices, faces, axis, at):
    """The segments in which a plane of constant coordinate cuts a surface."""
    above = vertices[:, axis] > at
    segments = []
    for face in faces[above[faces].any(1) & ~above[faces].all(1)]:
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            p, q = vertices[face[a]], vertices[face[b]]
            if above[face[a]] != above[face[b]]:
                ends.append(p + (at - p[axis]) / (q[axis] - p[axis]) * (q - p))
        segments.append(ends)
    return np.array(segments)


def skin_of(tetrahedra):
    """The triangles that bound some tetrahedra, outward."""
    faces = np.concatenate([tetrahedra[:, c] for c in ([1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1])])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def facets(eye, vertices, faces, colours, wire=1.2):
    """A picture of flat triangles with their edges. Colours: one for each triangle."""
    corners = vertices[faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat /= np.linalg.norm(flat, axis=1)[:, None]
    at = eye.flat(corners.reshape(-1, 3))[0].reshape(-1, 3, 2)
    sides = np.roll(at, 1, axis=1) - np.roll(at, -1, axis=1)
    areas = np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])[:, None]
    heights = areas / np.maximum(np.linalg.norm(sides, axis=2), 1e-9)     # pixels from each corner to the opposite side
    far = heights[:, :, None] * np.eye(3)
    paints = np.repeat(np.asarray(colours, float), 3, axis=0)
    depth, seen = eye.seen(corners.reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3), np.repeat(flat, 3, axis=0),
                           attributes=np.hstack([far.reshape(-1, 3), paints]))
    shade, gloss = eye.lit(seen[..., :3])
    picture = np.clip(seen[..., 6:] * shade[..., None] + .4 * gloss[..., None], 0, 1)
    line = np.clip(wire - seen[..., 3:6].min(-1), 0, 1)[..., None] * .55
    picture = (1 - line) * picture + line * np.array([.12, .16, .22])
    picture[depth == -np.inf] = 1
    return picture
