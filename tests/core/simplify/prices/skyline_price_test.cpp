// Prices against the change of the whole sum, computed from scratch before and after.
#include "core/simplify/prices/skyline_price.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "core/simplify/order/collapser.h"
#include "core/simplify/polish/polish.h"
#include "core/simplify/polish/vertex_change.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/level_objective.h"
#include "tests/support/random_operations.h"
#include "tests/support/small_terrains.h"
#include "tests/support/workbench.h"

namespace farhorizon {
namespace {

constexpr float kWeight = 2;
constexpr float kSlopesWeigh = 0.25;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Tally {
  int exact = 0;
  int dearer = 0;      // priced higher than it is: too low a height was taken for what is left
  int cheaper = 0;     // priced lower than it is: a rise between two looks at the hull
  double missing = 0;  // the most that it is priced too low, of both sums
};

class PriceBench {
 public:
  PriceBench(const Dem& dem, std::mt19937& random) : bench(dem, {0.01, 0}), random_(random) {
    bench.work.price.SetWeight(kWeight);
    bench.work.price.AllowRises(true);
    mesh().measure().SetSlopeWeight(kSlopesWeigh);
    mesh().MeasureAll();
    bench.work.rules.BeginSoft(mesh());
  }
  HalfEdgeMesh& mesh() { return bench.work.mesh; }
  [[nodiscard]] std::int32_t Any(std::int32_t count) {
    return static_cast<std::int32_t>(random_() % static_cast<unsigned>(count));
  }
  // Half of the triangles, polished: a mesh with heights of its own.
  void MakeLevel() {
    Collapser collapser(bench.work);
    for (std::int32_t v = 0; v < mesh().vertices(); ++v) collapser.Consider(v);
    ASSERT_TRUE(collapser.Run(mesh().triangles() / 2, {}, [] {}));
    ASSERT_TRUE(FlipEdges(bench.work, {}));
    ASSERT_TRUE(MoveVertices(bench.work, {}));
    ASSERT_TRUE(FitHeights(bench.work, {}));
  }
  // Holds the price of what makes the mesh into `after`.
  void Compare(double price, const HalfEdgeMesh& after, Tally& tally) {
    const Objective was = ObjectiveOf(bench.work, mesh(), kSlopesWeigh, kWeight);
    const Objective is = ObjectiveOf(bench.work, after, kSlopesWeigh, kWeight);
    if (!was.known || !is.known || !was.tops_are_true) return;
    const double rounding = 1e-2 + 1e-4 * (was.most + is.most);
    if (price < is.least - was.most - rounding) {
      ++tally.cheaper;
      tally.missing =
          std::max(tally.missing, (is.least - was.most - rounding - price) / (was.most + is.most));
    } else if (price > is.most - was.least + rounding) {
      ++tally.dearer;
    } else {
      ++tally.exact;
    }
  }

  Workbench bench;

