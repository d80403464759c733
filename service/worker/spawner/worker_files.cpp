#include "service/worker/spawner/worker_files.h"

#include <algorithm>
#include <elf.h>
#include <fstream>
#include <sstream>

#include "core/geo/reference_data.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// The kernel looks at no more of a script's first line (BINPRM_BUF_SIZE).
constexpr std::size_t kLongestFirstLine = 256;
constexpr int kDeepestInterpreters = 4;  // the kernel's own limit

fs::path FoundBy(const std::string& name) {
  for (const char* folder : {"/usr/local/bin", "/usr/bin", "/bin"}) {
    std::error_code failure;
    if (fs::is_regular_file(fs::path(folder) / name, failure)) return fs::path(folder) / name;
  }
  return {};
}

// "#!/usr/bin/env python3": env, and what it finds.
std::vector<fs::path> InterpretersOfScript(const std::string& line) {
  std::istringstream words(line);
  std::string interpreter;
  std::string argument;
  words >> interpreter >> argument;
  if (fs::path(interpreter).filename() != "env") return {interpreter};
  if (argument == "-S") words >> argument;
  return {interpreter, FoundBy(argument)};
}

// The loader that an ELF program of this machine's class names.
std::vector<fs::path> LoaderOf(std::ifstream& file) {
  Elf64_Ehdr head{};
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(&head), sizeof(head))) return {};
  for (int i = 0; i < std::min<int>(head.e_phnum, 64); ++i) {
    Elf64_Phdr part{};
    file.seekg(static_cast<std::streamoff>(head.e_phoff) + i * std::streamoff{sizeof(part)});
    if (!file.read(reinterpret_cast<char*>(&part), sizeof(part))) return {};
    if (part.p_type != PT_INTERP || part.p_filesz < 2 || part.p_filesz > 4096) continue;
    std::string name(part.p_filesz - 1, '\0');
    file.seekg(static_cast<std::streamoff>(part.p_offset));
    if (file.read(name.data(), static_cast<std::streamsize>(name.size()))) return {name};
  }
  return {};
}

std::vector<fs::path> InterpretersOf(const fs::path& program) {
  std::ifstream file(program, std::ios::binary);
  std::string beginning(kLongestFirstLine, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(file.gcount()));
  file.clear();
  if (beginning.starts_with("#!")) {
    return InterpretersOfScript(beginning.substr(2, beginning.find('\n') - 2));
  }
  if (beginning.starts_with("\177ELF")) return LoaderOf(file);
  return {};
}

void Add(const fs::path& program, int depth, std::vector<fs::path>& files) {
  std::error_code failure;
  const fs::path real = fs::canonical(program, failure);
  if (failure || std::ranges::find(files, real) != files.end()) return;
  files.push_back(real);
  if (depth == kDeepestInterpreters) return;
  for (const fs::path& interpreter : InterpretersOf(real)) Add(interpreter, depth + 1, files);
}

}  // namespace

std::vector<fs::path> FilesToExecute(const fs::path& program) {
  std::vector<fs::path> files;
  Add(program, 0, files);
  return files;
}

FileRights RightsOf(const LaunchOrder& order) {
  FileRights rights;
  rights.read = {order.directory, "/etc/ld.so.cache", "/dev/zero", "/dev/random", "/dev/urandom"};
  rights.write = {"/dev/null"};
  rights.fill = {order.directory / "out"};
#if defined(__SANITIZE_ADDRESS__)
  rights.read.emplace_back("/proc");  // AddressSanitizer reads the map of its own memory
#endif
  if (order.program == kThisProgram) {
    for (const char* path : {"/usr/lib", "/lib", "/lib64", "/usr/share/zoneinfo"}) {
      rights.read.emplace_back(path);
    }
    rights.read.emplace_back(ProjDataFolder());
    rights.read.emplace_back(GdalDataFolder());
  } else {
    for (const char* path : {"/usr", "/bin", "/lib", "/lib64"}) rights.read.emplace_back(path);
    rights.read.emplace_back(order.program);
    rights.execute = FilesToExecute(order.program);
  }
  return rights;
}

}  // namespace farhorizon
