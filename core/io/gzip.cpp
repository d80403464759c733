#include "core/io/gzip.h"

// For input that zlib reads and does not change.
#define ZLIB_CONST
#include <zlib.h>

namespace farhorizon {

namespace {

constexpr int kGzip = 16;  // added to the window's bits: a gzip head in place of zlib's

}  // namespace

Result<std::string> Gzip(std::string_view bytes) {
  constexpr int kMemory = 8;
  z_stream stream{};
  if (::deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, kMemory,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
    return Error{ErrorCode::kResourceExhausted, "no memory to compress a tile",
                 "resource-exhausted"};
  }
  std::string compressed(::deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(compressed.data());
  stream.avail_out = static_cast<uInt>(compressed.size());
  const int ended = ::deflate(&stream, Z_FINISH);
  compressed.resize(compressed.size() - stream.avail_out);
  ::deflateEnd(&stream);
  Check(ended == Z_STREAM_END, "a buffer of deflateBound holds the stream");
  return compressed;
}

std::optional<std::string> Gunzip(std::string_view bytes, std::size_t most) {
  constexpr std::size_t kPiece = 65536;
  z_stream stream{};
  if (::inflateInit2(&stream, MAX_WBITS + kGzip) != Z_OK) return std::nullopt;
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  int code = Z_OK;
  while (code == Z_OK && out.size() <= most) {
    const std::size_t before = out.size();
    out.resize(before + kPiece);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
    stream.avail_out = static_cast<uInt>(kPiece);
    code = ::inflate(&stream, Z_NO_FLUSH);
    out.resize(out.size() - stream.avail_out);
  }
  const bool whole = code == Z_STREAM_END && stream.avail_in == 0 && out.size() <= most;
  ::inflateEnd(&stream);
  if (!whole) return std::nullopt;
  return out;
}

}  // namespace farhorizon
