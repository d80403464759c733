#include "core/pipeline/verify/verify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/glb.h"
#include "core/io/horizon_chains.h"
#include "core/io/horizon_features.h"
#include "core/io/horizon_glb.h"
#include "core/io/horizon_glb_reader.h"
#include "core/pipeline/build.h"
#include "core/pipeline/report.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

// A hilly DEM with a hole, and its artifacts.
class Built : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string text =
        "ncols 30\nnrows 24\nxllcorner 500000\nyllcorner 5100000\ncellsize 30\n"
        "NODATA_value -9999\n";
    for (int r = 0; r < 24; ++r) {
      for (int c = 0; c < 30; ++c) {
        const bool hole = r / 3 == 4 && c / 4 == 2;
        const double height = 500 + 60 * std::sin(c / 3.0) + 40 * std::cos(r / 2.5 + c / 8.0);
        text += (hole ? "-9999" : std::to_string(std::lround(height))) + (c < 29 ? " " : "\n");
      }
    }
    options_.crs = "EPSG:32610";
    options_.levels = 2;
    options_.horizon_detail = HorizonDetail::kEdges;
    BuildOrCopy(text);
  }

  // The DEM and its artifacts, as an earlier test built them: to build takes as long as most of the
  // tests. A DEM goes with one set of options.
  void BuildOrCopy(const std::string& text) {
    static std::map<std::string, std::unique_ptr<TempDir>> builds;
    std::unique_ptr<TempDir>& build = builds[text];
    if (!build) {
      build = std::make_unique<TempDir>();
      SpillFile(*build / "hills.asc", text);
      Status built = BuildArtifacts(*build / "hills.asc", *build / "out", options_, control_);
      ASSERT_TRUE(built) << built.error().message;
    }
    std::filesystem::copy(build->path(), folder_.path(), std::filesystem::copy_options::recursive);
  }

  // The claims that do not hold.
  std::vector<std::string> False() {
    Result<std::vector<ClaimCheck>> claims =
        VerifyArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_);
    if (!claims) throw std::runtime_error(claims.error().message);
    std::vector<std::string> lines;
    for (const ClaimCheck& check : *claims) {
      if (!check.holds) lines.push_back(check.claim);
    }
    return lines;
  }

  // Replaces the first `what` of an artifact by `with`.
  void Change(const std::string& name, const std::string& what, const std::string& with) {
    std::string bytes = SlurpFile(folder_ / "out" / name);
    const std::size_t at = bytes.find(what);
    ASSERT_NE(at, std::string::npos);
    ASSERT_EQ(what.size(), with.size());
    SpillFile(folder_ / "out" / name, bytes.replace(at, what.size(), with));
  }

  DecodedMesh Decode(const std::string& name) {
    const std::string bytes = SlurpFile(folder_ / "out" / name);
    return *DecodeDraco({bytes.begin(), bytes.end()});
  }
  void Rewrite(const DecodedMesh& glb_mesh, const DecodedMesh& drc_mesh);
  double StepOf(const std::string& name) { return Decode(name).lattice.step_m; }

  static bool Names(const std::vector<std::string>& lines, const std::string& text) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find(text) != std::string::npos;
    });
  }

  TempDir folder_;
  BuildOptions options_;
  RunControl control_;
};

using Verify = Built;

TEST_F(Verify, EveryClaimOfABuildHolds) { EXPECT_TRUE(False().empty()) << False().front(); }

// Levels are planned and measured whatever is written: without files, nothing of them is claimed.
TEST_F(Verify, LevelsThatWereNotWrittenClaimNothing) {
  for (const std::vector<std::string>& formats : {std::vector<std::string>{"geojson"},
                                                  {"flatgeobuf"},
                                                  {"geopackage"},
                                                  {"3dtiles"},
                                                  {"drc", "geojson"}}) {
    options_.formats = formats;
    std::filesystem::remove_all(folder_ / "out");
    ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
    for (const auto& [format, name] : {std::pair{"geojson", "horizon.geojson"},
                                       {"flatgeobuf", "horizon.fgb"},
                                       {"geopackage", "horizon.gpkg"}}) {
      const bool asked = std::find(formats.begin(), formats.end(), format) != formats.end();
      EXPECT_EQ(std::filesystem::exists(folder_ / "out" / name), asked) << name;
    }
    const std::vector<std::string> lines = False();
    EXPECT_TRUE(lines.empty()) << formats.front() << ": " << lines.front();
  }
  SpillFile(folder_ / "out" / "lod1.glb", "not asked for");
  EXPECT_TRUE(False().empty()) << "with a .drc, the .glb is no file of the level's";
  options_.formats = {"geojson"};
  ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
  SpillFile(folder_ / "out" / "lod1.drc", "not asked for");
  EXPECT_TRUE(Names(False(), "lod1 has no bytes in the report and no file"));
}

