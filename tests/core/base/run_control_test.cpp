#include "core/base/run_control.h"

#include <algorithm>
#include <stop_token>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(RunControl, APieceReportsToItsPieceOfTheWhole) {
  std::vector<double> reported;
  RunControl control;
  control.progress = [&reported](Stage stage, double done) {
    EXPECT_EQ(stage, Stage::kMeasure);
    reported.push_back(done);
  };
  const int pieces = 7;
  for (int i = 0; i < pieces; ++i) {
    const RunControl piece =
        control.Between(i / static_cast<double>(pieces), (i + 1) / static_cast<double>(pieces));
    for (const double done : {0.0, 0.3, 1.0}) piece.Report(Stage::kMeasure, done);
  }
  ASSERT_EQ(reported.size(), 21U);
  EXPECT_EQ(reported.front(), 0);
  EXPECT_EQ(reported.back(), 1);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  reported.clear();
  control.Between(0.5, 1).Between(0, 0.5).Report(Stage::kMeasure, 1);
  EXPECT_EQ(reported, std::vector<double>{0.75}) << "of a piece of a piece";
}

TEST(RunControl, APieceTellsAndStopsAsTheWholeDoes) {
  std::string told;
  std::stop_source source;
  const RunControl control{
      {}, source.get_token(), [&told](const std::string& text) { told = text; }};
  const RunControl piece = control.Between(0.2, 0.4);
  piece.Report(Stage::kRead, 1);  // nobody listens
  piece.Warn("something");
  EXPECT_EQ(told, "something");
  EXPECT_FALSE(piece.StopRequested());
  source.request_stop();
  EXPECT_TRUE(piece.StopRequested());
}

}  // namespace
}  // namespace farhorizon
