// What the files that people send instead of a DEM are, and the way from each to one. The marks are
// those of the formats' descriptions; the commands are GDAL's unless they name another program.
#include "core/io/file_kind/unread_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string>

#include "core/io/file_kind/hgt_name.h"

namespace farhorizon {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view kTranslate = "convert it with gdal_translate IN OUT.tif";
constexpr std::string_view kUnpack = "unpack it and give the DEM that is in it";
constexpr std::string_view kPicture =
    "colours are not heights: fetch the DEM itself; where the colours encode heights "
    "(Terrain-RGB), decode them with gdal_calc.py first";
constexpr std::string_view kPoints =
    "make a grid of its points first, with pdal (writers.gdal) or gdal_grid";
constexpr std::string_view kVector =
    "it has no cells: make a grid of its heights first, with gdal_grid or gdal_rasterize";
constexpr std::string_view kNetcdf =
    "take its heights out with gdal_translate NETCDF:IN:VARIABLE OUT.tif (gdalinfo IN lists the "
    "variables)";
constexpr std::string_view kHdf =
    "take its heights out with gdal_translate SUBDATASET OUT.tif (gdalinfo IN lists the "
    "subdatasets)";
constexpr std::string_view kBeside =
    "it belongs to a file of the same name with another ending, which is the one to give";

// What stands at `at` in the file.
struct Mark {
  std::size_t at;
  std::string_view bytes;
  UnreadFormat format;
};

constexpr Mark kMarks[] = {
    {0, "CDF\x01"sv, {"a netCDF file", kNetcdf}},
    {0, "CDF\x02"sv, {"a netCDF file", kNetcdf}},
    {0, "CDF\x05"sv, {"a netCDF file", kNetcdf}},
    {0, "\x89HDF\r\n"sv, {"an HDF5 file (netCDF-4 and BAG are, too)", kHdf}},
    {0, "\x0e\x03\x13\x01"sv, {"an HDF4 file", kHdf}},
    {0, "GRIB"sv, {"a GRIB file", kTranslate}},
    {0, "PK\x03\x04"sv, {"a zip archive", "unpack it (unzip IN) and give the DEM that is in it"}},
    {0, "PK\x05\x06"sv, {"an empty zip archive", "fetch it again"}},
    {0, "\x1f\x8b"sv, {"a gzip file", "unpack it (gunzip IN) and give the file that is in it"}},
    {0, "BZh"sv, {"a bzip2 file", "unpack it (bunzip2 IN) and give the file that is in it"}},
    {0,
     "\xfd"
     "7zXZ"sv,
     {"an xz file", "unpack it (unxz IN) and give the file that is in it"}},
    {0, "\x28\xb5\x2f\xfd"sv, {"a zstd file", "unpack it (unzstd IN) and give what is in it"}},
    {0, "7z\xbc\xaf\x27\x1c"sv, {"a 7z archive", kUnpack}},
    {0, "Rar!"sv, {"a RAR archive", kUnpack}},
    {257, "ustar"sv, {"a tar archive", "unpack it (tar xf IN) and give the DEM that is in it"}},
    {0, "\x89PNG"sv, {"a PNG picture", kPicture}},
    {0, "\xff\xd8\xff"sv, {"a JPEG picture", kPicture}},
    {0, "GIF8"sv, {"a GIF picture", kPicture}},
    {8, "WEBP"sv, {"a WebP picture", kPicture}},
    {0,
     "\x00\x00\x00\x0cjP  "sv,
     {"a JPEG 2000 file", "where it holds heights, convert it with gdal_translate IN OUT.tif"}},
    {0,
     "\xff\x4f\xff\x51"sv,
     {"a JPEG 2000 codestream",
      "where it holds heights, convert it with gdal_translate IN OUT.tif"}},
    {0, "LASF"sv, {"a LAS or LAZ point cloud", kPoints}},
    {0, "ply\n"sv, {"a PLY mesh or point cloud", kPoints}},
    {0, "ply\r"sv, {"a PLY mesh or point cloud", kPoints}},
    {0, "ASTM-E57"sv, {"an E57 point cloud", kPoints}},
    {0, "glTF"sv, {"a glTF mesh", "the grid of heights that it was made of is needed"}},
    {0, "b3dm"sv, {"a tile of 3D Tiles", "the grid of heights that it was made of is needed"}},
    {0,
     "SQLite format 3"sv,
     {"an SQLite database (GeoPackage and MBTiles are, too)",
      "where it holds a raster of heights, convert that with gdal_translate IN OUT.tif"}},
    {0, "\x00\x00\x27\x0a\x00\x00\x00\x00"sv, {"a shapefile", kVector}},
    {0, "fgb"sv, {"a FlatGeobuf file", kVector}},
    {0, "%PDF"sv, {"a PDF document", "fetch the DEM itself"}},
    {0, "NITF"sv, {"an NITF file", kTranslate}},
    {0, "NSIF"sv, {"an NSIF file", kTranslate}},
    {0, "SIMPLE  ="sv, {"a FITS file", kTranslate}},
    {0, "PDS_VERSION_ID"sv, {"a PDS file of the planets", kTranslate}},
    {0, "CCSD3ZF"sv, {"a PDS file of the planets", kTranslate}},
    {0, "Object = IsisCube"sv, {"an ISIS cube", kTranslate}},
    {0, "RUU CROSS SYSTEM MAP FORMAT"sv, {"a PCRaster map", kTranslate}},
    {0, "TERRAGENTERRAIN "sv, {"a Terragen terrain", kTranslate}},
    {0, "HGPC1"sv, {"a Vertical Mapper grid", kTranslate}},
    {0, "HGPC8"sv, {"a Vertical Mapper classified grid", kTranslate}},
    {0, "EXP  "sv, {"an Arc/Info export file (E00)", kTranslate}},
    {0,
     "GRID1."sv,
     {"the header of an Arc/Info binary grid",
      "convert the whole folder with gdal_translate FOLDER OUT.tif"}},
    {0, "<MRF_META"sv, {"the header of an MRF raster", kTranslate}},
    {0, "Lerc2 "sv, {"a LERC block", "fetch the DEM as GeoTIFF"}},
    {0, "CntZImage "sv, {"a LERC block", "fetch the DEM as GeoTIFF"}},
    {0, "msid"sv, {"a MrSID picture", "where it holds heights, have it converted to GeoTIFF"}},
    {0, "NUM_OREC"sv, {"a grid of datum shifts (NTv2), not of heights", "give the DEM itself"}},
    {0,
     "version https://git-lfs"sv,
     {"a pointer of Git LFS, not the file itself", "fetch that with git lfs pull"}},
    {0,
     "\xff\xfe\0\0"sv,
     {"text in UTF-32", "write it in UTF-8: iconv -f UTF-32 -t UTF-8 IN > OUT"}},
    {0, "\xff\xfe"sv, {"text in UTF-16", "write it in UTF-8: iconv -f UTF-16 -t UTF-8 IN > OUT"}},
    {0, "\xfe\xff"sv, {"text in UTF-16", "write it in UTF-8: iconv -f UTF-16 -t UTF-8 IN > OUT"}},
};

// What a text begins with, in lower case, after white space.
struct Opening {
  std::string_view text;
  UnreadFormat format;
};

constexpr Opening kOpenings[] = {
    {"<vrtdataset",
     {"a VRT file, which names other files",
      "put what they hold into one file: gdal_translate IN OUT.tif"}},
    {"<!doctype html",
     {"a web page, not the DEM (of a login or an error?)",
      "open it in a browser to see what it says, and fetch the DEM again"}},
    {"<html",
     {"a web page, not the DEM (of a login or an error?)",
      "open it in a browser to see what it says, and fetch the DEM again"}},
    {"<kml", {"a KML file", kVector}},
    {"<mrf_meta", {"the header of an MRF raster", kTranslate}},
    {"<pamdataset", {"the .aux.xml of a raster", kBeside}},
    {"<gdal_wms", {"the description of a map service", kTranslate}},
    {"<",
     {"an XML file, not a raster (a server's error?)",
      "where GDAL knows it, convert it with gdal_translate IN OUT.tif"}},
    {"[internetshortcut]",
     {"a shortcut to an address, not the file itself", "fetch that, and give it"}},
    {"{", {"a JSON file, not a raster (a server's error?)", kVector}},
    {"#",
     {"a text that begins with a comment",
      "where a grid follows, take the comments out (sed '/^#/d' IN > OUT)"}},
    {"//",
     {"a text that begins with a comment",
      "where a grid follows, take the comments out (sed '/^[/][/]/d' IN > OUT)"}},
    {"envi", {"the header of an ENVI raster", kBeside}},
    {"byteorder", {"the header of an Esri raster (.flt, .bil)", kBeside}},
    {"http://", {"the address of a file, not the file itself", "fetch that, and give it"}},
    {"https://", {"the address of a file, not the file itself", "fetch that, and give it"}},
};

// The ending of a name, for formats without a mark.
constexpr Opening kEndings[] = {
    {".hdr", {"the header of a raster", kBeside}},
    {".prj", {"the reference system of a raster", kBeside}},
    {".tfw", {"the world file of a raster", kBeside}},
    {".ovr", {"the overviews of a raster", kBeside}},
    {".rrd", {"the overviews of a raster", kBeside}},
    {".ige",
     {"the cells of an Erdas Imagine raster", "convert that with gdal_translate IN.img OUT.tif"}},
    {".adf",
     {"a file of an Arc/Info binary grid",
      "convert the whole folder with gdal_translate FOLDER OUT.tif"}},
    {".bil", {"a raster whose header (.hdr) is not beside it", "put that there"}},
    {".bip", {"a raster whose header (.hdr) is not beside it", "put that there"}},
    {".bsq", {"a raster whose header (.hdr) is not beside it", "put that there"}},
    {".flt", {"a raster whose header (.hdr) is not beside it", "put that there"}},
    {".terrain", {"a tile of quantized mesh", "the grid of heights that it was made of is needed"}},
    {".sdat", {"the cells of a SAGA grid", kTranslate}},
    {".sgrd", {"the header of a SAGA grid", "convert it with gdal_translate IN.sdat OUT.tif"}},
    {".rst", {"an Idrisi raster", kTranslate}},
    {".gtx", {"a grid of a geoid, not of heights", "give the DEM itself"}},
    {".grd", {"a grid that is not Surfer's", kTranslate}},
    {".srtmswbd.raw", {"a mask of the water in an SRTM tile", "give the .hgt of the same name"}},
    {".dwg", {"a drawing", kVector}},
    {".dxf", {"a drawing", kVector}},
    {".dbf", {"the table of a shapefile", kVector}},
};

constexpr UnreadFormat kEmpty = {"empty", "it has no bytes; fetch or make it again"};
constexpr UnreadFormat kZeros = {"nothing but zeros at its beginning",
                                 "its transfer may have broken off; fetch it again"};
constexpr UnreadFormat kUtf16 = {"text in UTF-16",
                                 "write it in UTF-8: iconv -f UTF-16LE -t UTF-8 IN > OUT"};
constexpr UnreadFormat kUtf16BigEndian = {"text in UTF-16",
                                          "write it in UTF-8: iconv -f UTF-16BE -t UTF-8 IN > OUT"};
constexpr UnreadFormat kTable = {
    "a table of numbers that is no grid",
    "as a grid it needs the header of an Arc/Info ASCII grid (ncols, nrows, xllcorner, yllcorner, "
    "cellsize); as a list of points it must have three columns, x, y and height (cut -d, -f2-4 IN "
    "> OUT takes the second to the fourth)"};
constexpr UnreadFormat kText = {"a text that is no grid",
                                "see what it says; where it is not the DEM, fetch that again"};
constexpr UnreadFormat kTiff = {"a TIFF that cannot be opened, damaged or cut short",
                                "fetch or make the file again"};

// Text of two bytes a letter without a byte order mark: every other byte is 0, and no other is.
const UnreadFormat* WideText(std::string_view bytes) {
  const std::string_view part = bytes.substr(0, 16);
  if (part.size() < 16) return nullptr;
  std::array<int, 2> zeros = {0, 0};
  for (std::size_t i = 0; i < part.size(); ++i) zeros[i % 2] += part[i] == '\0' ? 1 : 0;
  if (zeros[0] == 0 && zeros[1] == 8) return &kUtf16;
  return zeros[0] == 8 && zeros[1] == 0 ? &kUtf16BigEndian : nullptr;
}

// Text without any format's mark: a table where its second line has numbers alone.
const UnreadFormat* PlainText(std::string_view bytes) {
  const auto is_text = [](unsigned char c) {
    return c >= 0x80 || std::isprint(c) != 0 || std::isspace(c) != 0;
  };
  if (!std::ranges::all_of(bytes, is_text)) return nullptr;
  constexpr std::string_view kLineEnds = "\r\n";
  const std::size_t first = bytes.find_first_of(kLineEnds);
  const std::size_t second = bytes.find_first_not_of(kLineEnds, first);
  if (first == std::string_view::npos || second == std::string_view::npos) return &kText;
  const std::string_view line =
      bytes.substr(second, bytes.find_first_of(kLineEnds, second) - second);
  const bool numbers = line.find_first_not_of("0123456789.,;eE+- \t") == std::string_view::npos &&
                       line.find_first_of("0123456789") != std::string_view::npos;
  return numbers ? &kTable : &kText;
}

// The first 64 bytes after white space, in lower case.
std::string Opened(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  if (bytes.starts_with("<?") || bytes.starts_with("<!--")) {  // the element after the declaration
    const std::size_t element = bytes.find(bytes[1] == '?' ? "?>" : "-->");
    if (element != std::string_view::npos) {
      const std::size_t next = bytes.find('<', element);
      if (next != std::string_view::npos) bytes.remove_prefix(next);
    }
  }
  std::string text(bytes.substr(0, 64));
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

const UnreadFormat* FindUnreadFormat(std::string_view beginning, std::int64_t bytes,
                                     std::string_view filename) {
  if (bytes == 0) return &kEmpty;
  if (beginning.starts_with("II*") || beginning.starts_with("MM\0*"sv) ||
      beginning.starts_with("II+") || beginning.starts_with("MM\0+"sv)) {
    return &kTiff;
  }
  for (const Mark& mark : kMarks) {
    if (beginning.size() >= mark.at && beginning.substr(mark.at).starts_with(mark.bytes)) {
      return &mark.format;
    }
  }
  const std::string text = Opened(beginning);
  for (const Opening& opening : kOpenings) {
    if (text.starts_with(opening.text)) return &opening.format;
  }
  for (const Opening& ending : kEndings) {
    if (HasEnding(filename, ending.text)) return &ending.format;
  }
  const bool zeros = beginning.find_first_not_of('\0') == std::string_view::npos;
  if (zeros && !IsHgtSize(bytes)) return &kZeros;  // a tile of sea is all zeros
  if (const UnreadFormat* wide = WideText(beginning)) return wide;
  return PlainText(beginning);
}

}  // namespace farhorizon
