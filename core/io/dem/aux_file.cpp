// GDAL's persistent auxiliary metadata: PAMDataset, with a PAMRasterBand for each band. GDAL would
// follow names of overviews and masks in it, so that its own reader stays switched off.
#include "core/io/dem/aux_file.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include <cpl_minixml.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include "core/geo/named_files.h"
#include "core/io/dem/place/reference_system.h"
#include "core/io/dem/values/nodata_rule.h"
#include "core/io/dem/values/number_text.h"
#include "core/io/file.h"
#include "core/io/text_grid/text_number.h"

namespace farhorizon {

namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{16} << 20;

struct DestroyXml {
  void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using XmlPtr = std::unique_ptr<CPLXMLNode, DestroyXml>;

// What is in hand while one auxiliary file is read.
class AuxReader {
 public:
  AuxReader(std::string name, GDALDatasetH dataset, int number, Assumptions& assumptions)
      : name_(std::move(name)),
        dataset_(dataset),
        band_(GDALGetRasterBand(dataset, number)),
        number_(number),
        assumptions_(assumptions) {}

  AuxTags Read(const CPLXMLNode* root, const DemReadOptions& options) {
    AuxTags tags;
    if (const CPLXMLNode* band = FindBand(root)) {
      if (const std::optional<std::string> text = Text(band, "NoDataValue")) {
        tags.nodata = ParseNodataText(*text, name_, assumptions_);
      }
      ReadScale(band);
      if (!options.height_unit) ReadUnit(band);
    }
    tags.geotransform = ReadGeoTransform(root);
    if (!options.crs) tags.crs = ReadCrs(root);
    SayRest(root);
    return tags;
  }

  void Say(const std::string& what) {
    assumptions_.push_back({"aux-file", "the file " + name_ + " beside " + what});
  }

 private:
  static std::optional<std::string> Text(const CPLXMLNode* node, const char* key) {
    const char* text = CPLGetXMLValue(node, key, nullptr);
    return text != nullptr ? std::optional<std::string>(text) : std::nullopt;
  }

  [[nodiscard]] const CPLXMLNode* FindBand(const CPLXMLNode* root) const {
    for (const CPLXMLNode* node = root->psChild; node != nullptr; node = node->psNext) {
      if (node->eType == CXT_Element && std::string_view(node->pszValue) == "PAMRasterBand" &&
          std::atoi(CPLGetXMLValue(node, "band", "0")) == number_) {
        return node;
      }
    }
    return nullptr;
  }

  // `what` stands in both, with the values `there` and `here`.
  void SayBoth(const std::string& what, const std::string& there, const std::string& here) {
    Say("gives " + what + " as " + there + ", the file itself as " + here +
        "; that beside counts, as with GDAL; take it away, or put it in with gdal_translate IN "
        "OUT");
  }

  void ReadScale(const CPLXMLNode* node) {
    // Both are read before one is set: GDAL then reports both as given.
    int has_scale = 0;
    int has_offset = 0;
    const double scale = GDALGetRasterScale(band_, &has_scale);
    const double offset = GDALGetRasterOffset(band_, &has_offset);
    const auto read = [&](const char* key, const std::string& what, std::optional<double> own,
                          auto get, auto set) {
      const std::optional<std::string> text = Text(node, key);
      if (!text) return;
      const std::optional<TextNumber> number = ParseNumber(*text);
      if (!number) {
        Say("gives " + what + " that is no number; it was passed over");
        return;
      }
      const double there = number->value;
      if (own && *own != there) SayBoth(what, NumberText(there), NumberText(*own));
      set(band_, there);
      if (get(band_, nullptr) != there) SayUnread(what);
    };
    const auto given = [](double value, int has) {
      return has != 0 ? std::optional<double>(value) : std::nullopt;
    };
    read("Scale", "the scale of the heights", given(scale, has_scale), GDALGetRasterScale,
         GDALSetRasterScale);
    read("Offset", "the offset of the heights", given(offset, has_offset), GDALGetRasterOffset,
         GDALSetRasterOffset);
  }

  void ReadUnit(const CPLXMLNode* node) {
    const std::optional<std::string> unit = Text(node, "UnitType");
    if (!unit || unit->empty()) return;
    const std::string own = GDALGetRasterUnitType(band_);
    if (!own.empty() && own != *unit) SayBoth("the unit of the heights", *unit, own);
    GDALSetRasterUnitType(band_, unit->c_str());
    if (GDALGetRasterUnitType(band_) != *unit) SayUnread("the unit of the heights");
  }

