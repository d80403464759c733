#include "service/worker/run_echo.h"

#include <chrono>
#include <filesystem>
#include <utility>
#include <vector>

#include "core/io/base64.h"
#include "core/io/file.h"
#include "core/io/manifest.h"
#include "core/io/sha256.h"
#include "service/clock.h"
#include "service/echo_task.h"

namespace farhorizon {

namespace {

Result<std::string> BytesOf(const EchoOutput& output) {
  if (!output.base64) return output.text;
  std::string bytes;
  Base64Decoder decoder;
  if (decoder.Feed(output.text, bytes) && decoder.MayEnd()) return bytes;
  return Error{ErrorCode::kUnsupportedData, "an echo's " + output.name + " is no base64"};
}

}  // namespace

Status RunEcho(const std::string& input, const std::string& output) {
  Result<std::string> text = ReadFile(input);
  if (!text) return std::move(text.error());
  Result<EchoTask> task = ReadEchoTask(*text);
  if (!task) return std::move(task.error());
  Pause(std::chrono::seconds(task->pause_seconds), {});
  const std::filesystem::path folder = output;
  std::vector<ManifestEntry> entries;
  for (const EchoOutput& one : task->outputs) {
    Result<std::string> bytes = BytesOf(one);
    if (!bytes) return std::move(bytes.error());
    Status written = WriteFile(folder / one.name, *bytes);
    if (!written) return written;
    entries.push_back({one.name, one.media_type, bytes->size(), Sha256Hex(*bytes)});
  }
  return WriteFile(folder / "manifest.json", WriteManifest(entries));
}

}  // namespace farhorizon
