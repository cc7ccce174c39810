"""An airfoil turns in a mesh with thin layers of cells. Does any cell invert, and do the layers come along?

The peer is linear elasticity with a stiffness of one over the area, which programs for moving meshes use. An O-mesh
runs around the airfoil. A C-mesh also has a wake of thin cells behind it. Both come from conformal maps, so lines leave
the wall at right angles.
"""

import numpy as np
from common import EXACT, Clock, Report, areas, library, mesh_of, one_to_one, options, signs, wants

wants("scipy", "shapely")
from peers import elasticity                                    # noqa: E402

# Joukowski's airfoil: a circle with this centre, a little larger than one through 1, so that the trailing edge is round.
CENTRE, LARGER = -.09, 1.012
FIRST, GROWTH, N_LAYERS = 2e-4, 1.2, 21     # the layers at the wall, in chords
FAR = 10.                                   # the far boundary, in chords
PIVOT = np.array([-.25, 0])                 # a quarter of the chord behind the nose
# Heights of the cells at the wall, after over before.
LOWEST, HIGHEST = .95, 1.05
# Exponent of the area in the stiffness: layers ride along.
POWER = 1.5


class Mesh:
    """Vertices, triangles, numbers of the wall's and the far vertices, and of the vertices above the wall's."""

    def __init__(self, vertices, triangles, wall, far, above):
        turned = areas(vertices, triangles) < 0
        triangles[turned] = triangles[turned][:, ::-1]
        self.vertices, self.triangles, self.wall, self.far, self.above = vertices, triangles, wall, far, above
        self.held = np.r_[wall, far]

    def turned(self, degrees):
        """Places of the held vertices when the airfoil has turned clockwise."""
        t = -np.radians(degrees)
        turn = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
        return np.r_[PIVOT + (self.vertices[self.wall] - PIVOT) @ turn.T, self.vertices[self.far]]

    def layer(self, images, degrees):
        """Angles in degrees between the layer's lines and where they would be if they were glued to the wall, and the
        heights of the first cells, after over before."""
        t = np.radians(degrees)
        lines = [(points[self.above] - points[self.wall]) @ [1, 1j] for points in (self.vertices, images)]
        ratio = lines[1] / (lines[0] * np.exp(-1j * t))
        return np.abs(np.degrees(np.angle(ratio))), np.abs(ratio)


def joukowski(circle):
    """The airfoil's outside, of length about 1 around the origin, from the outside of the unit circle."""
    z = CENTRE + (1 - CENTRE) * LARGER * circle
    return (z + 1 / z) / 4


def distances(n, first, end):
    """n + 1 distances from 0 to `end`: layers that grow slowly, then lines that grow as they must."""
    near = np.r_[0, np.cumsum(first * GROWTH ** np.arange(N_LAYERS))]
    last, powers = near[-1] - near[-2], np.arange(1, n - N_LAYERS + 1)
    low, high = 1., 3.
    for _ in range(60):
        middle = .5 * (low + high)
        low, high = (middle, high) if near[-1] + (last * middle ** powers).sum() < end else (low, middle)
    result = np.r_[near, near[-1] + np.cumsum(last * low ** powers)]
    return result * end / result[-1]


def plane(z):
    return np.c_[z.real, z.imag]


def strips(numbers, closed):
    """Two triangles for each cell between lines of vertex numbers."""
    here, there = numbers[:, :-1], numbers[:, 1:]
    if closed:
        here, there = numbers, np.roll(numbers, -1, 1)
    a, b, c, d = (x.ravel() for x in (here[:-1], there[:-1], there[1:], here[1:]))
    return np.concatenate([np.c_[a, b, c], np.c_[a, c, d]])


def o_mesh(n, m):
    """n vertices around the airfoil, and m lines outside of it."""
    radius = 1 + distances(m, 4 * FIRST, 4 * FAR)
    circle = radius[:, None] * np.exp(2j * np.pi * np.arange(n) / n)
    numbers = np.arange(circle.size).reshape(circle.shape)
    return Mesh(plane(joukowski(circle).ravel()), strips(numbers, True), numbers[0], numbers[-1], numbers[1])