  std::optional<std::array<double, 6>> ReadGeoTransform(const CPLXMLNode* root) {
    const std::optional<std::string> text = Text(root, "GeoTransform");
    if (!text) return std::nullopt;
    std::array<double, 6> there{};
    std::istringstream words(*text);
    for (double& coefficient : there) {
      std::string word;
      std::getline(words >> std::ws, word, ',');
      const std::optional<TextNumber> value = ParseNumber(word.substr(0, word.find(' ')));
      if (!value) {
        Say("has a geotransform of other than six numbers; it was passed over");
        return std::nullopt;
      }
      coefficient = value->value;
    }
    std::array<double, 6> own{};
    if (GDALGetGeoTransform(dataset_, own.data()) == CE_None && !NearlyEqual(there, own)) {
      SayBoth("the place of the raster",
              "(" + NumberText(there[0]) + ", " + NumberText(there[3]) + ")",
              "(" + NumberText(own[0]) + ", " + NumberText(own[3]) + ")");
    }
    return there;
  }

  // Within a thousandth of a cell: the text has fewer digits than the file.
  static bool NearlyEqual(const std::array<double, 6>& a, const std::array<double, 6>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double cell = std::abs(i < 3 ? b[1] : b[5]);
      if (!(std::abs(a[i] - b[i]) <= 1e-3 * cell)) return false;
    }
    return true;
  }

  std::optional<std::string> ReadCrs(const CPLXMLNode* root) {
    const std::optional<std::string> text = Text(root, "SRS");
    if (!text || text->empty()) return std::nullopt;
    const CrsPtr crs(OSRNewSpatialReference(nullptr));
    std::string wkt = *text;
    char* position = wkt.data();
    // Not from "user input", which may be the name of a file.
    if (NamedFileIn(wkt) != nullptr || OSRImportFromWkt(crs.get(), &position) != OGRERR_NONE) {
      Say("gives a reference system that cannot be read; name it with --crs");
      return std::nullopt;
    }
    OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    const OGRSpatialReferenceH own = GDALGetSpatialRef(dataset_);
    if (own != nullptr && !SameCrs(own, crs.get())) {
      SayBoth("the reference system", OSRGetName(crs.get()), OSRGetName(own));
    }
    Result<std::string> name = NameOfCrs(crs.get());
    return name ? std::optional(*std::move(name)) : std::nullopt;
  }

  void SayUnread(const std::string& what) {
    Say("gives " + what + ", which was not read; put it in with gdal_translate IN OUT.tif");
  }

  void SayRest(const CPLXMLNode* root) {
    if (CPLGetXMLNode(root, "GCPList") != nullptr) {
      Say("has control points, which were not read; settle them with gdalwarp IN OUT");
    }
    CPLXMLNode* esri = CPLSearchXMLNode(const_cast<CPLXMLNode*>(root), "GeodataXform");
    if (esri == nullptr) return;
    const std::string_view type = CPLGetXMLValue(esri, "xsi:type", "");
    if (type.find("IdentityXform") == std::string_view::npos) {
      Say("has a transformation of Esri's, which was not read; settle it with gdalwarp IN OUT");
    }
  }

  std::string name_;
  GDALDatasetH dataset_;
  GDALRasterBandH band_;
  int number_;
  Assumptions& assumptions_;
};

}  // namespace

AuxTags ReadAuxFile(const std::filesystem::path& path, void* dataset, int number,
                    const DemReadOptions& options, Assumptions& assumptions) {
  std::filesystem::path beside = path;
  beside += ".aux.xml";
  std::error_code failure;
  if (!std::filesystem::is_regular_file(beside, failure)) return {};
  AuxReader reader(beside.filename().string(), dataset, number, assumptions);
  const Result<std::string> text = ReadFile(beside, kMaxBytes);
  const XmlPtr xml(text ? CPLParseXMLString(text->c_str()) : nullptr);
  const CPLXMLNode* root = xml ? CPLGetXMLNode(xml.get(), "=PAMDataset") : nullptr;
  if (root == nullptr) {
    reader.Say(
        "was passed over: it is no XML of GDAL's (PAMDataset) of at most 16 MiB; if it has "
        "something to say, put it in with gdal_translate IN OUT");
    return {};
  }
  return reader.Read(root, options);
}

}  // namespace farhorizon
