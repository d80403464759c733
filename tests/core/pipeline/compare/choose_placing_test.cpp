#include "core/pipeline/compare/choose_placing.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/placed_dem.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;

constexpr int kLastColumn = PlacedDem::kColumns - 1;
constexpr int kLastRow = PlacedDem::kRows - 1;

class ChoosePlacingTest : public testing::Test {
 protected:
  // The frame that is chosen, with " y" where y is up; the error's message where none is.
  std::string Chosen(const FileMesh& mesh, const StatedPlacing& stated = {}) {
    const auto chosen = ChoosePlacing(mesh, stated, dem_.input());
    if (!chosen) return std::string(chosen.error().kind.name()) + ": " + chosen.error().message;
    ExpectOnPosts(mesh, chosen->placing);
    return MeshFrameName(chosen->placing.frame) +
           std::string(chosen->placing.up == UpAxis::kY ? " y" : "") +
           (chosen->assumed ? "" : ", stated");
  }

  // Each point is at its post: within a thousandth of a cell and a millimetre.
  void ExpectOnPosts(const FileMesh& mesh, const MeshPlacing& placing) {
    const auto grid = PlaceOnGrid(mesh.points, placing, dem_.input());
    ASSERT_TRUE(grid) << grid.error().message;
    const PlainMesh posts = dem_.InPosts();
    for (std::size_t i = 0; i < posts.points.size(); ++i) {
      ASSERT_NEAR((*grid)[i].column, posts.points[i][0], 1e-3);
      ASSERT_NEAR((*grid)[i].row, posts.points[i][1], 1e-3);
      ASSERT_NEAR((*grid)[i].height_m, posts.points[i][2], 1e-3);
    }
  }

  // Metres along rows and columns, as a stranger counts them: on a sphere, rounded.
  PlainMesh InMetres(double from_column, double from_row, double down) const {
    return dem_.In([=](double c, double r, double h) -> FilePoint {
      return {(c - from_column) * 77.3, (r - from_row) * 111.2 * down, h};
    });
  }

  PlacedDem dem_;
};

TEST_F(ChoosePlacingTest, FindsEveryFrameWithEitherAxisUp) {
  const std::pair<const char*, PlainMesh> frames[] = {
      {"posts", dem_.InPosts()},
      {"posts-up", dem_.In([](double c, double r, double h) -> FilePoint {
         return {c, kLastRow - r, h};
       })},
      {"crs", dem_.In([](double c, double r, double h) -> FilePoint {
         return {PlacedDem::kWest + c * PlacedDem::kStep, PlacedDem::kNorth - r * PlacedDem::kStep,
                 h};
       })},
      {"corner", InMetres(0, kLastRow, -1)},
      {"corner-down", InMetres(0, 0, 1)},
      {"centre", InMetres(kLastColumn / 2.0, kLastRow / 2.0, -1)},
      {"tile", dem_.InTileFrame()},
  };
  for (const auto& [name, mesh] : frames) {
    EXPECT_EQ(Chosen(AsFile(mesh)), name);
    EXPECT_EQ(Chosen(AsFile(YUp(mesh))), std::string(name) + " y");
    EXPECT_EQ(Chosen(AsFile(YUp(mesh), FileFrame::kYUp)), std::string(name) + " y");
    // A glTF whose writer did not turn it.
    EXPECT_EQ(Chosen(AsFile(mesh, FileFrame::kYUp)), name);
  }
  EXPECT_EQ(Chosen(AsFile(dem_.InEcef())), "ecef");
}

TEST_F(ChoosePlacingTest, StretchesCellsOfAnotherSizeWhereHeightsTell) {
  const PlainMesh squares = dem_.In([](double c, double r, double h) -> FilePoint {
    return {c * 30, (kLastRow - r) * 30, h};
  });
  EXPECT_EQ(Chosen(AsFile(squares)), "corner");
  EXPECT_EQ(Chosen(AsFile(YUp(squares))), "corner y");
  const auto chosen = ChoosePlacing(AsFile(squares), {}, dem_.input());
  EXPECT_THAT(chosen->text, HasSubstr("a cell is 30 x 30 of its metres"));
  // From anywhere: as three.js lays out a grid, rows along z from the first one.
  const PlainMesh scene = dem_.In([](double c, double r, double h) -> FilePoint {
    return {7 + c * 2, h, r * 2 - 11};
  });
  EXPECT_EQ(Chosen(AsFile(scene)), "corner y");
  EXPECT_EQ(Chosen(AsFile(scene), {.frame = MeshFrame::kCorner, .up = UpAxis::kY}),
            "corner y, stated");
}

TEST_F(ChoosePlacingTest, TakesTheWordOfTheFileAndOfTheCall) {
  EXPECT_EQ(Chosen(AsFile(dem_.InEcef(), FileFrame::kEcef)), "ecef, stated");
  EXPECT_EQ(Chosen(AsFile(dem_.InTileFrame(), FileFrame::kTile)), "tile, stated");
  EXPECT_EQ(Chosen(AsFile(dem_.InPosts()), {.frame = MeshFrame::kPosts}), "posts");
  EXPECT_EQ(Chosen(AsFile(dem_.InPosts()), {.frame = MeshFrame::kPosts, .up = UpAxis::kZ}),
            "posts, stated");
  EXPECT_THAT(Chosen(AsFile(dem_.InPosts()), {.frame = MeshFrame::kEcef}),
              HasSubstr("mesh-elsewhere"));
}

