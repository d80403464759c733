#pragma once

#include <string>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/io/dem/tiff/tiff_file.h"

namespace farhorizon {

/// How a band's values are stored, where GDAL's type does not say it: GDAL 3.6 reads signed samples
/// of 8 bits, and of any number of bits that is no machine type, as if they were unsigned.
struct SampleType {
  std::string name = {};  ///< for messages: "Int16", "12-bit signed integers"
  double least = 0;       ///< of the stored type: what a writer of voids may have used
  double greatest = 0;
  int bits = 0;  ///< of a sample
  bool is_float = false;
  int significant_bits = 0;  ///< of a float: 53, 24, 17 or 11
  bool wrapped = false;      ///< signed, read as unsigned: see Meant
  bool undefined = false;    ///< the file says that it does not say (SampleFormat 4)

  /// The value that GDAL's `raw` stands for.
  [[nodiscard]] double Meant(double raw) const;
  /// `value` as a sample of this type stores it: rounded, or infinite beyond a float's range; NaN
  /// where no sample has it (-9999 among unsigned integers, 0.5 among integers).
  [[nodiscard]] double AsStored(double value) const;
};

/// The type of the samples of `band` (a GDALRasterBandH), which in a TIFF is band of the first
/// image of `tiff`; otherwise nullptr.
/// Errors: kUnsupportedData, kind "unsupported-type": complex, unknown or contradictory types.
Result<SampleType> ReadSampleType(void* band, TiffFile* tiff);

/// Decides what samples of an undefined format are, from their values as GDAL reads them: unsigned,
/// as TIFF 6.0 advises, or signed where one of 16 bits has its highest bit set and is none of
/// `nodata`, since heights of 32768 m and more are none. Leaves other types as they are.
void DecideUndefinedFormat(const std::vector<double>& raw, const std::vector<double>& nodata,
                           SampleType& type, Assumptions& assumptions);

}  // namespace farhorizon
