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

Result<HorizonInContext> FindHorizonInContext(const TerrainInput& input, bool asks_context,
                                              const HorizonOptions& options, WorkBudget& budget,
                                              const RunControl& control) {
  Result<Horizon> horizon = FindHorizon(input.terrain(), options, budget,
                                        asks_context ? control.Between(0, 0.5) : control);
  if (!horizon) return std::move(horizon.error());
  HorizonInContext found{*std::move(horizon), {}};
  if (!asks_context) return found;
  Result<std::vector<bool>> in_context =
      FindInContext(input, found.horizon, options, control.Between(0.5, 1));
  if (!in_context) return std::move(in_context.error());
  found.in_context = *std::move(in_context);
  return found;
}

}  // namespace farhorizon
