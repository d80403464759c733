// GDAL 3.6 hands out samples as unsigned integers where their type is none of its own. So what the
// file itself says is read beside it: the tags of a TIFF, or the word PIXELTYPE of other formats.
#include "core/io/dem/values/sample_type.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <gdal.h>

namespace farhorizon {

namespace {

// Values of TIFF's tag SampleFormat (TIFF 6.0, section 19).
enum class SampleFormat { kUnsigned = 1, kSigned = 2, kFloat = 3, kUndefined = 4 };

Error BadType(const std::string& what) {
  return {ErrorCode::kUnsupportedData, what, "unsupported-type"};
}

SampleType Integers(const std::string& name, int bits, bool is_signed) {
  SampleType type;
  type.name = name;
  type.bits = bits;
  type.least = is_signed ? -std::ldexp(1.0, bits - 1) : 0;
  type.greatest = std::ldexp(1.0, is_signed ? bits - 1 : bits) - 1;
  return type;
}

// Floats of IEEE 754, and GDAL's of 24 bits: 1 of sign, 7 of exponent, 16 of mantissa.
SampleType Floats(const std::string& name, int bits) {
  SampleType type;
  type.name = name;
  type.bits = bits;
  type.is_float = true;
  type.significant_bits = bits == 16 ? 11 : bits == 24 ? 17 : bits == 32 ? 24 : 53;
  const int exponent = bits == 16 ? 16 : bits == 24 ? 64 : bits == 32 ? 128 : 1024;
  type.greatest = std::ldexp(1 - std::ldexp(1.0, -type.significant_bits), exponent);
  type.least = -type.greatest;
  return type;
}

Result<SampleType> MachineType(GDALRasterBandH band) {
  const GDALDataType type = GDALGetRasterDataType(band);
  const std::string name = GDALGetDataTypeName(type);
  const int bits = GDALGetDataTypeSizeBits(type);
  switch (type) {
    case GDT_Byte: {
      // Drivers without a type of signed bytes say so beside the band.
      const char* pixel_type = GDALGetMetadataItem(band, "PIXELTYPE", "IMAGE_STRUCTURE");
      if (pixel_type == nullptr || std::string_view(pixel_type) != "SIGNEDBYTE") {
        return Integers(name, bits, false);
      }
      SampleType bytes = Integers("signed bytes", bits, true);
      bytes.wrapped = true;
      return bytes;
    }
    case GDT_UInt16:
    case GDT_UInt32:
    case GDT_UInt64:
      return Integers(name, bits, false);
    case GDT_Int16:
    case GDT_Int32:
    case GDT_Int64:
      return Integers(name, bits, true);
    case GDT_Float32:
    case GDT_Float64:
      return Floats(name, bits);
    default:
      return BadType("the band's values are of type " + name +
                     ", heights must be real numbers; where they are the real part, take it out "
                     "with gdal_translate -ot Float64 IN OUT");
  }
}

// What TIFF's tags say beyond `machine`, GDAL's type.
Result<SampleType> TiffType(const SampleType& machine, TiffFile& tiff) {
  const int bits = static_cast<int>(tiff.Integer(0, TiffTag::kBitsPerSample, 1));
  const int format = static_cast<int>(tiff.Integer(0, TiffTag::kSampleFormat, 1));
  const std::string count = std::to_string(bits);
  switch (static_cast<SampleFormat>(format)) {
    case SampleFormat::kUnsigned:
      if (machine.is_float) break;
      return bits == machine.bits ? machine : Integers(count + "-bit integers", bits, false);
    case SampleFormat::kSigned: {
      if (machine.is_float) break;
      if (bits == machine.bits && (machine.least < 0 || machine.wrapped)) return machine;
      SampleType type = Integers(count + "-bit signed integers", bits, true);
      type.wrapped = true;
      return type;
    }
    case SampleFormat::kFloat:
      if (!machine.is_float) break;
      return bits == machine.bits ? machine : Floats("Float" + count, bits);
    case SampleFormat::kUndefined:
      if (bits != 8 && bits != 16) break;
      SampleType type = machine;
      type.undefined = true;
      return type;
  }
  return BadType(
      "the file says of its samples of " + count + " bits that they are of SampleFormat " +
      std::to_string(format) +
      ", which does not tell what they are; state it: tiffset -s 339 1 FILE for unsigned "
      "integers, 2 for signed ones, 3 for floating point");
}

}  // namespace

double SampleType::Meant(double raw) const {
  return wrapped && raw > greatest ? raw - std::ldexp(1.0, bits) : raw;
}

double SampleType::AsStored(double value) const {
  if (std::isnan(value)) return value;
  if (!is_float) {
    const bool fits = value >= least && value <= greatest && value == std::trunc(value);
    return fits ? value : std::numeric_limits<double>::quiet_NaN();
  }
  if (std::isinf(value) || value == 0) return value;
  int exponent = 0;
  std::frexp(value, &exponent);
  const double unit = std::ldexp(1.0, exponent - significant_bits);
  const double rounded = unit > 0 ? std::nearbyint(value / unit) * unit : value;
  if (std::abs(rounded) <= greatest) return rounded;
  return std::copysign(std::numeric_limits<double>::infinity(), value);
}

Result<SampleType> ReadSampleType(void* band, TiffFile* tiff) {
  Result<SampleType> type = MachineType(band);
  if (!type || tiff == nullptr) return type;
  return TiffType(*type, *tiff);
}

void DecideUndefinedFormat(const std::vector<double>& raw, const std::vector<double>& nodata,
                           SampleType& type, Assumptions& assumptions) {
  if (!type.undefined) return;
  const double half = std::ldexp(1.0, type.bits - 1);
  const auto upper_half = [&](double value) {
    return value >= half && std::ranges::find(nodata, value) == nodata.end();
  };
  if (std::ranges::none_of(raw, upper_half)) return;
  const bool is_signed = type.bits == 16;
  if (is_signed) {
    type = Integers("Int16", type.bits, true);
    type.wrapped = true;
  }
  assumptions.push_back(
      {"sample-format",
       "the file says of its " + std::to_string(type.bits) +
           "-bit samples that they are undefined (SampleFormat 4); they were read as " +
           (is_signed ? "signed, since no height on Earth is 32768 m and more" : "unsigned") +
           "; gdal_translate IN OUT makes them unsigned, gdal_calc.py -A IN --outfile=OUT "
           "--type=Int16 --calc=\"A.astype('int" +
           std::to_string(type.bits) + "')\" signed"});
}

}  // namespace farhorizon
