#include "service/handlers/result_answer.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/base64.h"
#include "core/io/sha256.h"
#include "service/handlers/byte_range.h"
#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/result_wishes.h"
#include "service/handlers/results.h"

namespace farhorizon {

namespace {

using nlohmann::ordered_json;

constexpr std::int64_t kMostValueBytes = std::int64_t{4} << 20U;
// With longer heads, clients give up.
constexpr std::size_t kMostLinks = 100;

// An artifact on its way into a response.
struct Output {
  Artifact artifact;
  Transmission how = Transmission::kReference;
  std::string bytes = {};  // where it is sent as itself, beside others
};

// Those of the job's artifacts that were asked for.
std::vector<Output> Selected(std::vector<Artifact> artifacts, const ResultWishes& wishes) {
  std::vector<Output> outputs;
  for (Artifact& artifact : artifacts) {
    if (!wishes.outputs) {
      outputs.push_back({std::move(artifact)});
      continue;
    }
    const auto asked = wishes.outputs->find(artifact.name);
    if (asked != wishes.outputs->end()) outputs.push_back({std::move(artifact), asked->second});
  }
  return outputs;
}

// The first of them, as a text for people.
std::string NamesOf(const std::vector<Artifact>& artifacts) {
  constexpr std::size_t kMost = 30;
  std::string names;
  for (std::size_t i = 0; i < std::min(artifacts.size(), kMost); ++i) {
    names += (i == 0 ? "" : ", ") + artifacts[i].name;
  }
  return names + (artifacts.size() > kMost ? " and others" : "");
}

Result<std::string> BytesOf(JobService& jobs, const std::string& job, const std::string& name) {
  Result<OpenArtifact> open = jobs.Open(job, name);
  if (!open) return std::move(open.error());
  std::string bytes;
  const std::int64_t size = open->object->bytes();
  while (static_cast<std::int64_t>(bytes.size()) < size) {
    const auto at = static_cast<std::int64_t>(bytes.size());
    Result<std::string_view> piece = open->object->Read(at, size - at);
    if (!piece) return std::move(piece.error());
    bytes += *piece;
  }
  return bytes;
}

// Reads those that are sent as themselves; those for which there is no room become links.
Status ReadValues(JobService& jobs, const std::string& job, std::vector<Output>& outputs) {
  std::int64_t left = kMostValueBytes;
  for (Output& output : outputs) {
    if (output.how != Transmission::kValue) continue;
    left -= output.artifact.bytes;
    if (left < 0) {
      left += output.artifact.bytes;
      output.how = Transmission::kReference;
      continue;
    }
    Result<std::string> bytes = BytesOf(jobs, job, output.artifact.name);
    if (!bytes) return std::move(bytes.error());
    output.bytes = *std::move(bytes);
  }
  return Ok{};
}

std::string HrefOf(const HandlerContext& context, const Job& job, const Artifact& artifact) {
  return context.base + "/jobs/" + job.id + "/results/" + artifact.name;
}

// A value in a document: lists, bounding boxes and plain text stand by themselves, other objects
// and bytes within one that says what they are.
ordered_json ValueIn(const Output& output) {
  const std::string media = MediaTypeIn(output.artifact.media_type);
  if (media == "text/plain") return output.bytes;
  if (media.ends_with("json")) {
    ordered_json value = ordered_json::parse(output.bytes, nullptr, false);
    if (value.is_array() || (value.is_object() && value.contains("bbox"))) return value;
    if (!value.is_discarded()) return {{"value", std::move(value)}, {"mediaType", media}};
  }
  const auto* const bytes = reinterpret_cast<const unsigned char*>(output.bytes.data());
  return {{"value", ToBase64({bytes, output.bytes.size()})},
          {"mediaType", media},
          {"encoding", "base64"}};
}

ordered_json DocumentOf(const HandlerContext& context, const Job& job,
                        const std::vector<Output>& outputs) {
  ordered_json document = ordered_json::object();
  for (const Output& output : outputs) {
    const Artifact& artifact = output.artifact;
    if (output.how == Transmission::kValue) {
      document[artifact.name] = ValueIn(output);
      continue;
    }
    document[artifact.name] = {{"href", HrefOf(context, job, artifact)},
                               {"type", artifact.media_type},
                               {"title", artifact.name},
                               {"length", artifact.bytes},
                               {"sha256", artifact.sha256}};
  }
  return document;
}

HttpResponse Document(const HandlerContext& context, const HttpRequest& request, const Job& job,
                      const std::vector<Output>& outputs) {
  return TaggedJsonResponse(request, DocumentOf(context, job, outputs));
}

HttpResponse Links(const HandlerContext& context, const Job& job,
                   const std::vector<Output>& outputs) {
  HttpResponse response;
  response.status = 204;
  response.Set("Cache-Control", "no-cache");
  for (const Output& output : outputs) {
    response.Set("Link", "<" + HrefOf(context, job, output.artifact) +
                             ">; rel=\"http://www.opengis.net/def/rel/ogc/1.0/results\"; title=\"" +
                             output.artifact.name + "\"; type=\"" + output.artifact.media_type +
                             "\"");
  }
  return response;
}

// [RFC 2046, section 5.1]. The boundary is a hash of all that it parts, so none of it has it, and
// it is the same each time.
HttpResponse Multipart(const HandlerContext& context, const HttpRequest& request, const Job& job,
                       const std::vector<Output>& outputs) {
  std::string all;
  for (const Output& output : outputs) all += Sha256Hex(output.artifact.name + output.bytes);
  const std::string boundary = Sha256Hex(all);
  HttpResponse response;
  for (const Output& output : outputs) {
    const Artifact& artifact = output.artifact;
    response.body += "--" + boundary + "\r\nContent-Type: " + artifact.media_type +
                     "\r\nContent-ID: <" + artifact.name + ">\r\n";
    if (output.how == Transmission::kReference) {
      response.body += "Content-Location: " + HrefOf(context, job, artifact) + "\r\n";
    }
    response.body += "\r\n" + output.bytes + "\r\n";
  }
  response.body += "--" + boundary + "--\r\n";
  const std::string etag = "\"" + Sha256Hex(response.body) + "\"";
  response.status = StatusByConditions(request, etag);
  if (response.status == 412) {
    return ProblemResponse(request,
                           {"precondition-failed", "it is not the one that If-Match names"});
  }
  response.Set("Content-Type", "multipart/related; type=\"" + outputs.front().artifact.media_type +
                                   "\"; boundary=" + boundary);
  response.Set("Cache-Control", "no-cache");
  response.Set("ETag", etag);
  if (response.status == 304) response.body.clear();
  return response;
}

HttpResponse Raw(const HandlerContext& context, const HttpRequest& request, const Job& job,
                 std::vector<Output> outputs) {
  const bool referred = std::all_of(outputs.begin(), outputs.end(), [](const Output& output) {
    return output.how == Transmission::kReference;
  });
  if (referred && outputs.size() <= kMostLinks) return Links(context, job, outputs);
  if (referred) return Document(context, request, job, outputs);
  if (outputs.size() == 1) {
    Result<OpenArtifact> open = context.jobs.Open(job.id, outputs.front().artifact.name);
    if (!open) return LostArtifact(request, job, open.error());
    return SendArtifact(request, *std::move(open));
  }
  if (Status read = ReadValues(context.jobs, job.id, outputs); !read) {
    return LostArtifact(request, job, read.error());
  }
  return Multipart(context, request, job, outputs);
}

}  // namespace

HttpResponse AnswerResults(const HandlerContext& context, const HttpRequest& request,
                           const Job& job) {
  Result<std::vector<Artifact>> artifacts = context.jobs.Artifacts(job.id);
  if (!artifacts) return ProblemResponse(request, ProblemOf(artifacts.error()));
  const ResultWishes wishes = ReadResultWishes(job.answer);
  // An echo of nothing has none.
  const bool asked = wishes.outputs && !wishes.outputs->empty() && job.process == kTerrainProcess;
  const auto is_asked = [&wishes](const Artifact& artifact) {
    return wishes.outputs->contains(artifact.name);
  };
  if (asked && std::none_of(artifacts->begin(), artifacts->end(), is_asked)) {
    return ProblemResponse(
        request, {"no-such-output", "the job has none of the outputs that were asked for; it has " +
                                        NamesOf(*artifacts)});
  }
  std::vector<Output> outputs = Selected(*std::move(artifacts), wishes);
  if (wishes.raw) return Raw(context, request, job, std::move(outputs));
  if (Status read = ReadValues(context.jobs, job.id, outputs); !read) {
    return LostArtifact(request, job, read.error());
  }
  return Document(context, request, job, outputs);
}

Result<ordered_json> ResultLinks(const HandlerContext& context, const Job& job) {
  Result<std::vector<Artifact>> artifacts = context.jobs.Artifacts(job.id);
  if (!artifacts) return std::move(artifacts.error());
  std::vector<Output> outputs = Selected(*std::move(artifacts), ReadResultWishes(job.answer));
  for (Output& output : outputs) output.how = Transmission::kReference;
  return DocumentOf(context, job, outputs);
}

}  // namespace farhorizon
