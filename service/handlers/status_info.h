#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "service/jobs/job.h"

namespace farhorizon {

/// A job as OGC API - Processes shows it (1.0 and the draft of 2.0). base: the public URL, no slash
/// at its end.
nlohmann::ordered_json StatusInfo(const Job& job, const std::string& base);

}  // namespace farhorizon
