// A pencil of parallel lines is one pass over the ridges: a ridge crosses a run of successive
// lines, and its height over them is linear. What is taken already comes first, so that it wins
// ties: of level ground, where many sides are equally high, no more are taken than lines need.
// Pencils are worked on apart and their findings joined in order, so that threads do not matter.
#include "core/measure/own_skyline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "core/base/parallel_for.h"
#include "core/measure/mesh_sides.h"

namespace farhorizon {

namespace {

// Directions of the first round; each further round has twice as many, none of them again.
constexpr int kDirections = 192;
constexpr int kMostRounds = 5;
constexpr double kLinesPerCell = 2;
// What is no more above is as high, metres: far below any lattice, far above what doubles round.
constexpr double kTied = 1e-6;
constexpr std::size_t kBins = 64;
// By how much the pencils' first lines differ from one direction to the next, so that lines of
// successive directions do not meet in the same points: the golden section. Any value is sound.
constexpr double kShift = 0.6180339887498949;

constexpr double kMissed = -std::numeric_limits<double>::infinity();
constexpr std::int32_t kNobody = -1;

// The box that the mesh lies in, in columns and rows.
struct PlanBox {
  double column = std::numeric_limits<double>::infinity();
  double row = std::numeric_limits<double>::infinity();
  double last_column = -std::numeric_limits<double>::infinity();
  double last_row = -std::numeric_limits<double>::infinity();
};

PlanBox BoxOf(const GridMesh& mesh) {
  PlanBox box;
  for (const GridPoint& p : mesh.points) {
    box.column = std::min(box.column, p.column);
    box.row = std::min(box.row, p.row);
    box.last_column = std::max(box.last_column, p.column);
    box.last_row = std::max(box.last_row, p.row);
  }
  return box;
}

// Parallel lines of direction [cosine, sine]: line i has cosine * row - sine * column =
// first + i / kLinesPerCell.
struct Pencil {
  double sine = 0;
  double cosine = 1;
  double first = 0;
  std::int64_t count = 0;
  std::size_t bin = 0;

  Pencil(int direction, int directions, const PlanBox& box) {
    // The half keeps off the grid's own directions, and a doubled round off those of the last one.
    const double turn = (direction + 0.5) / directions;
    sine = std::sin(std::numbers::pi * turn);
    cosine = std::cos(std::numbers::pi * turn);
    bin = std::min(static_cast<std::size_t>(turn * kBins), kBins - 1);
    const std::array<double, 2> rows = {cosine * box.row, cosine * box.last_row};
    const double least = std::min(rows[0], rows[1]) - sine * box.last_column;
    const double width = std::max(rows[0], rows[1]) - sine * box.column - least;
    const double shift = direction * kShift - std::floor(direction * kShift);
    first = least + shift / kLinesPerCell;
    count = static_cast<std::int64_t>(width * kLinesPerCell) + 1;
  }
  [[nodiscard]] double PlaceOf(const GridPoint& p) const {
    return (cosine * p.row - sine * p.column - first) * kLinesPerCell;
  }
};

// A side that may be highest over some line.
struct Ridge {
  std::int32_t a = 0;
  std::int32_t b = 0;
};

// How many lines of a pencil a ridge has.
struct Carried {
  std::size_t ridge = 0;
  std::int64_t lines = 0;
};

// The heights of a pencil's lines, and which ridge has them.
class PencilSkyline {
 public:
  PencilSkyline(const GridMesh& mesh, const Pencil& pencil)
      : mesh_(mesh),
        pencil_(pencil),
        heights_(static_cast<std::size_t>(pencil.count), kMissed),
        ridges_(static_cast<std::size_t>(pencil.count), kNobody) {
    places_.reserve(mesh.points.size());
    for (const GridPoint& p : mesh.points) places_.push_back(pencil.PlaceOf(p));
  }

  // Gives the ridge the lines that it is more than `margin_m` higher over than all before it.
  void Add(std::size_t index, const Ridge& ridge, double margin_m) {
    double from = places_[static_cast<std::size_t>(ridge.a)];
    double to = places_[static_cast<std::size_t>(ridge.b)];
    double at_from = mesh_.points[static_cast<std::size_t>(ridge.a)].height_m;
    double at_to = mesh_.points[static_cast<std::size_t>(ridge.b)].height_m;
    if (from > to) {
      std::swap(from, to);
      std::swap(at_from, at_to);
    }
    const auto first = static_cast<std::int64_t>(std::ceil(std::max(from, 0.0)));
    const auto last =
        static_cast<std::int64_t>(std::min(to, static_cast<double>(pencil_.count - 1)));
    if (last < first || to < 0) return;
    const double slope = to > from ? (at_to - at_from) / (to - from) : 0;
    for (std::int64_t i = first; i <= last; ++i) {
      const double height = at_from + slope * (static_cast<double>(i) - from);
      const auto line = static_cast<std::size_t>(i);
      if (!(height > heights_[line] + margin_m)) continue;
      heights_[line] = height;
      ridges_[line] = static_cast<std::int32_t>(index);
    }
  }

  [[nodiscard]] std::vector<Carried> Take() {
    std::erase(ridges_, kNobody);
    std::ranges::sort(ridges_);
    std::vector<Carried> carried;
    for (const std::int32_t ridge : ridges_) {
      const auto index = static_cast<std::size_t>(ridge);
      if (carried.empty() || carried.back().ridge != index) carried.push_back({index, 0});
      ++carried.back().lines;
    }
    return carried;
  }

