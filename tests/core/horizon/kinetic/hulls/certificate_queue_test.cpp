// The order of events, and which of them are stale.
#include "core/horizon/kinetic/hulls/certificate_queue.h"

#include <cstdint>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "core/base/result.h"

namespace farhorizon::kinetic {
namespace {

constexpr CertificateKind kKind = CertificateKind::kTangent;

/// The root of s^2 - square, which is no whole number.
SweepDepth RootOf(std::int64_t square) { return RootsOf({-Int128{square}, 0, 1}).at[1]; }

TEST(CertificateQueue, GivesEventsByDepth) {
  CertificateQueue queue;
  queue.Schedule(kKind, 3, SweepDepth::At(2));
  queue.Schedule(kKind, 1, RootOf(3));
  queue.Schedule(kKind, 2, SweepDepth::At(1));
  queue.Schedule(kKind, 0, RootOf(2));
  for (const std::int32_t id : {2, 0, 1, 3}) {
    const std::optional<SweepDepth> next = queue.NextDepth();
    ASSERT_TRUE(next);
    const std::optional<Event> event = queue.PopAt(*next);
    ASSERT_TRUE(event);
    EXPECT_EQ(event->id, id);
  }
  EXPECT_FALSE(queue.NextDepth());
}

TEST(CertificateQueue, DropsStaleEvents) {
  CertificateQueue queue;
  queue.Schedule(kKind, 0, SweepDepth::At(1));
  queue.Schedule(kKind, 0, SweepDepth::At(5));  // in place of the first
  queue.Schedule(kKind, 1, SweepDepth::At(2));
  queue.Cancel(kKind, 1);
  queue.Schedule(kKind, 2, SweepDepth::At(3));
  queue.Schedule(kKind, 2, std::nullopt);  // never fails any more
  EXPECT_EQ(queue.pending(), 1);
  ASSERT_TRUE(queue.NextDepth());
  EXPECT_EQ(Compare(*queue.NextDepth(), SweepDepth::At(5)), 0);
  EXPECT_FALSE(queue.PopAt(SweepDepth::At(4)));
  EXPECT_EQ(queue.PopAt(SweepDepth::At(5))->id, 0);
  EXPECT_EQ(queue.pending(), 0);
  EXPECT_FALSE(queue.NextDepth());
}

TEST(CertificateQueue, KeepsCertificatesOfEachKindApart) {
  CertificateQueue queue;
  queue.Schedule(CertificateKind::kHull, 7, SweepDepth::At(1));
  queue.Schedule(CertificateKind::kInterior, 7, SweepDepth::At(1));
  queue.Cancel(CertificateKind::kHull, 7);
  EXPECT_TRUE(queue.WasUsed(CertificateKind::kHull, 7));
  EXPECT_FALSE(queue.WasUsed(CertificateKind::kTangent, 7));
  EXPECT_FALSE(queue.WasUsed(CertificateKind::kHull, 8));
  EXPECT_EQ(queue.PopAt(SweepDepth::At(1))->kind, CertificateKind::kInterior);
  EXPECT_FALSE(queue.PopAt(SweepDepth::At(1)));
}

TEST(CertificateQueue, GivesAllEventsOfOneDepth) {
  CertificateQueue queue;
  queue.Schedule(kKind, 0, RootOf(2));
  queue.Schedule(kKind, 1, RootsOf({-6, 0, 3}).at[1]);  // the same root of another polynomial
  queue.Schedule(kKind, 2, RootOf(3));
  std::set<std::int32_t> ids;
  while (const std::optional<Event> event = queue.PopAt(RootOf(2))) ids.insert(event->id);
  EXPECT_EQ(ids, (std::set<std::int32_t>{0, 1}));
}

TEST(CertificateQueue, ThrowsWhereAnEventWasPassedOver) {
  CertificateQueue queue;
  queue.Schedule(kKind, 0, RootOf(2));
  EXPECT_THROW(queue.PopAt(SweepDepth::At(2)), InternalError);
}

}  // namespace
}  // namespace farhorizon::kinetic
