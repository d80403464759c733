#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "service/asio.h"
#include "service/handlers/http_message.h"
#include "service/handlers/problem.h"

namespace farhorizon {

/// As much of a body as is read at once.
constexpr std::size_t kBodyPieceBytes = 65536;

/// Takes the body of a request out of its connection, piece by piece, as the head framed it.
///
/// Bounded like the head are all chunk extensions of a body together, and its trailers; both are
/// skipped. A trailer that is folded over two lines is refused, as it is in a head.
class BodyReader {
 public:
  /// most_head_bytes: as of ServerOptions.
  BodyReader(const HttpRequest& request, std::size_t most_head_bytes);
  BodyReader(const BodyReader&) = delete;
  BodyReader& operator=(const BodyReader&) = delete;

  [[nodiscard]] bool done() const { return parser_.is_done(); }
  /// Bytes of the body so far.
  [[nodiscard]] std::int64_t received() const { return received_; }

  /// The next bytes of the body, possibly none. buffer: what of the connection was read already.
  /// failure: set where the connection ended or the framing is broken; ProblemOfBody says which.
  /// Requires: not done(); the piece is used before the next call.
  asio::awaitable<std::string_view> ReadSome(beast::tcp_stream& stream, beast::flat_buffer& buffer,
                                             boost::system::error_code& failure);

 private:
  bool chunked_;
  http::request_parser<http::buffer_body> parser_;
  std::string piece_;
  std::size_t extension_bytes_ = 0;
  std::function<void(std::uint64_t, beast::string_view, boost::system::error_code&)>
      count_extensions_;
  std::int64_t received_ = 0;
};

/// What a failure of ReadSome answers.
Problem ProblemOfBody(const boost::system::error_code& failure);

}  // namespace farhorizon