 private:
  std::mt19937& random_;
};

void TryCollapse(PriceBench& on, Tally& tally) {
  Ring ring;
  const std::int32_t v = on.Any(on.mesh().vertices());
  if (!on.mesh().IsVertex(v) || !on.mesh().Gather(v, ring)) return;
  const std::int32_t j = on.Any(ring.count);
  if (!MayCollapse(on.mesh(), ring, j)) return;
  SkylinePrice& price = on.bench.work.price;
  const Place& b = ring.at(j);
  price.Begin(v);
  price.FindLost(ring);
  double cost = price.ChangeOfLost(ring, b, j);
  for (std::int32_t i = 0; i < ring.count; ++i) {
    if (!ring.Joined(i, j)) cost += price.RiseOf(b, ring.at(i));
  }
  HalfEdgeMesh after = on.mesh();
  after.Collapse(ring, ring.id(j));
  // The posts' part is that of PostSquares, which has tests of its own.
  cost += SquaresOf(after) - SquaresOf(on.mesh());
  on.Compare(cost, after, tally);
}

void TryFlip(PriceBench& on, Tally& tally) {
  const std::int32_t h = on.Any(on.mesh().half_edges());
  if (!MayFlip(on.mesh(), h)) return;
  Ring quad;
  quad.closed = true;
  const std::int32_t b = on.mesh().origin(HalfEdgeMesh::Previous(h));
  const std::int32_t d = on.mesh().origin(HalfEdgeMesh::Previous(on.mesh().twin(h)));
  for (const std::int32_t v :
       {on.mesh().origin(h), d, on.mesh().origin(HalfEdgeMesh::Next(h)), b}) {
    quad.Add(v, on.mesh().at(v));
  }
  SkylinePrice& price = on.bench.work.price;
  price.BeginFlip(quad);
  double cost = price.ChangeOfFlip(quad);
  cost += price.RiseOf(on.mesh().at(b), on.mesh().at(d));
  HalfEdgeMesh after = on.mesh();
  after.Flip(h);
  cost += SquaresOf(after) - SquaresOf(on.mesh());
  on.Compare(cost, after, tally);
}

void TryPlace(PriceBench& on, bool move, Tally& tally) {
  const Ground& ground = on.bench.ground;
  const std::int32_t v = on.Any(on.mesh().vertices());
  if (!on.bench.work.IsFree(v)) return;
  // Corners of a rim keep their heights: no sum may have their posts (PostSquares).
  if (on.mesh().OnRim(v) && !RimIsStraight(on.mesh(), v)) return;
  VertexChange change(on.bench.work);
  if (!change.Begin(v)) return;
  Place place = on.mesh().at(v);
  if (move) {
    if (on.mesh().OnRim(v)) return;
    place.x =
        static_cast<std::int16_t>(std::clamp(place.x + on.Any(5) - 2, 0, ground.columns() - 1));
    place.y = static_cast<std::int16_t>(std::clamp(place.y + on.Any(5) - 2, 0, ground.rows() - 1));
    if (!ground.HasData(place.x, place.y)) return;
    place = ground.At(place.x, place.y);
  }
  place = ground.WithHeight(place.x, place.y, place.plan + static_cast<float>(on.Any(7) - 3));
  if (!change.IsInside(place)) return;
  HalfEdgeMesh after = on.mesh();
  after.SetPlace(v, place);
  on.Compare(change.Cost(place, kInfinity), after, tally);
}

enum class Kind { kCollapse, kFlip, kMove, kHeight };

Tally TallyOf(Kind kind, bool polished, std::uint32_t seed) {
  std::mt19937 random(seed);
  Tally tally;
  const int tries = kind == Kind::kMove ? 150 : 12;  // most are refused
  // Not a tenth under the sanitizers: what is rare has to come up.
  for (int round = 0; round < std::max(Rounds(500), 200); ++round) {
    PriceBench on(AnySmallDem(kind == Kind::kMove ? 12 : 9, random), random);
    if (polished) on.MakeLevel();
    for (int k = 0; k < tries; ++k) {
      switch (kind) {
        case Kind::kCollapse:
          TryCollapse(on, tally);
          break;
        case Kind::kFlip:
          TryFlip(on, tally);
          break;
        case Kind::kMove:
          TryPlace(on, true, tally);
          break;
        case Kind::kHeight:
          TryPlace(on, false, tally);
          break;
      }
    }
  }
  return tally;
}

class SkylinePriceOf : public testing::TestWithParam<Kind> {};

TEST_P(SkylinePriceOf, AChangeOfTheTerrainIsWhatItDoesToTheWholeSumOrMore) {
  const Tally tally = TallyOf(GetParam(), false, 1);
  EXPECT_LT(tally.cheaper, 0.01 * tally.exact);
  EXPECT_LT(tally.missing, 0.6);  // the terrain's own sum is 0
  EXPECT_GT(tally.exact, Rounds(200));
  EXPECT_LT(tally.dearer, tally.exact);
}

TEST_P(SkylinePriceOf, AChangeOfALevelIsSeldomAnythingElse) {
  const Tally tally = TallyOf(GetParam(), true, 2);
  EXPECT_LT(tally.cheaper, 0.02 * tally.exact);
  EXPECT_LT(tally.missing, 0.2);
  EXPECT_GT(tally.exact, Rounds(30));
  EXPECT_LT(tally.dearer, tally.exact);
}

INSTANTIATE_TEST_SUITE_P(EveryOperation, SkylinePriceOf,
                         testing::Values(Kind::kCollapse, Kind::kFlip, Kind::kMove, Kind::kHeight));

TEST(SkylinePrice, ARiseIsForbiddenWhereNoneIsAllowed) {
  // A valley between two ridges of 9: an edge across it, from ridge to ridge, rises above the floor
  // that lines along the valley see.
  Workbench bench(AsciiDem("99999\n00000\n00000\n00000\n99999"));
  SkylinePrice& price = bench.work.price;
  price.SetWeight(1);
  price.AllowRises(false);
  const Place high = bench.ground.At(2, 0);
  const Place across = bench.ground.At(2, 4);
  const Place floor = bench.ground.At(2, 2);
  price.Begin(0);
  EXPECT_EQ(price.RiseOf(high, across), SkylinePrice::kForbidden);
  EXPECT_EQ(price.RiseOf(bench.ground.At(0, 2), floor), 0);
  price.AllowRises(true);
  EXPECT_GT(price.RiseOf(high, across), 10);
  EXPECT_LT(price.RiseOf(high, across), SkylinePrice::kForbidden);
}

}  // namespace
}  // namespace farhorizon
