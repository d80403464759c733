#pragma once

#include <string>
#include <vector>

#include "core/base/assumption.h"
#include "core/io/dem/tiff/tiff_file.h"
#include "core/io/dem/values/sample_type.h"

namespace farhorizon {

/// The nodata values that the file itself has: the tag of `tiff` (nullptr for other formats) as its
/// text says, or what GDAL reports of `band` (a GDALRasterBandH). GDAL makes 0 of a tag that is no
/// number; here such a tag means nothing, and is said.
std::vector<double> ReadNodataTags(void* band, TiffFile* tiff, Assumptions& assumptions);

/// The numbers of a nodata tag's text, several apart by blanks ("-9999 -32768"), or none where a
/// word of it is no number: then `where`, which has the tag, is said.
std::vector<double> ParseNodataText(const std::string& text, const std::string& where,
                                    Assumptions& assumptions);

/// The values of a band that mean no data: NaN, and every value that the file or the call names.
class NoDataRule {
 public:
  /// values: of the file and of the call; samples: their type, which rounds them.
  NoDataRule(const SampleType& samples, const std::vector<double>& values);

  /// True where `value`, raw, means no data. Nodata values beyond any height (-1e37, -3.40282e+38)
  /// are written with few digits, six at least, so that text and bits may differ: those match
  /// within 1e-5 of their size. Others match as the band's type, or a float, stores them.
  [[nodiscard]] bool Matches(double value) const;

 private:
  struct Nodata {
    double value = 0;
    double stored = 0;
    double slack = 0;  // by which a sample may be off
  };
  [[nodiscard]] bool Matches(double value, const Nodata& nodata) const;

  bool is_float_;
  std::vector<Nodata> nodata_;
};

/// Says of each of `tags` that no sample of type `samples` can have it (-9999 among unsigned
/// integers): it hides nothing, and the file may have another value for what it means.
void SayTagsWithoutSamples(const std::vector<double>& tags, const SampleType& samples,
                           Assumptions& assumptions);

}  // namespace farhorizon
