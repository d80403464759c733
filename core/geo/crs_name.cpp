// A name must come out the same for every tile of a survey, so it is made of the system alone: its
// code, that of an equivalent system, its own words, its PROJ string, in that order. A compound is
// named by its parts.
#include "core/geo/crs_name.h"

#include <memory>

#include <proj.h>
#include <proj_experimental.h>  // demotion to 2-D; GDAL builds on it too

#include "core/base/lower.h"
#include "core/geo/short_text.h"

namespace farhorizon {

namespace {

// PROJ's confidence, percent, from which a candidate is looked at: 70 where names or codes do not
// settle it (proj_identify's documentation). What decides is that the two are equivalent.
constexpr int kCandidate = 70;

// The name of a system that is no compound.
std::string NameOfPart(const ProjSession& session, const PJ* crs) {
  if (std::string code = CodeOf(crs); !code.empty()) return code;
  if (const ProjObject known = Identified(session, crs)) return CodeOf(known.get());
  // A map with heights above the ellipsoid has the name of the map.
  const ProjObject plan(proj_crs_demote_to_2D(session.get(), nullptr, crs));
  if (plan && !CodeOf(plan.get()).empty()) return CodeOf(plan.get());
  if (const ProjObject known = plan ? Identified(session, plan.get()) : nullptr) {
    return CodeOf(known.get());
  }
  const char* name = proj_get_name(crs);
  if (name != nullptr && !IsUnnamed(name)) return name;
  if (proj_get_type(crs) == PJ_TYPE_VERTICAL_CRS) return DatumName(session, crs);
  const char* text = proj_as_proj_string(session.get(), crs, PJ_PROJ_5, nullptr);
  if (text == nullptr || *text == '\0') return name != nullptr ? name : "";
  std::string shown = text;
  for (const char* word : {" +type=crs", " +no_defs"}) {
    if (const std::size_t at = shown.find(word); at != std::string::npos) {
      shown.erase(at, std::string(word).size());
    }
  }
  return shown;
}

}  // namespace

std::string CodeOf(const PJ* object) {
  const char* authority = proj_get_id_auth_name(object, 0);
  const char* code = proj_get_id_code(object, 0);
  return authority != nullptr && code != nullptr ? std::string(authority) + ":" + code : "";
}

ProjObject Identified(const ProjSession& session, const PJ* crs) {
  int* confidence = nullptr;
  const std::unique_ptr<PJ_OBJ_LIST, void (*)(PJ_OBJ_LIST*)> known(
      proj_identify(session.get(), crs, "EPSG", nullptr, &confidence), proj_list_destroy);
  const int count = known ? proj_list_get_count(known.get()) : 0;
  ProjObject found;
  for (int i = 0; i < count && !found; ++i) {
    if (confidence[i] < kCandidate) break;
    ProjObject one(proj_list_get(session.get(), known.get(), i));
    if (one && proj_is_equivalent_to_with_ctx(session.get(), crs, one.get(),
                                              PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0) {
      // As the database has it: what proj_identify returns may lack the area of use.
      found.reset(proj_create(session.get(), CodeOf(one.get()).c_str()));
    }
  }
  proj_int_list_destroy(confidence);
  return found;
}

std::string NameOf(const ProjSession& session, const PJ* crs) {
  if (std::string code = CodeOf(crs); !code.empty()) return code;
  if (proj_get_type(crs) != PJ_TYPE_COMPOUND_CRS) return NameOfPart(session, crs);
  const ProjObject plan(proj_crs_get_sub_crs(session.get(), crs, 0));
  const ProjObject heights(proj_crs_get_sub_crs(session.get(), crs, 1));
  if (!plan || !heights) return NameOfPart(session, crs);
  const std::string first = NameOfPart(session, plan.get());
  const std::string second = NameOfPart(session, heights.get());
  const std::size_t colon = first.find(':');
  const bool one_authority = colon != std::string::npos &&
                             first.substr(0, colon + 1) == second.substr(0, colon + 1) &&
                             first.find(' ') == std::string::npos;
  return one_authority ? first + "+" + second.substr(colon + 1) : first + " + " + second;
}

std::string HorizontalDatumName(const ProjSession& session, const PJ* plan) {
  const ProjObject geodetic(proj_crs_get_geodetic_crs(session.get(), plan));
  return geodetic ? DatumName(session, geodetic.get()) : "";
}

std::string DatumName(const ProjSession& session, const PJ* crs) {
  ProjObject datum(proj_crs_get_datum(session.get(), crs));
  if (!datum) datum.reset(proj_crs_get_datum_ensemble(session.get(), crs));
  const char* name = datum ? proj_get_name(datum.get()) : nullptr;
  return name != nullptr ? name : "";
}

bool IsUnnamed(const std::string& name) {
  const std::string lower = Lower(name);
  return lower.empty() || lower == "unknown" || lower == "unnamed" || lower == "undefined" ||
         lower == "user-defined" || lower == "n/a" || lower.starts_with("unknown ");
}

}  // namespace farhorizon
