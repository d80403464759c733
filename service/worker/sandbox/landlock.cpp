// Landlock takes away what a ruleset handles and no rule gives back (the kernel's
// userspace-api/landlock). Debian 12's headers are those of version 2, so the later rights and
// fields are spelt out here.
#include "service/worker/sandbox/landlock.h"

#include <cstdint>
#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/io/unique_fd.h"

namespace farhorizon {

namespace {

// struct landlock_ruleset_attr as of version 6; older kernels take its beginning.
struct RulesetOf6 {
  std::uint64_t files = 0;
  std::uint64_t network = 0;
  std::uint64_t scopes = 0;
};

constexpr std::uint64_t kTruncate = 1U << 14U;           // version 3
constexpr std::uint64_t kIoctlOfDevices = 1U << 15U;     // version 5
constexpr std::uint64_t kBindAndConnectTcp = 3;          // version 4
constexpr std::uint64_t kAbstractSocketsAndSignals = 3;  // version 6

constexpr std::uint64_t kReadFile = LANDLOCK_ACCESS_FS_READ_FILE;
constexpr std::uint64_t kRead = kReadFile | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kWrite = LANDLOCK_ACCESS_FS_WRITE_FILE | kTruncate;
// No folders, links, pipes, sockets or devices: none of them is an artifact.
constexpr std::uint64_t kFill =
    kRead | kWrite | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REMOVE_FILE;
// What a rule on a file, not on a folder, may have.
constexpr std::uint64_t kOfFiles =
    kReadFile | kWrite | LANDLOCK_ACCESS_FS_EXECUTE | kIoctlOfDevices;

std::uint64_t FileRightsOfVersion(int version) {
  constexpr std::uint64_t kOfVersion1 = (1U << 13U) - 1;
  return kOfVersion1 | (version >= 2 ? LANDLOCK_ACCESS_FS_REFER : 0) |
         (version >= 3 ? kTruncate : 0) | (version >= 5 ? kIoctlOfDevices : 0);
}

UniqueFd MakeRuleset(int version) {
  RulesetOf6 ruleset;
  ruleset.files = FileRightsOfVersion(version);
  if (version >= 4) ruleset.network = kBindAndConnectTcp;
  if (version >= 6) ruleset.scopes = kAbstractSocketsAndSignals;
  const std::size_t size = version >= 6   ? sizeof(ruleset)
                           : version >= 4 ? 2 * sizeof(std::uint64_t)
                                          : sizeof(std::uint64_t);
  return UniqueFd(static_cast<int>(::syscall(SYS_landlock_create_ruleset, &ruleset, size, 0)));
}

bool Allow(int ruleset, const std::vector<std::filesystem::path>& paths, std::uint64_t rights) {
  for (const std::filesystem::path& path : paths) {
    const UniqueFd file(::open(path.c_str(), O_PATH | O_CLOEXEC));
    struct stat about {};
    if (!file || ::fstat(file.get(), &about) != 0) continue;
    struct landlock_path_beneath_attr rule {};
    rule.allowed_access = S_ISDIR(about.st_mode) ? rights : rights & kOfFiles;
    rule.parent_fd = file.get();
    if (::syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace

int RestrictFiles(const FileRights& rights) {
  const auto version = static_cast<int>(
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
  if (version < 1) return 0;
  const UniqueFd ruleset = MakeRuleset(version);
  const std::uint64_t known = FileRightsOfVersion(version);
  const bool made = ruleset && Allow(ruleset.get(), rights.read, kRead) &&
                    Allow(ruleset.get(), rights.write, (kReadFile | kWrite) & known) &&
                    Allow(ruleset.get(), rights.fill, kFill & known) &&
                    Allow(ruleset.get(), rights.execute, LANDLOCK_ACCESS_FS_EXECUTE | kReadFile) &&
                    ::syscall(SYS_landlock_restrict_self, ruleset.get(), 0) == 0;
  return made ? version : 0;
}

}  // namespace farhorizon
