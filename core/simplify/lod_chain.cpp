// The chain: one mesh, collapsed from the full grid through all levels. Here is the order of the
// steps of a level, and which rules each level has.
#include "core/simplify/lod_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simplify/level_mesh.h"
#include "core/simplify/order/collapser.h"
#include "core/simplify/order/take_back_rises.h"
#include "core/simplify/polish/polish.h"
#include "core/simplify/sides/side_thinner.h"

namespace farhorizon {

namespace {

// Square metres of mean vertical error that a square metre of mean silhouette error is worth, at a
// twentieth of all triangles; the less triangles, the less, by the fourth root. Less gives up
// skylines that cost little, more gives up ground that nothing brings back (measured: from 0 to
// 1000 on seven DEMs).
constexpr double kLambda = 25;
constexpr double kLambdaShare = 0.05;
// Square cells that a squared gradient's error is worth, for each post to a triangle: the error of
// a facet of that size is so much less steep. From 0.02 to 0.07 facets come nearer to the ground's
// by 8 to 14 % at a fifth of all triangles and by 3 to 8 % below; vertical errors grow by 1 to 8 %
// and 0 to 3 % (by more on a coast, where they are small), and silhouettes at a tenth by up to a
// fifth, most of it beyond 0.04 (measured on eight DEMs).
constexpr double kSlopeWeight = 0.04;
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
constexpr double kLeast = 1e-9;  // a share of which no side has a post but its corners
constexpr int kRoundsOfPolish = 2;
// At an exact level most vertices are held, and more rounds change nothing that is seen.
constexpr int kRoundsOfExactPolish = 1;
constexpr double kCollapsing = 0.7;  // of a level's time
// Of all triangles: from here on an exact level's collapses are asked at the end (TakeBackRises).
// Sooner is faster, by 7 % where it is from the beginning, and the log takes memory: with this
// share no more than the rest of the chain asks for.
constexpr double kAskedAtTheEnd = 0.6;
// Of a level's triangles, at most, that its sides' posts may ask for, so that small levels are not
// all sides.
constexpr double kMostOfSides = 0.5;

class ChainBuilder {
 public:
  ChainBuilder(const Terrain& terrain, const Horizon& horizon, const LodPlan& plan)
      : plan_(plan),
        horizon_(horizon),
        ground_(terrain, {plan.column_bend, plan.row_bend}),
        work_(ground_, horizon, kDirections),
        collapser_(work_),
        sides_(terrain),
        full_(2.0 * (terrain.dem().columns - 1) * (terrain.dem().rows - 1)) {
    CutInto(PartDepthFor(Triangles(), plan.part_triangles, MostParts(1)));
  }

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
      RelaxParts(work_.rules.parts().depth());
      levels_.push_back(LevelOf(work_, side_heights_));
      work_.mesh.Compact();
    }
    control.Report(Stage::kSimplify, 1);
    return std::move(levels_);
  }

 private:
  [[nodiscard]] std::int32_t Triangles() const { return work_.mesh.triangles(); }
  [[nodiscard]] double ExactTriangles() const {
    return kTrianglesPerEdge * static_cast<double>(horizon_.edges.size());
  }

  // Of the grid without holes, as neighbours have them.
  [[nodiscard]] double SidePostsOfGrid() const {
    return 2.0 * (ground_.columns() + ground_.rows()) - 4;
  }
  // How often a level may be halved of whose sides' posts this share stays.
  [[nodiscard]] PartDepth MostParts(double side_share) const {
    return {SidePartDepth(ground_.columns(), side_share),
            SidePartDepth(ground_.rows(), side_share)};
  }
  [[nodiscard]] bool HasNext() const { return kNextLevel * Triangles() >= kLeastTriangles; }

  Status BuildBySize(std::size_t level, const RunControl& control) {
    if (level == 0) {
      BeginExact(plan_.max_error_m, plan_.silhouette_error_m, control);
      return Simplify(ExactTriangles(), control);
    }
    const double budget = kNextLevel * Triangles();
    BeginSoft(kSideShare * std::pow(kNextLevel, static_cast<double>(level)), control);
    return Simplify(budget, control);
  }

  Status BuildByCount(std::size_t level, const RunControl& control) {
    const auto budget = static_cast<double>(plan_.triangles[level]);
    // The smallest power of kNextLevel that is not below the share, and leaves room inside.
    double share = 1;
    while (
        kNextLevel * share * full_ >= budget ||
        (SidePosts::ShareOf(share) * SidePostsOfGrid() > kMostOfSides * budget && share > kLeast)) {
      share *= kNextLevel;
    }
    const bool was_exact = level == 0 || levels_.back().exact;
    const bool fits = budget >= ExactTriangles() || budget >= Triangles();
    if (was_exact && fits && SidePosts::ShareOf(share) >= 1) {
      BeginExact(std::numeric_limits<float>::infinity(), 0, control);
      Status simplified = Simplify(budget, control);
      if (!simplified || Triangles() <= budget) return simplified;
    }
    BeginSoft(share, control);
    return Simplify(budget, control);
  }

