#include "core/pipeline/artifact_writer.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/io/file.h"
#include "core/io/media_type.h"
#include "core/io/sha256.h"

namespace farhorizon {

namespace fs = std::filesystem;

ArtifactWriter::ArtifactWriter(fs::path directory) : directory_(std::move(directory)) {}

ArtifactWriter::~ArtifactWriter() {
  if (finished_) return;
  std::error_code ignored;
  for (const ManifestEntry& entry : entries_) fs::remove(directory_ / entry.name, ignored);
  if (made_directory_) fs::remove(directory_, ignored);
}

Status ArtifactWriter::Open() {
  std::error_code failure;
  made_directory_ = fs::create_directories(directory_, failure);
  if (failure || !fs::is_directory(directory_)) {
    return Error{ErrorCode::kIo, "cannot make the folder " + directory_.filename().string() + ": " +
                                     failure.message()};
  }
  return Ok{};
}

Status ArtifactWriter::Add(const std::string& name, std::string_view bytes) {
  entries_.push_back({name, MediaTypeOf(name), bytes.size(), Sha256Hex(bytes)});
  return WriteFile(directory_ / name, bytes);
}

Status ArtifactWriter::Add(const std::string& name, const std::vector<std::uint8_t>& bytes) {
  return Add(name, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

Status ArtifactWriter::AddWritten(const std::string& name) {
  Result<std::string> bytes = ReadFile(PathOf(name));
  if (!bytes) return std::move(bytes.error());
  entries_.push_back({name, MediaTypeOf(name), bytes->size(), Sha256Hex(*bytes)});
  return Ok{};
}

fs::path ArtifactWriter::PathOf(const std::string& name) const { return directory_ / name; }

Status ArtifactWriter::Finish() {
  std::sort(entries_.begin(), entries_.end(),
            [](const ManifestEntry& a, const ManifestEntry& b) { return a.name < b.name; });
  Status written = WriteFile(directory_ / "manifest.json", WriteManifest(entries_));
  finished_ = written.has_value();
  return written;
}

}  // namespace farhorizon
