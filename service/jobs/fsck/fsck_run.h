#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "service/jobs/data_directory.h"
#include "service/jobs/fsck/check_store.h"

namespace farhorizon {

/// One look at a store, as its parts share it.
struct FsckRun {
  const FsckOptions& options;
  const DataDirectory& directory;
  FsckSum sum = {};
  std::map<std::string, std::int64_t> good = {};  ///< bytes of the sound objects by name

  /// Counts a fault and says it.
  void Fault(const std::string& line, bool mended);
  /// Where repairs are asked for, moves a file to stray/`why` of the data directory; true
  /// if that is done.
  [[nodiscard]] bool SetAside(const std::filesystem::path& file, const char* why) const;
};

}  // namespace farhorizon
