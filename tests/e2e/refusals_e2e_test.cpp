// What no job could build is refused before the 201, by its cause.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

std::string Grid(const std::string& south, const std::string& step, const std::string& heights) {
  return "ncols 4\nnrows 4\nxllcorner 7\nyllcorner " + south + "\ncellsize " + step +
         "\nNODATA_value -9999\n" + heights;
}

TEST(RefusalsE2e, EachCauseHasItsCode) {
  const TempDir folder;
  const Process service({FARHORIZON_PROGRAM, "serve", "--listen", "127.0.0.1:0", "--data",
                         (folder / "data").string()},
                        {}, folder / "log");
  const std::uint16_t port = PortOf(folder / "log");
  ASSERT_NE(port, 0) << SlurpFile(folder / "log");
  const std::string hills = "1 2 3 4\n2 3 4 5\n3 4 9 6\n4 5 6 7\n";
  const std::string voids = "-9999 -9999 -9999 -9999\n";
  const std::string sound = Grid("46", "0.001", hills);
  const std::vector<std::pair<std::string, std::pair<std::string, std::string>>> kinds = {
      {"unknown-crs", {"EPSG:4978", sound}},
      {"outside-crs", {"EPSG:4326", Grid("500", "0.001", hills)}},
      {"outside-crs", {"EPSG:32632", Grid("46", "1e300", hills)}},
      {"no-surface",
       {"EPSG:4326", Grid("46", "0.001", "5 -9999 -9999 -9999\n" + voids + voids + voids)}},
      {"height-out-of-range",
       {"EPSG:4326", Grid("46", "0.001", "1 2 3 4\n2 3 25000 5\n3 4 9 6\n4 5 6 7\n")}},
      {"unknown-crs", {"%2Bproj%3Dlonglat%20%2Bgeoidgrids%09%3D%2Ftmp%2Fx%20%2Btype%3Dcrs", sound}},
      {"unknown-crs", {"%2Binit%20%3D%2Ftmp%2Fx%3Ay", sound}},
  };
  for (const auto& [code, request] : kinds) {
    const auto& [crs, body] = request;
    const RawAnswer answer = Ask(port, "POST", "/jobs?filename=a.asc&crs=" + crs,
                                 "Content-Type: application/octet-stream\r\n", body);
    EXPECT_EQ(answer.status, 422) << code << crs;
    EXPECT_EQ(nlohmann::json::parse(answer.body).value("code", ""), code) << answer.body;
  }
}

}  // namespace
}  // namespace farhorizon