  void CutInto(const PartDepth& depth) {
    work_.rules.Cut(PartGrid(ground_.columns(), ground_.rows(), depth));
  }

  // The fewer triangles, the fewer parts, `most` at most. What a line has held may go when it is
  // none any more.
  void RelaxParts(PartDepth most) {
    const PartGrid before = work_.rules.parts();
    most.columns = std::min(most.columns, before.depth().columns);
    most.rows = std::min(most.rows, before.depth().rows);
    const PartDepth depth = PartDepthFor(Triangles(), plan_.part_triangles, most);
    if (depth == before.depth()) return;
    CutInto(depth);
    for (std::int32_t v = 0; v < work_.mesh.vertices(); ++v) {
      if (!work_.mesh.IsVertex(v)) continue;
      const Place& p = work_.mesh.at(v);
      if (before.IsOnLine(p.x, p.y) && !work_.rules.parts().IsOnLine(p.x, p.y)) work_.Touch(v, 0);
    }
  }

  void BeginExact(double most_m, double rise_m, const RunControl& control) {
    work_.mesh.measure().SetMost(static_cast<float>(most_m));
    work_.rules.BeginExact(rise_m);
    work_.price.AllowRises(rise_m > 0);
    for (std::int32_t v = 0; v < work_.mesh.vertices(); ++v) {
      work_.stays[static_cast<std::size_t>(v)] =
          work_.mesh.IsVertex(v) && (ground_.OnSide(work_.mesh.at(v)) || !work_.IsFree(v));
    }
    Weigh();
    ConsiderAll(control);
  }

  void BeginSoft(double share, const RunControl& control) {
    const bool was_exact = work_.rules.exact();
    work_.mesh.measure().SetMost(std::numeric_limits<float>::infinity());
    work_.rules.BeginSoft(work_.mesh);
    work_.price.AllowRises(true);
    const double side_share = SidePosts::ShareOf(share);
    RelaxParts(MostParts(side_share));
    Weigh();
    side_heights_ = sides_.At(side_share);
    SideThinner thinner(work_, collapser_);
    thinner.Thin(side_heights_);
    if (was_exact || levels_.empty()) ConsiderAll(control);
  }

  // Ends early where a stop is requested: the next step returns the error.
  void ConsiderAll(const RunControl& control) {
    for (std::int32_t v = 0; v < work_.mesh.vertices(); ++v) {
      if (v % kVerticesBetweenChecks == 0 && control.StopRequested()) return;
      if (!work_.queued[static_cast<std::size_t>(v)]) collapser_.Consider(v);
    }
  }

  // Fewer vertices need fewer lines to judge them; the weight of one follows, and that of slopes.
  void Weigh() {
    work_.skyline.Thin(std::max(kLeastLines, kLinesPerVertex * Triangles() / 2));
    const double lambda = kLambda * std::pow(Triangles() / full_ / kLambdaShare, 0.25);
    work_.price.SetWeight(static_cast<float>(lambda * work_.skyline.PostsPerLine()));
    work_.mesh.measure().SetSlopeWeight(
        static_cast<float>(kSlopeWeight * work_.mesh.vertices() / Triangles()));
    work_.mesh.MeasureAll();
  }

  Status Collapse(std::int32_t budget, const RunControl& control) {
    const auto weigh = [this] {
      RelaxParts(work_.rules.parts().depth());
      Weigh();
    };
    if (work_.rules.exact() && !work_.rules.allows_rises()) {
      const auto asked = static_cast<std::int32_t>(kAskedAtTheEnd * full_);
      Status done = collapser_.Run(std::max(budget, asked), control.Between(0, 0.3), weigh);
      if (!done) return done;
      work_.mesh.Compact();
      work_.rules.Trust(true);
      collapser_.log().Begin(work_.mesh);
      done = collapser_.Run(budget, control.Between(0.3, 0.6), weigh);
      work_.rules.Trust(false);
      if (done) done = TakeBackRises(work_, collapser_.log(), plan_.threads, control);
      if (!done) return done;
    }
    return collapser_.Run(budget, control.Between(0.6, 1), weigh);
  }

  Status Simplify(double triangles, const RunControl& control) {
    const auto budget = static_cast<std::int32_t>(std::min(triangles, full_));
    Status done = Collapse(budget, control.Between(0, kCollapsing));
    if (done) control.Report(Stage::kSimplify, kCollapsing);
    const int rounds = work_.rules.exact() ? kRoundsOfExactPolish : kRoundsOfPolish;
    for (int i = 0; i < rounds; ++i) {
      if (done) done = FlipEdges(work_, control);
      if (done) done = MoveVertices(work_, control);
      if (done) done = FitHeights(work_, control);
    }
    if (done && !work_.rules.exact()) {
      SideThinner(work_, collapser_).Finish(side_heights_);
      // What the sides' posts kept from going may go now.
      done = collapser_.Run(budget, control.Between(kCollapsing, 1), [this] { Weigh(); });
    }
    if (done) control.Report(Stage::kSimplify, 1);
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
