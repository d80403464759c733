#include "core/horizon/lines_of_sight/upper_envelope.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/oracles/skyline_by_definition.h"
#include "tests/support/effort.h"

namespace farhorizon {
namespace {

using boost::multiprecision::cpp_int;

Number ExactValue(const Fraction& f) {
  return Number(cpp_int(f.numerator), cpp_int(f.denominator));
}

std::vector<SeenStretch> ExactValue(const std::vector<EnvelopePiece>& envelope) {
  std::vector<SeenStretch> stretches;
  for (const EnvelopePiece& piece : envelope) {
    stretches.push_back({piece.segment, ExactValue(piece.from), ExactValue(piece.to)});
  }
  return stretches;
}

// A random segment within +-side in plan, heights within 0 ... top.
Segment AnySegment(std::int32_t side, std::int32_t top, std::mt19937& random) {
  const auto point = [&] {
    const auto within = [&](std::int32_t limit) {
      return static_cast<std::int32_t>(random() % (2 * static_cast<std::uint32_t>(limit) + 1)) -
             limit;
    };
    return Point3i{within(side), within(side), within(top)};
  };
  return {point(), point()};
}

TEST(UpperEnvelope, IsTheSkylineByItsDefinition) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(3000); ++round) {
    // Small numbers tie often; segments may cross, and be in front of one another.
    const auto side = static_cast<std::int32_t>(2 + random() % 5);
    const auto top = static_cast<std::int32_t>(random() % 4);
    std::vector<Segment> segments(random() % 9);
    for (Segment& s : segments) s = AnySegment(side, top, random);
    const auto step = [&] { return static_cast<std::int32_t>(random() % 7) - 3; };
    ViewDirection view{step(), step()};
    if (view.dc == 0 && view.dr == 0) view.dc = 1;
    ASSERT_EQ(ExactValue(UpperEnvelope(segments, view)), SkylineByDefinition(segments, view))
        << round;
  }
}

TEST(UpperEnvelope, IsExactAtTheLimits) {
  std::mt19937 random(2);
  for (int round = 0; round < Rounds(200); ++round) {
    std::vector<Segment> segments(6);
    for (Segment& s : segments) s = AnySegment(1 << 16, (1 << 30) - 1, random);
    // Two at one height at all offsets, or a quantum apart at one end.
    segments[1] = segments[0];
    segments[1].a.z -= static_cast<std::int32_t>(random() % 2);
    const auto step = [&] {
      return static_cast<std::int32_t>(random() % (2UL * kMaxViewStep)) - kMaxViewStep;
    };
    const ViewDirection view{random() % 2 == 0 ? kMaxViewStep : step(), step()};
    ASSERT_EQ(ExactValue(UpperEnvelope(segments, view)), SkylineByDefinition(segments, view))
        << round;
  }
}

TEST(UpperEnvelope, OfNothingIsNothing) {
  EXPECT_TRUE(UpperEnvelope({}, {1, 0}).empty());
  const std::vector<Segment> along = {{{0, 0, 5}, {3, 0, 9}}};
  EXPECT_TRUE(UpperEnvelope(along, {1, 0}).empty());
}

}  // namespace
}  // namespace farhorizon
