#pragma once

// The one door through which Boost comes in. With g++ 12 and C++20 Boost 1.74's awaitable.hpp uses
// std::exchange without <utility>, so that has to come first.
#include <utility>

#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

namespace farhorizon {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

/// For a wait of a coroutine whose error goes to `failure`.
inline auto Into(boost::system::error_code& failure) {
  return asio::redirect_error(asio::use_awaitable, failure);
}

}  // namespace farhorizon
