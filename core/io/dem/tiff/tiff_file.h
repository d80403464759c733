#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace farhorizon {

/// The tags of a TIFF that this program asks for by number (TIFF 6.0).
enum class TiffTag : std::uint16_t {
  kNewSubfileType = 254,
  kSubfileType = 255,  // older than kNewSubfileType
  kColumns = 256,
  kRows = 257,
  kBitsPerSample = 258,
  kPhotometric = 262,
  kStripOffsets = 273,
  kRowsPerStrip = 278,
  kStripByteCounts = 279,
  kPlanarConfiguration = 284,
  kTileWidth = 322,
  kTileLength = 323,
  kTileOffsets = 324,
  kTileByteCounts = 325,
  kSampleFormat = 339,
  kModelPixelScale = 33550,
  kModelTiepoint = 33922,
  kGeoKeyDirectory = 34735,
  kGeoAsciiParams = 34737,
  kGdalNodata = 42113,
};

/// The directories of a TIFF or BigTIFF, one an image: tags that GDAL interprets in its own way or
/// does not report. Reads of a broken file come back empty; nothing is trusted for a size.
class TiffFile {
 public:
  /// nullopt where the file at `path` is no TIFF or its first directory cannot be read.
  static std::optional<TiffFile> Open(const std::filesystem::path& path);

  /// The number of directories: images, overviews and masks, at most 1000.
  [[nodiscard]] std::size_t size() const { return directories_.size(); }
  [[nodiscard]] std::uint64_t file_bytes() const { return file_bytes_; }

  [[nodiscard]] bool Has(std::size_t directory, TiffTag tag) const;
  /// The first numbers of a tag, of whatever numeric type, `at_most` of them; empty where the
  /// directory has no such tag or its values lie beyond the end of the file.
  std::vector<double> Numbers(std::size_t directory, TiffTag tag, std::size_t at_most);
  /// The first number of a tag where it is whole and within 0..2^32, else `otherwise`.
  std::int64_t Integer(std::size_t directory, TiffTag tag, std::int64_t otherwise);
  /// The number of a GeoKey of the first directory; nullopt where it has none of that key, or text.
  std::optional<int> GeoKey(int key);
  /// A tag of text up to its first NUL; at most 256 bytes of it.
  std::string Text(std::size_t directory, TiffTag tag);
  /// All bytes of a tag of text; empty where it has none, or more than `at_most`.
  std::string WholeText(std::size_t directory, TiffTag tag, std::uint64_t at_most);

 private:
  struct Entry {
    std::uint16_t type = 0;
    std::uint64_t count = 0;
    std::uint64_t place = 0;  // of its values in the file
  };
  using Directory = std::map<std::uint16_t, Entry>;

  TiffFile() = default;
  // The bytes at `place`; empty where the file has fewer.
  std::string Bytes(std::uint64_t place, std::uint64_t count);
  // The unsigned number in `bytes` at `at`.
  [[nodiscard]] std::uint64_t Unsigned(const std::string& bytes, std::size_t at,
                                       std::size_t count) const;
  // Reads the directory at `place`; returns where the next one is, 0 for none.
  std::optional<std::uint64_t> ReadDirectory(std::uint64_t place);
  const Entry* Find(std::size_t directory, TiffTag tag) const;

  std::ifstream in_;
  std::uint64_t file_bytes_ = 0;
  bool big_endian_ = false;
  bool big_tiff_ = false;
  std::vector<Directory> directories_;
};

}  // namespace farhorizon
