#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace farhorizon {

/// Every kind of error, in alphabetical order: the closed list of the `code` of a problem document.
/// A new kind needs a row here, in the statuses of service/handlers/problem.cpp, in proto/errors.md
/// (meaning and remedy) and in the enum of proto/schemas/problem.schema.json.
inline constexpr auto kErrorKinds = std::to_array<std::string_view>({
    "all-nodata",
    "bad-azimuth",
    "bad-draco",
    "bad-geojson",
    "bad-glb",
    "bad-manifest",
    "bad-mesh",
    "bad-mesh-file",
    "bad-report",
    "bad-request",
    "bad-tileset",
    "block-too-large",
    "body-not-allowed",
    "body-too-large",
    "callback-not-allowed",
    "cancelled",
    "cannot-listen",
    "cells-too-narrow",
    "checksum-mismatch",
    "connection",
    "data-directory",
    "degenerate-geotransform",
    "digest-mismatch",
    "displaced-vertex",
    "draining",
    "expectation-failed",
    "file-limit",
    "flipped-triangle",
    "head-too-large",
    "height-out-of-range",
    "hole",
    "href-failed",
    "href-not-allowed",
    "href-timeout",
    "idempotency-key-reused",
    "infinite-height",
    "input-corrupt",
    "insufficient-scope",
    "internal-error",
    "invalid-address",
    "invalid-argument",
    "invalid-config",
    "invalid-idempotency-key",
    "invalid-json",
    "invalid-key",
    "invalid-multipart",
    "invalid-parameter",
    "invalid-query-parameter-value",
    "invalid-upload",
    "invalid-url",
    "io",
    "job-store",
    "job-store-unusable",
    "key-required",
    "kinetic-too-large",
    "local-crs",
    "max-error-too-small",
    "memory-limit",
    "mesh-elsewhere",
    "mesh-frame",
    "mesh-too-large",
    "method-not-allowed",
    "misdirected-request",
    "no-config",
    "no-crs",
    "no-geoid-grid",
    "no-space",
    "no-such-file",
    "no-such-job",
    "no-such-key",
    "no-such-level",
    "no-such-output",
    "no-such-process",
    "no-such-resource",
    "no-such-upload",
    "no-surface",
    "not-a-raster",
    "not-found",
    "origin-not-allowed",
    "outside-crs",
    "overlap",
    "poison-job",
    "precondition-failed",
    "queue-full",
    "range-not-satisfiable",
    "raster-too-large",
    "reference-data",
    "request-timeout",
    "resource-exhausted",
    "result-corrupt",
    "result-not-available",
    "result-not-ready",
    "rotated-geotransform",
    "sandbox-missing",
    "several-bands",
    "storage",
    "target-too-long",
    "timeout",
    "too-large-extent",
    "too-many-connections",
    "too-many-header-fields",
    "too-many-jobs",
    "too-many-requests",
    "too-many-uploads",
    "too-small",
    "transfer-encoding-not-implemented",
    "truncated",
    "unknown-config",
    "unknown-crs",
    "unknown-format",
    "unknown-parameter",
    "unknown-point",
    "unknown-post",
    "unknown-unit",
    "unnamed-points",
    "unsupported-data",
    "unsupported-media-type",
    "unsupported-tus-version",
    "unsupported-type",
    "upload-incomplete",
    "upload-offset-mismatch",
    "uploads-full",
    "version-not-supported",
    "virtual-path",
    "work-budget",
    "worker-crashed",
    "worker-not-started",
    "worker-program",
    "worker-stuck",
});
static_assert(std::is_sorted(kErrorKinds.begin(), kErrorKinds.end()));

/// What went wrong, as a program reads it: one name of kErrorKinds, or none. A literal that is not
/// in the list does not compile: Error{ErrorCode::kIo, "disk gone", "storge"}.
class ErrorKind {
 public:
  constexpr ErrorKind() = default;
  consteval ErrorKind(const char* name)  // NOLINT(google-explicit-constructor): for literals
      : name_(*name == '\0' ? std::string_view() : Listed(name)) {}

  /// The kind of a name that comes from outside this program; nullopt if the list does not have it.
  static constexpr std::optional<ErrorKind> FromName(std::string_view name) {
    const auto* found = std::find(kErrorKinds.begin(), kErrorKinds.end(), name);
    if (found == kErrorKinds.end()) return std::nullopt;
    ErrorKind kind;
    kind.name_ = *found;
    return kind;
  }

  /// True where the error is of no kind but its ErrorCode.
  [[nodiscard]] constexpr bool empty() const { return name_.empty(); }
  [[nodiscard]] constexpr std::string_view name() const { return name_; }
  operator std::string() const {  // NOLINT(google-explicit-constructor): as text where one is asked
    return std::string(name_);
  }

  friend constexpr bool operator==(ErrorKind a, ErrorKind b) { return a.name_ == b.name_; }
  friend constexpr bool operator==(ErrorKind a, const char* name) { return a.name_ == name; }

 private:
  static consteval std::string_view Listed(std::string_view name) {
    const auto* found = std::find(kErrorKinds.begin(), kErrorKinds.end(), name);
    if (found == kErrorKinds.end()) throw std::invalid_argument("no row of kErrorKinds");
    return *found;
  }

  std::string_view name_;
};

}  // namespace farhorizon
