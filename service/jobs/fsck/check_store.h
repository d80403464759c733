#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// What to do with a data directory, and who hears of it.
struct FsckOptions {
  std::filesystem::path data;
  bool repair = false;
  std::function<void(const std::string& line)> say;
};

/// What was found.
struct FsckSum {
  std::int64_t jobs = 0;
  std::int64_t objects = 0;
  std::int64_t bytes = 0;   ///< of the objects
  std::int64_t faults = 0;  ///< one line each
  std::int64_t mended = 0;  ///< of them
};

/// Looks at the store of a data directory whose service is stopped: pages and rows of the database,
/// the hash of every object, which of them belong to which job, what a killed process has left.
///
/// With `repair`, mends what can be mended without losing anything: takes the rows that can be read
/// out of a damaged database, sets damaged objects, strays and the damaged database aside, runs
/// jobs again whose results are lost and whose upload is there, and fails those without.
/// Errors: kIo where the folder has no store, or a service uses it.
Result<FsckSum> CheckStore(const FsckOptions& options);

}  // namespace farhorizon
