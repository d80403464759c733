#include "core/geo/reference_data.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <proj.h>

#include "core/geo/proj_session.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

/// The height shift of `grid` at 7 degrees east, 46 north; infinite where PROJ does not open it.
double ShiftOf(const std::string& grid) {
  const ProjSession session;
  const ProjObject shift(
      proj_create(session.get(), ("+proj=vgridshift +multiplier=1 +grids=" + grid).c_str()));
  if (!shift) return HUGE_VAL;
  constexpr double kDegree = 0.017453292519943295;
  return proj_trans(shift.get(), PJ_FWD, proj_coord(7 * kDegree, 46 * kDegree, 0, 0)).lpz.z;
}

TEST(ReferenceData, TheDatabaseIsThatOfThePackage) {
  ASSERT_TRUE(CheckReferenceData());
  const TempDir folder;
  SpillFile(folder / "proj.db", "not a database");
  ::setenv("PROJ_DATA", folder.path().c_str(), 1);
  ::setenv("PROJ_LIB", folder.path().c_str(), 1);
  ::setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
  const ProjSession session;
  const ProjObject crs(proj_create(session.get(), "EPSG:32610"));
  EXPECT_TRUE(crs) << session.Complaint();
  const char* database = proj_context_get_database_path(session.get());
  ASSERT_NE(database, nullptr);
  EXPECT_EQ(std::string(database).find(folder.path().string()), std::string::npos) << database;
  for (const char* name : {"PROJ_DATA", "PROJ_LIB", "XDG_DATA_HOME"}) ::unsetenv(name);
}

TEST(ReferenceData, GridsOfThePackageAloneAreOpened) {
  EXPECT_NEAR(ShiftOf("egm96_15.gtx"), 52, 3);  // the geoid above the ellipsoid in Valais
  const TempDir folder;
  const ProjSession session;
  const std::filesystem::path database = proj_context_get_database_path(session.get());
  const std::filesystem::path copy = folder / "canary.gtx";
  std::filesystem::copy_file(database.parent_path() / "egm96_15.gtx", copy);
  EXPECT_TRUE(std::isinf(ShiftOf(copy.string())));
  EXPECT_TRUE(std::isinf(ShiftOf((database.parent_path() / "..").string() + copy.string())));
}

}  // namespace
}  // namespace farhorizon
