#include "service/jobs/coding.h"

namespace farhorizon {

std::string_view CodingName(Coding coding) {
  switch (coding) {
    case Coding::kGzip:
      return "gzip";
    case Coding::kZstd:
      return "zstd";
    default:
      return "identity";
  }
}

}  // namespace farhorizon
