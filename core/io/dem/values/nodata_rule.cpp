// Which of a band's raw values mean no data.
#include "core/io/dem/values/nodata_rule.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gdal.h>

#include "core/io/dem/values/number_text.h"
#include "core/io/dem/values/value_scale.h"
#include "core/io/text_grid/text_number.h"

namespace farhorizon {

std::vector<double> ParseNodataText(const std::string& text, const std::string& where,
                                    Assumptions& assumptions) {
  std::vector<double> values;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::optional<TextNumber> number = ParseNumber(word);
    if (!number) {
      std::string shown = text.substr(0, 40);
      std::ranges::replace_if(
          shown, [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
      assumptions.push_back({"nodata-tag", where + " names \"" + shown +
                                               "\" as the value that means no data, which is no "
                                               "number; it was passed over, --nodata names one"});
      return {};
    }
    values.push_back(number->value);
  }
  return values;
}

std::vector<double> ReadNodataTags(void* band, TiffFile* tiff, Assumptions& assumptions) {
  if (tiff != nullptr) {
    return ParseNodataText(tiff->Text(0, TiffTag::kGdalNodata), "the file", assumptions);
  }
  int given = 0;
  double value = 0;
  switch (GDALGetRasterDataType(band)) {
    case GDT_Int64:
      value = static_cast<double>(GDALGetRasterNoDataValueAsInt64(band, &given));
      break;
    case GDT_UInt64:
      value = static_cast<double>(GDALGetRasterNoDataValueAsUInt64(band, &given));
      break;
    default:
      value = GDALGetRasterNoDataValue(band, &given);
  }
  return given != 0 ? std::vector<double>{value} : std::vector<double>{};
}

NoDataRule::NoDataRule(const SampleType& samples, const std::vector<double>& values)
    : is_float_(samples.is_float) {
  // Floats of less than 32 bits are cut off by some writers and rounded by others.
  const bool coarse = samples.is_float && samples.significant_bits < 24;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    int exponent = 0;
    std::frexp(value, &exponent);
    const double slack = coarse ? std::ldexp(1.0, exponent - samples.significant_bits) : 0;
    nodata_.push_back({value, samples.AsStored(value), slack});
  }
}

bool NoDataRule::Matches(double value) const {
  return std::isnan(value) ||
         std::ranges::any_of(nodata_, [&](const Nodata& nodata) { return Matches(value, nodata); });
}

bool NoDataRule::Matches(double value, const Nodata& nodata) const {
  if (value == nodata.value || value == nodata.stored) return true;
  if (std::abs(nodata.value) < kMaxHeight) {
    if (std::abs(value - nodata.value) < nodata.slack) return true;
    // Doubles that were floats before: -9999.9 is then -9999.900390625.
    return is_float_ && std::abs(value) < kMaxHeight &&
           static_cast<float>(value) == static_cast<float>(nodata.value);
  }
  return std::isfinite(nodata.value) &&
         std::abs(value - nodata.value) <= 1e-5 * std::abs(nodata.value);
}

void SayTagsWithoutSamples(const std::vector<double>& tags, const SampleType& samples,
                           Assumptions& assumptions) {
  for (const double tag : tags) {
    if (samples.is_float || !std::isnan(samples.AsStored(tag))) continue;
    assumptions.push_back(
        {"nodata-tag", "the file names " + NumberText(tag) +
                           " as the value that means no data, which no sample of its type (" +
                           samples.name +
                           ") can have, so that it hides no post; if another value means no data, "
                           "name it with --nodata"});
  }
}

}  // namespace farhorizon
