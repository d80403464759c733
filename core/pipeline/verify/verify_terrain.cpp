#include "core/pipeline/verify/verify_terrain.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "core/base/run_control.h"
#include "core/io/file.h"
#include "core/io/gzip.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLayer = "layer.json";

// Another zlib may pack the same bytes otherwise.
bool HoldTheSame(const std::string& stored, const std::string& made) {
  if (stored == made) return true;
  constexpr std::size_t kRoom = 64;  // a tile that is longer than the one due is another
  const std::optional<std::string> due = Gunzip(made, std::size_t{1} << 30U);
  return due && Gunzip(stored, due->size() + kRoom) == due;
}

std::set<std::string> TilesIn(const fs::path& directory) {
  std::set<std::string> names;
  std::error_code failure;
  for (fs::directory_iterator at(directory, failure), end; !failure && at != end;
       at.increment(failure)) {
    const std::string name = at->path().filename().string();
    if (name.ends_with(".terrain")) names.insert(name);
  }
  return names;
}

}  // namespace

bool HasTerrain(const fs::path& directory) {
  std::error_code failure;
  return fs::exists(directory / kLayer, failure) || !TilesIn(directory).empty();
}

void VerifyTerrain(const fs::path& directory, std::vector<TiledLevel> levels, std::size_t count,
                   Claims& claims) {
  const bool all_read = levels.size() == count;
  claims.Add(all_read, "terrain tiles are of levels whose GLBs can be read");
  if (!all_read) return;
  std::set<std::string> others = TilesIn(directory);
  const auto there = std::ssize(others);
  std::vector<std::string> different;
  const Status cut = WriteTerrainTiles(
      std::move(levels), RunControl(), [&](const std::string& name, const std::string& bytes) {
        const Result<std::string> stored = ReadFile(directory / name);
        const bool same =
            stored && (name == kLayer ? *stored == bytes : HoldTheSame(*stored, bytes));
        if (!same) different.push_back(name);
        others.erase(name);
        return Status(Ok{});
      });
  claims.Add(cut.has_value(), std::string("levels can be cut into terrain tiles") +
                                  (cut ? "" : ": " + cut.error().message));
  if (!cut) return;
  different.insert(different.end(), others.begin(), others.end());
  claims.Add(different.empty(), "layer.json and " + std::to_string(there) +
                                    " terrain tiles are the levels, cut" +
                                    (different.empty() ? "" : "; not so " + different.front()));
}

}  // namespace farhorizon
