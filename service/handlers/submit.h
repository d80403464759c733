#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/handlers/router.h"
#include "service/jobs/job_service.h"

namespace farhorizon {

/// What handlers share.
struct HandlerContext {
  JobService& jobs;
  std::string base;  ///< the public URL, without a slash at its end
  std::int64_t max_body_bytes = 0;
};

/// POST /jobs: a DEM by itself, with its parameters in the query, or a multipart form.
Route SubmitRoute(const HandlerContext& context);

/// Parameters from the JSON of a form's "params": an object of numbers, texts, and arrays of those
/// (joined by commas). Errors: kInvalidArgument "invalid-json", "invalid-parameter".
Result<Parameters> ParametersOfJson(const std::string& text);

}  // namespace farhorizon
