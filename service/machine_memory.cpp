#include "service/machine_memory.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

void TakeLesser(std::optional<std::int64_t>& least, std::int64_t bytes) {
  least = std::min(least.value_or(bytes), bytes);
}

// "max", and whatever else is no number, is no limit.
void TakeLimit(const fs::path& file, std::optional<std::int64_t>& least) {
  std::ifstream text(file);
  std::int64_t bytes = 0;
  if (text >> bytes && bytes > 0) TakeLesser(least, bytes);
}

// Of a group and of those that it is in. In a container the path may name what is outside of what
// is mounted: then the container's own group is the root of the mount.
void TakeLimitsOf(const fs::path& mount, const std::string& group, const char* file,
                  std::optional<std::int64_t>& least) {
  for (fs::path at = fs::path(group).relative_path(); !at.empty(); at = at.parent_path()) {
    TakeLimit(mount / at / file, least);
  }
  TakeLimit(mount / file, least);
}

}  // namespace

std::optional<std::int64_t> MachineMemoryBytes(const fs::path& root) {
  std::optional<std::int64_t> least;
  std::ifstream memory(root / "proc/meminfo");
  std::string name;
  std::int64_t kibibytes = 0;
  if (memory >> name >> kibibytes && name == "MemTotal:") TakeLesser(least, kibibytes * 1024);
  // Lines of "number:controllers:/group"; version 2 has the number 0 and no controllers.
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    std::istringstream parts(line);
    std::string number;
    std::string controllers;
    std::string group;
    std::getline(parts, number, ':');
    std::getline(parts, controllers, ':');
    std::getline(parts, group);
    const fs::path mounts = root / "sys/fs/cgroup";
    if (controllers.empty()) {
      TakeLimitsOf(mounts, group, "memory.max", least);
    } else if (("," + controllers + ",").find(",memory,") != std::string::npos) {
      TakeLimitsOf(mounts / "memory", group, "memory.limit_in_bytes", least);
    }
  }
  return least;
}

}  // namespace farhorizon
