#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <zstd.h>

namespace farhorizon {

/// What the one frame of zstd holds; empty where `bytes` is no whole one and nothing else.
inline std::string Unzstd(std::string_view bytes) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     &ZSTD_freeDCtx);
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  std::string text;
  std::string piece(65536, '\0');
  for (;;) {
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(left)) return "";
    text.append(piece, 0, out.pos);
    if (left == 0) return in.pos == in.size ? text : "";
    if (in.pos == in.size && out.pos < out.size) return "";
  }
}

}  // namespace farhorizon