// Heights whose quantum is far finer than skyline drops are searched to.
TEST_F(Verify, EveryClaimHoldsWhereHeightsHaveAllTheBitsOfADouble) {
  std::string text = "ncols 9\nnrows 7\nxllcorner 500000\nyllcorner 5100000\ncellsize 30\n";
  for (int r = 0; r < 7; ++r) {
    for (int c = 0; c < 9; ++c) {
      const double height = 500 + 60 * std::sin(c * c / 3.0) + 40 * std::cos(r * 2.5 + c / 8.0);
      char written[40];
      std::snprintf(written, sizeof written, "%.17g%c", height, c < 8 ? ' ' : '\n');
      text += written;
    }
  }
  SpillFile(folder_ / "hills.asc", text);
  std::filesystem::remove_all(folder_ / "out");
  options_.levels = 1;
  Status built = BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_);
  ASSERT_TRUE(built) << built.error().message;
  const std::vector<std::string> lines = False();
  EXPECT_TRUE(lines.empty()) << lines.front();
  const Report report = *ReadReport(SlurpFile(folder_ / "out" / "report.json"));
  EXPECT_LT(report.dem.height_quantum_m, 1e-4);
}

// One edge whose line of sight no double can write does not refuse the DEM.
TEST_F(Verify, AnEdgeWithoutWitnessIsDecidedByItself) {
  // Cliffs of 4096 m in quanta of 2^-17 m.
  TestRaster raster{.columns = 4, .rows = 4, .type = "Float64"};
  raster.values = {536870913, 3,         32770, 536870912, 536870915, 32770, 536870915, 536870912,
                   536870915, 536870912, 1,     32768,     536870914, 3,     3,         32771};
  for (double& z : raster.values) z = std::ldexp(z, -17);
  WriteTiff(folder_ / "hills.asc", raster);
  std::filesystem::remove_all(folder_ / "out");
  options_.formats = {"geojson"};
  Status built = BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_);
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_NE(SlurpFile(folder_ / "out" / "horizon.geojson").find(R"("witness":null)"),
            std::string::npos);
  const std::vector<std::string> lines = False();
  EXPECT_TRUE(lines.empty()) << lines.front();
}

TEST_F(Verify, AnEdgeWithoutWitnessThatIsNotOnTheHorizonIsFound) {
  Result<std::vector<HorizonFeature>> features =
      ReadHorizonGeoJson(SlurpFile(folder_ / "out" / "horizon.geojson"));
  for (HorizonFeature& f : *features) f.witness.exact = false;
  SpillFile(folder_ / "out" / "horizon.geojson", WriteHorizonGeoJson(*features));
  EXPECT_FALSE(Names(False(), "that no line of sight touches"));
  features->front().b = {features->front().a[0], features->front().a[1] + 9};  // no edge
  SpillFile(folder_ / "out" / "horizon.geojson", WriteHorizonGeoJson(*features));
  EXPECT_TRUE(
      Names(False(), "without a witness that no line of sight touches: claimed 0, found 1"));
}

TEST_F(Verify, AzimuthsThatAreNotTheEdgesAreFound) {
  // Turns every edge's azimuths by a quarter turn.
  Result<std::vector<HorizonFeature>> features =
      ReadHorizonGeoJson(SlurpFile(folder_ / "out" / "horizon.geojson"));
  for (HorizonFeature& f : *features) {
    for (auto& [from, to] : f.measures.azimuths) {
      const double turn = from < 90 ? 90 : -90;
      from += turn;
      to += turn;
    }
    std::sort(f.measures.azimuths.begin(), f.measures.azimuths.end());
  }
  SpillFile(folder_ / "out" / "horizon.geojson", WriteHorizonGeoJson(*features));
  const std::vector<std::string> lines = False();
  EXPECT_TRUE(Names(lines, "other azimuths, spans or weights"));
  EXPECT_TRUE(Names(lines, "random lines with their skyline outside an edge's azimuths"));
  EXPECT_TRUE(Names(lines, "seen from between their azimuths"));
  EXPECT_TRUE(Names(lines, "not seen from within an azimuth"));
}

