#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "service/handlers/job_terms.h"
#include "service/jobs/job_service.h"
#include "service/pages/asset_folder.h"

namespace farhorizon {

class CallbackRules;
class Fetcher;
class KeyGate;

/// What the handlers share.
struct HandlerContext {
  JobService& jobs;
  std::string base;  ///< the public URL, without a slash at its end
  std::int64_t max_body_bytes = 0;
  TermBounds terms = {};
  std::shared_ptr<const AssetFolder> cesium = nullptr;  ///< for the viewer; nullptr: not installed
  bool echo = false;                                    ///< whether the process echo is offered
  std::shared_ptr<KeyGate> gate = nullptr;              ///< nullptr: nobody asks for keys
  std::shared_ptr<Fetcher> fetcher = nullptr;           ///< nullptr: nothing is fetched
  std::shared_ptr<const CallbackRules> callbacks = nullptr;  ///< nullptr: nobody is called
};

}  // namespace farhorizon
