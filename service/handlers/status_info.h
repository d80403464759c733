#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "service/jobs/job.h"

namespace farhorizon {

/// The statusInfo document of a job: OGC API - Processes 1.0, and the draft of 2.0. base: the
/// public URL, without a slash at its end.
nlohmann::ordered_json StatusInfo(const Job& job, const std::string& base);

}  // namespace farhorizon
