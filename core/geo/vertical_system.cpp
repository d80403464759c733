// The heights of a reference system: their axis, their datum, and the search for a vertical system
// by the name of its datum.
#include "core/geo/vertical_system.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <proj.h>
#include <proj_experimental.h>  // compound systems, demotion to 2-D; GDAL builds on it too

#include "core/base/lower.h"
#include "core/geo/crs_name.h"
#include "core/geo/parse_crs.h"
#include "core/geo/short_text.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxCandidates = 5;  // in a message

Error Unusable(const std::string& message) {
  return {ErrorCode::kUnsupportedData, message, "unknown-crs"};
}

ProjObject Unbound(const ProjSession& session, const PJ* crs) {
  if (proj_get_type(crs) == PJ_TYPE_BOUND_CRS) {
    return ProjObject(proj_get_source_crs(session.get(), crs));
  }
  return ProjObject(proj_clone(session.get(), crs));
}

// The part of `crs` that has its heights: its vertical part, or itself.
ProjObject HeightPart(const ProjSession& session, const PJ* crs) {
  ProjObject part = Unbound(session, crs);
  if (part && proj_get_type(part.get()) == PJ_TYPE_COMPOUND_CRS) {
    part.reset(proj_crs_get_sub_crs(session.get(), part.get(), 1));
    if (part) part = Unbound(session, part.get());
  }
  return part;
}

// The name of the datum of the vertical part of `crs` in small letters; "" where it has none.
std::string VerticalDatum(const ProjSession& session, const PJ* crs) {
  const ProjObject part = HeightPart(session, crs);
  if (!part || proj_get_type(part.get()) != PJ_TYPE_VERTICAL_CRS) return "";
  return Lower(DatumName(session, part.get()));
}

// Without blanks, and in small letters: "NAVD 88" and "navd88" are one.
std::string Bare(const std::string& name) {
  std::string bare = Lower(name);
  std::erase(bare, ' ');
  return bare == "meansealevel" ? "msl" : bare;
}

// The vertical system whose name is `name`, or `name` and "height"; else the only one that has
// `name` in its name; else an error that lists those that do, heights first; null where none does.
Result<ProjObject> FindByName(ProjSession& session, const std::string& name) {
  const PJ_TYPE type = PJ_TYPE_VERTICAL_CRS;
  const std::unique_ptr<PJ_OBJ_LIST, void (*)(PJ_OBJ_LIST*)> found(
      proj_create_from_name(session.get(), nullptr, name.c_str(), &type, 1, 1, 0, nullptr),
      proj_list_destroy);
  const int count = found ? proj_list_get_count(found.get()) : 0;
  std::vector<std::string> heights;
  std::vector<std::string> depths;
  for (int i = 0; i < count; ++i) {
    ProjObject one(proj_list_get(session.get(), found.get(), i));
    const std::string full = proj_get_name(one.get());
    if (Bare(full) == Bare(name) || Bare(full) == Bare(name) + "height") return one;
    const bool depth = Bare(full).find("depth") != std::string::npos;
    (depth ? depths : heights).push_back(CodeOf(one.get()) + " (" + full + ")");
  }
  if (count == 0) return ProjObject();
  if (count == 1) return ProjObject(proj_list_get(session.get(), found.get(), 0));
  heights.insert(heights.end(), depths.begin(), depths.end());
  std::string list;
  for (std::size_t i = 0; i < std::min(heights.size(), kMaxCandidates); ++i) {
    list += (i == 0 ? "" : ", ") + heights[i];
  }
  return Unusable(ShownCrsText(name, CrsRole::kHeights) +
                  " fits several; give --vertical-datum the code of one, such as " + list +
                  ", or \"ellipsoid\"");
}

}  // namespace

std::optional<HeightAxis> HeightAxisOf(const ProjSession& session, const PJ* crs) {
  const ProjObject part = HeightPart(session, crs);
  const ProjObject system(part ? proj_crs_get_coordinate_system(session.get(), part.get())
                               : nullptr);
  if (!system) return std::nullopt;
  const int count = proj_cs_get_axis_count(session.get(), system.get());
  if (count == 2) return std::nullopt;  // 1: a vertical system; 3: its last
  HeightAxis axis;
  const char* direction = nullptr;
  const char* unit = nullptr;
  if (proj_cs_get_axis_info(session.get(), system.get(), count - 1, nullptr, nullptr, &direction,
                            &axis.unit_m, &unit, nullptr, nullptr) == 0) {
    return std::nullopt;
  }
  if (unit != nullptr) axis.unit = unit;
  axis.down = direction != nullptr && std::string(direction) == "down";
  return axis;
}

