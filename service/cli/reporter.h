#pragma once

#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "core/base/progress.h"
#include "core/pipeline/progress_plan.h"

namespace farhorizon {

/// How long work shows itself on stderr.
struct ReporterOptions {
  std::string form = "auto";  ///< auto: a bar on a terminal, else nothing; json; none
};

void AddReporterOptions(CLI::App& command, ReporterOptions& options);

/// Shows progress: a bar that is drawn over, or a JSON object a line.
class Reporter {
 public:
  explicit Reporter(const ReporterOptions& options);
  ~Reporter();
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  /// For one run. Requires: this outlives it.
  Progress progress(Workflow workflow);
  /// A line of its own, in every form. Requires: as above.
  Notice notice();
  /// The same with the overall percentage known already.
  void Show(const std::string& stage, double done, int percent);
  /// Takes the bar away, so that a message can stand in its place.
  void Clear();

 private:
  bool bar_ = false;
  bool json_ = false;
  bool drawn_ = false;
  std::string last_;
  std::optional<OverallProgress> overall_;
};

}  // namespace farhorizon
