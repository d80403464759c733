#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// The objects of a store, each read whole.
struct CheckedObjects {
  std::map<std::string, std::int64_t> good;    ///< bytes by name
  std::vector<std::filesystem::path> damaged;  ///< files whose bytes are not those of their name
  std::vector<std::filesystem::path>
      unfitting;  ///< links, folders and the like in an object's place
};

/// Reads every object under `root` but strays. Errors: kIo where a folder cannot be listed.
Result<CheckedObjects> CheckObjects(const std::filesystem::path& root);

/// Moves a file into the folder `aside`, under a name that is free; true if that is done.
bool MoveAside(const std::filesystem::path& file, const std::filesystem::path& aside);

}  // namespace farhorizon
