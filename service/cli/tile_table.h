#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// What became of one DEM of many.
struct TileRow {
  std::string dem = {};  ///< its path, as it was given
  std::string job = {};  ///< id; empty: none was made
  std::string status =
      {};  ///< waiting, accepted, running, successful, failed, dismissed; refused: the
           ///< service makes no job of it; unreached: another run may go on with it
  std::string code = {};    ///< of the error
  std::string detail = {};  ///< likewise, for people
  std::string key = {};     ///< the idempotency key: of the DEM's bytes and the parameters
};

/// The table of all of them: tab-separated values, a row a DEM, the first line the columns' names.
/// Tabs and line ends within a value are blanks.
class TileTable {
 public:
  TileTable(std::filesystem::path file, std::vector<TileRow> rows)
      : file_(std::move(file)), rows_(std::move(rows)) {}

  /// The rows of a table of an earlier run, by DEM; none where there is no such file.
  static std::map<std::string, TileRow> Read(const std::filesystem::path& file);

  [[nodiscard]] const std::vector<TileRow>& rows() const { return rows_; }
  /// Takes a row, and writes the file if that was not done a moment ago.
  /// Errors: those of WriteFile.
  Status Set(std::size_t index, TileRow row);
  Status Write() const;

 private:
  std::filesystem::path file_;
  std::vector<TileRow> rows_;
  std::chrono::steady_clock::time_point written_;
};

}  // namespace farhorizon
