// The chain: one mesh, collapsed from the full grid through all levels. Here is the order of the
// steps of a level, and which rules each level has.
#include "core/simplify/lod_chain.h"

#include <algorithm>
#include <cmath>

#include "core/simplify/level_mesh.h"
#include "core/simplify/order/collapser.h"
#include "core/simplify/polish/polish.h"
#include "core/simplify/sides/side_thinner.h"

namespace farhorizon {

namespace {

// Square metres of mean vertical error that a square metre of mean silhouette error is worth. Less
// gives up skylines that cost little, more gives up ground that nothing brings back (measured: from
// 0 to 1000 on seven DEMs).
constexpr double kLambda = 30;
// Pencils of sampled lines: fewer leave room between them at fine levels.
constexpr std::int32_t kDirections = 128;
// More lines than so many a vertex, and than so many in all, change nothing.
constexpr std::int64_t kLinesPerVertex = 5;
constexpr std::int64_t kLeastLines = 15000;
// Triangles for each horizon edge, below which locked vertices fill an exact mesh (measured).
constexpr double kTrianglesPerEdge = 3.6;
// Of the triangles of the level before.
constexpr double kNextLevel = 0.4;
constexpr double kLeastTriangles = 500;
// A level's share of all triangles as far as its sides are concerned: that of level 0, and then by
// kNextLevel.
constexpr double kSideShare = 0.2;
constexpr int kSweepsOverHeights = 1;

class ChainBuilder {
 public:
  ChainBuilder(const Terrain& terrain, const Horizon& horizon, const LodPlan& plan)
      : plan_(plan),
        horizon_(horizon),
        ground_(terrain, {plan.column_bend, plan.row_bend}),
        work_(ground_, horizon, kDirections),
        collapser_(work_),
        sides_(terrain),
        full_(2.0 * (terrain.dem().columns - 1) * (terrain.dem().rows - 1)) {}

  Result<std::vector<Lod>> Build(const RunControl& control) {
    const auto count =
        plan_.triangles.empty() ? static_cast<std::size_t>(plan_.levels) : plan_.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
      const double share = static_cast<double>(count);
      const RunControl piece =
          control.Between(static_cast<double>(i) / share, static_cast<double>(i + 1) / share);
      if (plan_.triangles.empty() && i > 0 && !HasNext()) break;
      Status built = plan_.triangles.empty() ? BuildBySize(i, piece) : BuildByCount(i, piece);
      if (!built) return std::move(built.error());
      levels_.push_back(LevelOf(work_, side_heights_));
      work_.mesh.Compact();
    }
    return std::move(levels_);
  }

 private:
  [[nodiscard]] std::int32_t Triangles() const { return work_.mesh.triangles(); }
  [[nodiscard]] double ExactTriangles() const {
    return kTrianglesPerEdge * static_cast<double>(horizon_.edges.size());
  }

  [[nodiscard]] bool HasNext() const { return kNextLevel * Triangles() >= kLeastTriangles; }

  Status BuildBySize(std::size_t level, const RunControl& control) {
    if (level == 0) {
      BeginExact(plan_.max_error_m, plan_.silhouette_error_m);
      return Simplify(ExactTriangles(), control);
    }
    const double budget = kNextLevel * Triangles();
    BeginSoft(kSideShare * std::pow(kNextLevel, static_cast<double>(level)));
    return Simplify(budget, control);
  }

  Status BuildByCount(std::size_t level, const RunControl& control) {
    const auto budget = static_cast<double>(plan_.triangles[level]);
    // The smallest power of kNextLevel that is not below the share.
    double share = 1;
    while (kNextLevel * share * full_ >= budget) share *= kNextLevel;
    const bool was_exact = level == 0 || levels_.back().exact;
    if (was_exact && budget >= ExactTriangles() && SidePosts::ShareOf(share) >= 1) {
      BeginExact(std::numeric_limits<double>::infinity(), 0);
      Status simplified = Simplify(budget, control);
      if (!simplified || Triangles() <= budget) return simplified;
    }
    BeginSoft(share);
    return Simplify(budget, control);
  }

  void BeginExact(double most_m, double rise_m) {
    work_.rules.BeginExact(static_cast<float>(most_m), rise_m);
    work_.price.AllowRises(rise_m > 0);
    for (std::int32_t v = 0; v < work_.mesh.vertices(); ++v) {
      work_.stays[static_cast<std::size_t>(v)] =
          work_.mesh.IsVertex(v) && (ground_.OnSide(work_.mesh.at(v)) || !work_.IsFree(v));
    }
    Weigh();
    ConsiderAll();
  }

  void BeginSoft(double share) {
    const bool was_exact = work_.rules.exact();
    work_.rules.BeginSoft(work_.mesh);
    work_.price.AllowRises(true);
    Weigh();
    side_heights_ = sides_.At(SidePosts::ShareOf(share));
    SideThinner thinner(work_, collapser_);
    thinner.Thin(side_heights_);
    if (was_exact || levels_.empty()) ConsiderAll();
  }

  void ConsiderAll() {
    for (std::int32_t v = 0; v < work_.mesh.vertices(); ++v) {
      if (!work_.queued[static_cast<std::size_t>(v)]) collapser_.Consider(v);
    }
  }

  // Fewer vertices need fewer lines to judge them; the weight of one follows.
  void Weigh() {
    work_.skyline.Thin(std::max(kLeastLines, kLinesPerVertex * Triangles() / 2));
    work_.price.SetWeight(static_cast<float>(kLambda * work_.skyline.PostsPerLine()));
  }

  Status Simplify(double triangles, const RunControl& control) {
    const auto budget = static_cast<std::int32_t>(std::min(triangles, full_));
    Status done = collapser_.Run(budget, control, [this] { Weigh(); });
    if (done) done = FlipEdges(work_, control);
    if (done) done = MoveVertices(work_, control);
    for (int i = 0; i < kSweepsOverHeights && done; ++i) done = FitHeights(work_, control);
    if (done && !work_.rules.exact()) SideThinner(work_, collapser_).Finish(side_heights_);
    control.Report(Stage::kSimplify, 1);
    return done;
  }

  const LodPlan& plan_;
  const Horizon& horizon_;
  Ground ground_;
  Workpiece work_;
  Collapser collapser_;
  SidePosts sides_;
  double full_;  // triangles of the grid without holes, as neighbours have it
  std::vector<SidePosts::Height> side_heights_;
  std::vector<Lod> levels_;
};

}  // namespace

Result<std::vector<Lod>> BuildLodChain(const Terrain& terrain, const Horizon& horizon,
                                       const LodPlan& plan, const RunControl& control) {
  control.Report(Stage::kSimplify, 0);
  ChainBuilder builder(terrain, horizon, plan);
  return builder.Build(control);
}

}  // namespace farhorizon
