#pragma once

#include <vector>

#include "service/config/config_keys.h"

namespace farhorizon {

// The keys of each section of the configuration, in the order of the file: of what clients and
// other servers meet (network_keys.cpp), and of the work (job_keys.cpp).

std::vector<ConfigKey> HttpKeys();
std::vector<ConfigKey> AuthKeys();
std::vector<ConfigKey> FetchKeys();
std::vector<ConfigKey> CallbackKeys();

std::vector<ConfigKey> StoreKeys();
std::vector<ConfigKey> JobKeys();
std::vector<ConfigKey> UploadKeys();
std::vector<ConfigKey> WorkerKeys();

}  // namespace farhorizon
