// Maps between surfaces in space: the bar, bent, and the tetrahedra inside.

export function spaceOperations(icc) {
  let map = null, surface = null;

  const domain = (points) => icc.Domain.surface(points, surface.facets);

  function solid() {
    const { vertices, images, simplices } = map.mesh(), { certified, kind, nSimplices, energy } = map.info;
    return { vertices, images, simplices, certified: certified === 1 && kind === 'mesh', nSimplices, energy };
  }

  const become = (next) => { map?.free(); map = next; };

  return {
    /** A map from a surface { points, facets } to the same one with other points. */
    'space.create'({ points, facets, target }) {
      surface = { facets };
      const from = domain(points), to = domain(target);
      try { become(new icc.Map(from, to)); } finally { from.free(); to.free(); }
      return solid();
    },

    /** The map to points that have moved; a new one where it does not follow. */
    'space.follow'({ points, facets, target }) {
      const to = domain(target);
      try { become(map.retarget(to, 2)); } catch (error) {
        if (!(error instanceof icc.IccError) || !['CERTIFICATE', 'UNSUPPORTED'].includes(error.code)) throw error;
        return this['space.create']({ points, facets, target });
      } finally { to.free(); }
      return solid();
    },
  };
}
