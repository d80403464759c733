// The edges are found again by the code that found them, from the decoded mesh; and then checked
// without it: a loop over all sides of all triangles says how high the mesh is over a random line,
// one over the file's lines how high they are.
#include "core/pipeline/verify/verify_level_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "core/io/file.h"
#include "core/io/glb.h"
#include "core/io/horizon_glb_reader.h"
#include "core/io/line_chains.h"
#include "core/pipeline/level_edges.h"
#include "core/pipeline/verify/random_line.h"

namespace farhorizon {

namespace {

// Of a level's skyline a two-hundredth may be off its edges; among so many lines more than twice as
// many are there by chance once in a thousand times.
constexpr int kMostOff = kRandomLines / 100;
// What is no more above is as high, metres: far below any lattice.
constexpr double kTied = 1e-6;

constexpr double kMissed = -std::numeric_limits<double>::infinity();

// A line drawn uniformly in the measure of lines: the points with cosine * row - sine * column =
// offset. Lines through posts (RandomLine) would be a poor sample: there edges meet, and rounding
// decides which of them a line crosses.
struct UniformLine {
  double sine;
  double cosine;
  double offset;

  UniformLine(const Dem& dem, std::mt19937_64& random) {
    // Bits instead of a distribution, whose numbers differ between standard libraries.
    const auto draw = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    const double t = std::numbers::pi * draw();
    sine = std::sin(t);
    cosine = std::cos(t);
    const double reach = std::hypot(dem.columns, dem.rows) / 2;
    const double middle = (cosine * (dem.rows - 1) - sine * (dem.columns - 1)) / 2;
    offset = middle + reach * (2 * draw() - 1);
  }

  // The height of the segment over the line; minus infinity where they do not cross.
  [[nodiscard]] double HeightOf(const GridPoint& a, const GridPoint& b) const {
    const double of_a = cosine * a.row - sine * a.column - offset;
    const double of_b = cosine * b.row - sine * b.column - offset;
    if ((of_a > 0) == (of_b > 0)) return kMissed;
    return std::lerp(a.height_m, b.height_m, of_a / (of_a - of_b));
  }
};

// Of random lines that meet the mesh, the number of those over which it is higher than all of the
// edges, which are pairs of its points.
int LinesOff(const Dem& dem, const GridMesh& mesh, const VertexPairs& edges) {
  const auto point = [&mesh](auto i) { return mesh.points[static_cast<std::size_t>(i)]; };
  std::mt19937_64 random(1868);
  int off = 0;
  for (int met = 0, drawn = 0; met < kRandomLines && drawn < 100 * kRandomLines; ++drawn) {
    const UniformLine line(dem, random);
    double highest = kMissed;
    for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        highest = std::max(highest, line.HeightOf(point(t[k]), point(t[(k + 1) % 3])));
      }
    }
    if (highest == kMissed) continue;
    ++met;
    double of_edges = kMissed;
    for (const auto& [a, b] : edges) {
      of_edges = std::max(of_edges, line.HeightOf(point(a), point(b)));
    }
    off += highest > of_edges + kTied ? 1 : 0;
  }
  return off;
}

bool Close(const std::optional<float>& claimed, const std::optional<float>& found) {
  if (!claimed || !found) return claimed.has_value() == found.has_value();
  // What floats and measures of another build may be off by.
  return std::abs(*claimed - *found) <= 1e-5 * (1 + *found);
}

bool Same(const LineChain& claimed, const LineChain& found) {
  return claimed.points == found.points && claimed.azimuths == found.azimuths &&
         Close(claimed.line_measure_m, found.line_measure_m) &&
         Close(claimed.skyline_drop_m, found.skyline_drop_m);
}

std::int64_t EdgesOf(const std::vector<LineChain>& chains) {
  std::int64_t edges = 0;
  for (const LineChain& chain : chains) edges += std::ssize(chain.points) - 1;
  return edges;
}

void VerifyFile(const std::filesystem::path& directory, const LevelReport& claimed,
                const QuantizationLattice& lattice, const LevelEdges& found, Claims& claims) {
  const std::string name = HorizonGlbName(claimed.level);
  Result<std::string> text = ReadFile(directory / name);
  if (!text) {
    claims.Add(false, name + ": " + text.error().message);
    return;
  }
  claims.Same(name + " bytes", claimed.skyline_edges.bytes, std::ssize(*text));
  Result<HorizonGlbContents> glb = ReadHorizonGlb({text->begin(), text->end()});
  claims.Add(glb.has_value(),
             name + " is a binary glTF with lines" + (glb ? "" : ": " + glb.error().message));
  if (!glb) return;
  claims.Add(glb->matrix == GltfMatrix(lattice),
             name + " has the lattice of the level's mesh in the node's matrix");
  claims.Add(glb->in_box, name + " POSITION min and max are those of its lines");
  claims.Same(name + " lines", claimed.skyline_edges.edges, EdgesOf(glb->chains));
  const std::vector<LineChain> expected = LineChainsOf(found.lines);
  claims.Same(name + " chains", glb->chains.size(), expected.size());
  std::int64_t different = 0;
  for (std::size_t i = 0; i < std::min(glb->chains.size(), expected.size()); ++i) {
    different += Same(glb->chains[i], expected[i]) ? 0 : 1;
  }
  claims.Same(name + " chains with other points, azimuths or weights", std::int64_t{0}, different);
}

}  // namespace

void VerifyLevelEdges(const LevelContext& context, const std::filesystem::path& directory,
                      const LevelReport& claimed, const StoredLevel& level, const KnownEdges& known,
                      Claims& claims) {
  const std::string name = "lod" + std::to_string(claimed.level);
  std::error_code failure;
  const bool has_file = std::filesystem::exists(directory / HorizonGlbName(claimed.level), failure);
  claims.Same(name + "-horizon.glb is there", claimed.skyline_edges.bytes > 0, has_file);
  const bool inlined = !level.inlined.bits.empty();
  if (claimed.skyline_edges.edges == 0) {
    claims.Add(!inlined && !has_file, name + " draws no horizon edges");
    return;
  }
  RunControl quiet = context.control;  // stages of a build are none of a verification's
  quiet.progress = nullptr;
  Result<LevelEdges> found =
      FindLevelEdges(context.With(quiet), known.kept, {level.decoded, level.placed}, known.threads);
  claims.Add(found.has_value(), name + " has its skyline looked for again" +
                                    (found ? "" : ": " + found.error().message));
  if (!found) return;
  if (has_file) AddMeasures(known.features, *found);  // flags have none
  claims.Same(name + " edges of its skyline", claimed.skyline_edges.edges, found->report.edges);
  claims.Same(name + " edges that a line of sight shows", claimed.skyline_edges.carrying,
              found->report.carrying);
  claims.Same(name + " share of its skyline on them", claimed.skyline_edges.share,
              found->report.share);
  const int off = LinesOff(context.terrain.dem(), level.placed.grid, found->vertices);
  claims.Add(off <= kMostOff, name + ": of " + std::to_string(kRandomLines) +
                                  " random lines at most " + std::to_string(kMostOff) +
                                  " have its skyline off them, found " + std::to_string(off));
  if (has_file) VerifyFile(directory, claimed, level.decoded.lattice, *found, claims);
  if (!inlined) return;
  claims.Add(level.inlined == FlagEdges(level.decoded.mesh, found->vertices),
             name + ".glb flags them and no others");
}

}  // namespace farhorizon
