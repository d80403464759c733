#pragma once

#include <filesystem>
#include <vector>

namespace farhorizon {

/// The files that a process may still reach. What does not exist is passed over.
struct FileRights {
  std::vector<std::filesystem::path> read;     ///< files, and folders with all below
  std::vector<std::filesystem::path> write;    ///< files that exist already
  std::vector<std::filesystem::path> fill;     ///< folders to make, change and remove files in
  std::vector<std::filesystem::path> execute;  ///< programs, their interpreters and the loader
};

/// Takes every other file from this process and those that it starts, for good, with Landlock; also
/// TCP, abstract sockets and signals to processes outside, where the kernel's Landlock can. The
/// version of its interface, or 0 where the kernel has none or refuses.
/// Requires: no new privileges are set for the process.
int RestrictFiles(const FileRights& rights);

}  // namespace farhorizon
