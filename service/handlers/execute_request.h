#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/result_wishes.h"
#include "service/jobs/callback.h"

namespace farhorizon {

/// The body of an execute request of OGC API - Processes.
struct ExecuteRequest {
  std::string process;
  nlohmann::json inputs;  ///< an object
  ResultWishes wishes;
  Subscriber subscriber = {};
};

/// Reads the body. process: whose execution was asked for; empty where the body may say, as its
/// member `process`, and means terrain-lod where it does not.
///
/// Without `response` the results of echo are raw; those of terrain-lod are where one output is
/// asked for. Without `transmissionMode` an output of echo is sent as itself, one of terrain-lod
/// where it is the raw result.
/// Errors: kInvalidArgument "invalid-json", "invalid-parameter", "callback-not-allowed"; kNotFound
///   "no-such-process".
Result<ExecuteRequest> ReadExecuteRequest(const HandlerContext& context, const std::string& text,
                                          const std::string& process);

/// An input as it came: a value by itself, or in an object with its format.
struct GivenInput {
  nlohmann::json value;
  std::string media_type;
  std::string encoding;
};

/// Reads one value of the input `name`. An object that has no member `value` is a value itself.
/// Errors: kInvalidArgument "invalid-parameter"; "href-not-allowed" for a link to a value.
Result<GivenInput> ReadInput(const std::string& name, const nlohmann::json& given);

/// The values of the input `name`: of an array, each of its elements is read by itself.
/// Errors: as ReadInput.
Result<nlohmann::json> ReadValue(const std::string& name, const nlohmann::json& given);

/// "no-such-process".
Error NoSuchProcess(std::string_view process);

}  // namespace farhorizon
