#pragma once

#include <functional>
#include <memory>

#include "core/base/result.h"
#include "service/config/load_config.h"
#include "service/handlers/key_gate.h"
#include "service/http/server.h"

namespace farhorizon {

/// As KeyGate::Open has it, for a service that listens at `address`.
Result<std::shared_ptr<KeyGate>> OpenKeyGate(const Config& config, const HostPort& address);

/// What a process does for the jobs of its stores.
enum class ServeRole {
  kServe,  ///< takes them, runs them, answers for them
  kWork,   ///< runs them; of its answers there are health and metrics
};

/// Runs the service until SIGINT or SIGTERM; the exit status. SIGHUP takes the keys of a new
/// configuration that can be changed while it runs.
/// reload: reads the configuration again.
int ServeProcess(ServeRole role, const LoadedConfig& loaded,
                 const std::function<Result<LoadedConfig>()>& reload);

}  // namespace farhorizon
