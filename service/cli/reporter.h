#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/base/run_control.h"
#include "core/pipeline/progress_plan.h"
#include "service/cli/command_line.h"

namespace farhorizon {

/// How the progress of long work is shown on standard error.
struct ReporterOptions {
  std::string form = "auto";  ///< auto: a bar on a terminal, else nothing; json; none
};

void AddReporterOptions(Command& command, ReporterOptions& options);

/// Shows progress on standard error: a bar that each step draws over, or one JSON object a line.
class Reporter {
 public:
  explicit Reporter(const ReporterOptions& options);
  ~Reporter();
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  /// Shows each step with its percentage of the workflow. Requires: this outlives it.
  Progress progress(Workflow workflow);
  /// Prints each notice on a line of its own, in every form. Requires: this outlives it.
  WarningHandler warn();
  /// Prints each assumption likewise. Requires: this outlives it.
  AssumptionHandler assume();
  /// Shows `stage`, the share of it that is done, and the percentage of the whole work.
  void Show(const std::string& stage, double done, int percent);
  /// Removes the bar, so that a message can be printed in its place. So does the destructor.
  void Clear();

 private:
  void Print(const std::string& text, const nlohmann::json& object);

  bool bar_ = false;
  bool json_ = false;
  bool drawn_ = false;
  std::string last_;
  std::optional<OverallProgress> overall_;
};

}  // namespace farhorizon
