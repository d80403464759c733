#pragma once

#include <cstdint>
#include <string>

#include "service/handlers/job_terms.h"
#include "service/jobs/job_service.h"

namespace farhorizon {

/// What the handlers share.
struct HandlerContext {
  JobService& jobs;
  std::string base;  ///< the public URL, without a slash at its end
  std::int64_t max_body_bytes = 0;
  TermBounds terms = {};
};

}  // namespace farhorizon
