#include "service/handlers/execute_request.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "service/handlers/asked_outputs.h"
#include "service/handlers/problem.h"
#include "service/handlers/processes.h"
#include "service/handlers/subscriber.h"
#include "service/strict_json.h"

namespace farhorizon {

namespace {

using nlohmann::json;

// What an input or an output says of its format: by itself, or in an object `format`.
std::string TextOf(const json& object, const char* name) {
  const auto found = object.find(name);
  if (found != object.end() && found->is_string()) return found->get<std::string>();
  const auto format = object.find("format");
  if (format == object.end() || !format->is_object()) return "";
  const auto within = format->find(name);
  return within != format->end() && within->is_string() ? within->get<std::string>() : "";
}

Status CheckMembers(const json& body) {
  constexpr std::array<std::string_view, 5> kKnown = {"inputs", "outputs", "process", "response",
                                                      "subscriber"};
  if (!body.is_object()) return InvalidParameter("an execute request is a JSON object");
  for (const auto& [name, value] : body.items()) {
    if (std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end()) continue;
    return InvalidParameter("an execute request has no member \"" + name.substr(0, 100) +
                            "\"; known are inputs, outputs, response, process and subscriber");
  }
  if (body.contains("inputs") && body["inputs"].is_object()) return Ok{};
  return InvalidParameter("an execute request has its inputs in an object, as {\"inputs\": {…}}");
}

// The process that the body names, by its name or its URL.
Result<std::string> ProcessOf(const HandlerContext& context, const json& body,
                              const std::string& expected) {
  if (!body.contains("process")) return expected.empty() ? kTerrainProcess : expected;
  if (!body["process"].is_string())
    return InvalidParameter("process must be a process' name or URL");
  std::string named = body["process"].get<std::string>();
  const std::string folder = context.base + "/processes/";
  if (named.starts_with(folder)) named.erase(0, folder.size());
  if (!expected.empty() && named != expected) {
    return InvalidParameter("the body names another process than the path");
  }
  if (!IsOffered(context, named)) return NoSuchProcess(named);
  return named;
}

// nullopt without the member.
Result<std::optional<bool>> RawOf(const json& body) {
  if (!body.contains("response")) return std::optional<bool>();
  if (body["response"] == "raw") return std::optional<bool>(true);
  if (body["response"] == "document") return std::optional<bool>(false);
  return InvalidParameter("response must be raw or document");
}

ResultWishes WishesOf(const std::string& process, std::optional<bool> raw, AskedOutputs asked) {
  const bool echo = process == kEchoProcess;
  if (!asked && echo) {
    asked.emplace();
    const nlohmann::ordered_json description = ProcessDescription(process, "");
    for (const auto& [name, output] : description["outputs"].items()) (*asked)[name] = {};
  }
  const bool one = asked && asked->size() == 1;
  ResultWishes wishes{raw.value_or(echo || one)};
  if (!asked) return wishes;
  const Transmission usual =
      echo || (one && wishes.raw) ? Transmission::kValue : Transmission::kReference;
  wishes.outputs.emplace();
  for (const auto& [name, mode] : *asked) (*wishes.outputs)[name] = mode.value_or(usual);
  return wishes;
}

}  // namespace

Error NoSuchProcess(std::string_view process) {
  return {ErrorCode::kNotFound,
          "there is no process \"" + std::string(process.substr(0, 100)) +
              "\"; GET /processes lists all",
          "no-such-process"};
}

Result<GivenInput> ReadInput(const std::string& name, const json& given) {
  if (!given.is_object()) return GivenInput{given, "", ""};
  if (given.contains("href")) {
    return Error{
        ErrorCode::kInvalidArgument,
        "the input " + name + " is a link, which only the DEM may be; send the value itself",
        "href-not-allowed"};
  }
  if (!given.contains("value")) return GivenInput{given, "", ""};
  return GivenInput{given["value"], TextOf(given, "mediaType"), TextOf(given, "encoding")};
}

Result<json> ReadValue(const std::string& name, const json& given) {
  if (!given.is_array()) {
    Result<GivenInput> read = ReadInput(name, given);
    if (!read) return std::move(read.error());
    return std::move(read->value);
  }
  json values = json::array();
  for (const json& element : given) {
    Result<GivenInput> read = ReadInput(name, element);
    if (!read) return std::move(read.error());
    values.push_back(std::move(read->value));
  }
  return values;
}

Result<ExecuteRequest> ReadExecuteRequest(const HandlerContext& context, const std::string& text,
                                          const std::string& process) {
  Result<json> body = ParseStrictJson(text);
  if (!body) return std::move(body.error());
  if (Status known = CheckMembers(*body); !known) return std::move(known.error());
  Result<std::string> named = ProcessOf(context, *body, process);
  if (!named) return std::move(named.error());
  Result<std::optional<bool>> raw = RawOf(*body);
  if (!raw) return std::move(raw.error());
  Result<AskedOutputs> asked = ReadAskedOutputs(*body, *named);
  if (!asked) return std::move(asked.error());
  Result<Subscriber> subscriber = ReadSubscriber(context, *body);
  if (!subscriber) return std::move(subscriber.error());
  ResultWishes wishes = WishesOf(*named, *raw, *std::move(asked));
  return ExecuteRequest{*std::move(named), std::move((*body)["inputs"]), std::move(wishes),
                        *std::move(subscriber)};
}

}  // namespace farhorizon