TEST_F(Verify, SpansAndWeightsThatAreNotTheEdgesAreFound) {
  const auto claim = [&](const std::function<void(HorizonFeature&)>& change) {
    Result<std::vector<HorizonFeature>> features =
        ReadHorizonGeoJson(SlurpFile(folder_ / "out" / "horizon.geojson"));
    std::vector<HorizonFeature> changed = *features;
    change(changed[changed.size() / 2]);
    SpillFile(folder_ / "out" / "horizon.geojson", WriteHorizonGeoJson(changed));
    const bool found = Names(False(), "other azimuths, spans or weights: claimed 0, found 1");
    SpillFile(folder_ / "out" / "horizon.geojson", WriteHorizonGeoJson(*features));
    return found;
  };
  EXPECT_TRUE(claim([](HorizonFeature& f) { f.measures.spans[0][1] -= 1e-4; }));
  EXPECT_TRUE(claim([](HorizonFeature& f) { f.measures.line_measure_m *= 1.001; }));
  EXPECT_TRUE(claim([](HorizonFeature& f) { f.measures.angular_share += 1e-4; }));
  EXPECT_TRUE(claim([](HorizonFeature& f) { f.measures.skyline_drop_m += 0.01; }));
}

TEST_F(Verify, SkylineDropsBelowTheEdgesAreFound) {
  Result<std::vector<HorizonFeature>> features =
      ReadHorizonGeoJson(SlurpFile(folder_ / "out" / "horizon.geojson"));
  for (HorizonFeature& f : *features) f.measures.skyline_drop_m /= 8;
  SpillFile(folder_ / "out" / "horizon.geojson", WriteHorizonGeoJson(*features));
  EXPECT_TRUE(Names(False(), "rises above all others by more than its skyline drop"));
}

TEST_F(Verify, ANodeThatPlacesTheMeshElsewhereIsFound) {
  Change("lod0.glb", R"("matrix":[0.)", R"("matrix":[1.)");
  EXPECT_TRUE(Names(False(), "lod0.glb has the lattice of its Draco stream"));
}

TEST_F(Verify, ASkirtOfAnotherDepthIsFound) {
  Result<Report> report = ReadReport(SlurpFile(folder_ / "out" / "report.json"));
  ASSERT_TRUE(report);
  EXPECT_GT(report->levels[1].skirt_m, 0);
  EXPECT_GT(report->levels[1].skirt_triangles, 2 * (29 + 23));
  report->levels[1].skirt_m += report->levels[1].quantization_step_m;
  SpillFile(folder_ / "out" / "report.json", WriteReport(*report));
  const std::vector<std::string> lines = False();
  EXPECT_TRUE(Names(lines, "lod1.glb skirt hangs from every edge of the rim"));
  EXPECT_FALSE(Names(lines, "lod0.glb skirt"));
  report->levels[0].skirt_m = 0;
  SpillFile(folder_ / "out" / "report.json", WriteReport(*report));
  EXPECT_TRUE(Names(False(), "lod0.glb skirt is there where the report has one"));
}

TEST_F(Verify, BuildsWithoutSkirtsAndWithDeepOnesHold) {
  for (const double depth_m : {0.0, 1000.0}) {
    options_.skirt_m = depth_m;
    ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
    const std::vector<std::string> lines = False();
    EXPECT_TRUE(lines.empty()) << lines.front();
    const Report report = *ReadReport(SlurpFile(folder_ / "out" / "report.json"));
    EXPECT_EQ(report.levels[0].skirt_m, depth_m);
    EXPECT_EQ(report.levels[0].skirt_triangles > 0, depth_m > 0);
    const auto tileset = nlohmann::json::parse(SlurpFile(folder_ / "out" / "tileset.json"));
    const double least_m = tileset["root"]["boundingVolume"]["region"][4];
    EXPECT_EQ(least_m<report.dem.heights_m[0] - 900, depth_m> 0);
  }
}

