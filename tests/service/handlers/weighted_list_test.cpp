#include "service/handlers/weighted_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

TEST(WeightedList, HasNamesAndWeights) {
  EXPECT_THAT(WeightedList("Text/HTML, application/json ; q=0.5,*/*;q=0.001"),
              ElementsAre(Pair("text/html", 1000), Pair("application/json", 500), Pair("*/*", 1)));
  EXPECT_THAT(WeightedList("application/signed-exchange;v=b3;q=0.7, a;q=1;x=y"),
              ElementsAre(Pair("application/signed-exchange", 700), Pair("a", 1000)));
}

TEST(WeightedList, TakesWhatItCannotReadAsUnwanted) {
  EXPECT_THAT(WeightedList("a;q=2, b;q=, c;q=0,5"),
              ElementsAre(Pair("a", 0), Pair("b", 0), Pair("c", 0), Pair("5", 1000)));
  EXPECT_THAT(WeightedList(""), IsEmpty());
  EXPECT_THAT(WeightedList(" ,;q=1, "), IsEmpty());
}

}  // namespace
}  // namespace farhorizon
