// The posts of a run leave cheapest first, from a heap whose older entries are known by their
// price: a post is priced anew when a neighbour has gone. A price is what the gap's sum of squares
// grows by, times the heaviest weight within. Nothing but the run's own heights counts, in one
// order, as two tiles that share a side must find the same.
#include "core/simplify/sides/ranking.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace farhorizon {

namespace {

constexpr double kNever = 2;
// Metres: a parabola of so much a squared step is added, so that the posts of a level or an evenly
// sloped run go evenly and not from one end; the Earth's curvature makes a long edge sag. Far below
// what heights differ by, far above what doubles round; no number of the tile's, as both tiles of a
// side must add the same.
constexpr double kBend = 1e-6;

// For each height the number of steps to the next higher one before or after it, the greater; to
// beyond the end where there is none.
std::vector<double> Reach(const std::vector<double>& heights) {
  const std::size_t n = heights.size();
  std::vector<double> reach(n, 1);
  std::vector<std::size_t> higher;  // indices that a later one may have to look at, falling heights
  const auto look = [&](const auto& index) {
    higher.clear();
    for (std::size_t k = 0; k < n; ++k) {
      const double z = heights[index(k)];
      while (!higher.empty() && heights[index(higher.back())] <= z) higher.pop_back();
      const std::size_t steps = higher.empty() ? k + 1 : k - higher.back();
      reach[index(k)] = std::max(reach[index(k)], static_cast<double>(steps));
      higher.push_back(k);
    }
  };
  look([](std::size_t k) { return k; });
  look([n](std::size_t k) { return n - 1 - k; });
  return reach;
}

// Sum over the posts between i and k of the square of what the line from i to k is off.
double SquaresBetween(const std::vector<double>& z, std::size_t i, std::size_t k) {
  const double slope = (z[k] - z[i]) / static_cast<double>(k - i);
  double sum = 0;
  for (std::size_t j = i + 1; j < k; ++j) {
    const double off = z[j] - (z[i] + slope * static_cast<double>(j - i));
    sum += off * off;
  }
  return sum;
}

}  // namespace

std::vector<double> RankRun(const std::vector<double>& heights) {
  const std::size_t n = heights.size();
  std::vector<double> gone(n, kNever);
  if (n < 3) return gone;
  std::vector<double> bent = heights;
  for (std::size_t i = 0; i < n; ++i) bent[i] += kBend * static_cast<double>(i * i);
  std::vector<double> weight = Reach(heights);
  for (std::size_t i = 0; i < n; ++i) {
    const auto to_end = static_cast<double>(std::max<std::size_t>(1, std::min(i, n - 1 - i)));
    weight[i] = std::sqrt(static_cast<double>(n) / to_end * weight[i]);
  }
  std::vector<std::size_t> before(n);
  std::vector<std::size_t> after(n);
  for (std::size_t i = 0; i < n; ++i) {
    before[i] = i - 1;
    after[i] = i + 1;
  }
  using Entry = std::pair<double, std::size_t>;  // cost, post
  std::vector<Entry> heap;
  std::vector<double> cost(n, 0);
  const auto rate = [&](std::size_t i) {
    if (i == 0 || i == n - 1) return;
    const std::size_t p = before[i];
    const std::size_t q = after[i];
    const auto at = [&](std::size_t k) { return weight.begin() + static_cast<std::ptrdiff_t>(k); };
    const double heaviest = *std::max_element(at(p + 1), at(q));
    cost[i] = heaviest * (SquaresBetween(bent, p, q) - SquaresBetween(bent, p, i) -
                          SquaresBetween(bent, i, q));
    heap.emplace_back(cost[i], i);
    std::push_heap(heap.begin(), heap.end(), std::greater<>());
  };
  for (std::size_t i = 0; i < n; ++i) rate(i);
  double left = 0;
  while (!heap.empty()) {
    const auto [price, i] = heap.front();
    std::pop_heap(heap.begin(), heap.end(), std::greater<>());
    heap.pop_back();
    if (gone[i] != kNever || price != cost[i]) continue;  // an older entry
    gone[i] = ++left / static_cast<double>(n - 1);
    after[before[i]] = after[i];
    before[after[i]] = before[i];
    rate(before[i]);
    rate(after[i]);
  }
  return gone;
}

std::vector<double> FitRun(const std::vector<double>& heights,
                           const std::vector<std::size_t>& staying) {
  const std::size_t m = staying.size();
  // The normal equations are tridiagonal: a height meets those before and after it only.
  std::vector<double> diagonal(m, 0);
  std::vector<double> beside(m, 0);  // of i and i + 1
  std::vector<double> right(m, 0);
  for (std::size_t i = 0; i + 1 < m; ++i) {
    const std::size_t from = staying[i];
    const std::size_t to = staying[i + 1];
    for (std::size_t j = from; j < to; ++j) {
      const double t = static_cast<double>(j - from) / static_cast<double>(to - from);
      diagonal[i] += (1 - t) * (1 - t);
      beside[i] += t * (1 - t);
      diagonal[i + 1] += t * t;
      right[i] += (1 - t) * heights[j];
      right[i + 1] += t * heights[j];
    }
  }
  std::vector<double> fitted(m);
  for (std::size_t i = 0; i < m; ++i) fitted[i] = heights[staying[i]];
  if (m < 3) return fitted;
  right[1] -= beside[0] * fitted[0];
  right[m - 2] -= beside[m - 2] * fitted[m - 1];
  for (std::size_t i = 2; i + 1 < m; ++i) {  // elimination [Thomas49]
    const double share = beside[i - 1] / diagonal[i - 1];
    diagonal[i] -= share * beside[i - 1];
    right[i] -= share * right[i - 1];
  }
  fitted[m - 2] = right[m - 2] / diagonal[m - 2];
  for (std::size_t i = m - 2; i-- > 1;) {
    fitted[i] = (right[i] - beside[i] * fitted[i + 1]) / diagonal[i];
  }
  return fitted;
}

}  // namespace farhorizon