TEST_F(Verify, ADracoStreamWithAnotherLatticeIsFound) {
  // Halves the step, in the bitstreams of both files.
  const double half = StepOf("lod1.drc") / 2;
  for (const std::string name : {"lod1.drc", "lod1.glb"}) {
    std::string bytes = SlurpFile(folder_ / "out" / name);
    const std::size_t at = bytes.find("lattice_step") + std::string("lattice_step").size() + 1;
    std::memcpy(bytes.data() + at, &half, sizeof half);
    SpillFile(folder_ / "out" / name, bytes);
  }
  const std::vector<std::string> lines = False();
  EXPECT_TRUE(Names(lines, "lod1.glb has the lattice of its Draco stream"));
  EXPECT_TRUE(Names(lines, "lod1 lattice's step"));
}

// Writes both files of level 1 anew.
void Built::Rewrite(const DecodedMesh& glb_mesh, const DecodedMesh& drc_mesh) {
  const std::vector<std::uint8_t> drc = *EncodeDraco(drc_mesh.mesh, drc_mesh.lattice);
  const std::vector<std::uint8_t> stream =
      *EncodeDraco(glb_mesh.mesh, glb_mesh.lattice, DracoPosts::kLeftOut);
  DecodedMesh decoded = *DecodeDraco(stream);
  decoded.mesh.posts.resize(decoded.mesh.positions.size());
  const std::vector<std::uint8_t> glb = WriteGlb(stream, decoded, {});
  SpillFile(folder_ / "out" / "lod1.drc", {drc.begin(), drc.end()});
  SpillFile(folder_ / "out" / "lod1.glb", {glb.begin(), glb.end()});
}

TEST_F(Verify, NormalsThatAreNotTheDemsAreFound) {
  DecodedMesh decoded = Decode("lod1.drc");
  // Turns normals by some two degrees.
  for (UnitNormal& n : decoded.mesh.normals) {
    n[0] += 0.04;
    const double length = std::hypot(n[0], n[1], n[2]);
    n = {n[0] / length, n[1] / length, n[2] / length};
  }
  decoded.lattice.bits = 16;
  Rewrite(decoded, decoded);
  const std::vector<std::string> lines = False();
  EXPECT_TRUE(Names(lines, "lod1 normals a degree or more off the DEM's: claimed 0, found"));
  EXPECT_FALSE(Names(lines, "lod0 normals"));
}

TEST_F(Verify, TwoFilesThatHoldOtherMeshesAreFound) {
  DecodedMesh decoded = Decode("lod1.drc");
  decoded.lattice.bits = 16;
  Rewrite(decoded, decoded);
  EXPECT_FALSE(Names(False(), "lod1.glb and .drc hold the same mesh"));
  DecodedMesh raised = decoded;
  raised.mesh.positions[5].up += decoded.lattice.step_m;
  Rewrite(raised, decoded);
  EXPECT_TRUE(Names(False(), "lod1.glb and .drc hold the same mesh"));
  DecodedMesh renamed = decoded;
  std::swap(renamed.mesh.posts[5], renamed.mesh.posts[6]);
  Rewrite(decoded, renamed);
  EXPECT_TRUE(Names(False(), "lod1.glb and .drc hold the same mesh"));
}

TEST_F(Verify, SidesThatAreNotWhereANeighboursAreAreFound) {
  DecodedMesh decoded = Decode("lod1.drc");
  decoded.lattice.bits = 16;
  const auto on_side = std::ranges::find_if(decoded.mesh.posts, [](std::uint32_t post) {
    return post % 30 == 0 && post > 0 && post < 30 * 23;
  });
  ASSERT_NE(on_side, decoded.mesh.posts.end());
  const auto at = static_cast<std::size_t>(on_side - decoded.mesh.posts.begin());
  decoded.lattice.step_m /= 2;
  decoded.mesh.positions[at].up += decoded.lattice.step_m;
  Rewrite(decoded, decoded);
  EXPECT_TRUE(Names(False(), "lod1 coordinates on sides that are no multiple"));
}

