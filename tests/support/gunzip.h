#pragma once

#include <string>
#include <string_view>
#include <zlib.h>

namespace farhorizon {

/// What the one member of a gzip file holds; empty where `bytes` is no whole one and nothing else.
inline std::string Gunzip(std::string_view bytes) {
  constexpr int kGzipOnly = 16;  // added to the window's bits
  z_stream stream{};
  if (::inflateInit2(&stream, MAX_WBITS + kGzipOnly) != Z_OK) return "";
  // zlib wants bytes that may change, and changes none.
  std::string in(bytes);
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  std::string out;
  int code = Z_OK;
  while (code == Z_OK) {
    std::string piece(65536, '\0');
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    code = ::inflate(&stream, Z_NO_FLUSH);
    out += piece.substr(0, piece.size() - stream.avail_out);
  }
  const bool whole = code == Z_STREAM_END && stream.avail_in == 0;
  ::inflateEnd(&stream);
  return whole ? out : "";
}

}  // namespace farhorizon
