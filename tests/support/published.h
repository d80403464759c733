#pragma once

#include "core/io/horizon_features.h"
#include "core/io/skyline_features.h"

namespace farhorizon {

/// A horizon edge with a value in each property except level_kept.
inline HorizonFeature SomeFeature() {
  HorizonFeature feature{};
  feature.a = {3, 4};
  feature.b = {4, 5};
  feature.from = {-84.25, 36.5000000004, 1076};
  feature.to = {-84.1234567891, 36.49, 1075.12349};
  feature.measures.azimuths = {{12.5, 13}, {170.25, 190.125}};
  feature.measures.spans = {{0, 0.25}, {0.5, 1}};
  feature.measures.angular_share = 0.125;
  feature.measures.line_measure_m = 3.5;
  feature.measures.skyline_drop_m = 1.25;
  feature.witness.t = 0.1 + 0.2;
  feature.witness.dc = -7;
  feature.witness.dr = 2;
  return feature;
}

/// A part of a skyline. left, right: offsets of its ends, metres.
inline SkylineFeature SomePart(double left, double right, double depth, double height) {
  return {{1, 2},         {2, 2},        {7, 46, height}, {7.5, 46, height + 10},
          {0.1, 2.0 / 3}, {left, right}, {depth, depth}};
}

/// Three parts from left to right; the first two touch, the second is the farthest.
inline SkylineOfDirection SomeSkyline() {
  return {30,
          {4194304, -77},
          false,
          {SomePart(-200, -50, 10, 500), SomePart(-50, 0, 900, 480), SomePart(100, 200, 0, 510)}};
}

}  // namespace farhorizon