TEST_F(ChoosePlacingTest, AddsTheStatedOffsetAlongTheVertical) {
  for (const PlainMesh& mesh : {dem_.InPosts(), dem_.InEcef(), dem_.InTileFrame()}) {
    PlainMesh lowered = mesh;
    const auto chosen = ChoosePlacing(AsFile(mesh), {.height_offset_m = 40}, dem_.input());
    ASSERT_TRUE(chosen) << chosen.error().message;
    const auto grid = PlaceOnGrid(mesh.points, chosen->placing, dem_.input());
    for (std::size_t i = 0; i < mesh.points.size(); i += 7) {
      EXPECT_NEAR((*grid)[i].height_m, dem_.InPosts().points[i][2] + 40, 1e-3);
      EXPECT_NEAR((*grid)[i].column, dem_.InPosts().points[i][0], 1e-3);
    }
  }
}

TEST_F(ChoosePlacingTest, LeavesAMeshOfTheMapWhereItSaysItIs) {
  // Half a cell off, as by pixels taken for points.
  const auto off = dem_.In([](double c, double r, double h) -> FilePoint {
    return {PlacedDem::kWest + (c + 0.5) * PlacedDem::kStep,
            PlacedDem::kNorth - (r + 0.5) * PlacedDem::kStep, h};
  });
  const auto chosen = ChoosePlacing(AsFile(off), {}, dem_.input());
  ASSERT_TRUE(chosen) << chosen.error().message;
  EXPECT_EQ(chosen->placing.frame, MeshFrame::kCrs);
}

TEST_F(ChoosePlacingTest, SaysFromWhereAMeshIsCountedThatItMoves) {
  const auto far = dem_.In([](double c, double r, double h) -> FilePoint {
    return {5e5 + c * 77.3, 4e6 + (kLastRow - r) * 111.2, h};
  });
  const auto chosen = ChoosePlacing(AsFile(far), {}, dem_.input());
  ASSERT_TRUE(chosen) << chosen.error().message;
  EXPECT_EQ(chosen->placing.frame, MeshFrame::kCorner);
  EXPECT_THAT(chosen->text, HasSubstr("counted from x 500000 and y 4000000"));
}

TEST_F(ChoosePlacingTest, SaysWhereAMeshIsThatLiesElsewhere) {
  PlainMesh east = dem_.InEcef();
  for (auto& p : east.points) p[1] += 10'000;
  const std::string far = Chosen(AsFile(east, FileFrame::kEcef));
  EXPECT_THAT(far, HasSubstr("mesh-elsewhere"));
  // At longitude 7 almost all of y is east.
  EXPECT_THAT(far, HasSubstr("its middle is 9920."));
  const std::string unplaced = Chosen(AsFile(dem_.In([](double c, double r, double h) -> FilePoint {
    return {c * 1e9, r * 1e9, std::fmod(h * 31, 17)};
  })));
  EXPECT_THAT(unplaced, HasSubstr("x from 0 to 29000000000"));
  EXPECT_THAT(unplaced, HasSubstr("30 x 20 posts"));
  EXPECT_THAT(unplaced, HasSubstr("--mesh-frame"));
}

TEST(ChoosePlacing, AsksWhereHeightsCannotTell) {
  const PlacedDem flat([](int, int) { return 100; });
  const auto chosen = ChoosePlacing(AsFile(flat.InPosts()), {}, flat.input());
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().kind, "mesh-frame");
  EXPECT_EQ(chosen.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(chosen.error().message,
              HasSubstr("--mesh-frame posts --mesh-up z, or --mesh-frame posts-up --mesh-up z"))
      << "level ground does not tell where north is";
  const auto stated =
      ChoosePlacing(AsFile(flat.InPosts()), {.frame = MeshFrame::kPosts}, flat.input());
  ASSERT_TRUE(stated) << stated.error().message;
  EXPECT_EQ(stated->placing.up, UpAxis::kZ);
}

TEST(ChoosePlacing, BelievesAPlaceOnLevelGround) {
  const PlacedDem flat([](int, int) { return 100; });
  const PlainMesh map = flat.In([](double c, double r, double h) -> FilePoint {
    return {PlacedDem::kWest + c * PlacedDem::kStep, PlacedDem::kNorth - r * PlacedDem::kStep, h};
  });
  for (const auto& [mesh, frame] :
       {std::pair{map, MeshFrame::kCrs}, {flat.InEcef(), MeshFrame::kEcef}}) {
    const auto chosen = ChoosePlacing(AsFile(mesh), {}, flat.input());
    ASSERT_TRUE(chosen) << chosen.error().message;
    EXPECT_EQ(chosen->placing.frame, frame);
  }
}

TEST(ChoosePlacing, PlacesAPartAndACoarseMesh) {
  const PlacedDem dem;
  // Two triangles over a quarter of the DEM, at its own heights.
  PlainMesh part;
  for (const auto& [c, r] : {std::pair{0U, 0U}, {14U, 0U}, {0U, 9U}, {14U, 9U}}) {
    part.points.push_back({c * 1.0, r * 1.0, dem.Height(c, r)});
  }
  part.triangles = {{0, 2, 3}, {0, 3, 1}};
  const auto stated =
      ChoosePlacing(AsFile(part), {.frame = MeshFrame::kPosts, .up = UpAxis::kZ}, dem.input());
  ASSERT_TRUE(stated) << stated.error().message;
  EXPECT_FALSE(stated->assumed);
}

TEST(MeshFrames, HaveNamesThatReadBack) {
  for (const MeshFrame frame : AllMeshFrames()) {
    EXPECT_EQ(MeshFrameFromName(MeshFrameName(frame)), frame);
    EXPECT_THAT(MeshFrameNames(), HasSubstr(MeshFrameName(frame)));
  }
  EXPECT_EQ(MeshFrameFromName("post"), std::nullopt);
}

}  // namespace
}  // namespace farhorizon
