// A file system of GDAL's ("/vsisealed/") whose files are those of a list. GDAL joins names found
// in a raster to the raster's folder and asks the file system for them; what is not listed, word
// for word, does not exist.
#include "core/io/raster/sealed_folder.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>

#include <cpl_vsi.h>

#include "core/base/result.h"
#include "core/io/file.h"

namespace farhorizon {

namespace {

constexpr char kPrefix[] = "/vsisealed/";  // GDAL keeps the pointer

// Real paths by what stands after kPrefix: "7/dem.img".
struct Listing {
  std::mutex mutex;
  std::map<std::string, std::filesystem::path> files;
  std::uint64_t folders = 0;
};

Listing& TheListing() {
  static Listing listing;
  return listing;
}

std::filesystem::path RealPath(const char* name) {
  Listing& listing = TheListing();
  const std::lock_guard lock(listing.mutex);
  const auto found = listing.files.find(name);
  return found == listing.files.end() ? std::filesystem::path() : found->second;
}

int Stat(void*, const char* name, VSIStatBufL* status, int) {
  const std::filesystem::path path = RealPath(name);
  return path.empty() ? -1 : VSIStatL(path.c_str(), status);
}

void* Open(void*, const char* name, const char* access) {
  if (access[0] != 'r' || std::strchr(access, '+') != nullptr) return nullptr;
  const std::filesystem::path path = RealPath(name);
  return path.empty() ? nullptr : VSIFOpenL(path.c_str(), "rb");
}

vsi_l_offset Tell(void* file) { return VSIFTellL(static_cast<VSILFILE*>(file)); }

int Seek(void* file, vsi_l_offset offset, int whence) {
  return VSIFSeekL(static_cast<VSILFILE*>(file), offset, whence);
}

std::size_t Read(void* file, void* buffer, std::size_t size, std::size_t count) {
  return VSIFReadL(buffer, size, count, static_cast<VSILFILE*>(file));
}

int Eof(void* file) { return VSIFEofL(static_cast<VSILFILE*>(file)); }

int Close(void* file) { return VSIFCloseL(static_cast<VSILFILE*>(file)); }

void Install() {
  static std::once_flag once;
  std::call_once(once, [] {
    const std::unique_ptr<VSIFilesystemPluginCallbacksStruct,
                          decltype(&VSIFreeFilesystemPluginCallbacksStruct)>
        calls(VSIAllocFilesystemPluginCallbacksStruct(), VSIFreeFilesystemPluginCallbacksStruct);
    calls->stat = Stat;
    calls->open = Open;
    calls->tell = Tell;
    calls->seek = Seek;
    calls->read = Read;
    calls->eof = Eof;
    calls->close = Close;
    Check(VSIInstallPluginHandler(kPrefix, calls.get()) == 0,
          "the sealed file system is installed");
  });
}

}  // namespace

SealedFolder::SealedFolder(const std::vector<Member>& members) {
  Install();
  Listing& listing = TheListing();
  const std::lock_guard lock(listing.mutex);
  prefix_ = std::to_string(++listing.folders) + "/";
  for (const Member& member : members) {
    names_.push_back(prefix_ + member.name);
    listing.files.insert_or_assign(names_.back(), AbsolutePath(member.path));
  }
}

SealedFolder::~SealedFolder() {
  Listing& listing = TheListing();
  const std::lock_guard lock(listing.mutex);
  for (const std::string& name : names_) listing.files.erase(name);
}

std::string SealedFolder::PathOf(const std::string& name) const { return kPrefix + prefix_ + name; }

}  // namespace farhorizon
