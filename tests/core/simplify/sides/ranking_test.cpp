#include "core/simplify/sides/ranking.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

std::vector<double> AnyRun(std::size_t most, std::mt19937& random) {
  std::vector<double> heights(1 + random() % most);
  const std::uint32_t relief = random() % 3 == 0 ? 2 : 1000;
  double last = 0;
  const bool walk = random() % 2 == 0;
  for (double& z : heights) {
    last = (walk ? last : 0) + static_cast<double>(random() % (relief + 1));
    z = last;
  }
  return heights;
}

// Steps to the next higher post on one side of i; to beyond the end where there is none.
int StepsToHigher(const std::vector<double>& heights, int i, int step) {
  const auto n = static_cast<int>(heights.size());
  int k = i + step;
  while (k >= 0 && k < n &&
         heights[static_cast<std::size_t>(k)] <= heights[static_cast<std::size_t>(i)]) {
    k += step;
  }
  return std::abs(k - i);
}

// What is off between two posts that stay, squared and summed.
double Off(const std::vector<double>& z, std::size_t from, std::size_t to) {
  const double slope = (z[to] - z[from]) / static_cast<double>(to - from);
  double sum = 0;
  for (std::size_t j = from + 1; j < to; ++j) {
    const double off = z[j] - (z[from] + slope * static_cast<double>(j - from));
    sum += off * off;
  }
  return sum;
}

// The order by definition: all posts that are left are rated anew for each that goes.
std::vector<double> RankByDefinition(const std::vector<double>& heights) {
  const std::size_t n = heights.size();
  std::vector<double> bent = heights;
  for (std::size_t i = 0; i < n; ++i) bent[i] += 1e-6 * static_cast<double>(i * i);
  std::vector<double> gone(n, 2);
  std::vector<std::size_t> left(n);
  std::iota(left.begin(), left.end(), std::size_t{0});
  const auto weight = [&](std::size_t i) {
    const auto at = static_cast<int>(i);
    const double reach = std::max(StepsToHigher(heights, at, -1), StepsToHigher(heights, at, 1));
    const auto to_end = static_cast<double>(std::max<std::size_t>(1, std::min(i, n - 1 - i)));
    return std::sqrt(static_cast<double>(n) / to_end * reach);
  };
  for (int count = 1; left.size() > 2; ++count) {
    std::size_t best = 0;
    double least = 0;
    for (std::size_t k = 1; k + 1 < left.size(); ++k) {
      double heaviest = 0;
      for (std::size_t i = left[k - 1] + 1; i < left[k + 1]; ++i) {
        heaviest = std::max(heaviest, weight(i));
      }
      const double cost =
          heaviest * (Off(bent, left[k - 1], left[k + 1]) - Off(bent, left[k - 1], left[k]) -
                      Off(bent, left[k], left[k + 1]));
      if (best == 0 || cost < least) {
        best = k;
        least = cost;
      }
    }
    gone[left[best]] = count / static_cast<double>(n - 1);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return gone;
}

TEST(RankRun, IsTheOrderThatRatingEveryPostEachTimeGives) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(2000); ++round) {
    const std::vector<double> heights = AnyRun(24, random);
    ASSERT_EQ(RankRun(heights), RankByDefinition(heights)) << testing::PrintToString(heights);
  }
}

TEST(RankRun, TheEndsStayAndTheOthersGoOneByOne) {
  std::mt19937 random(2);
  for (int round = 0; round < Rounds(500); ++round) {
    const std::vector<double> heights = AnyRun(60, random);
    std::vector<double> gone = RankRun(heights);
    const std::size_t n = heights.size();
    ASSERT_GT(gone.front(), 1);
    ASSERT_GT(gone.back(), 1);
    std::sort(gone.begin(), gone.end());
    for (std::size_t i = 0; i + 2 < n; ++i) {
      ASSERT_EQ(gone[i], static_cast<double>(i + 1) / static_cast<double>(n - 1));
    }
  }
}

TEST(RankRun, PostsOfALevelRunGoEvenly) {
  // A long edge sags on the curved Earth; of equal posts none may go just for its number.
  const std::vector<double> gone = RankRun(std::vector<double>(101, 5));
  for (const double share : {0.5, 0.25, 0.1}) {
    std::size_t widest = 0;
    std::size_t last = 0;
    for (std::size_t i = 0; i < gone.size(); ++i) {
      if (gone[i] <= 1 - share) continue;
      widest = std::max(widest, i - last);
      last = i;
    }
    EXPECT_LE(static_cast<double>(widest), 2.5 / share) << share;
  }
}

// All heights as unknowns of dense normal equations, by elimination with pivots.
std::vector<double> FitByDefinition(const std::vector<double>& z,
                                    const std::vector<std::size_t>& staying) {
  const std::size_t m = staying.size();
  std::vector<std::vector<double>> a(m, std::vector<double>(m + 1, 0));
  for (std::size_t j = 0; j < z.size(); ++j) {
    std::vector<double> share(m, 0);  // of each staying post's height in the line's at j
    for (std::size_t i = 0; i < m; ++i) {
      if (j == staying[i]) share[i] = 1;
      if (i + 1 < m && j > staying[i] && j < staying[i + 1]) {
        share[i + 1] =
            static_cast<double>(j - staying[i]) / static_cast<double>(staying[i + 1] - staying[i]);
        share[i] = 1 - share[i + 1];
      }
    }
    for (std::size_t p = 0; p < m; ++p) {
      for (std::size_t q = 0; q < m; ++q) a[p][q] += share[p] * share[q];
      a[p][m] += share[p] * z[j];
    }
  }
  for (const std::size_t end : {std::size_t{0}, m - 1}) {
    std::fill(a[end].begin(), a[end].end(), 0);
    a[end][end] = 1;
    a[end][m] = z[staying[end]];
  }
  for (std::size_t p = 0; p < m; ++p) {
    std::size_t pivot = p;
    for (std::size_t q = p; q < m; ++q) {
      if (std::abs(a[q][p]) > std::abs(a[pivot][p])) pivot = q;
    }
    std::swap(a[p], a[pivot]);
    for (std::size_t q = 0; q < m; ++q) {
      if (q == p) continue;
      const double times = a[q][p] / a[p][p];
      for (std::size_t k = p; k <= m; ++k) a[q][k] -= times * a[p][k];
    }
  }
  std::vector<double> fitted;
  for (std::size_t i = 0; i < m; ++i) fitted.push_back(a[i][m] / a[i][i]);
  return fitted;
}

TEST(FitRun, IsTheLeastSquaresOfDenseNormalEquations) {
  std::mt19937 random(3);
  for (int round = 0; round < Rounds(3000); ++round) {
    const std::vector<double> heights = AnyRun(30, random);
    const std::size_t n = heights.size();
    std::vector<std::size_t> staying;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == 0 || i == n - 1 || random() % 3 == 0) staying.push_back(i);
    }
    const std::vector<double> found = FitRun(heights, staying);
    const std::vector<double> wanted = FitByDefinition(heights, staying);
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i], wanted[i], 1e-6);
    ASSERT_EQ(found.front(), heights.front());
    ASSERT_EQ(found.back(), heights.back());
  }
}

TEST(FitRun, LeavesHeightsAloneWhereAllPostsStay) {
  const std::vector<double> heights = {3, 1, 4, 1, 5};
  const std::vector<double> fitted = FitRun(heights, {0, 1, 2, 3, 4});
  for (std::size_t i = 0; i < heights.size(); ++i) EXPECT_DOUBLE_EQ(fitted[i], heights[i]);
}

}  // namespace
}  // namespace farhorizon
