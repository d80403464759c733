#include "core/horizon/visibility/occluder_set.h"

#include "core/horizon/visibility/segment_index.h"

namespace farhorizon {

struct OccluderSet::Index {
  SegmentIndex segments;
};

OccluderSet::OccluderSet(std::int32_t columns, std::int32_t rows)
    : index_(std::make_unique<Index>(Index{SegmentIndex(columns, rows)})) {}
OccluderSet::~OccluderSet() = default;
OccluderSet::OccluderSet(OccluderSet&&) noexcept = default;
OccluderSet& OccluderSet::operator=(OccluderSet&&) noexcept = default;

OccluderId OccluderSet::Insert(const Segment& segment) { return index_->segments.Insert(segment); }
void OccluderSet::Erase(OccluderId id) { index_->segments.Erase(id); }
std::int64_t OccluderSet::size() const { return index_->segments.alive(); }

Visibility OccluderSet::FindLineOfSight(const VisibilityQuery& query) const {
  return farhorizon::FindLineOfSight(index_->segments, query);
}

}  // namespace farhorizon
