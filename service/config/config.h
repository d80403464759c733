#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "service/auth/auth_options.h"
#include "service/http/server.h"
#include "service/jobs/job_service.h"
#include "service/log.h"
#include "service/outgoing/callback_rules.h"
#include "service/outgoing/fetcher.h"

namespace farhorizon {

/// The configuration of `farhorizon serve`: the options of its parts. ConfigKeys has a key for each
/// field that can be configured; the defaults of the fields are those of config/default.json.
struct Config {
  std::string listen = "127.0.0.1:8080";  ///< HOST:PORT, from which http.host and http.port follow
  int workers = 0;  ///< 0: as many as there are cores; jobs.workers follows from this
  ServerOptions http;
  AuthOptions auth;
  FetchOptions fetch;
  CallbackOptions callbacks;
  std::int64_t max_body_bytes = std::int64_t{1} << 31U;
  JobServiceOptions jobs;
  // Docker kills 10 seconds after it has asked: running jobs are given back before.
  std::chrono::seconds drain_time{8};
  std::string sandbox_require = "none";  ///< as CheckSandbox takes it
  LogOptions log;
  bool echo = false;             ///< whether the process echo is offered
  std::filesystem::path cesium;  ///< the folder of CesiumJS; empty: InstalledCesium()
};

}  // namespace farhorizon
