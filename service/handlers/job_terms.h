#pragma once

#include "core/base/result.h"
#include "service/jobs/job.h"

namespace farhorizon {

/// What a client may ask of the queue.
struct TermBounds {
  Priority highest = Priority::kHigh;
  std::int64_t timeout_seconds = 3600;  ///< of a run, at most
  std::int64_t deadline_seconds = 0;    ///< of a job that asks for none; 0: none
};

/// Takes the parameters `priority`, `deadline` and `timeout` out of those of a job.
/// Errors: kInvalidArgument "invalid-parameter".
Result<JobTerms> TakeTerms(Parameters& parameters, const TermBounds& bounds);

}  // namespace farhorizon
