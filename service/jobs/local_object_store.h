#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// How many processes use a store at a time.
enum class Sharing { kOneProcess, kManyProcesses };

/// Objects as read-only files `root`/ab/<sha256>, where ab are the first two digits; an incoming
/// one has a second name, incoming/<sha256>, and strays are stray/<sha256>. PutFile and CopyTo
/// copy bytes, so that no other process holds a descriptor of an object's own file; temporary files
/// are in `root`/temp. Files of other names are left alone.
///
/// Many processes may share a folder, on one file system that all of them see alike: a rename there
/// is atomic, and what is synced is there for all. What a killed process has left in temp goes at
/// the next start, or, where others may be writing theirs, after a day.
/// Errors: kIo where the folders cannot be made.
Result<std::unique_ptr<ObjectStore>> OpenLocalObjectStore(const std::filesystem::path& root,
                                                          Sharing sharing = Sharing::kOneProcess);

/// The file that has the label of the objects below `root`.
std::filesystem::path LabelFile(const std::filesystem::path& root);
/// The label of the objects below `root`, as ObjectStore has it, without a store of them.
/// Errors: those of ReadFile and WriteFile.
Result<std::string> ReadLabel(const std::filesystem::path& root);
Status WriteLabel(const std::filesystem::path& root, const std::string& label);

}  // namespace farhorizon