def c_mesh(n, n_wake, m):
    """n vertices around the airfoil, n_wake along the wake, and m lines outside. A half-plane is bent around both: its
    boundary from -2 to 2 becomes the airfoil, and what lies outside of that, both sides of the wake."""
    end = 2 * np.sqrt(FAR)
    wake = 2 * np.cosh(np.linspace(0, np.arccosh(end / 2), n_wake + 1)[1:])
    along = np.r_[-wake[::-1], -2 * np.cos(np.pi * np.arange(n + 1) / n), wake]
    w = along[None] + 1j * distances(m, 4 * FIRST, end)[:, None]
    s = (w + np.sqrt(w - 2) * np.sqrt(w + 2)) / 2
    numbers = np.arange(w.size).reshape(w.shape)
    # Both sides of the wake have the same vertices, from the trailing edge on.
    numbers[0, :n_wake + 1] = numbers[0, ::-1][:n_wake + 1]
    used, numbers = np.unique(numbers, return_inverse=True)
    numbers = numbers.reshape(w.shape)
    wall = numbers[0, n_wake:-n_wake - 1]
    far = np.unique(np.r_[numbers[-1], numbers[:, 0], numbers[:, -1]])
    return Mesh(plane(joukowski(s ** 2).ravel()[used]), strips(numbers, False), wall, far, numbers[1, n_wake:-n_wake - 1])


def line(name, mesh, images, degrees, seconds):
    off, tall = mesh.layer(images, degrees)
    n = int((signs(images, mesh.triangles) <= 0).sum())
    return n, off, tall, (f"{name}: {n} inverted, layer off by {np.median(off):.2f} in the median, {off.max():.2f} at most; "
                          f"heights {tall.min():.3f} to {tall.max():.3f}; {seconds:.2f} s")


def turn(report, libicc, name, mesh, degrees):
    """One turn, by the peer and by libicc."""
    n_steps = max(1, round(degrees / 4.5))
    with Clock() as clock:
        other = elasticity(mesh.vertices, mesh.triangles, mesh.held, lambda t: mesh.turned(t * degrees), n_steps)
    _, off_other, _, text = line("elasticity", mesh, other, degrees, clock.seconds)
    report.say(f"{name}, {len(mesh.triangles)} triangles, turned by {degrees:g} degrees; {text}")
    if libicc is None:
        return
    to = mesh.turned(degrees)
    with Clock() as clock:
        fit = libicc.fit(mesh=(mesh.vertices, mesh.triangles), vertices=(mesh.held, to), stiffness=POWER)
    vertices, images, triangles = mesh_of(fit)
    what = f"{name}, {degrees:g} degrees"
    report.check(np.array_equal(vertices, mesh.vertices) and np.array_equal(triangles, mesh.triangles), f"{what}: the mesh is kept")
    n, off, tall, text = line("libicc", mesh, images, degrees, clock.seconds)
    report.say(f"   {text}; {fit.info.n_iterations} steps")
    faults = one_to_one(vertices, images, triangles)
    report.check(fit.certified and not faults, f"{what}: certified, {faults or 'and so it is'}")
    report.check(fit.info.n_off == 0, f"{what}: the wall is where it was told to be, but for {fit.info.n_off} vertices")
    report.at_most(f"{what}: distance of the wall", np.abs(images[mesh.held] - to).max(), EXACT * FAR)
    report.at_least(f"{what}: lowest height of a cell at the wall", tall.min(), LOWEST)
    report.at_most(f"{what}: largest height of a cell at the wall", tall.max(), HIGHEST)
    report.at_most(f"{what}: layer off the normal, beside elasticity's", np.median(off), np.median(off_other))


def main():
    args = options(__doc__)
    libicc = None if args.peers else library()
    report = Report()
    rng = np.random.default_rng(args.seed)
    if args.full:
        meshes = [("O-mesh", o_mesh(96, 59)), ("C-mesh", c_mesh(96, 32, 40))]
        angles = [45, 90, 165, 170, float(rng.uniform(20, 170))]
    else:
        meshes, angles = [("O-mesh", o_mesh(48, 32)), ("C-mesh", c_mesh(48, 12, 28))], [45, 120]
    for name, mesh in meshes:
        report.check((signs(mesh.vertices, mesh.triangles) > 0).all(), f"{name}: the mesh is valid at first")
        for degrees in angles:
            turn(report, libicc, name, mesh, degrees)
    report.end(args.peers)


if __name__ == "__main__":
    main()