ProjObject HeightsOf(const ProjSession& session, const PJ* crs) {
  const ProjObject whole = Unbound(session, crs);
  if (!whole || proj_get_type(whole.get()) != PJ_TYPE_COMPOUND_CRS) return nullptr;
  return ProjObject(proj_crs_get_sub_crs(session.get(), whole.get(), 1));
}

bool NamesHeightDatum(const ProjSession& session, const PJ* crs) {
  const ProjObject part = HeightPart(session, crs);
  if (!part || !HeightAxisOf(session, part.get())) return false;
  return proj_get_type(part.get()) != PJ_TYPE_VERTICAL_CRS ||
         !IsUnnamed(DatumName(session, part.get()));
}

bool IsAboveEllipsoid(const ProjSession& session, const PJ* crs) {
  return VerticalDatum(session, crs).find("ellipsoid") != std::string::npos;
}

bool IsMeanSeaLevel(const ProjSession& session, const PJ* crs) {
  return VerticalDatum(session, crs) == "mean sea level";
}

Result<ProjObject> ReadVerticalSystem(ProjSession& session, const std::string& text) {
  const std::string complete = CompletedCrsText(text);
  if (Status allowed = CheckCrsText(complete, CrsRole::kHeights); !allowed) {
    return std::move(allowed.error());
  }
  // A name is one of a vertical system before it is anything else: "EGM96" is a datum, too.
  if (complete.find_first_of(":[{=") == std::string::npos) {
    Result<ProjObject> named = FindByName(session, complete);
    if (!named || *named) return named;
  }
  Result<ProjObject> crs = ParseCrs(session, complete, CrsRole::kHeights);
  if (!crs) return crs;
  const ProjObject heights = HeightsOf(session, crs->get());
  const PJ* whole = heights ? heights.get() : crs->get();
  const ProjObject unbound = Unbound(session, whole);
  if (!unbound || proj_get_type(unbound.get()) != PJ_TYPE_VERTICAL_CRS) {
    return Unusable(ShownCrsText(text, CrsRole::kHeights) + " is no vertical reference system; " +
                    RemedyFor(CrsRole::kHeights));
  }
  return ProjObject(proj_clone(session.get(), whole));
}

Result<ProjObject> WithoutHeights(const ProjSession& session, ProjObject crs) {
  const std::string name = NameOf(session, crs.get());
  ProjObject plan(proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS
                      ? proj_crs_get_sub_crs(session.get(), crs.get(), 0)
                      : crs.release());
  if (plan && HeightAxisOf(session, plan.get())) {
    plan.reset(proj_crs_demote_to_2D(session.get(), nullptr, plan.get()));
  }
  if (!plan) {
    return Unusable("reference system \"" + name + "\" has no horizontal part; " +
                    RemedyFor(CrsRole::kMap));
  }
  return plan;
}

Result<ProjObject> WithEllipsoidalHeights(const ProjSession& session, ProjObject crs) {
  Result<ProjObject> plan = WithoutHeights(session, std::move(crs));
  if (!plan) return plan;
  ProjObject high(proj_crs_promote_to_3D(session.get(), nullptr, plan->get()));
  if (!high) {
    return Unusable("reference system " + NameOf(session, plan->get()) + " takes no heights" +
                    session.Complaint() + "; give another with --crs");
  }
  return high;
}

Result<ProjObject> WithHeights(const ProjSession& session, ProjObject crs, const PJ* heights) {
  Result<ProjObject> plan = WithoutHeights(session, std::move(crs));
  if (!plan) return plan;
  const ProjObject own(proj_clone(session.get(), heights));
  ProjObject both(proj_create_compound_crs(session.get(), nullptr, plan->get(), own.get()));
  if (!both) {
    return Unusable("the vertical datum " + NameOf(session, heights) + " does not go with " +
                    NameOf(session, plan->get()) + session.Complaint() +
                    "; give --vertical-datum ellipsoid, or another system with --crs");
  }
  return both;
}

}  // namespace farhorizon
