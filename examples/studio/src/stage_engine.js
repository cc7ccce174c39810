// The steps of the papers by themselves: grid, maximum, tree, function, curves.
import { flatOf } from './shape.js';

const CURVES = 150;

/** Vertices inside, about CURVES of them, evenly among all. */
function spreadOver(inside) {
  const all = [...inside.keys()].filter((v) => inside[v]), every = Math.ceil(all.length / CURVES);
  return all.filter((_, i) => i % every === Math.floor(every / 2));
}

const countOf = (words) => ({ all: words.length, maximum: words.filter((word) => word === 'maximum').length });

export function stageOperations(icc) {
  let objects = [], charts = [];

  const clear = () => { for (const object of [...objects, ...charts]) object.free(); objects = []; charts = []; };

  const chartOf = (outline, options) => {
    const chart = new icc.Chart(flatOf(outline), { method: 'gradient', ...options });
    charts.push(chart);
    return chart;
  };

  return {
    'stages.make'({ source, target, cells, kind }) {
      clear();
      const domain = icc.Domain.polygon(flatOf(source)), grid = new icc.Grid(domain, cells);
      const { vertex, rounds } = grid.findMaximum();
      const tree = new icc.Tree(grid, vertex), f = new icc.GridFunction(tree, { function: kind });
      const points = grid.points(spreadOver(grid.inside()));
      const up = new icc.Curves(f, points, 'up'), down = new icc.Curves(f, points, 'down');
      objects = [domain, grid, tree, f, up, down];
      chartOf(source, { cells, function: kind });
      chartOf(target, { cells, function: kind });
      const { edges, kinds, tested } = icc.GridFunction.ofChart(charts[0]).edges();
      return {
        grid: grid.info, inside: grid.inside(), maximum: vertex, rounds, parents: tree.parents(),
        generations: tree.generations(), report: tree.report(), values: f.values(), critical: f.report(),
        curves: [...up.vertices(), ...down.vertices()], ends: countOf(up.ends().end), edges, kinds, tested, chart: charts[0].report(),
      };
    },

    /** The curves through a point and through its image, and its coordinates. */
    'stages.trace'({ point }) {
      const p = Float64Array.from(point), { facet, bary, t, status } = charts[0].encode(p);
      if (status[0] !== 0) return { status: icc.codeOf(status[0]) };
      const image = charts[1].decode({ facet, bary, t });
      const there = image.status[0] === 0 ? charts[1].trace(image.points) : new Float64Array(0);
      return { curve: charts[0].trace(p), facet: facet[0], share: bary[0], t: t[0], image: image.points, there,
        status: icc.codeOf(image.status[0]) };
    },
  };
}
