#include "core/horizon/visibility/occluder_set.h"

#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"
#include "tests/support/shrink.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

constexpr std::array<Ties, 2> kBothTies{Ties::kPass, Ties::kBlock};

const char* TextOfCase(Ties ties) { return ties == Ties::kPass ? "kPass" : "kBlock"; }

struct Extent {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
};

std::optional<Witness> FindItsLine(Extent extent, const Segment& segment,
                                   const std::vector<Segment>& set, Ties ties) {
  OccluderSet occluders(extent.columns, extent.rows);
  for (const Segment& f : set) occluders.Insert(f);
  return occluders.FindLineOfSight({.segment = segment, .ties = ties}).witness;
}

// FindLineOfSight finds a line of sight exactly where the definition has one, and nothing is above
// the line that it finds. Where ties block, that line may still touch an end or a point of equal
// height, if the lines beside it do not.
testing::AssertionResult MatchesTheDefinition(Extent extent, const Segment& segment,
                                              const std::vector<Segment>& all, Ties ties) {
  const auto fails = [&](const std::vector<Segment>& set) {
    const std::optional<Witness> witness = FindItsLine(extent, segment, set, ties);
    return witness.has_value() != LineOfSightByBruteForce(segment, set, ties).has_value() ||
           (witness && witness->exact && !LineOfSightIsClear(*witness, segment, set, Ties::kPass));
  };
  if (!fails(all)) return testing::AssertionSuccess();
  const std::vector<Segment> few = Shrink(all, fails);
  const std::optional<Witness> witness = FindItsLine(extent, segment, few, ties);
  testing::AssertionResult failure = testing::AssertionFailure();
  failure << TextOfCase(ties) << ", segment " << DrawSegments({segment}) << "occluders\n"
          << DrawSegments(few);
  if (!witness) return failure << "no line of sight is found, though there is one";
  if (!LineOfSightByBruteForce(segment, few, ties))
    failure << "a line of sight is found, though there is none; ";
  return failure << LineOfSightIsClear(*witness, segment, few, Ties::kPass).message();
}

// Random segments of one of many kinds.
class SegmentSource {
 public:
  SegmentSource(std::int32_t side, std::int32_t max_height, std::uint32_t seed)
      : side_(side), max_height_(max_height), random_(seed) {}

  std::int32_t Below(std::int32_t bound) {
    return static_cast<std::int32_t>(random_() % static_cast<std::uint32_t>(bound));
  }
  Point3i AnyPoint() { return {Below(side_), Below(side_), Below(max_height_ + 1)}; }

  // Anywhere: on small grids chords cross, pass over each other's ends and overlap.
  Segment Chord() {
    for (;;) {
      const Segment s{AnyPoint(), AnyPoint()};
      if (s.a.x != s.b.x || s.a.y != s.b.y) return s;
    }
  }
  // Between neighbours in the grid.
  Segment GridEdge() {
    for (;;) {
      const Segment s{AnyPoint(), AnyPoint()};
      const std::int32_t dx = s.b.x - s.a.x;
      const std::int32_t dy = s.b.y - s.a.y;
      if (std::max(std::abs(dx), std::abs(dy)) == 1) return s;
    }
  }
  // On the line of `other` in plan, inside it or beyond it, at its height or near it.
  Segment InLineWith(const Segment& other) {
    const std::int32_t from = Below(4) - 1;
    const std::int32_t to = from + 1 + Below(2);
    const auto along = [&other](std::int32_t k, std::int32_t a, std::int32_t b) {
      return a + k * (b - a);
    };
    Segment s = other;
    s.a = {along(from, other.a.x, other.b.x), along(from, other.a.y, other.b.y),
           along(from, other.a.z, other.b.z)};
    s.b = {along(to, other.a.x, other.b.x), along(to, other.a.y, other.b.y),
           along(to, other.a.z, other.b.z)};
    if (Below(3) == 0) s.a.z += Below(3) - 1;
    if (!Inside(s.a) || !Inside(s.b)) return other;
    return s;
  }
  std::vector<Segment> Set(int count) {
    std::vector<Segment> set;
    while (static_cast<int>(set.size()) < count) {
      switch (set.empty() ? Below(2) : Below(4)) {
        case 0:
          set.push_back(Chord());
          break;
        case 1:
          set.push_back(GridEdge());
          break;
        case 2:
          set.push_back(InLineWith(set[static_cast<std::size_t>(Below(Size(set)))]));
          break;
        default: {  // equal height, or joined to another one
          Segment s = Chord();
          const Segment& other = set[static_cast<std::size_t>(Below(Size(set)))];
          if (Below(2) == 0) {
            s.b.z = s.a.z;
          } else if (other.b.x != s.b.x || other.b.y != s.b.y) {
            s.a = other.b;
          }
          set.push_back(s);
        }
      }
    }
    return set;
  }

