// The queue holds at most one entry for each vertex: its cheapest collapse. A collapse makes the
// costs of the neighbours stale; a stale entry is rated again when it comes first. So entries are
// cheap to keep, and the order is that of costs except where a stale cost was too high.
#include "core/simplify/collapse.h"

#include <algorithm>

namespace farhorizon {

namespace {

// No vertex gets more triangles than these. Any count is sound; rating a collapse costs about the
// square of it.
constexpr std::int32_t kMostTriangles = 48;
constexpr std::int64_t kStepsBetweenChecks = 512;

std::uint64_t Pair(VertexId p, VertexId q) {
  return (static_cast<std::uint64_t>(p) << 32) | static_cast<std::uint32_t>(q);
}

std::uint64_t UnorderedPair(VertexId p, VertexId q) { return p < q ? Pair(p, q) : Pair(q, p); }

}  // namespace

Collapser::Collapser(const Terrain& terrain)
    : terrain_(&terrain),
      surface_(terrain),
      posts_by_triangle_(terrain.post_count(), surface_.triangle_id_end()),
      star_(terrain) {
  const auto posts = static_cast<std::size_t>(terrain.post_count());
  pinched_.assign(posts, false);
  queued_.assign(posts, false);
  stale_.assign(posts, false);
  has_refusal_.assign(posts, false);
  target_.assign(posts, -1);
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (!surface_.IsVertex(v)) continue;
    star_.Gather(surface_, posts_by_triangle_, v);
    // One fan has as many neighbours as triangles, or one more at the border.
    pinched_[static_cast<std::size_t>(v)] =
        star_.neighbours().size() > star_.triangles().size() + 1;
  }
}

void Collapser::Enqueue(double cost, VertexId v) {
  queued_[static_cast<std::size_t>(v)] = true;
  queue_.push_back({cost, v});
  std::push_heap(queue_.begin(), queue_.end(), Later);
}

Collapser::Entry Collapser::Dequeue() {
  std::pop_heap(queue_.begin(), queue_.end(), Later);
  const Entry entry = queue_.back();
  queue_.pop_back();
  queued_[static_cast<std::size_t>(entry.v)] = false;
  return entry;
}

void Collapser::Start(const CollapseRules& rules) {
  queue_.clear();
  std::fill(queued_.begin(), queued_.end(), false);
  std::fill(has_refusal_.begin(), has_refusal_.end(), false);
  refused_edges_.clear();
  refused_moves_.clear();
  for (VertexId v = 0; v < terrain_->post_count(); ++v) {
    const auto at = static_cast<std::size_t>(v);
    if (surface_.IsVertex(v) && rules.removable[at] && !pinched_[at]) Rate(rules, v);
  }
}

void Collapser::Refuse(std::unordered_set<std::uint64_t>& set, VertexId p, VertexId q) {
  set.insert(&set == &refused_edges_ ? UnorderedPair(p, q) : Pair(p, q));
  has_refusal_[static_cast<std::size_t>(p)] = true;
  has_refusal_[static_cast<std::size_t>(q)] = true;
}

bool Collapser::Refused(VertexId v, VertexId b) const {
  if (!has_refusal_[static_cast<std::size_t>(b)]) return false;
  if (refused_moves_.count(Pair(v, b)) > 0) return true;
  return std::any_of(star_.neighbours().begin(), star_.neighbours().end(), [this, b](VertexId n) {
    return has_refusal_[static_cast<std::size_t>(n)] &&
           refused_edges_.count(UnorderedPair(b, n)) > 0;
  });
}

void Collapser::Rate(const CollapseRules& rules, VertexId v) {
  stale_[static_cast<std::size_t>(v)] = false;
  star_.Gather(surface_, posts_by_triangle_, v);
  const auto triangles = static_cast<std::int32_t>(star_.triangles().size());
  double best = Star::kNever;
  for (const VertexId b : star_.neighbours()) {
    if (rules.may_move && !rules.may_move(v, b)) continue;
    if (Refused(v, b)) continue;
    const double cost = star_.CostOfCollapse(b, rules.limits, best);
    if (cost >= best) continue;
    if (surface_.CountTrianglesOf(b) + triangles > kMostTriangles) continue;
    best = cost;
    target_[static_cast<std::size_t>(v)] = b;
  }
  if (best < Star::kNever) Enqueue(best, v);
}

bool Collapser::TryCollapse(const CollapseRules& rules, VertexId v) {
  const VertexId b = target_[static_cast<std::size_t>(v)];
  star_.Gather(surface_, posts_by_triangle_, v);
  others_.clear();
  star_.NewNeighbours(b, others_);
  if (rules.may_add_edge) {
    bool all = true;
    for (const VertexId n : others_) {
      if (star_.IsBelowSurface(b, n) || rules.may_add_edge(b, n)) continue;
      Refuse(refused_edges_, b, n);
      all = false;
    }
    if (!all) return false;
  }
  Check(star_.CostOfCollapse(b, rules.limits, Star::kNever) < Star::kNever,
        "a rated collapse is allowed");
  if (rules.move_ridges && !rules.move_ridges(v, b)) {
    Refuse(refused_moves_, v, b);
    return false;
  }
  star_.DistributePosts(b, posts_by_triangle_);
  surface_.Collapse(v, b);
  return true;
}

void Collapser::MarkNeighboursStale() {
  for (const VertexId n : star_.neighbours()) {
    stale_[static_cast<std::size_t>(n)] = true;
    // A collapse that was not allowed may be so now. It is rated before anything that costs more
    // than the collapse just done.
    if (!queued_[static_cast<std::size_t>(n)]) Enqueue(last_cost_, n);
  }
}

Status Collapser::Run(const CollapseRules& rules, const RunControl& control,
                      const std::function<void(double)>& report) {
  Start(rules);
  last_cost_ = 0;
  const std::int64_t triangles_before = surface_.triangle_count();
  std::int64_t steps = 0;
  while (!queue_.empty()) {
    if (steps++ % kStepsBetweenChecks == 0) {
      if (control.StopRequested()) return Error{ErrorCode::kCancelled, "stopped while simplifying"};
      if (report) {
        report(1.0 - static_cast<double>(surface_.triangle_count()) /
                         static_cast<double>(triangles_before));
      }
    }
    const Entry entry = Dequeue();
    const auto at = static_cast<std::size_t>(entry.v);
    if (!rules.removable[at] || pinched_[at]) continue;
    if (stale_[at] || !TryCollapse(rules, entry.v)) {
      Rate(rules, entry.v);
      continue;
    }
    last_cost_ = entry.cost;
    MarkNeighboursStale();
  }
  return Ok{};
}

}  // namespace farhorizon
