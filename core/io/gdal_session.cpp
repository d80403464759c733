// Settings are of the thread, the error handler is on GDAL's stack for it: both go with the
// session. Drivers are registered once in a process, and so is the place of PROJ's files.
#include "core/io/gdal_session.h"

#include <array>
#include <mutex>
#include <string_view>
#include <utility>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>
#include <ogrsf_frmts.h>

#include "core/geo/reference_data.h"
#include "core/io/file.h"

namespace farhorizon {

namespace {

// GTIFF_REPORT_COMPD_CS: reports a vertical datum in the file, which decides what heights mean.
constexpr std::array<std::pair<const char*, const char*>, 7> kSettings = {{
    {"GDAL_PAM_ENABLED", "NO"},
    {"GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR"},
    {"CPL_VSIL_CURL_ALLOWED_EXTENSIONS", ".nothing"},
    {"PROJ_NETWORK", "OFF"},
    {"GTIFF_REPORT_COMPD_CS", "YES"},
    {"GTIFF_IGNORE_READ_ERRORS", "NO"},
    {"OGR_SQLITE_SYNCHRONOUS", "OFF"},
}};

// GDALAllRegister would register some 200 drivers and load plug-ins.
void RegisterDrivers() {
  static std::once_flag once;
  std::call_once(once, [] {
    const char* const folders[] = {ProjDataFolder(), nullptr};
    OSRSetPROJSearchPaths(folders);
    OSRSetPROJEnableNetwork(0);
    // Otherwise the first registration reads options from $HOME/.gdal/gdalrc or /etc/gdal/gdalrc,
    // and looks for plug-ins.
    CPLSetConfigOption("GDAL_CONFIG_FILE", "");
    CPLSetConfigOption("GDAL_DRIVER_PATH", "disable");
    GDALRegister_GTiff();
    GDALRegister_SRTMHGT();
    GDALRegister_DTED();
    GDALRegister_USGSDEM();
    GDALRegister_ENVI();
    GDALRegister_EHdr();
    GDALRegister_HFA();
    GDALRegister_GSBG();
    GDALRegister_GS7BG();
    GDALRegister_MEM();
    GDALRegister_JPEG();
    GDALRegister_PNG();
    RegisterOGRFlatGeobuf();
    RegisterOGRGeoPackage();
  });
}

// GDAL's tables (of ellipsoids, of Esri's state planes) lie in the folder of its package. What it
// would search are the current folder and the one that GDAL_DATA names; the places are the
// thread's.
void FindPackagedTables() {
  CPLFinderClean();
  CPLPushFinderLocation(GdalDataFolder());  // comes after those that GDAL searches anyway
  constexpr int kMostPlaces = 4;
  for (int i = 0; i < kMostPlaces; ++i) CPLPopFinderLocation();
  CPLPushFinderLocation(GdalDataFolder());
}

void CPL_STDCALL HearError(CPLErr severity, CPLErrorNum, const char* message) {
  if (severity < CE_Failure) return;
  static_cast<GdalSession*>(CPLGetErrorHandlerUserData())->Hear(message);
}

void Replace(std::string& text, const std::string& what, const std::string& with) {
  if (what.empty()) return;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), with);
    at += with.size();
  }
}

// Takes the names of SealedFolders out: "/vsisealed/7/".
void ForgetSealedFolders(std::string& text) {
  constexpr std::string_view kSealed = "/vsisealed/";
  for (std::size_t at = text.find(kSealed); at != std::string::npos; at = text.find(kSealed)) {
    const std::size_t end = text.find('/', at + kSealed.size());
    text.erase(at, end == std::string::npos ? kSealed.size() : end + 1 - at);
  }
}

}  // namespace

GdalSession::GdalSession(const std::filesystem::path& path) : path_(AbsolutePath(path)) {
  RegisterDrivers();
  for (const auto& [key, value] : kSettings) CPLSetThreadLocalConfigOption(key, value);
  FindPackagedTables();
  CPLPushErrorHandlerEx(HearError, this);
}

GdalSession::~GdalSession() {
  CPLPopErrorHandler();
  for (const auto& [key, value] : kSettings) CPLSetThreadLocalConfigOption(key, nullptr);
}

void GdalSession::Hear(const char* message) {
  if (!first_failure_.empty()) return;
  first_failure_ = message;
  const std::string directory = path_.parent_path().string();
  Replace(first_failure_, path_.string(), path_.filename().string());
  if (directory.size() > 1) {
    Replace(first_failure_, directory + "/", "");
    Replace(first_failure_, directory, ".");
  }
  ForgetSealedFolders(first_failure_);
  for (char& c : first_failure_) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
}

std::string GdalSession::Complaint() const {
  return first_failure_.empty() ? "" : " (GDAL: " + first_failure_ + ")";
}

}  // namespace farhorizon