TEST_F(Verify, EveryClaimHoldsOfLevelsByTriangles) {
  options_.levels = BuildOptions().levels;
  options_.triangles = {900, 300};
  ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
  EXPECT_TRUE(False().empty()) << False().front();
  const Report report = *ReadReport(SlurpFile(folder_ / "out" / "report.json"));
  ASSERT_EQ(report.levels.size(), 2U);
  EXPECT_EQ(report.levels[0].asked.triangles, 900);
  EXPECT_EQ(report.levels[1].asked.triangles, 300);
}

TEST_F(Verify, EveryClaimHoldsWhereOneFormatIsAskedFor) {
  for (const char* format : {"3dtiles", "drc"}) {
    std::filesystem::remove_all(folder_ / "out");
    options_.formats = {format};
    ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
    const bool glb = std::filesystem::exists(folder_ / "out" / "lod0.glb");
    EXPECT_EQ(glb, options_.formats[0] == "3dtiles");
    EXPECT_NE(glb, std::filesystem::exists(folder_ / "out" / "lod0.drc"));
    EXPECT_TRUE(False().empty()) << format << ": " << False().front();
  }
}

TEST_F(Verify, EdgesAreInTheFilesThatAreAskedForAndNoOthers) {
  for (const auto& [edges, lines, inlined] :
       {std::tuple{EdgeFiles::kLines, true, false}, std::tuple{EdgeFiles::kInline, false, true},
        std::tuple{EdgeFiles::kBoth, true, true}, std::tuple{EdgeFiles::kNone, false, false}}) {
    std::filesystem::remove_all(folder_ / "out");
    options_.edges = edges;
    ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
    EXPECT_EQ(std::filesystem::exists(folder_ / "out" / "lod1-horizon.glb"), lines);
    const std::string glb = SlurpFile(folder_ / "out" / "lod1.glb");
    EXPECT_EQ(glb.find("EXT_mesh_primitive_edge_visibility") != std::string::npos, inlined);
    const Report report = *ReadReport(SlurpFile(folder_ / "out" / "report.json"));
    const SkylineEdgesReport& level = report.levels[1].skyline_edges;
    EXPECT_EQ(level.edges > 0, lines || inlined);
    EXPECT_EQ(level.bytes > 0, lines);
    if (level.edges > 0) {
      EXPECT_GT(level.edges, report.levels[1].horizon_edges) << "a level has chords of its own";
      EXPECT_LE(level.carrying, level.edges);
      EXPECT_GE(level.share, 0.995);
    }
    EXPECT_TRUE(False().empty()) << False().front();
  }
}

// Writes the lines of level 1 anew, one chain of them changed.
TEST_F(Verify, LinesThatAreNotTheLevelsAreFound) {
  const std::string name = "lod1-horizon.glb";
  const std::string bytes = SlurpFile(folder_ / "out" / name);
  const std::vector<LineChain> chains = ReadHorizonGlb({bytes.begin(), bytes.end()})->chains;
  const QuantizationLattice lattice = Decode("lod1.drc").lattice;
  const auto claim = [&](const std::function<void(std::vector<LineChain>&)>& change) {
    std::vector<LineChain> changed = chains;
    change(changed);
    const std::vector<std::uint8_t> glb = WriteHorizonGlb(changed, lattice);
    SpillFile(folder_ / "out" / name, {glb.begin(), glb.end()});
    return False();
  };
  const std::string others = "lod1-horizon.glb chains with other points, azimuths or weights";
  using Chains = std::vector<LineChain>;
  EXPECT_FALSE(Names(claim([](Chains&) {}), "lod1-horizon.glb"));
  EXPECT_TRUE(Names(claim([](Chains& c) { c[3].points[1][2] += 1; }), others));
  EXPECT_TRUE(Names(claim([](Chains& c) { std::swap(c[3], c[4]); }), others));
  EXPECT_TRUE(Names(claim([](Chains& c) { c[3].azimuths ^= 1; }), others));
  EXPECT_TRUE(Names(claim([](Chains& c) { c[3].skyline_drop_m = 99; }), others));
  EXPECT_TRUE(Names(claim([](Chains& c) { c[3].line_measure_m = 1e-3F; }), others));
  EXPECT_TRUE(Names(claim([](Chains& c) { c.pop_back(); }), "lod1-horizon.glb lines"));
  std::filesystem::remove(folder_ / "out" / name);
  EXPECT_TRUE(Names(False(), "lod1-horizon.glb is there: claimed 1, found 0"));
}

