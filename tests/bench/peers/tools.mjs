// Who takes part in the contest beside farhorizon: README.md says how.

/**
 * In the order of the tables. `best`: counts where "the best of the others" is asked for; martini
 * does not, for it takes no number of triangles and only square grids of 2^k + 1 posts.
 */
export const tools = [
  {id: 'delatin', name: 'delatin', best: true},
  {id: 'martini', name: 'martini', best: false},
  {id: 'meshoptimizer', name: 'meshoptimizer, border locked', best: true},
  {id: 'meshoptimizer-free', name: 'meshoptimizer, free', best: true},
  {id: 'lt', name: 'CGAL Lindstrom-Turk', best: true},
  {id: 'gh', name: 'CGAL Garland-Heckbert', best: true},
];