 private:
  const GridMesh& mesh_;
  const Pencil& pencil_;
  std::vector<double> places_;  // of the mesh's points
  std::vector<double> heights_;
  std::vector<std::int32_t> ridges_;
};

class SkylineSearch {
 public:
  SkylineSearch(const GridMesh& mesh, const std::vector<std::array<std::int32_t, 2>>& known)
      : mesh_(mesh), box_(BoxOf(mesh)) {
    std::vector<std::array<std::int32_t, 2>> sorted = known;
    std::ranges::sort(sorted);
    std::vector<Ridge> others;
    // A side's record may be there twice where triangles lie over one another: both are asked.
    const MeshSides sides = SidesOf(mesh);
    for (const MeshSide& side : sides.sides) {
      if (std::ranges::binary_search(sorted, std::array{side.a, side.b})) {
        ridges_.push_back({side.a, side.b});
      } else if (IsRidgeOrOutline(mesh, side)) {
        others.push_back({side.a, side.b});
      }
    }
    known_ = ridges_.size();
    ridges_.insert(ridges_.end(), others.begin(), others.end());
    lines_.assign(ridges_.size(), 0);
    pencils_.assign(ridges_.size(), 0);
    directions_.assign(ridges_.size(), 0);
  }

  Result<OwnSkyline> Run(int threads, const RunControl& control) {
    for (int round = 0; round < kMostRounds; ++round) {
      const double rounds = kMostRounds;
      if (!Sample(kDirections << round, threads,
                  control.Between(round / rounds, (round + 1) / rounds))) {
        return Error{ErrorCode::kCancelled, "stopped while looking for a level's skyline"};
      }
      if (MissedShare() <= kMissedShare) break;
    }
    OwnSkyline skyline;
    for (std::size_t i = 0; i < ridges_.size(); ++i) {
      if (!IsTaken(i)) continue;
      skyline.sides.push_back({ridges_[i].a, ridges_[i].b, lines_[i], directions_[i]});
    }
    std::ranges::sort(skyline.sides, [](const SkylineSide& p, const SkylineSide& q) {
      return std::tie(p.a, p.b) < std::tie(q.a, q.b);
    });
    skyline.lines = sampled_;
    skyline.missed_share = MissedShare();
    return skyline;
  }

 private:
  [[nodiscard]] bool IsTaken(std::size_t i) const { return i < known_ || lines_[i] > 0; }

  // Lines of one pencil are no independent sample: a side that has one of them has its neighbours,
  // too. So pencils are left out one by one: what each alone has shown is what the others missed.
  [[nodiscard]] double MissedShare() const {
    std::int64_t lines = 0;
    for (std::size_t i = known_; i < ridges_.size(); ++i) {
      if (pencils_[i] == 1) lines += lines_[i];
    }
    return static_cast<double>(lines) / static_cast<double>(std::max<std::int64_t>(sampled_, 1));
  }

  // What was taken before this round comes first; the rest follows in its order.
  [[nodiscard]] std::vector<Carried> CarriedIn(const Pencil& pencil,
                                               const std::vector<bool>& taken) const {
    PencilSkyline skyline(mesh_, pencil);
    for (std::size_t i = 0; i < ridges_.size(); ++i) {
      if (taken[i]) skyline.Add(i, ridges_[i], 0);
    }
    for (std::size_t i = 0; i < ridges_.size(); ++i) {
      if (!taken[i]) skyline.Add(i, ridges_[i], kTied);
    }
    return skyline.Take();
  }

  bool Sample(int directions, int threads, const RunControl& control) {
    std::vector<bool> taken(ridges_.size());
    for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = IsTaken(i);
    std::vector<std::vector<Carried>> found(static_cast<std::size_t>(directions));
    const auto work = [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t d = begin; d < end; ++d) {
        found[d] = CarriedIn(Pencil(static_cast<int>(d), directions, box_), taken);
      }
    };
    if (!ParallelForBatches(found.size(), 1, threads, Stage::kEncode, control, work)) return false;
    for (std::size_t d = 0; d < found.size(); ++d) {
      const Pencil pencil(static_cast<int>(d), directions, box_);
      for (const Carried& carried : found[d]) {
        lines_[carried.ridge] += carried.lines;
        ++pencils_[carried.ridge];
        directions_[carried.ridge] |= std::uint64_t{1} << pencil.bin;
        sampled_ += carried.lines;
      }
    }
    return true;
  }

  const GridMesh& mesh_;
  PlanBox box_;
  std::vector<Ridge> ridges_;  // the first known_ are known
  std::size_t known_ = 0;
  std::vector<std::int64_t> lines_;    // of each ridge
  std::vector<std::int32_t> pencils_;  // of each ridge: in which it has lines
  std::vector<std::uint64_t> directions_;
  std::int64_t sampled_ = 0;
};

}  // namespace

Result<OwnSkyline> FindOwnSkyline(const GridMesh& mesh,
                                  const std::vector<std::array<std::int32_t, 2>>& known,
                                  int threads, const RunControl& control) {
  return SkylineSearch(mesh, known).Run(threads, control);
}

}  // namespace farhorizon
