#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/result.h"
#include "core/io/text_grid/text_words.h"

namespace farhorizon {

/// Whether `beginning`, the first bytes of a file, are lines of three numbers, after one of three
/// words at most. Blanks, commas or semicolons part them.
bool LooksLikeXyz(std::string_view beginning);

/// x, y and height.
using XyzPoint = std::array<double, 3>;

/// The points of a list, one a line, after a first line that may name the columns.
class XyzPoints {
 public:
  /// Reads the first line if it has names. Errors: kUnsupportedData "not-a-raster" where they are
  ///   not those of a place and a height in metres; kIo.
  static Result<XyzPoints> Open(const std::filesystem::path& path);

  /// A first line names the columns.
  [[nodiscard]] bool order_is_stated() const { return order_is_stated_; }
  /// That of the last point.
  [[nodiscard]] std::int64_t line() const { return line_; }

  /// The next point; nullopt at the end. Errors: kUnsupportedData "not-a-raster", which names the
  ///   line that is not three numbers.
  Result<std::optional<XyzPoint>> Next();

 private:
  explicit XyzPoints(TextWords words) : words_(std::move(words)) {}
  Status ReadHeader();

  TextWords words_;
  std::array<int, 3> axes_ = {0, 1, 2};
  bool order_is_stated_ = false;
  std::int64_t line_ = 0;
  TextWord word_;  // the first of the next line
  bool more_ = false;
};

}  // namespace farhorizon