TEST_F(Verify, FlagsAndTilesThatAreNotTheLevelsAreFound) {
  std::filesystem::remove_all(folder_ / "out");
  options_.formats = {"3dtiles", "quantized-mesh"};
  options_.edges = EdgeFiles::kInline;
  ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
  const std::string bytes = SlurpFile(folder_ / "out" / "lod1.glb");
  const GlbContents contents = *ReadGlb({bytes.begin(), bytes.end()});
  DecodedMesh decoded = *DecodeDraco(contents.surface.draco);
  decoded.mesh.posts.resize(decoded.mesh.positions.size());
  const std::vector<std::uint8_t> glb =
      WriteGlb(contents.surface.draco, decoded, FlagEdges(decoded.mesh, {{0, 1}}));
  SpillFile(folder_ / "out" / "lod1.glb", {glb.begin(), glb.end()});
  Change("tileset.json", "lod0.glb", "lod9.glb");
  SpillFile(folder_ / "out" / "terrain-0-1-0.terrain", "no tile");
  const std::vector<std::string> lines = False();
  EXPECT_TRUE(Names(lines, "lod1.glb flags them and no others"));
  EXPECT_TRUE(Names(lines, "tileset.json has each GLB once"));
  EXPECT_TRUE(Names(lines, "terrain tiles are the levels, cut; not so terrain-0-1-0.terrain"));
}

// A DEM whose level 0 is cut in two, as it is long enough for it, and its artifacts.
class VerifyParts : public Built {
 protected:
  void SetUp() override {
    std::string text = "ncols 66\nnrows 12\nxllcorner 500000\nyllcorner 5100000\ncellsize 30\n";
    for (int i = 0; i < 66 * 12; ++i) {
      const int c = i % 66;
      const int r = i / 66;
      const double height = 500 + 60 * std::sin(c / 3.0) + 40 * std::cos(r / 2.5 + c / 8.0);
      text += std::to_string(std::lround(height)) + (c < 65 ? " " : "\n");
    }
    SpillFile(folder_ / "hills.asc", text);
    options_.crs = "EPSG:32610";
    options_.levels = 2;
    options_.max_error_m = 0.3;
    options_.tile_triangles = 1000;
    options_.edges = EdgeFiles::kInline;
    options_.formats = {"3dtiles", "drc", "quantized-mesh"};
    Status built = BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_);
    ASSERT_TRUE(built) << built.error().message;
  }
};

