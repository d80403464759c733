// Steps are powers of two and origins multiples of them: sums and products of lattice numbers with
// them are exact in double, and in float where ExactInFloat holds, so that a position that was
// rounded once is never rounded again.
#include "core/io/quantization_lattice.h"

#include <algorithm>
#include <cmath>

#include "core/base/result.h"

namespace farhorizon {

namespace {

constexpr int kFloatBits = 24;

std::array<double, 3> Axes(const Enu& p) { return {p.east, p.north, p.up}; }

struct Box {
  std::array<double, 3> least;
  std::array<double, 3> greatest;
};

Box BoxOf(const std::vector<Enu>& points) {
  Check(!points.empty(), "a lattice over no points");
  Box box = {Axes(points[0]), Axes(points[0])};
  for (const Enu& point : points) {
    const std::array<double, 3> p = Axes(point);
    for (std::size_t i = 0; i < 3; ++i) {
      box.least[i] = std::min(box.least[i], p[i]);
      box.greatest[i] = std::max(box.greatest[i], p[i]);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Check(std::isfinite(box.least[i]) && std::isfinite(box.greatest[i]), "a point is not finite");
  }
  return box;
}

// The number of the lattice position nearest to `value`. The division is by a power of two, so that
// only the difference and nearbyint may round.
double NumberOf(double value, double origin, double step) {
  return std::nearbyint((value - origin) / step);
}

// The lattice of this step over the box; its bits may be more than are allowed.
QuantizationLattice LatticeOver(const Box& box, double step) {
  QuantizationLattice lattice;
  lattice.step_m = step;
  double last = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    lattice.origin[i] = std::floor(box.least[i] / step) * step;
    last = std::max(last, NumberOf(box.greatest[i], lattice.origin[i], step));
  }
  std::frexp(last, &lattice.bits);  // last < 2^bits
  return lattice;
}

}  // namespace

QuantizationLattice ChooseLattice(const std::vector<Enu>& points, double wanted_step_m) {
  Check(wanted_step_m > 0 && std::isfinite(wanted_step_m), "a lattice without step");
  const Box box = BoxOf(points);
  int exponent = 0;
  std::frexp(wanted_step_m, &exponent);  // 2^(exponent - 1) <= wanted < 2^exponent
  for (double step = std::ldexp(1.0, exponent - 1);; step *= 2) {
    const QuantizationLattice lattice = LatticeOver(box, step);
    if (lattice.bits <= kMaxLatticeBits && ExactInFloat(lattice)) return lattice;
  }
}

bool ExactInFloat(const QuantizationLattice& lattice) {
  const double limit = std::ldexp(1.0, kFloatBits);
  return std::ranges::all_of(lattice.origin, [&](double origin) {
    return std::abs(origin) / lattice.step_m + std::ldexp(1.0, lattice.bits) <= limit;
  });
}

Enu SnapToLattice(const Enu& point, const QuantizationLattice& lattice) {
  const std::array<double, 3> n = LatticeNumbers(point, lattice);
  return {lattice.origin[0] + n[0] * lattice.step_m, lattice.origin[1] + n[1] * lattice.step_m,
          lattice.origin[2] + n[2] * lattice.step_m};
}

std::array<double, 3> LatticeNumbers(const Enu& point, const QuantizationLattice& lattice) {
  std::array<double, 3> numbers = Axes(point);
  for (std::size_t i = 0; i < 3; ++i) {
    numbers[i] = NumberOf(numbers[i], lattice.origin[i], lattice.step_m);
    Check(numbers[i] >= 0 && numbers[i] < std::ldexp(1.0, lattice.bits),
          "a position outside its lattice");
  }
  return numbers;
}

LatticeBox LatticeBoxOf(const std::vector<Enu>& points, const QuantizationLattice& lattice) {
  if (points.empty()) return {};
  const std::array<double, 3> first = LatticeNumbers(points[0], lattice);
  LatticeBox box = {first, first};
  for (const Enu& point : points) {
    const std::array<double, 3> numbers = LatticeNumbers(point, lattice);
    for (std::size_t i = 0; i < 3; ++i) {
      box.least[i] = std::min(box.least[i], numbers[i]);
      box.greatest[i] = std::max(box.greatest[i], numbers[i]);
    }
  }
  return box;
}

}  // namespace farhorizon
