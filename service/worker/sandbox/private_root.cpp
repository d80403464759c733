// Each tree is taken as a detached copy of its mount before the new root covers anything, then put
// into place in it. Mounts of a more privileged namespace are locked to those below them, so that
// trees are taken with all below (mount_namespaces(7)).
#include "service/worker/sandbox/private_root.h"

#include <array>
#include <fcntl.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/io/posix_file.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// Anything that exists may be covered while the root is made.
constexpr const char* kBase = "/usr";

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kNeedsProcesses = true;  // AddressSanitizer reads the map of its own memory
#else
constexpr bool kNeedsProcesses = false;
#endif

struct Tree {
  fs::path place;
  UniqueFd mount;
  bool folder = false;
};

// A copy of the mount at `path`, read-only where asked; no descriptor where it cannot be had.
Tree Take(const fs::path& path, bool read_only, bool devices) {
  Tree tree{path,
            UniqueFd(::open_tree(AT_FDCWD, path.c_str(),
                                 OPEN_TREE_CLONE | OPEN_TREE_CLOEXEC | AT_RECURSIVE)),
            fs::is_directory(path)};
  struct mount_attr attributes {};
  attributes.attr_set = static_cast<std::uint64_t>(MOUNT_ATTR_NOSUID) |
                        (devices ? 0U : static_cast<std::uint64_t>(MOUNT_ATTR_NODEV)) |
                        (read_only ? static_cast<std::uint64_t>(MOUNT_ATTR_RDONLY) : 0U);
  if (tree.mount && ::mount_setattr(tree.mount.get(), "", AT_EMPTY_PATH | AT_RECURSIVE, &attributes,
                                    sizeof(attributes)) != 0) {
    tree.mount.Reset();
  }
  return tree;
}

fs::path Below(const fs::path& path) { return fs::path(kBase) / path.relative_path(); }

// Makes an empty file or folder in the new root and puts the tree on it.
bool Place(const Tree& tree) {
  const fs::path place = Below(tree.place);
  std::error_code failure;
  fs::create_directories(tree.folder ? place : place.parent_path(), failure);
  if (failure) return false;
  if (!tree.folder) {
    const UniqueFd file(::open(place.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0400));
    if (!file) return false;
  }
  return ::move_mount(tree.mount.get(), "", AT_FDCWD, place.c_str(), MOVE_MOUNT_F_EMPTY_PATH) == 0;
}

// /bin, /lib and the like, which Debian has as links into /usr; folders of other systems are taken.
void AddSystemFolders(std::vector<Tree>& trees, std::vector<std::pair<fs::path, fs::path>>& links) {
  for (const char* path : {"/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32"}) {
    std::error_code failure;
    if (fs::is_symlink(path, failure)) {
      links.emplace_back(path, fs::read_symlink(path, failure));
    } else if (fs::is_directory(path, failure)) {
      trees.push_back(Take(path, true, false));
    }
  }
}

bool Exists(const fs::path& path) {
  std::error_code failure;
  return fs::exists(path, failure);
}

bool EnterBase() {
  return ::chdir(kBase) == 0 && ::syscall(SYS_pivot_root, ".", ".") == 0 &&
         ::umount2(".", MNT_DETACH) == 0 && ::chdir("/") == 0;
}

bool MakeReadOnly(const char* path) {
  struct mount_attr attributes {};
  attributes.attr_set = MOUNT_ATTR_RDONLY;
  return ::mount_setattr(AT_FDCWD, path, 0, &attributes, sizeof(attributes)) == 0;
}

}  // namespace

bool MapToNobody(unsigned outer_user, unsigned outer_group) {
  constexpr const char* kNobody = "65534 ";
  const auto write = [](const char* path, const std::string& text) {
    const UniqueFd file(::open(path, O_WRONLY | O_CLOEXEC));
    return file && WriteAll(file.get(), text);
  };
  return write("/proc/self/setgroups", "deny") &&
         write("/proc/self/uid_map", kNobody + std::to_string(outer_user) + " 1") &&
         write("/proc/self/gid_map", kNobody + std::to_string(outer_group) + " 1");
}

bool EnterPrivateRoot(const PrivateRootPlan& plan) {
  if (::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return false;
  std::vector<Tree> trees;
  std::vector<std::pair<fs::path, fs::path>> links;
  trees.push_back(Take("/usr", true, false));
  AddSystemFolders(trees, links);
  for (const char* path : {"/etc/ld.so.cache", "/etc/alternatives"}) {
    if (Exists(path)) trees.push_back(Take(path, true, false));
  }
  for (const fs::path& path : plan.read) trees.push_back(Take(path, true, false));
  for (const char* path : {"/dev/null", "/dev/zero", "/dev/random", "/dev/urandom"}) {
    trees.push_back(Take(path, false, true));
  }
  trees.push_back(Take(plan.directory, false, false));
  const fs::path input = plan.directory / "in";
  if (Exists(input)) trees.push_back(Take(input, true, false));

  if (::mount("farhorizon", kBase, "tmpfs", MS_NOSUID | MS_NODEV, "mode=0755,size=64k") != 0) {
    return false;
  }
  for (const Tree& tree : trees) {
    if (!tree.mount || !Place(tree)) return false;
  }
  for (const auto& [link, target] : links) {
    if (::symlink(target.c_str(), Below(link).c_str()) != 0) return false;
  }
  // Only what the namespace's own processes are; containers that hide parts of /proc allow none.
  const fs::path processes = Below("/proc");
  if (::mkdir(processes.c_str(), 0555) != 0) return false;
  const bool shown = ::mount("proc", processes.c_str(), "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC,
                             "subset=pid") == 0;
  if (kNeedsProcesses && !shown) return false;
  return EnterBase() && MakeReadOnly("/") && ::chdir(plan.directory.c_str()) == 0;
}

}  // namespace farhorizon
