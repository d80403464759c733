// PROJ looks for its database and grids in a folder that the user may write to (by HOME or
// XDG_DATA_HOME, else /tmp/proj), then where PROJ_DATA or PROJ_LIB say, then beside its library
// (PROJ, pj_open_lib_internal). So anyone who can write to /tmp could decide where a terrain lies.
// A search path of the program's own comes before all of these. Files that a definition names by a
// path are opened without a search: for them there are file functions that refuse.
#include "core/geo/reference_data.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include <proj.h>

namespace farhorizon {

namespace {

constexpr std::string_view kFolder = FARHORIZON_PROJ_DATA;

std::FILE* File(PROJ_FILE_HANDLE* handle) { return reinterpret_cast<std::FILE*>(handle); }

// Folders in the packaged one hold grids, too; a link in it is the packager's.
bool IsPackaged(std::string_view path) {
  return path.size() > kFolder.size() + 1 && path.starts_with(kFolder) &&
         path[kFolder.size()] == '/' && path.find("/..") == std::string_view::npos;
}

constexpr PROJ_FILE_API kPackagedFiles = {
    .version = 1,
    .open_cbk = [](PJ_CONTEXT*, const char* path, PROJ_OPEN_ACCESS access,
                   void*) -> PROJ_FILE_HANDLE* {
      if (access != PROJ_OPEN_ACCESS_READ_ONLY || !IsPackaged(path)) return nullptr;
      return reinterpret_cast<PROJ_FILE_HANDLE*>(std::fopen(path, "rbe"));
    },
    .read_cbk = [](PJ_CONTEXT*, PROJ_FILE_HANDLE* file, void* bytes, std::size_t size,
                   void*) -> std::size_t { return std::fread(bytes, 1, size, File(file)); },
    .write_cbk = [](PJ_CONTEXT*, PROJ_FILE_HANDLE*, const void*, std::size_t,
                    void*) -> std::size_t { return 0; },
    .seek_cbk = [](PJ_CONTEXT*, PROJ_FILE_HANDLE* file, long long offset, int whence, void*)
        -> int { return std::fseek(File(file), static_cast<long>(offset), whence) == 0 ? 1 : 0; },
    .tell_cbk = [](PJ_CONTEXT*, PROJ_FILE_HANDLE* file, void*) -> unsigned long long {
      return static_cast<unsigned long long>(std::ftell(File(file)));
    },
    .close_cbk = [](PJ_CONTEXT*, PROJ_FILE_HANDLE* file, void*) { std::fclose(File(file)); },
    .exists_cbk = [](PJ_CONTEXT*, const char* path, void*) -> int {
      std::error_code failure;
      return IsPackaged(path) && std::filesystem::exists(path, failure) ? 1 : 0;
    },
    .mkdir_cbk = [](PJ_CONTEXT*, const char*, void*) -> int { return 0; },
    .unlink_cbk = [](PJ_CONTEXT*, const char*, void*) -> int { return 0; },
    .rename_cbk = [](PJ_CONTEXT*, const char*, const char*, void*) -> int { return 0; },
};

}  // namespace

void SealContext(PJ_CONTEXT* context) {
  const char* const folders[] = {kFolder.data()};
  proj_context_set_search_paths(context, 1, folders);
  proj_context_set_enable_network(context, 0);  // reads proj.ini: by the search paths
  proj_context_set_fileapi(context, &kPackagedFiles, nullptr);
}

std::string WhereGridsGo() {
  return "put the file of that name, which https://cdn.proj.org has, into " + std::string(kFolder);
}

const char* ProjDataFolder() { return kFolder.data(); }
const char* GdalDataFolder() { return FARHORIZON_GDAL_DATA; }

int ReferenceDataFd() {
  std::error_code failure;
  const std::filesystem::path opened =
      std::filesystem::canonical(std::filesystem::path(kFolder) / "proj.db", failure);
  if (failure) return -1;
  const std::filesystem::directory_iterator end;
  std::filesystem::directory_iterator fd("/proc/self/fd", failure);
  for (; !failure && fd != end; fd.increment(failure)) {
    std::error_code closed;  // of the descriptor that lists the others
    if (std::filesystem::read_symlink(fd->path(), closed) == opened) {
      return std::stoi(fd->path().filename().string());
    }
  }
  return -1;
}

Status CheckReferenceData() {
  std::error_code failure;
  const std::filesystem::path database = std::filesystem::path(kFolder) / "proj.db";
  if (std::filesystem::is_regular_file(database, failure)) return Ok{};
  return Error{ErrorCode::kIo,
               "there is no " + database.string() +
                   ", the database of reference systems; install Debian's package proj-data",
               "reference-data"};
}

}  // namespace farhorizon
