#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace farhorizon {

/// The memory that this process and its children may have together: the machine's, or the least
/// limit of the control groups that they are in (version 1 or 2), where that is less. nullopt where
/// the kernel does not say.
///
/// root: what stands for "/", for tests.
std::optional<std::int64_t> MachineMemoryBytes(const std::filesystem::path& root = "/");

}  // namespace farhorizon