TEST_F(VerifyParts, EveryClaimHoldsAndAPartInAnothersPlaceIsFound) {
  EXPECT_TRUE(False().empty()) << False().front();
  const Report report = *ReadReport(SlurpFile(folder_ / "out" / "report.json"));
  ASSERT_EQ(report.levels.size(), 2U);
  EXPECT_EQ(report.levels[0].parts, (PartDepth{1, 0}));
  EXPECT_EQ(report.levels[1].parts, (PartDepth{0, 0}));
  const auto root = nlohmann::json::parse(SlurpFile(folder_ / "out" / "tileset.json"))["root"];
  EXPECT_EQ(root["content"]["uri"], "lod1.glb");
  ASSERT_EQ(root["children"].size(), 2U);
  EXPECT_EQ(root["children"][0]["content"]["uri"], "lod0-0-0.glb");
  EXPECT_EQ(root["children"][1]["content"]["uri"], "lod0-1-0.glb");
  // They meet along a meridian, or nearly so.
  EXPECT_NEAR(root["children"][0]["boundingVolume"]["region"][2],
              root["children"][1]["boundingVolume"]["region"][0], 1e-6);

  std::filesystem::copy_file(folder_ / "out" / "lod0-1-0.glb", folder_ / "out" / "lod0-0-0.glb",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(Names(False(), "lod0 covers the DEM without cracks"));
}

// Builds with chains, of which a test changes one.
class VerifyChains : public Built {
 protected:
  void SetUp() override {
    Built::SetUp();
    std::filesystem::remove_all(folder_ / "out");
    options_.horizon_detail = HorizonDetail::kChains;
    ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
    text_ = SlurpFile(folder_ / "out" / "horizon.geojson");
    ASSERT_TRUE(HasChains(text_));
  }
  // Whether some claim that does not hold names `text` after `change`.
  bool Finds(const std::string& text, const std::function<void(HorizonChain&)>& change) {
    std::vector<HorizonChain> chains = *ReadHorizonChains(text_);
    change(chains[chains.size() / 2]);
    SpillFile(folder_ / "out" / "horizon.geojson", WriteHorizonChains(chains, 30));
    return Names(False(), text);
  }

  std::string text_;
};

TEST_F(VerifyChains, EveryClaimHolds) { EXPECT_TRUE(False().empty()) << False().front(); }

TEST_F(VerifyChains, ChainsThatAreNotTheHorizonsAreFound) {
  EXPECT_FALSE(Finds("horizon.geojson chains", [](HorizonChain&) {}));
  EXPECT_TRUE(Finds("other azimuths or weights", [](HorizonChain& c) { c.azimuths ^= 1; }));
  EXPECT_TRUE(
      Finds("other azimuths or weights", [](HorizonChain& c) { c.line_measure_m *= 1.01; }));
  EXPECT_TRUE(Finds("other azimuths or weights", [](HorizonChain& c) { c.skyline_drop_m += 1; }));
  EXPECT_TRUE(Finds("not where their posts are", [](HorizonChain& c) { c.line[0].lat_deg += 1; }));
  EXPECT_TRUE(Finds("level_kept is the coarsest", [](HorizonChain& c) { c.level_kept[0] = 7; }));
  EXPECT_TRUE(
      Finds("edges that join no two posts", [](HorizonChain& c) { c.line[1] = c.line[0]; }));
  EXPECT_TRUE(Finds("horizon edges missing from horizon.geojson", [](HorizonChain& c) {
    c.line.back().lon_deg += 1e-3;  // three posts further east
  }));
}

// White noise under a budget that leaves much undecided.
class BuiltApproximately : public Built {
 protected:
  void SetUp() override {
    std::string text =
        "ncols 25\nnrows 25\nxllcorner 500000\nyllcorner 5100000\ncellsize 30\n"
        "NODATA_value -9999\n";
    std::uint32_t noise = 1;
    for (int i = 0; i < 25 * 25; ++i) {
      noise = noise * 1664525U + 1013904223U;
      text += std::to_string(noise >> 20U) + (i % 25 < 24 ? " " : "\n");
    }
    options_.crs = "EPSG:32610";
    options_.levels = 1;
    options_.work_budget = 20'000;
    options_.approximate = true;
    options_.horizon_detail = HorizonDetail::kEdges;
    BuildOrCopy(text);
  }
};

using VerifyApproximate = BuiltApproximately;

TEST_F(VerifyApproximate, EveryClaimHoldsAndSaysThatTheSetIsASuperset) {
  // Verification takes the budget from the report, not from its caller.
  options_.work_budget.reset();
  options_.approximate = false;
  EXPECT_TRUE(False().empty()) << False().front();
  EXPECT_NE(SlurpFile(folder_ / "out" / "report.json").find(R"("approximate": true)"),
            std::string::npos);
  EXPECT_NE(SlurpFile(folder_ / "out" / "horizon.geojson").find(R"("undecided":true)"),
            std::string::npos);
}

TEST_F(VerifyApproximate, EveryClaimOfChainsHolds) {
  std::filesystem::remove_all(folder_ / "out");
  options_.horizon_detail = HorizonDetail::kChains;
  ASSERT_TRUE(BuildArtifacts(folder_ / "hills.asc", folder_ / "out", options_, control_));
  EXPECT_TRUE(False().empty()) << False().front();
  EXPECT_NE(SlurpFile(folder_ / "out" / "horizon.geojson").find(R"("undecided":true)"),
            std::string::npos);
}

TEST_F(VerifyApproximate, AReportThatHidesADoubtIsFound) {
  Change("report.json", R"("approximate": true)", R"("approximate":false)");
  EXPECT_TRUE(Names(False(), "report.json"));
}

TEST_F(VerifyApproximate, ItIsAnErrorWhereItMayNotBeApproximate) {
  options_.approximate = false;
  Status built = BuildArtifacts(folder_ / "hills.asc", folder_ / "other", options_, control_);
  ASSERT_FALSE(built);
  EXPECT_EQ(built.error().kind, "work-budget");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "other" / "report.json"));
}

}  // namespace
}  // namespace farhorizon
