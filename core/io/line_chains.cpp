#include "core/io/line_chains.h"

#include <algorithm>

#include "core/io/join_edges.h"

namespace farhorizon {

namespace {

// What the edges of a chain add up to, in doubles until it is whole.
LineChain ChainOf(const std::vector<HorizonLine>& lines, const std::vector<ChainedEdge>& links) {
  LineChain chain;
  std::optional<double> measure_m;
  for (const ChainedEdge& link : links) {
    const HorizonLine& line = lines[link.edge];
    if (chain.points.empty()) chain.points.push_back(line.ends[link.reversed ? 1 : 0]);
    chain.points.push_back(line.ends[link.reversed ? 0 : 1]);
    chain.azimuths |= line.azimuths;
    if (line.line_measure_m) measure_m = measure_m.value_or(0) + *line.line_measure_m;
    // An optional without a value is less than any that has one.
    chain.skyline_drop_m = std::max(chain.skyline_drop_m, line.skyline_drop_m);
  }
  if (measure_m) chain.line_measure_m = static_cast<float>(*measure_m);
  return chain;
}

}  // namespace

std::vector<LineChain> LineChainsOf(const std::vector<HorizonLine>& lines) {
  std::vector<PlanEdge> edges;
  edges.reserve(lines.size());
  const auto plan = [](const std::array<float, 3>& p) { return std::array<double, 2>{p[0], p[1]}; };
  for (const HorizonLine& line : lines) {
    edges.push_back({plan(line.ends[0]), plan(line.ends[1])});
  }
  std::vector<LineChain> chains;
  for (const std::vector<ChainedEdge>& links : JoinEdges(edges)) {
    chains.push_back(ChainOf(lines, links));
  }
  return chains;
}

}  // namespace farhorizon
