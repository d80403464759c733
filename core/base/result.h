#pragma once

#include <optional>
#include <source_location>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "core/base/error_kind.h"

namespace farhorizon {

/// Why something could not be done, by where the remedy lies.
enum class ErrorCode {
  kInvalidArgument,    ///< the call is at fault
  kNotFound,           ///< the call names something that does not exist
  kUnsupportedData,    ///< the data is at fault
  kResourceExhausted,  ///< over a stated limit, or out of memory or disk
  kCancelled,          ///< a stop was requested
  kIo,                 ///< a file, a driver or a socket failed
};

/// The name of `code` as it stands in problem documents: "invalid-argument".
const char* ErrorCodeName(ErrorCode code);
/// The code that has this name; nullopt for any other text.
std::optional<ErrorCode> ErrorCodeFromName(std::string_view name);

/// A failure and its cause, worded for the person who can act on it.
struct Error {
  ErrorCode code;
  std::string message;  ///< lower case, no full stop, names the value, the limit and the remedy
  ErrorKind kind = {};  ///< stable, for programs to switch on: "no-crs", "several-bands"

  /// This error with `where` put in front: "read DEM: file is empty".
  [[nodiscard]] Error WithContext(const std::string& where) &&;
};

/// Thrown where an invariant of this program is broken: a bug of the program, whatever the data.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws InternalError, naming the place, unless `holds`. On in every build.
void Check(bool holds, const char* what,
           std::source_location where = std::source_location::current());

/// A value, or the Error on account of which there is none. A subset of std::expected (C++23).
/// Reading the one that is not there throws InternalError.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool has_value() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return has_value(); }

  T& operator*() & { return Value(); }
  const T& operator*() const& { return Value(); }
  T&& operator*() && { return std::move(Value()); }
  T* operator->() { return &Value(); }
  const T* operator->() const { return &Value(); }

  [[nodiscard]] Error& error() {
    Check(!has_value(), "error() of a success");
    return std::get<Error>(state_);
  }
  [[nodiscard]] const Error& error() const {
    Check(!has_value(), "error() of a success");
    return std::get<Error>(state_);
  }

 private:
  T& Value() {
    Check(has_value(), "value of a failure");
    return std::get<T>(state_);
  }
  const T& Value() const {
    Check(has_value(), "value of a failure");
    return std::get<T>(state_);
  }

  std::variant<T, Error> state_;
};

/// The result of work that returns no value.
struct Ok {};
using Status = Result<Ok>;

}  // namespace farhorizon
