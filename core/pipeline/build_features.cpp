#include "core/pipeline/build_features.h"

#include <utility>

namespace farhorizon {

Result<std::vector<HorizonFeature>> BuildFeatures(const TerrainInput& input, const Horizon& horizon,
                                                  const EdgeFacts& facts,
                                                  const MeasureOptions& measuring,
                                                  const RunControl& control) {
  std::vector<VertexId> ends;
  for (const HorizonEdge& e : horizon.edges) {
    ends.push_back(e.edge.a);
    ends.push_back(e.edge.b);
  }
  Result<std::vector<Geodetic>> points = input.georeference().ToGeodetic(ends);
  if (!points) return std::move(points.error());
  Result<std::vector<EdgeMeasures>> measures =
      MeasureEdges(input.terrain(), horizon, input.georeference(), measuring, control);
  if (!measures) return std::move(measures.error());
  const Dem& dem = input.dem();
  std::vector<HorizonFeature> features;
  features.reserve(horizon.edges.size());
  for (std::size_t i = 0; i < horizon.edges.size(); ++i) {
    const HorizonEdge& e = horizon.edges[i];
    HorizonFeature feature{};
    feature.a = {dem.Column(e.edge.a), dem.Row(e.edge.a)};
    feature.b = {dem.Column(e.edge.b), dem.Row(e.edge.b)};
    feature.from = (*points)[2 * i];
    feature.to = (*points)[2 * i + 1];
    feature.measures = std::move((*measures)[i]);
    feature.witness = e.witness;
    feature.undecided = e.undecided;
    if (i < facts.level_kept.size() && facts.level_kept[i] >= 0) {
      feature.level_kept = facts.level_kept[i];
    }
    if (i < facts.in_context.size()) feature.in_context = facts.in_context[i];
    features.push_back(std::move(feature));
  }
  return features;
}

}  // namespace farhorizon
