#include "service/http/body_reader.h"

#include <algorithm>
#include <limits>

#include "core/base/result.h"

namespace farhorizon {

namespace {

using boost::system::error_code;

// A head for Beast to frame the body by. The client's own head is read by ReadRequestHead alone;
// Beast gets the one field that decides where the body ends [RFC 9112, section 6.3], as it was
// established there. Two readers of one head could disagree about the end of the body, and part of
// it could pass for a request (section 11.2).
std::string FramingHead(const HttpRequest& request) {
  return "POST / HTTP/1.1\r\n" +
         (request.chunked ? std::string("Transfer-Encoding: chunked")
                          : "Content-Length: " + std::to_string(*request.content_length)) +
         "\r\n\r\n";
}

// Whether a field of the trailers is folded over two lines, which Beast takes.
//
// consumed: what it took last of a chunked body, at its end. It takes the last chunk's line and the
// trailers at once, and no line of the trailers could be that of the last chunk: each has a colon,
// or begins with a blank.
bool HasFoldedTrailer(std::string_view consumed) {
  while (consumed.size() >= 2) {
    consumed.remove_suffix(2);  // CR LF
    const std::size_t before = consumed.rfind("\r\n");
    const std::string_view line =
        consumed.substr(before == std::string_view::npos ? 0 : before + 2);
    if (!line.empty() && (line[0] == ' ' || line[0] == '\t')) return true;
    if (!line.empty() && line.find_first_not_of('0') == std::min(line.find(';'), line.npos)) {
      return false;
    }
    if (before == std::string_view::npos) return false;
    consumed = consumed.substr(0, before + 2);
  }
  return false;
}

}  // namespace

BodyReader::BodyReader(const HttpRequest& request, std::size_t most_head_bytes)
    : chunked_(request.chunked), piece_(kBodyPieceBytes, '\0') {
  parser_.body_limit(std::numeric_limits<std::uint64_t>::max());  // none is 0 in Beast 1.74
  parser_.header_limit(static_cast<std::uint32_t>(most_head_bytes));
  // Beast keeps a reference to the function alone.
  count_extensions_ = [this, most_head_bytes](std::uint64_t, beast::string_view extensions,
                                              error_code& failure) {
    extension_bytes_ += extensions.size();
    if (extension_bytes_ > most_head_bytes) failure = http::error::header_limit;
  };
  parser_.on_chunk_header(count_extensions_);
  error_code failure;
  parser_.put(asio::buffer(FramingHead(request)), failure);
  Check(!failure && parser_.is_header_done(), "Beast reads a head of ours");
}

asio::awaitable<std::string_view> BodyReader::ReadSome(beast::tcp_stream& stream,
                                                       beast::flat_buffer& buffer,
                                                       error_code& failure) {
  parser_.get().body() = {piece_.data(), piece_.size(), true};
  for (;;) {
    const auto have = buffer.cdata();
    const std::string_view text(static_cast<const char*>(have.data()), have.size());
    failure = http::error::need_more;
    if (!text.empty()) {
      failure = {};
      const std::size_t used = parser_.put(have, failure);
      const bool ends = chunked_ && !failure && parser_.is_done();
      if (ends && HasFoldedTrailer(text.substr(0, used))) failure = http::error::bad_value;
      buffer.consume(used);
    }
    if (failure != http::error::need_more) break;
    const std::size_t room = std::min(buffer.max_size() - buffer.size(), kBodyPieceBytes);
    failure = {};
    if (room == 0) failure = http::error::buffer_overflow;
    if (failure) break;
    buffer.commit(co_await stream.async_read_some(buffer.prepare(room), Into(failure)));
    if (failure) break;
  }
  if (failure == http::error::need_buffer) failure = {};
  const std::size_t size = piece_.size() - parser_.get().body().size;
  received_ += static_cast<std::int64_t>(size);
  co_return std::string_view(piece_.data(), size);
}

Problem ProblemOfBody(const error_code& failure) {
  // Beast keeps a chunk's head and the trailers in the buffer until they are whole.
  if (failure == http::error::header_limit || failure == http::error::buffer_overflow) {
    return {"head-too-large", "the body has too many chunk extensions or trailers"};
  }
  return {"bad-request", "the body is broken off or ill framed"};
}

}  // namespace farhorizon