 private:
  static std::int32_t Size(const std::vector<Segment>& set) {
    return static_cast<std::int32_t>(set.size());
  }
  [[nodiscard]] bool Inside(Point3i p) const {
    return p.x >= 0 && p.x < side_ && p.y >= 0 && p.y < side_;
  }

  std::int32_t side_;
  std::int32_t max_height_;
  std::mt19937 random_;
};

void ExpectTheOccluders(std::int32_t side, std::int32_t max_height, int occluders, int rounds,
                        std::uint32_t seed) {
  SegmentSource source(side, max_height, seed);
  int visible = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Segment> set = source.Set(2 + source.Below(occluders));
    const Segment segment = set.back();
    set.pop_back();
    for (const Ties ties : kBothTies) {
      ASSERT_TRUE(MatchesTheDefinition({side, side}, segment, set, ties)) << "round " << round;
      visible += LineOfSightByBruteForce(segment, set, ties) ? 1 : 0;
    }
  }
  EXPECT_GT(visible, rounds / 10);
  EXPECT_LT(visible, 2 * rounds - rounds / 10);
}

TEST(FindLineOfSight, IsTheDefinitionOnSegmentsThatCoincideInEveryWay) {
  ExpectTheOccluders(4, 3, 14, Rounds(12'000), 1);
}

TEST(FindLineOfSight, IsTheDefinitionOnLongChordsThatCross) {
  ExpectTheOccluders(30, 50, 40, Rounds(3'000), 2);
}

TEST(FindLineOfSight, IsTheDefinitionOnManySegments) {
  ExpectTheOccluders(10, 6, 120, Rounds(500), 3);
}

TEST(FindLineOfSight, IsTheDefinitionInALargePlanAtTheLimitsOfHeight) {
  constexpr std::int32_t kSide = 1'000;
  constexpr std::int32_t kHeight = (1 << 30) - 1;
  SegmentSource source(kSide, kHeight, 4);
  for (int round = 0; round < Rounds(500); ++round) {
    std::vector<Segment> set;
    for (int i = source.Below(20); i >= 0; --i) set.push_back(source.Chord());
    Segment segment = source.Chord();
    segment.a.z /= 2;
    for (const Ties ties : kBothTies) {
      ASSERT_TRUE(MatchesTheDefinition({kSide, kSide}, segment, set, ties)) << "round " << round;
    }
  }
}

// Chords between feet and tops that are 2^29 to 2^31 quanta apart and differ by single ones.
void ExpectTheDefinitionOnCliffs(std::int32_t side, int occluders, int rounds, std::uint32_t seed) {
  SegmentSource source(side, 3, seed);
  constexpr std::int32_t kTop = (1 << 30) - 4;
  const std::array<std::array<std::int32_t, 3>, 3> kinds{
      {{0, 0, 1 << 29}, {-kTop - 3, kTop, kTop}, {0, 1 << 16, kTop}}};
  for (int round = 0; round < rounds; ++round) {
    std::vector<Segment> set = source.Set(2 + source.Below(occluders));
    const auto& heights = kinds[static_cast<std::size_t>(round) % kinds.size()];
    for (Segment& s : set) {
      s.a.z += heights[static_cast<std::size_t>(source.Below(3))];
      s.b.z += heights[static_cast<std::size_t>(source.Below(3))];
    }
    const Segment segment = set.back();
    set.pop_back();
    for (const Ties ties : kBothTies) {
      ASSERT_TRUE(MatchesTheDefinition({side, side}, segment, set, ties)) << "round " << round;
    }
  }
}

TEST(FindLineOfSight, IsTheDefinitionOnCliffsThatDifferByAQuantum) {
  ExpectTheDefinitionOnCliffs(5, 25, Rounds(1'500), 9);
  ExpectTheDefinitionOnCliffs(60, 40, Rounds(500), 10);
  ExpectTheDefinitionOnCliffs(1'000, 60, Rounds(200), 11);
}

TEST(FindLineOfSightLong, IsTheDefinitionOnCliffsThatDifferByAQuantum) {
  ExpectTheDefinitionOnCliffs(5, 25, Rounds(30'000), 12);
  ExpectTheDefinitionOnCliffs(60, 40, Rounds(10'000), 13);
  ExpectTheDefinitionOnCliffs(1'000, 60, Rounds(5'000), 14);
}

TEST(FindLineOfSight, FindsALineInAnEmptySet) {
  const Segment segment{{0, 0, 5}, {3, 1, 2}};
  EXPECT_TRUE(MatchesTheDefinition({4, 4}, segment, {}, Ties::kBlock));
}

TEST(FindLineOfSight, GroundAtTheSameHeightOccludesOnlyWhereTiesBlock) {
  // A ring of horizontal segments around a horizontal one of the same height.
  const std::vector<Segment> ring{{{0, 0, 2}, {6, 0, 2}},
                                  {{6, 0, 2}, {6, 6, 2}},
                                  {{6, 6, 2}, {0, 6, 2}},
                                  {{0, 6, 2}, {0, 0, 2}}};
  const Segment segment{{2, 3, 2}, {4, 3, 2}};
  EXPECT_TRUE(FindItsLine({7, 7}, segment, ring, Ties::kPass));
  EXPECT_FALSE(FindItsLine({7, 7}, segment, ring, Ties::kBlock));
}

TEST(FindLineOfSight, ACopyOfTheSegmentOccludesItOnlyWhereTiesBlock) {
  const Segment segment{{0, 0, 2}, {3, 3, 7}};
  EXPECT_TRUE(FindItsLine({4, 4}, segment, {segment}, Ties::kPass));
  EXPECT_FALSE(FindItsLine({4, 4}, segment, {segment}, Ties::kBlock));
}

TEST(FindLineOfSight, IgnoresTheMemberThatIsExcepted) {
  SegmentSource source(5, 4, 5);
  for (int round = 0; round < Rounds(2'000); ++round) {
    const std::vector<Segment> set = source.Set(2 + source.Below(12));
    const auto asked =
        static_cast<std::size_t>(source.Below(static_cast<std::int32_t>(set.size())));
    OccluderSet occluders(5, 5);
    std::vector<OccluderId> ids;
    for (const Segment& s : set) ids.push_back(occluders.Insert(s));
    std::vector<Segment> others = set;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(asked));
    for (const Ties ties : kBothTies) {
      const VisibilityQuery query{.segment = set[asked], .ties = ties, .except = ids[asked]};
      ASSERT_EQ(occluders.FindLineOfSight(query).witness.has_value(),
                LineOfSightByBruteForce(set[asked], others, ties).has_value())
          << TextOfCase(ties) << ", number " << asked << " of\n"
          << DrawSegments(set);
    }
  }
}

TEST(FindLineOfSight, NamesMembersThatOccludeTheSegmentByThemselves) {
  SegmentSource source(6, 4, 6);
  int occluded = 0;
  for (int round = 0; round < Rounds(3'000); ++round) {
    std::map<OccluderId, Segment> members;
    OccluderSet occluders(6, 6);
    for (const Segment& s : source.Set(15)) members[occluders.Insert(s)] = s;
    const Segment segment = source.Chord();
    for (const Ties ties : kBothTies) {
      const Visibility answer =
          occluders.FindLineOfSight({.segment = segment, .ties = ties, .want_occluders = true});
      if (answer.witness) continue;
      ++occluded;
      std::vector<Segment> few;
      for (const OccluderId id : answer.occluders) {
        ASSERT_TRUE(members.contains(id));
        few.push_back(members.at(id));
      }
      ASSERT_FALSE(LineOfSightByBruteForce(segment, few, ties))
          << TextOfCase(ties) << ", segment " << DrawSegments({segment}) << "its occluders\n"
          << DrawSegments(few);
    }
  }
  EXPECT_GT(occluded, Rounds(500));
}

// A history of random insertions and erasures against a plain list of the members.
TEST(OccluderSet, AnswersForItsPresentMembersAfterAnyHistory) {
  SegmentSource source(6, 4, 7);
  for (int history = 0; history < Rounds(60); ++history) {
    OccluderSet occluders(6, 6);
    std::map<OccluderId, Segment> members;
    std::vector<OccluderId> ever;
    for (int step = 0; step < 80; ++step) {
      if (members.empty() || source.Below(5) < 3) {
        const Segment s = source.Chord();
        const OccluderId id = occluders.Insert(s);
        ASSERT_EQ(std::count(ever.begin(), ever.end(), id), 0) << "an id is never used again";
        ever.push_back(id);
        members[id] = s;
      } else {
        auto victim = members.begin();
        std::advance(victim, source.Below(static_cast<std::int32_t>(members.size())));
        occluders.Erase(victim->first);
        members.erase(victim);
      }
      ASSERT_EQ(occluders.size(), static_cast<std::int64_t>(members.size()));
      std::vector<Segment> set;
      for (const auto& [id, s] : members) set.push_back(s);
      const Segment segment = source.Chord();
      const Ties ties = kBothTies[static_cast<std::size_t>(step % 2)];
      const Visibility answer = occluders.FindLineOfSight({.segment = segment, .ties = ties});
      ASSERT_EQ(answer.witness.has_value(), LineOfSightByBruteForce(segment, set, ties).has_value())
          << TextOfCase(ties) << ", segment " << DrawSegments({segment}) << "members\n"
          << DrawSegments(set);
    }
  }
}

TEST(FindLineOfSight, GivesUpAtTheDecisionLimitAndNotBefore) {
  SegmentSource source(12, 30, 15);
  OccluderSet occluders(12, 12);
  for (const Segment& s : source.Set(80)) occluders.Insert(s);
  int gave_up = 0;
  for (int round = 0; round < Rounds(300); ++round) {
    VisibilityQuery query{.segment = source.Chord()};
    const Visibility whole = occluders.FindLineOfSight(query);
    query.decision_limit = whole.counts.Sum() + 1;
    EXPECT_FALSE(occluders.FindLineOfSight(query).gave_up);
    query.decision_limit = whole.counts.Sum() / 2;
    const Visibility half = occluders.FindLineOfSight(query);
    gave_up += half.gave_up ? 1 : 0;
    EXPECT_LE(half.counts.Sum(), whole.counts.Sum());
    if (half.gave_up) continue;
    EXPECT_EQ(half.witness.has_value(), whole.witness.has_value());
  }
  EXPECT_GT(gave_up, Rounds(300) / 10);
}

TEST(FindLineOfSight, CountsItsDecisions) {
  SegmentSource source(6, 4, 8);
  PredicateCounts counts;
  OccluderSet occluders(6, 6);
  for (const Segment& s : source.Set(30)) occluders.Insert(s);
  for (int i = 0; i < 20; ++i) {
    counts += occluders.FindLineOfSight({.segment = source.Chord()}).counts;
  }
  EXPECT_GT(counts.filtered + counts.exact, 0);
}

TEST(OccluderSet, LikelyOccludersChangeNoAnswer) {
  SegmentSource source(9, 12, 77);
  for (int round = 0; round < Rounds(2000); ++round) {
    OccluderSet occluders(9, 9);
    std::vector<Segment> set;
    std::vector<OccluderId> likely;
    for (int i = 0; i < 12; ++i) {
      set.push_back(source.Chord());
      const OccluderId id = occluders.Insert(set.back());
      if (source.Below(3) == 0) likely.push_back(id);
      if (source.Below(6) == 0) occluders.Erase(id);
    }
    const Segment segment = source.Chord();
    for (const Ties ties : kBothTies) {
      for (const auto& except : {std::optional<OccluderId>(), std::optional<OccluderId>(3)}) {
        VisibilityQuery query{.segment = segment, .ties = ties, .except = except};
        const bool plain = occluders.FindLineOfSight(query).witness.has_value();
        query.hints.likely = likely;
        EXPECT_EQ(occluders.FindLineOfSight(query).witness.has_value(), plain) << "round " << round;
      }
    }
  }
}

}  // namespace
}  // namespace farhorizon
