#include "service/jobs/compressor.h"

#include <array>
#include <utility>

// For input that zlib reads and does not change.
#define ZLIB_CONST
#include <zlib.h>
#include <zstd.h>

namespace farhorizon {

namespace {

Error NoMemory() {
  return {ErrorCode::kResourceExhausted, "no memory to compress a result", "resource-exhausted"};
}

class GzipCompressor : public Compressor {
 public:
  explicit GzipCompressor(Sink sink) : sink_(std::move(sink)) {
    constexpr int kGzip = 16;  // added to the window's bits: a gzip head in place of zlib's
    constexpr int kMemory = 8;
    ready_ = ::deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, kMemory,
                            Z_DEFAULT_STRATEGY) == Z_OK;
  }
  GzipCompressor(const GzipCompressor&) = delete;
  GzipCompressor& operator=(const GzipCompressor&) = delete;
  ~GzipCompressor() override {
    if (ready_) ::deflateEnd(&stream_);
  }

  Status Add(std::string_view bytes, Flush flush) override {
    if (!ready_) return NoMemory();
    const int mode = flush == Flush::kEnd   ? Z_FINISH
                     : flush == Flush::kAll ? Z_SYNC_FLUSH
                                            : Z_NO_FLUSH;
    stream_.next_in = reinterpret_cast<const Bytef*>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    // Room that is left says that all has been taken.
    do {
      stream_.next_out = out_.data();
      stream_.avail_out = static_cast<uInt>(out_.size());
      ::deflate(&stream_, mode);
      const std::size_t made = out_.size() - stream_.avail_out;
      if (made == 0) break;
      Status taken = sink_({reinterpret_cast<const char*>(out_.data()), made});
      if (!taken) return taken;
    } while (stream_.avail_out == 0);
    return Ok{};
  }

 private:
  Sink sink_;
  z_stream stream_{};
  bool ready_ = false;
  std::array<Bytef, 65536> out_{};
};

// Of the horizon's files the levels from 16 on make a fifth less than gzip, those below a twelfth.
// The logs bound the memory, here and at the client; the level's own, 23, save a thousandth more.
constexpr std::pair<ZSTD_cParameter, int> kZstd[] = {{ZSTD_c_compressionLevel, 17},
                                                     {ZSTD_c_windowLog, 20},
                                                     {ZSTD_c_hashLog, 20},
                                                     {ZSTD_c_chainLog, 20},
                                                     {ZSTD_c_checksumFlag, 1}};

class ZstdCompressor : public Compressor {
 public:
  explicit ZstdCompressor(Sink sink) : sink_(std::move(sink)), context_(ZSTD_createCCtx()) {
    ready_ = context_ != nullptr;
    for (const auto& [parameter, value] : kZstd) {
      ready_ = ready_ && !ZSTD_isError(ZSTD_CCtx_setParameter(context_.get(), parameter, value));
    }
  }

  Status Add(std::string_view bytes, Flush flush) override {
    if (!ready_) return NoMemory();
    const ZSTD_EndDirective mode = flush == Flush::kEnd   ? ZSTD_e_end
                                   : flush == Flush::kAll ? ZSTD_e_flush
                                                          : ZSTD_e_continue;
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    std::size_t left = 0;
    do {
      ZSTD_outBuffer out{out_.data(), out_.size(), 0};
      left = ZSTD_compressStream2(context_.get(), &out, &in, mode);
      if (ZSTD_isError(left)) return NoMemory();  // nothing else can go wrong
      if (out.pos == 0) continue;
      Status taken = sink_({out_.data(), out.pos});
      if (!taken) return taken;
    } while (flush == Flush::kNone ? in.pos < in.size : left > 0);
    return Ok{};
  }

 private:
  struct Free {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };

  Sink sink_;
  std::unique_ptr<ZSTD_CCtx, Free> context_;
  bool ready_ = false;
  std::array<char, 65536> out_{};
};

}  // namespace

std::unique_ptr<Compressor> MakeCompressor(Coding coding, Compressor::Sink sink) {
  if (coding == Coding::kZstd) return std::make_unique<ZstdCompressor>(std::move(sink));
  return std::make_unique<GzipCompressor>(std::move(sink));
}

}  // namespace farhorizon
