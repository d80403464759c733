#include "core/pipeline/horizon_context.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

Result<std::vector<bool>> FindInContext(const TerrainInput& input, const Horizon& horizon,
                                        const HorizonOptions& options, const RunControl& control) {
  const Terrain& around = input.around();
  WorkBudget budget = WorkBudgetOf(around, options);
  Result<Horizon> wide = FindHorizon(around, options, budget, control);
  if (!wide) return std::move(wide.error());
  const int apron = input.apron();
  const auto place = [&](VertexId v) {
    const Dem& dem = input.dem();
    return (dem.Row(v) + apron) * around.dem().columns + dem.Column(v) + apron;
  };
  std::vector<bool> in_context;
  in_context.reserve(horizon.edges.size());
  for (const HorizonEdge& e : horizon.edges) {
    const Edge sought{place(e.edge.a), place(e.edge.b)};
    in_context.push_back(std::ranges::binary_search(wide->edges, sought, {},
                                                    [](const HorizonEdge& w) { return w.edge; }));
  }
  return in_context;
}

}  // namespace farhorizon
