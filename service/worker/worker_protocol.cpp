#include "service/worker/worker_protocol.h"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "core/io/file.h"

namespace farhorizon {

namespace {

using nlohmann::json;

constexpr const char* kTaskFile = "task.json";
constexpr std::uintmax_t kLargestTask = 1U << 20U;
constexpr std::size_t kLongestText = 2000;
constexpr std::size_t kLongestCode = 64;

std::string Line(const json& object) {
  return object.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

// The beginning of `text`, at most kLongestText bytes, that ends with a whole character of UTF-8.
std::string Beginning(std::string text) {
  if (text.size() <= kLongestText) return text;
  std::size_t most = kLongestText;
  const auto continues = [&](std::size_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  for (int back = 0; back < 3 && most > 0 && continues(most); ++back) --most;
  text.resize(most);
  return text;
}

std::string TextOf(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return {};
  return Beginning(found->get<std::string>());
}

// An empty name is an error of no kind but its code.
std::optional<ErrorKind> KindOf(const std::string& name) {
  return name.empty() ? ErrorKind() : ErrorKind::FromName(name);
}

std::optional<WorkerMessage> ReadError(const json& error) {
  if (!error.is_object()) return std::nullopt;
  const std::optional<ErrorCode> code = ErrorCodeFromName(TextOf(error, "code"));
  const std::optional<ErrorKind> kind = KindOf(TextOf(error, "kind"));
  if (!code || !kind) return std::nullopt;
  return Error{*code, TextOf(error, "message"), *kind};
}

bool IsAssumptionCode(const std::string& code) {
  return !code.empty() && code.size() <= kLongestCode &&
         std::all_of(code.begin(), code.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
         });
}

std::optional<WorkerMessage> ReadAssumption(const json& assumption) {
  if (!assumption.is_object()) return std::nullopt;
  Assumption read{TextOf(assumption, "code"), TextOf(assumption, "text")};
  if (!IsAssumptionCode(read.code) || read.text.empty()) return std::nullopt;
  return read;
}

// The posts of a raster of at most 2^31 - 1 columns and rows.
std::optional<WorkerMessage> ReadSize(const json& posts) {
  constexpr std::int64_t kMost = std::int64_t{1} << 62U;
  if (!posts.is_number_integer() || posts < 1 || posts > kMost) return std::nullopt;
  return WorkerSize{posts.get<std::int64_t>()};
}

std::optional<WorkerMessage> ReadDone(const json& object) {
  const json& timings = object["timings"];
  const json peak = object.value("peakBytes", json(0U));
  if (!timings.is_object() || !peak.is_number_unsigned()) return std::nullopt;
  WorkerDone done;
  done.peak_bytes = peak.get<std::int64_t>();
  for (const auto& [stage, seconds] : timings.items()) {
    if (!seconds.is_number() || !StageFromName(stage)) return std::nullopt;
    done.timings[stage] = seconds.get<double>();
  }
  return done;
}

}  // namespace

std::string WriteTask(const WorkerTask& task) {
  return Line({{"input", task.input},
               {"output", task.output},
               {"parameters", task.parameters},
               {"maxPosts", task.max_posts},
               {"threads", task.threads},
               {"echo", task.echo}});
}

Result<WorkerTask> ReadTask(const std::string& text) {
  try {
    const json object = json::parse(text);
    WorkerTask task;
    task.input = object.at("input").get<std::string>();
    task.output = object.at("output").get<std::string>();
    task.parameters = object.at("parameters").get<Parameters>();
    task.max_posts = object.at("maxPosts").get<std::int64_t>();
    task.threads = object.at("threads").get<int>();
    task.echo = object.at("echo").get<bool>();
    return task;
  } catch (const json::exception& failure) {
    return Error{ErrorCode::kInvalidArgument, std::string("worker's task: ") + failure.what()};
  }
}

Status WriteTaskFile(const std::filesystem::path& directory, const WorkerTask& task) {
  std::ofstream file(directory / kTaskFile, std::ios::binary);
  file << WriteTask(task);
  file.close();
  if (!file) return Error{ErrorCode::kIo, "write the worker's task", "storage"};
  return Ok{};
}

Result<WorkerTask> ReadTaskFile() {
  Result<std::string> text = ReadFile(kTaskFile, kLargestTask);
  if (!text) return std::move(text.error());
  return ReadTask(*text);
}

std::string WriteMessage(const WorkerMessage& message) {
  if (std::holds_alternative<WorkerBeat>(message)) return Line({{"beat", true}});
  if (const auto* size = std::get_if<WorkerSize>(&message)) return Line({{"posts", size->posts}});
  if (const auto* progress = std::get_if<WorkerProgress>(&message)) {
    return Line({{"stage", StageName(progress->stage)}, {"done", progress->done}});
  }
  if (const auto* done = std::get_if<WorkerDone>(&message)) {
    return Line({{"timings", done->timings}, {"peakBytes", done->peak_bytes}});
  }
  if (const auto* assumption = std::get_if<Assumption>(&message)) {
    return Line(
        {{"assumption", {{"code", assumption->code}, {"text", Beginning(assumption->text)}}}});
  }
  const Error& error = std::get<Error>(message);
  return Line({{"error",
                {{"code", ErrorCodeName(error.code)},
                 {"kind", error.kind.name()},
                 {"message", Beginning(error.message)}}}});
}

std::optional<WorkerMessage> ReadMessage(std::string_view line) {
  const auto shallow = [](int depth, json::parse_event_t, json&) { return depth <= 4; };
  const json object = json::parse(line, shallow, false);
  if (!object.is_object()) return std::nullopt;
  if (const auto error = object.find("error"); error != object.end()) return ReadError(*error);
  if (object.contains("timings")) return ReadDone(object);
  if (const auto what = object.find("assumption"); what != object.end()) {
    return ReadAssumption(*what);
  }
  if (object.contains("beat")) return WorkerBeat{};
  if (const auto posts = object.find("posts"); posts != object.end()) return ReadSize(*posts);
  const auto done = object.find("done");
  if (done == object.end() || !done->is_number()) return std::nullopt;
  const double share = done->get<double>();
  if (!(share >= 0 && share <= 1)) return std::nullopt;
  const std::optional<Stage> stage = StageFromName(TextOf(object, "stage"));
  if (!stage) return std::nullopt;
  return WorkerProgress{*stage, share};
}

}  // namespace farhorizon
