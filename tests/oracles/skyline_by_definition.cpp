#include "tests/oracles/skyline_by_definition.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace farhorizon {
namespace {

// A segment in the view: its ends across, and the lines of its height and depth over the place.
struct InView {
  std::size_t segment;
  Number from;
  Number to;
  Number height_slope;
  Number height_at_zero;
  Number depth_slope;
  Number depth_at_zero;

  [[nodiscard]] Number Height(const Number& place) const {
    return height_at_zero + height_slope * place;
  }
  [[nodiscard]] Number Depth(const Number& place) const {
    return depth_at_zero + depth_slope * place;
  }
};

std::optional<InView> Project(std::size_t i, const Segment& s, const ViewDirection& view) {
  const Number a = Number(view.dc) * s.a.y - Number(view.dr) * s.a.x;
  const Number b = Number(view.dc) * s.b.y - Number(view.dr) * s.b.x;
  if (a == b) return std::nullopt;
  const Number depth_a = Number(view.dc) * s.a.x + Number(view.dr) * s.a.y;
  const Number depth_b = Number(view.dc) * s.b.x + Number(view.dr) * s.b.y;
  const Number height_slope = (Number(s.b.z) - s.a.z) / (b - a);
  const Number depth_slope = (depth_b - depth_a) / (b - a);
  return InView{
      i,           std::min(a, b),           std::max(a, b), height_slope, s.a.z - height_slope * a,
      depth_slope, depth_a - depth_slope * a};
}

void AddCrossing(const InView& p, const InView& q, std::vector<Number>& places) {
  if (p.to <= q.from || q.to <= p.from) return;
  if (p.height_slope != q.height_slope) {
    places.push_back((q.height_at_zero - p.height_at_zero) / (p.height_slope - q.height_slope));
  } else if (p.height_at_zero == q.height_at_zero && p.depth_slope != q.depth_slope) {
    places.push_back((q.depth_at_zero - p.depth_at_zero) / (p.depth_slope - q.depth_slope));
  }
}

}  // namespace

std::vector<SeenStretch> SkylineByDefinition(std::span<const Segment> segments,
                                             const ViewDirection& view) {
  std::vector<InView> seen;
  std::vector<Number> places;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::optional<InView> next = Project(i, segments[i], view);
    if (!next) continue;
    places.push_back(next->from);
    places.push_back(next->to);
    for (const InView& other : seen) AddCrossing(*next, other, places);
    seen.push_back(*next);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::vector<SeenStretch> stretches;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Number middle = (places[i - 1] + places[i]) / 2;
    const InView* best = nullptr;
    for (const InView& s : seen) {
      if (middle < s.from || s.to < middle) continue;
      const bool better =
          best == nullptr || std::tuple(s.Height(middle), -s.Depth(middle)) >
                                 std::tuple(best->Height(middle), -best->Depth(middle));
      if (better) best = &s;
    }
    if (best == nullptr) continue;
    if (!stretches.empty() && stretches.back().segment == best->segment &&
        stretches.back().to == places[i - 1]) {
      stretches.back().to = places[i];
    } else {
      stretches.push_back({best->segment, places[i - 1], places[i]});
    }
  }
  return stretches;
}

}  // namespace farhorizon
