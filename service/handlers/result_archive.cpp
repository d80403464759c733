#include "service/handlers/result_archive.h"

#include <algorithm>
#include <utility>

// For input that zlib reads and does not change.
#define ZLIB_CONST
#include <zlib.h>

#include "core/io/sha256.h"
#include "service/handlers/byte_range.h"
#include "service/handlers/problem.h"
#include "service/handlers/results.h"
#include "service/handlers/tar_format.h"
#include "service/handlers/zip_format.h"

namespace farhorizon {

namespace {

constexpr std::int64_t kPieceBytes = 65536;

std::string_view Cut(const std::string& text, std::int64_t offset, std::int64_t most) {
  return std::string_view(text).substr(static_cast<std::size_t>(offset),
                                       static_cast<std::size_t>(most));
}

// All that the archive's bytes follow from.
std::string TagOfArchive(const std::string& form, std::int64_t time_ms,
                         const std::vector<Artifact>& artifacts) {
  std::string text = form + "\n" + std::to_string(time_ms / 1000) + "\n";
  for (const Artifact& artifact : artifacts) text += artifact.name + " " + artifact.sha256 + "\n";
  return "\"" + Sha256Hex(text) + "\"";
}

}  // namespace

ArchiveSource::ArchiveSource(std::unique_ptr<ArchiveFormat> format, std::vector<ArchiveFile> files,
                             OpenFile open)
    : format_(std::move(format)),
      files_(std::move(files)),
      open_(std::move(open)),
      sums_(files_.size()),
      has_sum_(files_.size(), !format_->NeedsSums()) {
  std::int64_t at = 0;
  for (const ArchiveFile& file : files_) {
    starts_.push_back(at);
    at += format_->HeadBytes(file) + file.bytes + format_->PaddingBytes(file);
  }
  starts_.push_back(at);
}

std::int64_t ArchiveSource::bytes() const {
  return starts_.back() + format_->EndBytes(files_, starts_);
}

Status ArchiveSource::Open(std::size_t index) {
  if (file_ && file_index_ == index) return Ok{};
  file_.reset();  // one descriptor at a time
  Result<std::shared_ptr<BodySource>> opened = open_(index);
  if (!opened) return std::move(opened.error());
  file_ = *std::move(opened);
  file_index_ = index;
  return Ok{};
}

Result<std::uint32_t> ArchiveSource::SumOf(std::size_t index) {
  if (has_sum_[index]) return sums_[index];
  if (Status opened = Open(index); !opened) return std::move(opened.error());
  uLong sum = ::crc32(0, nullptr, 0);
  const std::int64_t size = files_[index].bytes;
  for (std::int64_t at = 0; at < size;) {
    const Result<std::string_view> piece = file_->Read(at, std::min(size - at, kPieceBytes));
    if (!piece) return piece.error();
    sum = ::crc32(sum, reinterpret_cast<const Bytef*>(piece->data()),
                  static_cast<uInt>(piece->size()));
    at += static_cast<std::int64_t>(piece->size());
  }
  has_sum_[index] = true;
  return sums_[index] = static_cast<std::uint32_t>(sum);
}

Result<std::string_view> ArchiveSource::ReadEnd(std::int64_t offset, std::int64_t most) {
  for (std::size_t i = 0; end_.empty() && i < files_.size(); ++i) {
    if (const Result<std::uint32_t> sum = SumOf(i); !sum) return sum.error();
  }
  if (end_.empty()) end_ = format_->End(files_, starts_, sums_);
  return Cut(end_, offset, most);
}

Result<std::string_view> ArchiveSource::ReadFile(std::size_t index, std::int64_t offset,
                                                 std::int64_t most) {
  const ArchiveFile& file = files_[index];
  const std::int64_t head = format_->HeadBytes(file);
  if (offset < head) {
    const Result<std::uint32_t> sum = SumOf(index);
    if (!sum) return sum.error();
    text_ = format_->Head(file, *sum);
    return Cut(text_, offset, most);
  }
  offset -= head;
  if (offset >= file.bytes) {
    text_.assign(static_cast<std::size_t>(format_->PaddingBytes(file)), '\0');
    return Cut(text_, offset - file.bytes, most);
  }
  if (Status opened = Open(index); !opened) return std::move(opened.error());
  return file_->Read(offset, std::min(most, file.bytes - offset));
}

Result<std::string_view> ArchiveSource::Read(std::int64_t offset, std::int64_t most) {
  if (offset >= starts_.back()) return ReadEnd(offset - starts_.back(), most);
  const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const auto index = static_cast<std::size_t>(after - starts_.begin()) - 1;
  return ReadFile(index, offset - starts_[index], most);
}

HttpResponse SendArchive(const HandlerContext& context, const HttpRequest& request, const Job& job,
                         const std::string& form) {
  const Result<std::vector<Artifact>> artifacts = context.jobs.Artifacts(job.id);
  if (!artifacts) return ProblemResponse(request, ProblemOf(artifacts.error()));
  std::vector<ArchiveFile> files;
  for (const Artifact& artifact : *artifacts) files.push_back({artifact.name, artifact.bytes});
  const std::int64_t time_ms = job.finished_ms.value_or(job.updated_ms);
  std::unique_ptr<ArchiveFormat> format;
  if (form == "zip") format = std::make_unique<ZipFormat>(time_ms);
  if (form == "tar") format = std::make_unique<TarFormat>(time_ms);
  const auto open = [jobs = &context.jobs, id = job.id, artifacts = *artifacts](std::size_t index) {
    return OpenSource(*jobs, id, artifacts[index].name);
  };
  const auto source = std::make_shared<ArchiveSource>(std::move(format), std::move(files), open);
  return SendSource(request,
                    {.source = source,
                     .bytes = source->bytes(),
                     .etag = TagOfArchive(form, time_ms, *artifacts),
                     .media_type = "application/" + std::string(form == "zip" ? "zip" : "x-tar"),
                     .disposition = "attachment; filename=\"" + job.id + "." + form + "\""});
}

}  // namespace farhorizon
