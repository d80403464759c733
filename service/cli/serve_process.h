#pragma once

#include <functional>

#include "core/base/result.h"
#include "service/config/load_config.h"

namespace farhorizon {

/// Runs the service until SIGINT or SIGTERM; the exit status. SIGHUP takes the keys of a new
/// configuration that can be changed while it runs.
/// reload: reads the configuration again.
int ServeProcess(const LoadedConfig& loaded, const std::function<Result<LoadedConfig>()>& reload);

}  // namespace farhorizon
