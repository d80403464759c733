#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/pipeline/report_page/html.h"

namespace farhorizon {

/// A table whose rows have a bar each, as long as the row's value is great.
struct BarTable {
  struct Row {
    Html name;
    double value = 0;
    std::array<Html, 2> cells;  ///< the value for people, and what else there is to say
  };
  Html caption;
  std::array<Html, 3> heads;  ///< of the names and of the two cells
  std::vector<Row> rows;
};

/// The table as a <table>.
Html DrawBars(const BarTable& table);

}  // namespace farhorizon
